"""The objects of a 3MF stay objects when it is filled, with their names, colours, skins and voids."""

from __future__ import annotations

import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from made_shapes import box, together, union
from test_command_line import run

from infill import Surface, check, read_mesh
from infill.formats.parts import Part
from infill.formats.threemf import write_3mf_parts
from infill.formats.threemf_reading import FileObject, read_objects
from infill.lattices.objects import divide_by_objects
from infill.meshes.merging import surface_of

pytestmark = pytest.mark.usefixtures("coarse_grids")

RED, BLUE = (1.0, 0.0, 0.0), (0.0, 0.2, 1.0)
Place = tuple[float, float, float]


def cube(side: float, at: Place) -> trimesh.Trimesh:
    return box(side, side, side, at)


def hollow(*places: Place, skin: trimesh.Trimesh | None = None) -> Surface:
    """Cubes of 10 mm with a void of 4 mm in each; their skins may be another mesh."""
    skins = [cube(10, at) for at in places] if skin is None else [skin]
    voids = [cube(4, at) for at in places]
    for each in voids:
        each.invert()
    return surface_of(together(*voids, *skins))


def objects_of(*places: Place) -> tuple[Surface, list[FileObject]]:
    """The cubes as a part, and as objects of a file."""
    named = [FileObject(name=f"cube {i}", colour=(RED, BLUE)[i % 2], triangles=12) for i in range(len(places))]
    return surface_of(together(*(cube(10, at) for at in places))), named


@pytest.mark.parametrize("gap", [1e-3, 0.0, 25.0], ids=["near", "touching", "apart"])
def test_each_object_takes_back_its_skin_and_its_voids(gap: float) -> None:
    places = [(0, 0, 0), (10 + gap, 0, 0), (0, 10 + gap, 3)]
    part, objects = objects_of(*places)
    filled = hollow(*places)
    shuffled = replace(filled, faces=np.random.default_rng(3).permutation(filled.faces))
    for surface in (filled, shuffled):
        divided = divide_by_objects(surface, part, objects)
        assert [(each.name, each.colour) for each in divided] == [(each.name, each.colour) for each in objects]
        for each, place in zip(divided, places, strict=True):
            assert each.surface.closed
            assert each.surface.volume == pytest.approx(10**3 - 4**3)
            np.testing.assert_allclose(each.surface.bounds.mean(axis=0), place, atol=1e-9)


def test_objects_that_overlap_become_one_with_the_name_of_the_larger() -> None:
    places = [(0, 0, 0), (8, 0, 0), (40, 0, 0)]
    part, objects = objects_of(*places)
    skin = together(union(cube(10, places[0]), cube(10, places[1]), box(2, 14, 14, (11, 0, 0))), cube(10, places[2]))
    divided = divide_by_objects(hollow(*places, skin=skin), part, objects)
    assert [each.name for each in divided][1:] == ["cube 2"]
    assert divided[0].name in ("cube 0", "cube 1")
    assert all(each.surface.closed and each.surface.volume > 0 for each in divided)
    assert sum(len(each.surface.faces) for each in divided) == len(hollow(*places, skin=skin).faces)


def test_names_and_colours_are_read_from_the_file(tmp_path: Path) -> None:
    path = tmp_path / "a.3mf"
    parts = [
        Part(surface=surface_of(cube(5, (0, 0, 0))), name="grip", colour=RED),
        Part(surface=surface_of(cube(5, (9, 0, 0)))),
    ]
    with path.open("wb") as file:
        write_3mf_parts(parts, file)
    assert read_objects(path) == (
        FileObject(name="grip", colour=RED, triangles=12),
        FileObject(name="", colour=None, triangles=12),
    )
    with zipfile.ZipFile(path) as package:
        texts = {name: package.read(name) for name in package.namelist()}
    for colour, expected in ((b"#0033FF80", BLUE), (b"red", None)):  # with transparency, and none of the notation
        with zipfile.ZipFile(path, "w") as package:
            for name, text in texts.items():
                package.writestr(name, text.replace(b"#FF0000", colour))
        assert read_objects(path)[0].colour == expected


@pytest.mark.slow
@pytest.mark.usefixtures("compiled")
def test_a_filled_3mf_keeps_its_objects(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    named = {"left": (cube(12, (0, 0, 0)), RED), "right": (cube(12, (20, 0, 0)), BLUE)}
    with Path("two.3mf").open("wb") as file:
        write_3mf_parts([Part(surface=surface_of(m), name=name, colour=c) for name, (m, c) in named.items()], file)
    words = ["fill", "two.3mf", "--pattern", "cubic", "--cell", "6", "--line-width", "1", "--voxel", "0.7"]
    done = run(*words, "-o", "filled.3mf", "-o", "filled.stl")
    assert done.exit_code == 0, done.stderr
    assert "objects" in done.stderr
    assert "2 in the file, 2 in the result" in done.stderr
    written = read_objects(Path("filled.3mf"))
    assert [(each.name, each.colour) for each in written] == [(name, colour) for name, (_, colour) in named.items()]
    assert read_mesh("filled.3mf").volume == pytest.approx(read_mesh("filled.stl").volume, rel=1e-6)
    assert len(read_mesh("filled.3mf").faces) == len(read_mesh("filled.stl").faces)
    assert check("filled.3mf").printable
    alone = run(*words, "-o", "filled.stl", "--force")
    assert "objects" not in alone.stderr  # an STL has none
