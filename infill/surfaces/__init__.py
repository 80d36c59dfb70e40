"""From a field to triangles, to levels of the right volume, and to meshes in good order."""
