"""The desk of a worker: files that it has read, results that it has made, and how it answers each action."""

from __future__ import annotations

import contextlib
from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from infill.errors import FormatError, UsageError
from infill.studio.frames import FILE, Frame
from infill.studio.option_forms import SETS, name_files
from infill.studio.products import Made, Order, answer_frames, find_product
from infill.studio.reading import Content, read_content

if TYPE_CHECKING:
    from infill.result import Progress

MOST_RESULTS = 3  # kept in memory; others are made again when they are asked for


class Desk:
    """Files and results of one page.

    Parameters
    ----------
    folder : str
        Of the page, the working directory.
    memory : int
        Bytes that the library may take.
    """

    def __init__(self, *, folder: str, memory: int) -> None:
        self.folder = Path(folder)
        self.memory = memory
        self._contents: dict[str, Content] = {}
        self._results: OrderedDict[str, Made] = OrderedDict()

    def answer(self, message: Mapping[str, Any], progress: Progress, warnings: list[str]) -> Iterator[Frame]:
        """Answer one request in frames."""
        actions: dict[str, Callable[[Mapping[str, Any], Progress, list[str]], Iterator[Frame]]] = {
            "read": self._read,
            "make": self._make,
            "download": self._download,
        }
        return actions[message["action"]](message, progress, warnings)

    def forget(self) -> None:
        """Forget all results, whose memory is needed."""
        self._results.clear()

    def warm(self, is_awaited: Callable[[], bool]) -> None:
        """Load the library and its compiled loops, until a request waits."""
        import trimesh

        steps: tuple[Callable[[], object], ...] = (
            lambda: find_product("fill").code,
            lambda: self._draft_box(trimesh.creation.box((12.0, 12.0, 12.0))),
        )
        for step in steps:
            if is_awaited():
                return
            step()

    def _draft_box(self, box: Any) -> None:  # noqa: ANN401 - a Trimesh
        """Draft a small box."""
        from infill.lattices.draft import draft_fill
        from infill.lattices.request import check_request
        from infill.meshes.merging import surface_of

        draft_fill(surface_of(box), check_request(pattern="gyroid", own={}, density=0.3))

    def content(self, file_id: str, message: Mapping[str, Any], progress: Progress) -> Content:
        """Return the content of a file; read it if this process has not yet."""
        known = self._contents.get(file_id)
        if known is None:
            facts = message["files"][file_id]
            known = self._contents[file_id] = read_content(facts["name"], facts["kind"], progress, self.memory)
        return known

    def _read(self, message: Mapping[str, Any], progress: Progress, warnings: list[str]) -> Iterator[Frame]:
        """Read an uploaded file."""
        file_id = message["file"]
        name = message["files"][file_id]["name"]
        content = read_content(name, str(message.get("as", "")), progress, self.memory)
        self._contents[file_id] = content
        yield from content.frames(file_id, warnings)

    def _order(self, message: Mapping[str, Any], progress: Progress, options: Mapping[str, Any]) -> Order:
        """Return a checked request."""
        from patterns import PATTERNS

        product = find_product(message["product"])
        files = {file_id: facts["name"] for file_id, facts in message["files"].items()}
        code = product.code
        from infill.options.declaration import declared_options

        known = set(declared_options(code.DECLARATION)) - set(code.LEFT_OUT) | {"pattern", "for", "as"}
        named = name_files(options, files, known, PATTERNS)
        own = named.pop(SETS, {})
        if not isinstance(own, dict):
            raise UsageError("the parameters of a pattern are names and values")
        content = None if message["file"] is None else self.content(message["file"], message, progress)
        layer = message.get("layer")
        return Order(
            options=named,
            own=own,
            content=content,
            coarse=message["quality"] == "coarse",
            layer=layer if isinstance(layer, int) else None,
            progress=progress,
            memory=self.memory,
        )

    def _make(self, message: Mapping[str, Any], progress: Progress, warnings: list[str]) -> Iterator[Frame]:
        """Make a product."""
        product = find_product(message["product"])
        order = self._order(message, progress, message["options"])
        made = product.code.make(order)
        again: dict[str, str] = {}
        result = message["result"]
        if result is not None:
            self._keep(result, made)
        yield from answer_frames(message["product"], made, again, result, warnings)

    def _keep(self, result: str, made: Made) -> None:
        """Keep a result, the newest ones only."""
        self._results[result] = made
        while len(self._results) > MOST_RESULTS:
            self._results.popitem(last=False)

    def _download(self, message: Mapping[str, Any], progress: Progress, warnings: list[str]) -> Iterator[Frame]:  # noqa: ARG002
        """Write the file of a result."""
        request = {**message["request"], "files": message["files"]}
        product = find_product(request["product"])
        wanted = message["format"]
        if wanted not in product.downloads:
            raise FormatError(f"there is no format {str(wanted)[:20]!r}; choose from {', '.join(product.downloads)}")
        options, result = dict(request["options"]), message["result"]
        suffix = f".{wanted}"
        made = self._results.get(result)
        if wanted == "project":
            options["for"], suffix, made = message.get("slicer") or "prusaslicer", ".3mf", None
        if made is None:
            made = product.code.make(self._order(request, progress, options))
            if wanted != "project":
                self._keep(result, made)
        stem = Path(message["files"][request["file"]]["name"]).stem if request["file"] else "block"
        folder = self.folder / "downloads"
        folder.mkdir(exist_ok=True)
        path = folder / f"{stem}-{request['product']}{suffix}"
        with contextlib.suppress(OSError):
            path.unlink()
        product.code.write(made, path)
        yield Frame.of_json(FILE, {"path": str(path), "name": path.name})
