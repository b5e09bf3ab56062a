"""Springs and dashpots along the pile."""
