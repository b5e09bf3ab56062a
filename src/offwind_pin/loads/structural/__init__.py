"""Structural damping that acts between the structure and the inertial frame."""
