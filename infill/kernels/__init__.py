"""Compiled loops and nothing else: the only package that imports numba."""
