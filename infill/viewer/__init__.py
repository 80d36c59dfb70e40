"""Surfaces and prints as bytes for a browser, and as one page that needs nothing else."""
