"""The comparison helpers can fail."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from shapes import assert_printable


def test_a_box_is_printable() -> None:
    assert_printable(trimesh.creation.box())


@pytest.mark.parametrize("harm", ["hole", "inside out", "one face turned"])
def test_a_harmed_box_is_not_printable(harm: str) -> None:
    mesh = trimesh.creation.box()
    faces = mesh.faces.copy()
    if harm == "hole":
        faces = faces[1:]
    elif harm == "inside out":
        faces = faces[:, ::-1]
    else:
        faces[0] = faces[0, ::-1]
    with pytest.raises(AssertionError):
        assert_printable(trimesh.Trimesh(mesh.vertices, np.ascontiguousarray(faces), process=False))
