"""Shared by all rooms: errors, compiled kernels, definitions' base class, tables, whole files."""
