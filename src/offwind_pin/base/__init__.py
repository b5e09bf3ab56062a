"""Shared by all rooms: errors, compiled kernels, base class of definitions, tables, files."""
