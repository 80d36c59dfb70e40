"""Volumes in and out: medical images, slices, label tables."""
