"""A system and its equations of motion."""
