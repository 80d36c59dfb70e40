"""Families of centre lines that never cross: one small module per idea."""
