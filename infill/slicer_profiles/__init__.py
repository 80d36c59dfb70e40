"""Print profiles of installed slicers, and the post-processing line in them that runs ``infill refill``."""
