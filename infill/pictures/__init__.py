"""Previews without a display."""
