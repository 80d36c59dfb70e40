"""Compiled loops: the only package that imports numba."""
