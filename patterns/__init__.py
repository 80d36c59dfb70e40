"""Infill patterns: lines in a plane at height z, in millimetres.

Needs numpy and shapely, and loads them only when lines are asked for. Knows no grid.

>>> from patterns import PATTERNS
>>> sorted(PATTERNS.built_in)
['concentric-heart', 'honeycomb', 'zigzag']
"""

from patterns.errors import PatternError
from patterns.heart import ConcentricHeart
from patterns.honeycomb import Honeycomb
from patterns.protocol import Parameter, Pattern, check_parameters, in_degrees, lacking, parameter, parameters
from patterns.registry import PatternWarning, Registry
from patterns.zigzag import Zigzag

PATTERNS = Registry((ConcentricHeart, Zigzag, Honeycomb))

__all__ = [
    "PATTERNS",
    "ConcentricHeart",
    "Honeycomb",
    "Parameter",
    "Pattern",
    "PatternError",
    "PatternWarning",
    "Registry",
    "Zigzag",
    "check_parameters",
    "in_degrees",
    "lacking",
    "parameter",
    "parameters",
]
