"""The studio over HTTP: a real server, asked as its page asks it.

Laws first: nobody but the page gets an answer, nothing that is uploaded ends the server, and the command and the Python
beside a result make its file again.
"""

from __future__ import annotations

import json
import os
import shlex
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from infill import check_project, read_mesh

httpx = pytest.importorskip("httpx")
pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

from studio_client import LAYER, MESH, PATIENCE, Answer, Page, Studio, run_studio  # noqa: E402
from test_3mf_hostile import XMLS, ZIPS, changed  # noqa: E402
from test_3mf_parts import packed  # noqa: E402
from test_broken_files import READERS  # noqa: E402

from infill.studio.guard import Guard  # noqa: E402

CODE = "from infill.cli import main; main()"
TEMPORARY = "infill-studio-"


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A part, a scan, a print, and labels."""
    folder = tmp_path_factory.mktemp("files")
    subprocess.run([sys.executable, "-c", CODE, "sample", "part", "scan", "print", "-q"], cwd=folder, check=True)
    labels = np.zeros((24, 16, 16), np.uint8)
    for number, middle in enumerate((7, 16), 1):
        labels[((np.indices(labels.shape) - np.reshape((middle, 8, 8), (3, 1, 1, 1))) ** 2).sum(axis=0) < 25] = number
    np.save(folder / "labels.npy", labels)
    return folder


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    with run_studio(tmp_path_factory.mktemp("temporary")) as running:
        yield running


@pytest.fixture(scope="module")
def page(studio: Studio) -> Iterator[Page]:
    with studio.page() as opened:
        yield opened


@pytest.fixture(scope="module")
def ids(page: Page, files: Path) -> dict[str, str]:
    """Uploaded files by the kind of each."""
    return {
        name: page.upload(files / name).facts["file"] for name in ("part.stl", "scan.nrrd", "print.gcode", "labels.npy")
    }


def wait_until(holds, seconds: float = 20.0) -> None:
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, "it never came true"
        time.sleep(0.05)


# --- who gets an answer -----------------------------------------------------------------------------------


def raw(studio: Studio, path: str, *, host: str | None = None, method: str = "GET", **headers: str):
    """Ask without a client that would mend the headers."""
    with httpx.Client() as client:
        more = {"host": host or f"127.0.0.1:{studio.port}", **headers}
        return client.request(method, f"http://127.0.0.1:{studio.port}{path}", headers=more)


def test_every_request_needs_the_token(studio: Studio) -> None:
    token = httpx.URL(studio.address).path
    assert raw(studio, f"{token}api/about").status_code == 200
    wrong = f"/{'x' * (len(token) - 2)}/"
    for path in (
        "/",
        "/api/about",
        "/index.html",
        wrong,
        f"{wrong}api/about",
        token.rstrip("/"),
        f"/x{token}api/about",
    ):
        assert raw(studio, path).status_code == 404, path
    assert raw(studio, "/api/pages", method="POST").status_code == 404


def test_a_rebound_name_and_another_page_get_nothing(studio: Studio) -> None:
    about = f"{httpx.URL(studio.address).path}api/about"
    port = studio.port
    for host in (f"localhost:{port}", f"127.0.0.1:{port}"):
        assert raw(studio, about, host=host).status_code == 200
        assert raw(studio, about, host=host, origin=f"http://{host}").status_code == 200
    for host in ("127.0.0.1", f"evil.example:{port}", f"127.0.0.1.evil.example:{port}", f"127.0.0.1:{port + 1}", "x"):
        assert raw(studio, about, host=host).status_code == 403, host
    for origin in ("http://evil.example", f"http://127.0.0.1:{port + 1}", f"https://127.0.0.1:{port}", "null"):
        assert raw(studio, about, origin=origin).status_code == 403, origin


def test_browsers_leave_out_the_usual_port():
    async def nothing(scope, receive, send): ...

    at_80, at_81 = (Guard(app=nothing, token="t", host="127.0.0.1", port=port) for port in (80, 81))
    for host in ("127.0.0.1", "localhost", "[::1]", "127.0.0.1:80", "[::1]:80"):
        assert at_80.is_our_host(host), host
        assert not at_81.is_our_host(host), host
    assert at_81.is_our_host("[::1]:81")
    assert not at_80.is_our_host("evil.example")


def test_answers_carry_the_headers_of_security(studio: Studio) -> None:
    token = httpx.URL(studio.address).path
    for path in (token, f"{token}api/about", f"{token}nothing", "/"):
        headers = raw(studio, path).headers
        assert "default-src 'self'" in headers["content-security-policy"]
        assert "frame-ancestors 'none'" in headers["content-security-policy"]
        assert headers["referrer-policy"] == "no-referrer"
        assert headers["x-content-type-options"] == "nosniff"
    assert "server" not in headers


def test_files_of_the_machine_have_no_address(studio: Studio) -> None:
    token = httpx.URL(studio.address).path
    for path in (
        "../app.py",
        "%2e%2e/app.py",
        "..%2fapp.py",
        "app.py",
        "/etc/passwd",
        "%2Fetc%2Fpasswd",
        "bundle/../app.py",
    ):
        assert raw(studio, f"{token}{path}").status_code == 404, path


# --- what it offers -----------------------------------------------------------------------------------------


def test_about_has_every_product_with_its_options(studio: Studio) -> None:
    with studio.client() as client:
        about = client.get("api/about").json()
    assert set(about["products"]) == {"fill", "make", "smooth", "labels", "refill", "motion"}
    assert about["file"] is None
    for options in about["products"].values():
        for option in options:
            assert option["help"]
            assert option["kind"] in ("number", "whole", "flag", "choice", "text")
            assert (option["kind"] == "choice") == bool(option["choices"])
            assert option["flag"].startswith("--")
    density = next(option for option in about["products"]["fill"] if option["key"] == "density")
    assert (density["least"], density["most"], density["default_text"]) == (0.05, 0.6, "20%")


def test_every_pattern_has_a_picture_and_its_products(studio: Studio) -> None:
    from patterns import PATTERNS

    with studio.client() as client:
        patterns = {each["name"]: each for each in client.get("api/patterns").json()}
        assert set(patterns) == set(PATTERNS.built_in)
        for name in ("gyroid", "honeycomb", "lightning"):
            picture = Image.open(BytesIO(client.get(patterns[name]["picture"]).content))
            assert picture.format == "PNG"
        assert client.get("api/patterns/nothing.png").status_code == 404
    titles = {each["title"] for each in patterns.values()}
    assert len(titles) == len(patterns)
    assert titles >= {
        "Schwarz D",
        "Schwarz P network",
        "I-WP",
        "BCC",
        "FCC",
        "Fischer-Koch S",
        "Cross 3D",
        "Tri-hexagon",
    }
    assert patterns["gyroid"]["products"] == ["fill", "make", "refill"]
    assert patterns["gyroid"]["facts"]["density"] == 0.2
    assert {option["key"] for option in patterns["zigzag"]["parameters"]} >= {"waves", "angle"}


def test_facts_of_patterns_are_those_of_the_gallery() -> None:
    folder = Path(__file__).parents[1] / "docs"
    facts = json.loads((folder / "pictures" / "gallery" / "facts.json").read_text(encoding="utf-8"))
    text = (folder / "gallery.md").read_text(encoding="utf-8")
    for name, known in facts.items():
        row = next(line for line in text.splitlines() if line.startswith(f"| [{name}](#{name}) |"))
        assert f"| {known['cell']:.1f} | {known['line']:.2f} |" in row
        assert row.endswith(f"| {known['overhang']:.0%} | {known['voids']} |")


# --- files and products ---------------------------------------------------------------------------------------


def test_a_part_is_measured_and_shown(page: Page, files: Path) -> None:
    answer = page.upload(files / "part.stl", name="../../a;b.stl")
    facts = answer.facts
    assert facts["kind"] == "part"
    assert facts["name"] == "a_b.stl"
    assert facts["part"]["bounds"] == [[0, 0, 0], [60, 40, 40]]
    assert facts["part"]["closed"]
    assert facts["part"]["components"] == 1
    (pack,) = answer.payloads(MESH)
    assert unpack(pack)["part"] == pytest.approx(facts["part"]["volume"], rel=1e-4)


def unpack(pack: bytes) -> dict[str, float]:
    """Return the volumes of the surfaces of a mesh pack, as its format is described."""
    assert pack[:4] == b"IFM1"
    length = int.from_bytes(pack[4:8], "little")
    header, body = json.loads(pack[8 : 8 + length]), pack[8 + length :]
    volumes = {}
    for each in header["surfaces"]:
        steps = np.frombuffer(body, "<u2", 3 * each["vertices"], each["positions"]).reshape(-1, 3)
        vertices = np.array(each["low"]) + np.array(each["size"]) * steps / 65535
        indices = np.cumsum(np.frombuffer(body, "<u4", 3 * each["triangles"], each["indices"]), dtype=np.uint32)
        a, b, c = (vertices[indices.reshape(-1, 3)[:, corner]] for corner in range(3))
        volumes[each["name"]] = float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)
    return volumes


def test_a_scan_has_a_histogram_and_slices(page: Page, ids: dict[str, str], files: Path) -> None:
    facts = page.upload(files / "scan.nrrd").facts
    scan = facts["scan"]
    assert scan["shape"] == [56, 50, 96]
    assert sum(scan["histogram"]["counts"]) == 56 * 50 * 96
    assert scan["least"] < scan["otsu"] < scan["most"]
    for axis, size in (("x", (50, 96)), ("y", (56, 96)), ("z", (56, 50))):
        answer = page.client.get(page.url(f"files/{facts['file']}/slice"), params={"axis": axis, "index": 20})
        picture = Image.open(BytesIO(answer.content))
        assert (picture.mode, picture.size) == ("L", size)
    window = page.client.get(page.url(f"files/{facts['file']}/slice?axis=z&index=40&low=226&high=226.5"))
    assert set(np.unique(Image.open(BytesIO(window.content)))) <= {0, 255}
    for wrong in ("axis=z&index=96", "axis=q&index=1", "axis=z&index=-1", "axis=z&index=one", "axis=z"):
        assert page.client.get(page.url(f"files/{facts['file']}/slice?{wrong}")).status_code == 400
    assert page.upload(files / "labels.npy").facts["scan"]["labels"] == [
        {"value": 1, "name": "label_1", "colour": None},
        {"value": 2, "name": "label_2", "colour": None},
    ]


def read_layer(payload: bytes) -> tuple[dict, np.ndarray, np.ndarray, np.ndarray]:
    assert payload[:4] == b"IFL1"
    length = int.from_bytes(payload[4:8], "little")
    header, count = json.loads(payload[8 : 8 + length]), json.loads(payload[8 : 8 + length])["beads"]
    ends = np.frombuffer(payload, "<f4", 4 * count, 8 + length).reshape(-1, 4)
    speeds = np.frombuffer(payload, "<f4", count, 8 + length + 16 * count)
    features = np.frombuffer(payload, np.uint8, count, 8 + length + 20 * count)
    assert len(payload) == 8 + length + 21 * count
    return header, ends, speeds, features


def test_layers_of_a_print_take_the_time_of_the_print(page: Page, ids: dict[str, str], files: Path) -> None:
    facts = page.upload(files / "print.gcode").facts["print"]
    assert len(facts["layers"]) == 30
    assert facts["layers"][0] == {"z": 0.2, "height": 0.2}
    header, ends, speeds, features = read_layer(
        page.client.get(page.url(f"files/{ids['print.gcode']}/layers/5")).content
    )
    assert header["time_s"] == pytest.approx(facts["layer_seconds"][4])
    assert header["z"] == pytest.approx(facts["layers"][4]["z"], abs=1e-4)
    assert "sparse infill" in header["features"]
    assert features.max() < len(header["features"])
    assert 0 < speeds.min() <= speeds.max() < 500
    assert np.ptp(ends[:, 0]) == pytest.approx(50, abs=1)  # mm, the plate
    assert page.client.get(page.url(f"files/{ids['print.gcode']}/layers/31")).status_code == 400


REQUESTS = [
    ("make", None, {"pattern": "honeycomb", "size": [20, 15], "height": 3, "steps": 5}),
    ("fill", "part.stl", {"density": 0.3, "wall": 2, "voxel": 0.8, "set": {"angle": 10}, "pattern": "honeycomb"}),
    ("fill", "part.stl", {"density": [0.15, 0.4], "by": "skin", "voxel": 0.8, "open": "top"}),
    ("fill", "part.stl", {"voxel": 0.8, "region": ["z=0..10:density=40%"], "phase": [1, 0, 0], "drain": 3}),
    ("make", None, {"pattern": "gyroid", "size": [12, 12, 8], "density": "25%"}),
    ("smooth", "part.stl", {"resolution": 60, "steps": 8}),
    ("smooth", "scan.nrrd", {"threshold": 226, "voxel": 0.9, "smooth": "plain"}),
    ("labels", "labels.npy", {"label": [2], "steps": 5}),
    ("refill", "print.gcode", {"layers": "3-9", "pattern": "gyroid", "set": {"angle": 30}}),
    ("motion", "print.gcode", {"acceleration": 3000, "limits": {"max_z_velocity": 15}}),
]


@pytest.mark.long
@pytest.mark.parametrize(("product", "file", "options"), REQUESTS, ids=lambda value: str(value)[:30])
def test_command_and_python_make_the_file_again(
    page: Page, ids: dict[str, str], files: Path, tmp_path: Path, product: str, file: str | None, options: dict
) -> None:
    answer = page.ask(product, ids.get(str(file)), options=options)
    facts = answer.facts
    if file is not None:
        (tmp_path / file).write_bytes((files / file).read_bytes())
    command = shlex.split(facts["command"])
    assert command[:2] == ["infill", "smooth" if product == "labels" else product]
    done = subprocess.run(
        [sys.executable, "-c", CODE, *command[1:], *["--json"][: product == "motion"]],
        cwd=tmp_path,
        check=True,
        capture_output=True,
    )
    if product == "motion":
        assert json.loads(done.stdout)["seconds"] == pytest.approx(facts["report"]["seconds"])
        return
    name = command[-1]
    by_command = (tmp_path / name).read_bytes()
    (tmp_path / name).unlink()
    download = page.download(facts["result"], format=facts["downloads"][0])
    assert download.headers["content-disposition"] == f"attachment; filename*=UTF-8''{name}"
    subprocess.run([sys.executable, "-c", facts["python"]], cwd=tmp_path, check=True)
    by_python = (tmp_path / name).read_bytes()
    assert alike(download.content, by_command, name, tmp_path)
    assert alike(download.content, by_python, name, tmp_path)
    if facts["toml"] and product != "make":  # whose pattern stands in the file
        (tmp_path / "again.toml").write_text(facts["toml"], encoding="utf-8")
        words = [command[1], file or "", "--config", "again.toml", "-o", name, "--force"]
        subprocess.run([sys.executable, "-c", CODE, *words], cwd=tmp_path, check=True, capture_output=True)
        assert alike(download.content, (tmp_path / name).read_bytes(), name, tmp_path)


def alike(first: bytes, second: bytes, name: str, folder: Path) -> bool:
    """Tell whether two files hold the same: archives may differ in the times that they state."""
    if not name.endswith(".3mf"):
        return first == second
    volumes = []
    for content in (first, second):
        (folder / f"other-{name}").write_bytes(content)
        mesh = read_mesh(folder / f"other-{name}")
        volumes.append((len(mesh.faces), round(mesh.volume, 6)))
    return volumes[0] == volumes[1]


@pytest.mark.long
def test_every_download_can_be_opened(page: Page, ids: dict[str, str], tmp_path: Path) -> None:
    answer = page.ask("fill", ids["part.stl"], options={"voxel": 1.0, "wall": 2})
    volume = answer.number("volume")
    assert sum(unpack(answer.payloads(MESH)[0]).values()) == pytest.approx(volume, rel=1e-3)
    for wanted in answer.facts["downloads"]:
        got = page.download(answer.facts["result"], format=wanted, slicer="cura")
        assert got.status_code == 200, got.text
        path = tmp_path / f"{wanted}.{'3mf' if wanted == 'project' else wanted}"
        path.write_bytes(got.content)
        if wanted != "project":
            assert read_mesh(path).volume == pytest.approx(volume, rel=1e-4)
    assert check_project(tmp_path / "project.3mf", "cura").fine
    assert page.download(answer.facts["result"], format="exe").status_code == 400
    assert page.download("r999", format="stl").status_code == 404


@pytest.mark.slow
def test_a_coarse_answer_is_near_the_exact_one(page: Page, ids: dict[str, str]) -> None:
    coarse = page.ask("fill", ids["part.stl"], options={"density": 0.25}, quality="coarse")
    exact = page.ask("fill", ids["part.stl"], options={"density": 0.25, "max_triangles": 50_000})
    assert coarse.facts["result"] is None
    assert coarse.facts["downloads"] == []
    assert coarse.facts["command"].startswith("infill fill part.stl --density 0.25")
    # A draft is drawn until it is within 5 % of its density, or twice.
    assert coarse.number("density") == pytest.approx(exact.number("density"), rel=0.12)
    assert coarse.number("solid share") == pytest.approx(exact.number("solid share"), rel=0.1)
    grams = exact.facts["grams"]
    assert grams["PLA"] == pytest.approx(exact.number("volume") / 1000 * 1.24)


@pytest.mark.longest
def test_a_layer_is_refilled_first(page: Page, ids: dict[str, str]) -> None:
    answer = page.ask("refill", ids["print.gcode"], options={"pattern": "gyroid"}, quality="coarse", layer=7)
    header, *_ = read_layer(answer.payloads(LAYER)[0])
    assert header["layer"] == 7
    names = {row["name"] for row in answer.facts["numbers"]}
    assert {"sections", "time of the print before"} <= names
    assert not {"sections refilled", "time of the print", "filament"} & names, "of one layer"
    whole = page.ask("refill", ids["print.gcode"], options={"pattern": "gyroid"})
    again = page.client.get(page.url(f"files/{ids['print.gcode']}/layers/7"), params={"result": whole.facts["result"]})
    assert read_layer(again.content)[0]["time_s"] == pytest.approx(header["time_s"], rel=0.02)


def test_mistakes_get_one_clear_message(page: Page, ids: dict[str, str]) -> None:
    part = ids["part.stl"]
    for options, parameter, says in (
        ({"density": 700}, "density", "density"),
        ({"wall": 30}, "wall", "nowhere thicker"),
        ({"nonsense": 1}, None, "no option"),
        ({"pattern": "nonsense"}, "pattern", "choose a pattern"),
        ({"set": {"nonsense": 1}}, None, "nonsense"),
        ({"set": 3}, None, "names and values"),
        ({"voxel": 0.0001}, None, "memory"),
    ):
        error = page.ask("fill", part, options=options).error
        assert error is not None
        assert says in error["message"]
        assert "\n" not in error["message"]
        assert error["parameter"] == parameter or parameter is None
    assert "needs a part" in page.ask("fill", ids["scan.nrrd"]).error["message"]
    assert "no product" in page.ask("nonsense", part).error["message"]
    assert page.ask("fill", "f999").status == 404
    assert page.post("requests", content=b"nonsense").status == 400
    assert page.post("requests", content=b"[" * 100_000).status == 400
    assert page.post("requests", content=b" " * 2_000_000).status == 413
    assert page.ask("fill", part, options={"voxel": 2, "wall": 3}).error is None


# --- what it refuses ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("product", "file", "options"),
    [
        ("fill", "part.stl", {"pattern": "mine.py:waves"}),
        ("fill", "part.stl", {"pattern": "/etc/passwd"}),
        ("fill", "part.stl", {"pattern": "tile.svg"}),
        ("fill", "part.stl", {"density": [0.1, 0.3], "by": "mine.py:field"}),
        ("fill", "part.stl", {"density": [0.1, 0.3], "by": "/etc/passwd"}),
        ("fill", "part.stl", {"region": ["/etc/passwd.stl:density=40%"]}),
        ("fill", "part.stl", {"region": ["z=0..5:pattern=mine.py:waves"]}),
        ("fill", "part.stl", {"region": ["z=0..5:density=40%,pattern=/etc/x.svg"]}),
        ("fill", "part.stl", {"region": [{"file": "f1", "settings": "pattern=mine.py:waves"}]}),
        ("make", None, {"pattern": "mine.py:waves"}),
        ("refill", "print.gcode", {"pattern": "mine.py:waves"}),
        ("labels", "labels.npy", {"labels": "/etc/passwd"}),
        ("motion", "print.gcode", {"printer": "/etc/passwd"}),
        ("smooth", "scan.nrrd", {"units": "in"}),
    ],
)
def test_no_text_names_a_file_or_a_module(
    page: Page, ids: dict[str, str], product: str, file: str | None, options: dict
) -> None:
    module = page.post("files?name=mine.py", content=b"import os; os.abort()")
    assert "not a file that the studio takes" in module.error["message"]
    error = page.ask(product, ids.get(str(file)), options=options).error
    assert error is not None
    assert "Error" not in error["message"]
    assert "root:" not in error["message"]


def test_an_uploaded_tile_is_repeated(page: Page, ids: dict[str, str]) -> None:
    drawing = (
        b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path d="M0 5 H10 M5 0 V10" stroke="#000"/></svg>'
    )
    tile = page.post("files?name=cross.svg", content=drawing).facts
    assert tile["kind"] == "tile"
    answer = page.ask("fill", ids["part.stl"], options={"pattern": {"file": tile["file"]}, "cell": 6, "voxel": 0.8})
    assert answer.facts["command"].split()[:5] == ["infill", "fill", "part.stl", "--pattern", "cross.svg"]
    assert answer.facts["report"]["request"]["pattern"] == "cross.svg"


def test_uploads_have_limits(page: Page, studio: Studio) -> None:
    with socket.create_connection(("127.0.0.1", studio.port)) as connection:
        path = httpx.URL(page.url("files?name=part.stl")).raw_path.decode()
        head = f"POST {path} HTTP/1.1\r\nhost: 127.0.0.1:{studio.port}\r\ncontent-length: 99999999999\r\n\r\n"
        connection.sendall(head.encode())
        assert connection.recv(1000).startswith(b"HTTP/1.1 413")
    assert page.post("files?name=part.stl", content=b"").status == 400
    assert "not a file that the studio takes" in page.post("files?name=part", content=b"x").error["message"]
    assert "not a file that the studio takes" in page.post("files", content=b"x").error["message"]


def test_what_fails_leaves_no_file(page: Page, studio: Studio) -> None:
    page.post("files?name=broken-one.stl", content=b"solid nothing")
    assert not [path for path in studio.temporary() if path.name == "broken-one.stl"]


# --- whatever is uploaded -------------------------------------------------------------------------------------


def corpus() -> list[Path]:
    folder = Path(os.environ.get("INFILL_DATA", "nowhere")) / "nasty"
    return sorted(path for path in folder.glob("*") if path.suffix != ".md")


@pytest.mark.longest
def test_the_nasty_corpus_ends_nothing(studio: Studio) -> None:
    paths = corpus()
    if not paths:
        pytest.skip("no $INFILL_DATA")
    with studio.page() as page:
        before: set[int] = set()
        for path in paths:
            answer = page.upload(path)
            before = before or studio.workers()
            if answer.error is not None:
                check_message(answer, path)
                continue
            assert answer.facts["kind"] == "part"
            filled = page.ask("fill", answer.facts["file"], options={"resolution": 40}, quality="coarse")
            if filled.error is not None:
                check_message(filled, path)
        assert studio.workers() == before
    assert studio.process.poll() is None


def check_message(answer: Answer, path: Path) -> None:
    message = answer.error["message"]
    assert "\n" not in message, path
    assert 10 < len(message) < 500, path
    assert "fault of the program" not in message, (path, message)


BROKEN = {
    "cut.stl": b"\0" * 80 + (1000).to_bytes(4, "little") + b"\0" * 99,
    "lies.stl": b"\0" * 80 + (2**32 - 1).to_bytes(4, "little"),
    "no.3mf": b"PK\3\4 no archive",
    "no.obj": b"f 1 2 99999999999999999999\n" * 10,
    "no.ply": b"ply\nformat binary_little_endian 1.0\nelement vertex 999999999999\nend_header\n",
    "no.glb": b"glTF" + b"\xff" * 60,
    "no.gcode": b"\0\1\2" * 100,
    "no.bgcode": b"GCDE" + b"\xff" * 60,
    "no.gcode.3mf": b"PK\5\6" + bytes(18),
    "no.nrrd": b"NRRD0004\ntype: int\ndimension: 3\nsizes: 99999 99999 99999\nencoding: raw\n\n",
    "no.nii.gz": b"\x1f\x8b\x08" + b"\xff" * 60,
    "no.npy": b"\x93NUMPY\1\0\x76\0{'descr': '|O', 'fortran_order': False, 'shape': (9,)}" + b" " * 60,
    "no.zip": b"PK\3\4",
    "no.dcm": b"\0" * 128 + b"DICM" + b"\xff" * 99,
    "no.svg": b"<svg><path d='M 1e999 nan'/></svg>",
    "no.png": b"\x89PNG\r\n\x1a\n" + b"\0" * 60,
    "no.dxf": b"0\nSECTION\n" * 10,
    "no.stl": b"solid " + b"\xff" * 2000,
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_file_is_one_message(page: Page, name: str) -> None:
    answer = page.post(f"files?name={name}", content=BROKEN[name])
    assert answer.error is not None
    check_message(answer, Path(name))


@pytest.mark.slow
def test_faults_of_packages_are_one_message_each(page: Page, tmp_path: Path) -> None:
    """Those that are planted for the readers, in tests/test_3mf_hostile.py."""
    faulty = {fault: changed(tmp_path / "a.3mf", change).read_bytes() for fault, (change, _) in ZIPS.items()}
    faulty |= {fault: packed(tmp_path / "a.3mf", text).read_bytes() for fault, (text, _) in XMLS.items()}
    for fault, content in faulty.items():
        answer = page.post("files?name=a.3mf", content=content)
        if answer.error is not None:  # of one of them, the readers of models know nothing
            check_message(answer, Path(fault))
    assert page.post("files?sample=part").error is None


CUT = [name for name in READERS if name not in ("png", "points", "ply points")]


@pytest.mark.slow
@pytest.mark.parametrize("name", CUT)
def test_files_that_are_cut_off_are_one_message(page: Page, name: str, tmp_path: Path) -> None:
    """Of every format, at three places: what is left is read, or refused."""
    path = READERS[name][0](tmp_path)
    content = path.read_bytes()
    assert page.upload(path).error is None
    for share in (0.1, 0.5, 0.95):
        path.write_bytes(content[: int(share * len(content))])
        answer = page.upload(path)
        if answer.error is not None:
            check_message(answer, path)


def test_an_archive_unpacks_into_its_folder_only(page: Page, studio: Studio, files: Path) -> None:
    import zipfile

    packed = BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.write(files / "scan.nrrd", "../../../escaped.nrrd")
        archive.writestr("__MACOSX/._scan.nrrd", b"note")
    facts = page.post("files?name=scan.zip", content=packed.getvalue()).facts
    assert facts["kind"] == "scan"
    assert [path.parent.name for path in studio.folder.rglob("escaped.nrrd")] == ["scan.zip.unpacked"]
    bomb = BytesIO()
    with zipfile.ZipFile(bomb, "w") as archive:
        for number in range(20_001):
            archive.writestr(f"{number}", b"")
    assert "unpacks to more" in page.post("files?name=bomb.zip", content=bomb.getvalue()).error["message"]


# --- pages -----------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_page_that_goes_takes_its_process_and_folder(studio: Studio, files: Path) -> None:
    others, kept = studio.workers(), set(studio.temporary())
    with studio.page() as page:
        page.upload(files / "part.stl")
        own = studio.workers() - others
        assert len(own) == 1
        assert set(studio.temporary()) - kept
        page.leave()
        wait_until(lambda: not studio.workers() & own)
        wait_until(lambda: set(studio.temporary()) <= kept)
        assert page.ask("make", options={"pattern": "honeycomb"}).status == 404


@pytest.mark.slow
def test_work_ends_when_its_page_goes(studio: Studio, files: Path) -> None:
    others = studio.workers()
    with studio.page() as page:
        file = page.upload(files / "part.stl").facts["file"]
        own = studio.workers() - others
        body = {"product": "fill", "file": file, "options": {"voxel": 0.25}, "quality": "exact"}
        with page.client.stream("POST", page.url("requests"), json=body, timeout=PATIENCE) as response:
            next(response.iter_raw())  # it works
            page.leave()
            wait_until(lambda: not studio.workers() & own)


@pytest.mark.slow
def test_closing_the_connection_cancels(studio: Studio, files: Path) -> None:
    with studio.page() as page:
        file = page.upload(files / "part.stl").facts["file"]
        page.ask("fill", file, options={"voxel": 1.0, "wall": 2})  # compiled by now
        body = {
            "product": "fill",
            "file": file,
            "options": {"voxel": 0.2, "max_triangles": 900_000},
            "quality": "exact",
        }
        with page.client.stream("POST", page.url("requests"), json=body, timeout=PATIENCE) as response:
            next(response.iter_raw())
        begin = time.perf_counter()
        answer = page.ask("make", options={"pattern": "honeycomb", "size": [10, 10], "height": 1})
        assert answer.error is None
        assert time.perf_counter() - begin < 15  # s; the whole fill would take longer, and so may a new process


@pytest.mark.longest
def test_a_cancelled_result_is_made_when_it_is_asked_for_again(studio: Studio, files: Path) -> None:
    with studio.page() as page:
        file = page.upload(files / "part.stl").facts["file"]
        body = {"product": "fill", "file": file, "options": {"voxel": 0.5}, "quality": "exact"}
        with page.client.stream("POST", page.url("requests"), json=body, timeout=PATIENCE) as response:
            next(response.iter_raw())  # it works
        draft = page.ask("fill", file, options={"voxel": 0.5}, quality="coarse")
        assert draft.facts["result"] is None
        again = page.ask("fill", file, options={"voxel": 0.5}).facts["result"]
        cancelled = f"r{int(again[1:]) - 1}"
        assert page.download(cancelled, format="stl").status_code == 404
        assert page.download(again, format="stl").status_code == 200


@pytest.mark.slow
def test_the_newest_request_of_a_lane_wins(studio: Studio, files: Path) -> None:
    import threading

    with studio.page() as page:
        file = page.upload(files / "part.stl").facts["file"]
        answers: dict[str, Answer] = {}

        def ask_slowly() -> None:
            with studio.client() as client:
                own = Page(client=client, name=page.name)
                answers["old"] = own.ask("fill", file, options={"voxel": 0.2, "max_triangles": 900_000})

        thread = threading.Thread(target=ask_slowly)
        thread.start()
        time.sleep(1.5)
        answers["new"] = page.ask("fill", file, options={"density": 0.3}, quality="coarse")
        thread.join(PATIENCE)
        assert answers["new"].error is None
        assert answers["old"].error["cancelled"]
        assert "newer request" in answers["old"].error["message"]


@pytest.mark.slow
def test_two_pages_do_not_disturb_each_other(studio: Studio, files: Path) -> None:
    with studio.page() as first, studio.page() as second:
        assert first.name != second.name
        mine, theirs = first.upload(files / "part.stl").facts, second.upload(files / "scan.nrrd").facts
        assert second.ask("fill", theirs["file"]).error is not None
        assert first.ask("fill", mine["file"], options={"voxel": 1, "wall": 2}).error is None
        assert first.client.get(first.url(f"files/{theirs['file']}x/slice?axis=z&index=1")).status_code == 404
        second.leave()
        assert first.ask("fill", mine["file"], options={"voxel": 1, "wall": 2.5}).error is None


@pytest.mark.slow
def test_pages_have_a_limit_and_unknown_ones_are_gone(studio: Studio) -> None:
    with studio.client() as client:
        opened = []
        for _ in range(12):
            answer = client.post("api/pages")
            if answer.status_code != 200:
                break
            opened.append(answer.json()["page"])
        assert answer.status_code == 503
        assert "close one" in answer.json()["message"]
        pages = [Page(client=client, name=name) for name in opened]
        for page in pages:
            page.live()
            page.leave()
        wait_until(lambda: client.post("api/pages").status_code == 200)
        assert client.post("api/pages/nothing/requests", json={}).status_code == 404
        assert client.get("api/pages/nothing/alive").status_code == 404


# --- beginning and end ---------------------------------------------------------------------------------------


LIMITED = """
from infill.studio.limits import StudioLimits
from infill.studio.server import serve
serve(browser=False, limits=StudioLimits(seconds=4, upload_bytes=60_000, files=2, memory_bytes=300_000_000))
"""


@pytest.mark.longest
def test_every_request_has_limits_of_time_and_memory(tmp_path: Path, files: Path) -> None:
    with run_studio(tmp_path, code=LIMITED) as studio, studio.page() as page:
        limits = page.client.get("api/about").json()["limits"]
        assert (limits["seconds"], limits["upload_bytes"]) == (4, 60_000)
        assert page.upload(files / "print.gcode").status == 413
        file = page.upload(files / "part.stl").facts["file"]
        slow = page.ask("fill", file, options={"voxel": 0.25, "max_triangles": 900_000})
        assert "takes over 4 s" in slow.error["message"]
        large = page.ask("fill", file, options={"voxel": 0.05})
        assert "memory" in large.error["message"]
        assert page.post("files?sample=part").error is None
        assert "holds 2 files" in page.upload(files / "part.stl").error["message"]
        assert page.ask("make", options={"pattern": "honeycomb", "size": [10, 10], "height": 1}).error is None


@pytest.mark.slow
def test_ctrl_c_ends_it_cleanly(tmp_path: Path, files: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    here = tmp_path_factory.mktemp("here")
    with run_studio(tmp_path, str(files / "part.stl"), cwd=here) as studio, studio.page() as page:
        assert page.client.get("api/about").json()["file"] == {"name": "part.stl"}
        facts = page.post("files?given=1").facts
        assert (facts["kind"], facts["name"]) == ("part", "part.stl")
        workers = studio.workers()
        assert workers
        assert [path.name for path in tmp_path.iterdir()] != []
        assert all(path.name.startswith(TEMPORARY) for path in tmp_path.iterdir())
        assert studio.stop() == 0
        assert list(tmp_path.iterdir()) == list(here.iterdir()) == []
        wait_until(lambda: not any(Path(f"/proc/{number}").exists() for number in workers))


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="of POSIX")
def test_workers_end_with_a_server_that_is_killed(tmp_path: Path) -> None:
    with run_studio(tmp_path) as studio, studio.page():
        workers = studio.workers()
        assert workers
        studio.process.kill()
        studio.process.wait()
        wait_until(lambda: not any(Path(f"/proc/{number}").exists() for number in workers))


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="of POSIX")
def test_the_next_start_removes_what_a_killed_studio_left(tmp_path: Path) -> None:
    others = [tmp_path / f"{TEMPORARY}{name}" for name in ("without-a-lock", "a-file")]
    others[0].mkdir()
    others[1].touch()
    with run_studio(tmp_path) as living:
        kept = {*tmp_path.iterdir()}
        with run_studio(tmp_path) as killed:
            killed.process.kill()
            killed.process.wait()
        assert len({*tmp_path.iterdir()} - kept) == 1
        left = {*tmp_path.iterdir()} - kept
        with run_studio(tmp_path) as following:
            assert not left & {*tmp_path.iterdir()}
            assert kept <= {*tmp_path.iterdir()}
            assert following.stop() == 0
        assert {*tmp_path.iterdir()} == kept
        assert living.stop() == 0
    assert {*tmp_path.iterdir()} == {*others}


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="of POSIX")
def test_folders_of_other_users_stay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from infill.studio.work_folder import LOCK, remove_leftovers

    left = tmp_path / f"{TEMPORARY}left"
    left.mkdir()
    (left / LOCK).touch()
    owner = os.getuid()
    monkeypatch.setattr(os, "getuid", lambda: owner + 1)
    remove_leftovers(tmp_path)
    assert left.exists()
    monkeypatch.undo()
    remove_leftovers(tmp_path)
    assert not left.exists()


@pytest.mark.slow
def test_mistakes_on_the_command_line(tmp_path: Path) -> None:
    def run(*words: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-c", CODE, "studio", "--no-browser", *words]
        return subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, timeout=PATIENCE, check=False)

    assert "there is no" in run("missing.stl").stderr
    assert "--port is 99999" in run("--port", "99999").stderr
    with socket.create_server(("127.0.0.1", 0)) as taken:
        error = run("--port", str(taken.getsockname()[1]))
    assert (error.returncode, error.stdout) == (1, "")
    assert error.stderr.startswith("error: cannot listen at 127.0.0.1 port")
    assert error.stderr.count("\n") == 1


@pytest.mark.longest
def test_the_other_commands_load_nothing_of_it() -> None:
    code = "import sys; sys.argv = ['infill', '--help']\nfrom infill.cli import main\ntry: main()\nexcept SystemExit: pass\n"
    code += (
        "print([name for name in sys.modules if name.split('.')[0] in ('starlette', 'uvicorn') or 'studio.' in name])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] in ("[]", "['infill.cli.studio']")


@pytest.mark.longest
def test_it_answers_soon(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with run_studio(tmp_path) as studio:
        with capsys.disabled():
            print(f"\nthe studio answers after {studio.seconds:.2f} s")
        assert studio.seconds < 5  # s, on a busy machine; 1.5 s on a quiet one
