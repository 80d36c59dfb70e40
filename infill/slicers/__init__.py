"""Projects for slicers: a part and its infill in one 3MF, with settings; and what a slicer will do with a file."""
