"""Projects for slicers: a part and its infill as 3MF, and the doctor that reads them as slicers do."""
