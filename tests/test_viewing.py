"""Pages as files: `infill view`, `--preview view.html`, `save` and `show`, and what a page holds of a print."""

from __future__ import annotations

import base64
import json
import re
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from test_architecture import modules_after
from test_command_line import one_line_error, run, usage_error
from test_viewer_packing import surface_of, unfold, unpack

from infill import make, read_mesh, refill, smooth_volume
from infill.formats.file_objects import split_objects
from infill.formats.mesh_files import save
from infill.formats.parts import Part
from infill.formats.threemf import write_3mf_parts
from infill.planner.layer_speeds import drawn_speeds, layer_speeds
from infill.samples.plate_print import plate_print
from infill.viewer import viewable
from infill.viewer.packing import STEPS
from infill.viewer.print_page import pack_print, print_page, thin_out
from tests.made_shapes import ball, box

TITLE = re.compile(r"<title>(.*?)</title>")


def data_of(page: str, number: int = 0) -> bytes:
    """Return the data of a view, as the page unpacks them."""
    text = re.search(rf'id="data{number}">([^<]*)<', page)
    assert text is not None
    return zlib.decompress(base64.b64decode(text[1]))


def rows_of(page: str) -> dict[str, str]:
    return dict(re.findall(r"<th scope=row>(\w[^<]*)</th><td>([^<]*)</td>", page))


@pytest.fixture
def part(tmp_path: Path) -> Path:
    return save(surface_of(box(30, 20, 10)), tmp_path / "part.stl")


@pytest.fixture(scope="module")
def gcode(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("print") / "print.gcode"
    path.write_bytes(plate_print())
    return path


# --- meshes ----------------------------------------------------------------------------------------------


def test_view_writes_a_page_with_the_mesh_and_its_numbers(part: Path, tmp_path: Path) -> None:
    done = run("view", part, "-o", tmp_path / "view.html")
    assert done.exit_code == 0, done.output
    assert "wrote" in done.stderr
    page = (tmp_path / "view.html").read_text(encoding="utf-8")
    [(name, (positions, faces, _))] = unpack(data_of(page)).items()
    assert name == "part"
    mesh = trimesh.Trimesh(positions, faces)
    assert mesh.is_volume
    assert mesh.volume == pytest.approx(6000, rel=1e-4)
    assert rows_of(page) | {"size": "30 x 20 x 10 mm", "volume": "6,000 mm³", "watertight": "yes"} == rows_of(page)


def test_objects_of_a_3mf_are_shown_apart(tmp_path: Path) -> None:
    path = tmp_path / "plate.3mf"
    surfaces = [surface_of(box(5, 5, 5 + number, (9 * number, 0, 0))) for number in range(3)]
    parts = [
        Part(surface=surface, name=name, colour=colour)
        for surface, name, colour in zip(surfaces, ("lid", "", "lid"), (None, (1.0, 0, 0), None), strict=True)
    ]
    with path.open("wb") as file:
        write_3mf_parts(parts, file)
    objects = split_objects(read_mesh(path), path)
    assert len({part.name for part in objects}) == 3
    assert objects[0].name == "lid"
    assert [part.surface.volume for part in objects] == pytest.approx([125, 150, 175])
    assert objects[1].colour == (1.0, 0, 0)
    assert run("view", path, "-o", tmp_path / "plate.html").exit_code == 0
    assert "3 surfaces, 36 triangles" in (tmp_path / "plate.html").read_text(encoding="utf-8")


def test_a_page_asks_nobody_for_anything(part: Path, tmp_path: Path) -> None:
    """Its policy forbids it, and no address is in it that a browser would load."""
    run("view", part, "-o", tmp_path / "view.html")
    page = (tmp_path / "view.html").read_text(encoding="utf-8")
    assert "default-src 'none'" in page
    assert not re.search(
        r"<(?:link|img|iframe|script)[^>]*(?:src|href)=[\"']?(?!\"?data:)[\"'\\w]", page.split("<script>")[0]
    )
    assert not re.search(r"<script[^>]+src=", page)


def test_names_cannot_become_part_of_the_page(tmp_path: Path) -> None:
    name = "<img src=x onerror=alert(1)>&.stl"
    save(surface_of(box(1, 2, 3)), tmp_path / "part.stl").rename(tmp_path / name)
    assert run("view", tmp_path / name, "-o", tmp_path / "view.html").exit_code == 0
    page = (tmp_path / "view.html").read_text(encoding="utf-8")
    assert "<img src=x" not in page
    assert "&lt;img src=x onerror=alert(1)&gt;&amp;.stl" in page


def test_view_opens_the_browser_unless_it_is_told_not_to(
    part: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert run("view", part, "-o", tmp_path / "view.html", "-q").stderr == ""
    done = run("view", part, "--no-browser")
    assert not opened
    assert Path(re.search(r"wrote (\S+)", done.stderr)[1]).read_text(encoding="utf-8").startswith("<!doctype html>")
    assert run("view", part).exit_code == 0
    assert len(opened) == 1
    assert opened[0].startswith("file:///")


def test_view_refuses_other_names_and_files_in_one_line(part: Path, tmp_path: Path) -> None:
    usage_error(run("view", part, "-o", tmp_path / "view.png"), r"-o|--output is 'view.png'")
    (tmp_path / "view.html").write_text("mine")
    one_line_error(run("view", part, "-o", tmp_path / "view.html"), "exists")
    assert (tmp_path / "view.html").read_text() == "mine"
    assert run("view", part, "-o", tmp_path / "view.html", "--force").exit_code == 0
    one_line_error(run("view", tmp_path / "nothing.stl", "-o", tmp_path / "other.html"), "there is no file")
    (tmp_path / "bad.gcode").write_bytes(b"\x89PNG\r\n\x1a\nnothing")
    one_line_error(run("view", tmp_path / "bad.gcode", "-o", tmp_path / "other.html"), "has no moves")
    assert not (tmp_path / "other.html").exists()


# --- results ---------------------------------------------------------------------------------------------


def test_a_block_saves_shows_and_repeats_itself(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    result = make("honeycomb", size=20, height=3)
    page = result.save(tmp_path / "view.html").read_text(encoding="utf-8")
    assert page == result.page()
    assert TITLE.search(page)[1] == "honeycomb"
    assert len(unpack(data_of(page))["block"][1]) == result.report["triangles"]
    assert rows_of(page)["density"] == f"{result.report['density']:.1%}"
    shown = result.show()
    assert shown.read_text(encoding="utf-8") == page
    assert opened == [shown.as_uri()]
    monkeypatch.setattr(viewable, "LARGEST_EMBEDDED", 1000)
    assert result._repr_html_() is None
    assert result._repr_png_() is not None


@pytest.mark.long
@pytest.mark.parametrize("command", ["make", "smooth", "fill"])
def test_a_preview_may_be_a_page(command: str, part: Path, tmp_path: Path) -> None:
    save(surface_of(ball(8.0, 3)), tmp_path / "ball.stl")
    words: dict[str, list[Any]] = {
        "make": ["zigzag", "--size", "20", "--height", "3"],
        "smooth": [tmp_path / "ball.stl", "--voxel", "0.5"],
        "fill": [part, "--pattern", "grid", "--voxel", "0.5"],
    }
    done = run(command, *words[command], "--preview", tmp_path / "view.html", "--json", "-q")
    assert done.exit_code == 0, done.output
    report = json.loads(done.stdout)
    page = (tmp_path / "view.html").read_text(encoding="utf-8")
    assert rows_of(page)["triangles"] == f"{report['triangles']:,}"
    assert json.loads(data_of(page)[8:].split(b"]}")[0] + b"]}")["surfaces"][0]["triangles"] == report["triangles"]
    usage_error_or_fine = run(command, *words[command], "--preview", tmp_path / "view.jpg")
    one_line_error(usage_error_or_fine, "ends in .png or .html")


def test_a_smoothed_surface_stands_beside_that_before_which_is_hidden() -> None:
    solid = (np.indices((20, 20, 20)) - 9.5) ** 2
    result = smooth_volume(solid.sum(axis=0) < 50)
    page = result.page("ball")
    assert list(unpack(data_of(page))) == ["solid", "before"]
    assert '"hidden": ["before"]' in page
    assert rows_of(page)["triangles"] == f"{result.report['triangles']:,}"


def test_a_page_is_cut_open_in_the_browser(part: Path, tmp_path: Path) -> None:
    usage_error(run("fill", part, "--preview", tmp_path / "view.html", "--cut", "z=3"), "leave --cut out")


# --- prints ----------------------------------------------------------------------------------------------


def read_lines(data: bytes) -> tuple[dict, NDArray, NDArray]:
    """Read a packed print, by the words at the top of print_page.py and nothing else."""
    assert data[:4] == b"IFP1"
    end = 8 + int.from_bytes(data[4:8], "little")
    header, body = json.loads(data[8:end]), data[end:]
    offset, size = header["places"]
    coded = unfold(body[offset : offset + size], 2, 3)
    steps = np.where(coded & 1, -(coded + 1) // 2, coded // 2).cumsum(axis=0) % 2**16
    places = np.array(header["low"]) + np.array(header["size"]) * steps / STEPS
    offset, size = header["speeds"]
    return header, places.reshape(-1, 2, 3), np.frombuffer(body, np.uint8, size, offset)


def test_lines_of_a_print_are_those_of_its_layers(gcode: Path) -> None:
    """The same length in every layer, and the same time, as planned piece by piece."""
    drawn = drawn_speeds(gcode)
    assert (np.diff(drawn.layer) >= 0).all()
    length = np.linalg.norm(drawn.end.astype(float) - drawn.start, axis=1)
    for number in (1, 7, int(drawn.layer.max())):
        layer = layer_speeds(gcode, number)
        pieces = np.linalg.norm(layer.end - layer.start, axis=1)[layer.draws]
        of_layer = drawn.layer == number
        assert length[of_layer].sum() == pytest.approx(pieces.sum(), rel=1e-4)
        seconds = (length / drawn.speed)[of_layer].sum()
        assert seconds == pytest.approx((pieces / layer.speed[layer.draws]).sum(), rel=0.06)  # pieces of 1 mm, not 0.4
        assert of_layer.sum() < 0.7 * layer.draws.sum()
    assert 0.4 < drawn.section / 0.2 < 0.5  # lines 0.45 mm wide in layers of 0.2 mm


def test_a_packed_print_keeps_places_and_speeds(gcode: Path) -> None:
    drawn = drawn_speeds(gcode)
    top = float(drawn.speed.max())
    header, places, speeds = read_lines(pack_print(drawn, top))
    half = np.array(header["size"]) / STEPS / 2 + 1e-6
    assert (np.abs(places[:, 0] - drawn.start) <= half).all()
    assert (np.abs(places[:, 1] - drawn.end) <= half).all()
    assert (np.abs(speeds / 255 * top - drawn.speed) <= top / 255 / 2 + 1e-3).all()
    assert header["height"] == pytest.approx(0.2)
    assert [layer["number"] for layer in header["layers"]] == sorted(set(drawn.layer.tolist()))
    assert all(drawn.layer[layer["start"]] == layer["number"] for layer in header["layers"])


def test_of_a_large_print_some_layers_are_left_out_and_the_page_says_so(
    gcode: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = drawn_speeds(gcode)
    assert set(thin_out(drawn, 3).layer.tolist()) == {n for n in drawn.layer.tolist() if (n - 1) % 3 == 0}
    monkeypatch.setattr("infill.viewer.print_page.MOST_LINES", len(drawn.speed) // 3)
    page = print_page({"print": drawn}, title="x")
    assert "one layer of 4 is in it" in page or "one layer of 3 is in it" in page
    assert len(read_lines(data_of(page))[1]) < len(drawn.speed) / 2


def test_a_refill_shows_before_and_after(gcode: Path, tmp_path: Path) -> None:
    before = drawn_speeds(gcode)
    copy = tmp_path / "print.gcode"
    copy.write_bytes(gcode.read_bytes())
    done = run("refill", copy, "--preview", tmp_path / "view.html", "--json", "-q")  # in place
    assert done.exit_code == 0, done.output
    page = (tmp_path / "view.html").read_text(encoding="utf-8")
    assert re.findall(r"<figcaption>(.*?)</figcaption>", page) == ["before", "refilled"]
    counts = [read_lines(data_of(page, number))[0]["lines"] for number in (0, 1)]
    assert counts == [len(before.speed), len(drawn_speeds(copy).speed)]
    report = json.loads(done.stdout)
    assert rows_of(page)["sections refilled"] == f"{report['sections']['replaced']} of {report['sections']['all']}"
    result = refill(gcode, output=tmp_path / "smooth.gcode")
    assert re.findall(r"<figcaption>(.*?)</figcaption>", result.page()) == ["before", "refilled"]
    assert rows_of(result.page()) == rows_of(page)


def test_view_shows_a_print(gcode: Path, tmp_path: Path) -> None:
    assert run("view", gcode, "-o", tmp_path / "view.html").exit_code == 0
    page = (tmp_path / "view.html").read_text(encoding="utf-8")
    assert TITLE.search(page)[1] == "print.gcode"
    assert read_lines(data_of(page))[0]["lines"] == len(drawn_speeds(gcode).speed)


# --- what it costs others --------------------------------------------------------------------------------


@pytest.mark.slow
def test_commands_without_a_page_load_nothing_of_it(tmp_path: Path) -> None:
    code = f"from infill import make; make('honeycomb', size=20, height=2).save({str(tmp_path / 'x.stl')!r})"
    brought = modules_after(code)
    assert "infill.viewer.viewable" in brought
    assert not {"infill.viewer.page", "infill.viewer.packing", "webbrowser"} & brought
