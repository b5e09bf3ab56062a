"""One load case as data: schema, run, summary."""
