"""Ground motion: records and what they do at the base."""
