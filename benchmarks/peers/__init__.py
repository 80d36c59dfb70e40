"""Other smoothing methods, to be measured beside ours."""
