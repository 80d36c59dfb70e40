"""From a field to triangles, levels of the right volume, and triangles put in order."""
