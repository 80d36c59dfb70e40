"""Families of paths that cover a region."""
