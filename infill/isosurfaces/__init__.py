"""From a field to triangles: marching cubes, dense and sparse, and the level of the right volume."""
