"""The equation: its specification, the methods that solve it, the sparse field, refinement, the profile."""
