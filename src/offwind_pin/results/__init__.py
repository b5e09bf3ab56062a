"""Datasets, blocks, reading."""
