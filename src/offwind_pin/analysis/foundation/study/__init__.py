"""What a turbine's soil does, as data."""
