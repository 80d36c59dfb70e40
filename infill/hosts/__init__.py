"""phasefill inside of other programs: each loads its own module here, and nothing else does."""
