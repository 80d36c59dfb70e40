"""Results of simulations: numbers at points, from files that may hold several arrays."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from infill.errors import FormatError
from infill.files.array_names import SIMULATIONS
from infill.files.broken import require_readable
from infill.formats.frd import read_frd
from infill.formats.simulated_values import SimulatedValues
from infill.formats.vtu import read_vtu

READERS = {".vtu": read_vtu, ".frd": read_frd}


def read_simulation(path: Path, name: str | None = None) -> SimulatedValues:
    """Read an array of results; `name` chooses one of several.

    Raises
    ------
    FormatError
        If there is no such file or array, the file is broken, or it holds numbers that are not finite.
    """
    source = require_readable(path, SIMULATIONS, "results of a simulation")
    results = READERS[source.suffix.lower()](source, name)
    if not np.isfinite(results.points).all() or not np.isfinite(results.values).all():
        raise FormatError(f"{source} holds numbers that are not finite; see if the simulation converged")
    return results
