"""Suffixes by which a file given to the wrong command is recognised."""

MESHES = (".stl", ".3mf", ".obj", ".ply", ".off", ".glb", ".gltf")
PRINTS = (".gcode", ".bgcode", ".gco")
