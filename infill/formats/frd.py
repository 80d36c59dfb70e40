"""Results of CalculiX, .frd as text: numbers at the nodes of a mesh, step after step.

Source: G. Dhondt, K. Wittig, "CalculiX GraphiX user's manual", chapter "Result format". Blocks have a head, records
of fixed columns, and a last record " -3":

    2C     nodes: " -1", the number of a node in 5 or 10 columns, and x, y, z in 12 columns each
    100C   results: " -4" and their name, " -5" and the name of each component, then " -1", a node and up to six
           numbers in 12 columns each; " -2" before more of them
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np

from infill.arrays import Floats
from infill.errors import FormatError
from infill.files.broken import SMALLER_VOLUME_ADVICE, wrap_reader_errors
from infill.formats.simulated_values import SimulatedValues, choose_array, reduce_components
from infill.machine import require_memory

KEY = 3  # columns of the key of a record
WORD, MOST_NUMBERS = 12, 6  # columns of a number, and numbers in a record
NODE_COLUMNS = {0: 5, 1: 10}  # of the number of a node, by the format of a block; from 2 on, it is binary
FORMAT = slice(73, 75)  # in the head of a block
NAME = slice(5, 13)  # of a result, or a component
DERIVED = slice(33, 38)  # in the record of a component: 1 if it is not stored
STRESS = "STRESS"  # chosen if it is there
LINE_BYTES = 60  # of memory for each, besides its text
AXES = 3


@dataclass(kw_only=True)
class _Block:
    """Results of a step: their name, those of their components, and the lines of their numbers."""

    name: str
    columns: int
    components: list[str] = field(default_factory=list)
    begin: int = 0
    end: int = 0


def read_frd(path: Path, name: str | None = None) -> SimulatedValues:
    """Read results at the nodes of a mesh, of the last step that has them.

    Parameters
    ----------
    path : Path
    name : str, optional
        Of results, such as "STRESS", or of a component, such as "SXX". By default, "STRESS", or the only results.

    Raises
    ------
    FormatError
        If the file is broken or binary, or has no such results.
    """
    with wrap_reader_errors(path):
        require_memory(2 * path.stat().st_size, None, SMALLER_VOLUME_ADVICE)
        lines = path.read_text(encoding="latin-1").splitlines()
        require_memory(2 * path.stat().st_size + LINE_BYTES * len(lines), None, SMALLER_VOLUME_ADVICE)
        mesh, blocks = _find_blocks(path, lines)
        names = [block.name for block in blocks]
        if name is None and STRESS in names:
            name = STRESS
        with_part = [] if name in names else [block for block in blocks if name in block.components]
        block = with_part[-1] if with_part else blocks[choose_array(path, names, name)]
        places = dict(zip(*_read_records(lines, mesh, AXES), strict=True))
        nodes, numbers = _read_records(lines, block, len(block.components))
        chosen = numbers[:, [block.components.index(str(name))]] if with_part else numbers
        return SimulatedValues(
            points=np.array([places[node] for node in nodes]).reshape(-1, AXES),
            values=reduce_components(path, block.name, chosen),
        )


def _find_blocks(path: Path, lines: list[str]) -> tuple[_Block, list[_Block]]:
    """Return the block of the nodes, and those of all results."""
    mesh: _Block | None = None
    blocks: list[_Block] = []
    current: _Block | None = None
    for number, line in enumerate(lines):
        key = line[:KEY]
        if key == " -1":
            if current is not None and not current.begin:
                current.begin = number
        elif key == " -4" and current is not None:
            current.name = line[NAME].strip()
        elif key == " -5" and current is not None:
            if line[DERIVED].strip() != "1":
                current.components.append(line[NAME].strip())
        elif key == " -3":
            if current is not None:
                current.end = number
            current = None
        elif line[4:6] == "2C" or line[2:6] == "100C":
            columns = NODE_COLUMNS.get(int(line[FORMAT]))
            if columns is None:
                raise FormatError(f"{path} is binary; let CalculiX write its results as text")
            current = _Block(name="", columns=columns)
            if line[4:6] == "2C":
                mesh = current
            else:
                blocks.append(current)
    if mesh is None or not mesh.end or not mesh.begin:
        raise ValueError("no nodes")
    if any(not block.end for block in blocks):
        raise EOFError("results without an end: it is cut off")
    return mesh, [block for block in blocks if block.begin and block.components]


def _read_records(lines: list[str], block: _Block, count: int) -> tuple[list[int], Floats]:
    """Return the numbers of nodes, and `count` numbers at each, (N, count)."""
    first = KEY + block.columns
    cuts = [first + WORD * part for part in range(min(count, MOST_NUMBERS) + 1)]
    columns = [slice(*pair) for pair in pairwise(cuts)]
    nodes: list[int] = []
    rows: list[list[float]] = []
    for line in lines[block.begin : block.end]:
        key = line[:KEY]
        if key == " -1":
            nodes.append(int(line[KEY:first]))
            rows.append([float(line[column]) for column in columns])
        elif key == " -2" and rows:
            rest = min(count - len(rows[-1]), MOST_NUMBERS)
            rows[-1] += [float(line[column]) for column in columns[:rest]]
        else:
            raise ValueError(f"a record that begins with {key!r}")
    return nodes, np.array(rows, dtype=np.float64).reshape(len(nodes), count)
