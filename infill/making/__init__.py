"""make: the paper's block of infill."""
