"""`fill`: a part and its infill as one solid."""
