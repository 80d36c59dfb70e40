"""Benchmarks: each figure of speed, paired with its peer in one run."""
