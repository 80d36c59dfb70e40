"""The page docs/paper.md, from what the scripts wrote."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from pathlib import Path

from examples.paper.entry import Entry, load
from infill.files.whole_files import atomic_file

HEAD = """# The paper, reproduced

Wang, Li, Choi, Lee, Kim, *Fast and accurate smoothing method using a modified Allen–Cahn equation*, Computer-Aided
Design 120 (2020) 102804, figure by figure: the paper's value, that of this package (column *ours*), and that of a
peer if there is one. This page and its pictures are written by `make paper` (`python -m examples.paper`); each part
is one script of [examples/paper](../examples/paper), and reading them in order is a course in the method. See also
[the mathematics](design/mathematics.md) and [smoothing, measured](smoothing.md).

**How to read it.** Lengths have no unit and h is the cell size, as in the paper; Δt = h²/7. "Picture only": the
paper shows this and prints no number; "–": it has nothing comparable as far as we know, or there is no peer. Figs.
1, 15 and 16 show no result. "Across" and "up" in pictures of solids are lengths in the plane of the picture. *Choi*
is Choi et al. 2017, the modified Cahn–Hilliard smoother that the paper compares itself with. Of that paper we had
only the abstract: a linearly stable splitting, solved by a Fourier spectral method. We built the standard method of
that name (`benchmarks/peers/cahn_hilliard.py`). Times are from one run.

**Misprints and gaps in our copy of the text, and how we read them.**

* *The stepped pyramid's upper bounds* are printed as 1 − h(187.5 − 3m) and so on, which leaves every layer empty.
  Read as −1 + h(…), which gives a pyramid.
* *Eq. (16)*, the "MSE of volume", is missing. The mean of (φⁿ − f)² over all cells is near the two values of Table
  1 that we have, and is nearly proportional to the vertices, as all six printed values are. No reading gives the
  values of Fig. 13, which are far larger; three are compared there.
* *The Neumann rows in three dimensions* are read as the plain six faces.
* *λ* has a unit: only λh² matters. λ = 100 is 0.01 at h = 0.01, 0.098 at h = 1/32 and 1 at h = 0.1.
* *Table 1* prints times proportional to the vertices of each shape, for both methods. A method that sweeps the
  whole grid takes the same time for every shape, so either the grids differ or the time counts something else. Of
  its rows we have the quotients by the number of vertices, and two values of the MSE.
* *Models, noisy meshes, fonts and scans* of the paper are not published; our substitutes are named where they appear.
"""

FOOT = """
## Credits

The pictures show models that are not part of this project: the bunny and the armadillo are from the Stanford 3D
Scanning Repository, the horse from the Georgia Tech Large Geometric Models Archive, the pig from the CGAL demo data,
the mandible from MyoSim (Apache-2.0), the bones of the foot from BodyParts3D, © The Database Center for Life Science
(CC BY-SA 2.1 Japan), the skull from OpenForge (CC BY-SA 3.0). The pictures of the foot and the skull (`fig19.png`)
are under CC BY-SA 3.0.
"""


@dataclass(frozen=True, kw_only=True)
class Script:
    """A script of this folder, and the entry it writes."""

    entry: str
    module: str


SCRIPTS = (
    Script(entry="fig02", module="fig02_fidelity"),
    Script(entry="fig03", module="fig03_from_another_shape"),
    Script(entry="fig04", module="fig04_interface"),
    Script(entry="fig05", module="fig05_digits"),
    Script(entry="fig06", module="fig06_silhouettes"),
    Script(entry="fig07_08", module="fig07_08_solids"),
    Script(entry="fig09_10", module="fig09_10_noise"),
    Script(entry="fig11", module="fig11_morphologies"),
    Script(entry="fig12_13", module="fig12_13_models"),
    Script(entry="fig14", module="fig14_cahn_hilliard"),
    Script(entry="table1", module="table1_cost"),
    Script(entry="table2", module="table2_mesh_filters"),
    Script(entry="fig17_18", module="fig17_18_patterns"),
    Script(entry="fig19", module="fig19_bones"),
    Script(entry="walls", module="walls"),
)


def write(docs: Path) -> Path:
    """Write paper.md from the entries in docs/paper, and return its path."""
    parts = [HEAD]
    for script in SCRIPTS:
        if (docs / "paper" / f"{script.entry}.json").is_file():
            parts.append(section(load(docs / "paper", script.entry), script.module))
        else:
            parts.append(f"\n## {script.entry}\n\nNot run: it takes models that were not there.\n")
    page = docs / "paper.md"
    with atomic_file(page) as file:
        file.write(("".join(parts) + FOOT).encode())
    return page


def section(entry: Entry, module: str) -> str:
    """Return the part of the page that shows an entry."""
    lines = "\n".join(
        f"| {bars(row.what)} | {bars(row.paper)} | {bars(row.ours)} | {bars(row.peer)} |" for row in entry.rows
    )
    return f"""
## {entry.title}

{wrapped(f"{entry.setting} ([script](../examples/paper/{module}.py))")}

![{entry.title}](paper/{entry.name}.png)

| | paper | ours | peer |
|---|---|---|---|
{lines}

{wrapped(entry.sentence)}
"""


def wrapped(text: str) -> str:
    """Return text in lines of the width of the other pages."""
    return textwrap.fill(text, width=118, break_long_words=False, break_on_hyphens=False)


def bars(text: str) -> str:
    r"""Return text for a cell of a table.

    >>> bars("|φ − f|")
    '\\|φ − f\\|'
    """
    return text.replace("|", r"\|")
