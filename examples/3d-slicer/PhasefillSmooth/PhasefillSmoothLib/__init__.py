"""What the module PhasefillSmooth of 3D Slicer does, apart from its panel."""
