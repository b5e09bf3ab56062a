"""Keys of a case file."""
