"""Drain holes: columns, clearance, branches, places."""
