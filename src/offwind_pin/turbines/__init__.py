"""Turbine definitions: typed models, the shipped library, the reader."""
