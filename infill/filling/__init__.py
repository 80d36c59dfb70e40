"""Infill as paths: corners rounded, regions covered, a sliced print refilled."""
