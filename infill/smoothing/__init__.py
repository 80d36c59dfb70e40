"""Scans, meshes and points to smooth closed meshes."""
