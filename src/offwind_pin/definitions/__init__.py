"""What a user writes: one frozen, typed class per concept, and the reader of turbine files."""
