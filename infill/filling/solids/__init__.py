"""A part and its infill as one solid: voids beside the walls of a pattern, taken out of the part."""
