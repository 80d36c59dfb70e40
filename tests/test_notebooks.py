"""The notebooks run from their first cell to their last in an empty folder, and each of their steps shows a picture."""

from __future__ import annotations

import base64
import json
import re
import subprocess
import sys
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

NOTEBOOKS = sorted((Path(__file__).resolve().parents[1] / "examples" / "notebooks").glob("*.ipynb"))
PRINTED = {
    "make": r"(1\d{3}) mm³, closed: True\n",
    "smooth": r"volume [+-]0\.0\d%, problems: \[\]\n",
    "fill": r"density (19\.[5-9]|20\.[0-5])%, wall 1\.2 mm\n",
    "refill": r"infill -1[34]% of its time\nnothing else changed: True\n",
}
# In a process of its own, as Jupyter does it: the loop of its client warns, on Windows for one.
RUN = """
import sys
import nbformat
from nbclient import NotebookClient
notebook = nbformat.read(sys.argv[1], as_version=4)
NotebookClient(notebook, timeout=1200, kernel_name="python3").execute(cwd=".")
nbformat.write(notebook, "done.ipynb")
"""


def read_cells(path: Path, kind: str) -> dict[str, dict[str, Any]]:
    """Return the cells of a kind by their names."""
    notebook = json.loads(path.read_text(encoding="utf-8"))
    return {cell["id"]: cell for cell in notebook["cells"] if cell["cell_type"] == kind}


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_stored_without_what_it_printed(path: Path) -> None:
    nbformat = pytest.importorskip("nbformat")
    nbformat.validate(nbformat.read(path, as_version=4))
    assert path.stat().st_size < 20_000
    for cell in read_cells(path, "code").values():
        assert cell["outputs"] == []
        assert cell["execution_count"] is None


@pytest.mark.longest
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_and_shows_pictures(path: Path, tmp_path: Path) -> None:
    pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    done = subprocess.run(
        [sys.executable, "-c", RUN, path], cwd=tmp_path, capture_output=True, encoding="utf-8", check=False
    )
    assert done.returncode == 0, done.stderr
    cells = read_cells(tmp_path / "done.ipynb", "code")
    assert list(cells) == list(PRINTED)
    for name, cell in cells.items():
        printed = "".join("".join(output["text"]) for output in cell["outputs"] if output.get("name") == "stdout")
        assert re.fullmatch(PRINTED[name], printed), printed
        (shown,) = (
            output["data"]["image/png"] for output in cell["outputs"] if output["output_type"] == "execute_result"
        )
        picture = Image.open(BytesIO(base64.b64decode("".join(shown))))
        assert min(picture.size) > 300
        assert len(picture.convert("RGB").getcolors(1 << 24)) > 100
