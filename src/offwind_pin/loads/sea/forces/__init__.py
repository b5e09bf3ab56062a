"""Forces of the water on the members."""
