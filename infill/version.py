"""The version, in one place that every room may look at."""

from __future__ import annotations

__version__ = "0.1.0"
