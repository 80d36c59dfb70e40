"""How a result is connected, how wide and thick it is, what smoothing changed, and whether it is printable."""
