"""A volume of 512³ in chunks: the bits of the whole, in less memory than it takes."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from benchmarks.chunks import THRESHOLD, write
from infill import Volume
from infill.chunks.hashing import hash_surface
from infill.lazy.opening import open_volume
from infill.phasefield.sparse import smooth_bricks
from infill.smoothing.levelling import extract_surface
from infill.smoothing.request import SmoothedInput, SmoothRequest
from infill.smoothing.scans import volume_ways

SIDE = 512
ALLOWED = 2.5  # GiB, of which the chunks at work may take 1.5


@pytest.mark.longest
@pytest.mark.skipif(sys.platform != "linux", reason="the peak of memory is read as Linux counts it")
def test_512_cells_a_side(tmp_path: Path) -> None:
    write(SIDE, tmp_path / "g.zarr")
    words = ["--threshold", str(THRESHOLD), "--smooth", "plain", "--tolerance", "0", "--max-memory", "1.5G"]
    command = [sys.executable, "-m", "infill.cli", "smooth", "g.zarr", *words, "--workers", "2", "--json", "-q"]
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE) as process:
        assert process.stdout is not None
        report = json.loads(process.stdout.read())
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    assert usage.ru_maxrss / 2**20 < ALLOWED
    assert report["chunks"]["count"] >= 8
    assert report["closed"]
    assert report["verdict"]["word"] != "lost"
    request = SmoothRequest(method="plain", tolerance=None)
    values = np.asarray(open_volume(tmp_path / "g.zarr").load().values)
    way = volume_ways(Volume(values=values), request, threshold=THRESHOLD)[0]
    del values
    request = way.request.for_cell(1.0)
    field = smooth_bricks(way.data.data.values, request.smoothing)
    whole = extract_surface(SmoothedInput(smooth_input=way.data, request=request, field=field)).levelled.surface
    assert report["hash"] == hash_surface(whole.vertices, whole.faces)
    assert report["triangles"] == len(whole.faces)
