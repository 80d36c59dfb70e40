"""A drawing as a tile that repeats."""
