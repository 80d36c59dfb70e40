"""What is solid on a grid: stamped patterns, meshes, points and scans turned into cells."""
