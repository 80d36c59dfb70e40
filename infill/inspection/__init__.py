"""What hangs together, how wide, how thick, what smoothing changed, is it printable."""
