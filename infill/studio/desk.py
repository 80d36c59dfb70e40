"""The desk of a worker: files that it has read, results that it has made, and how it answers each action."""

from __future__ import annotations

import importlib
import secrets
from collections import OrderedDict
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from infill.errors import FormatError, UsageError
from infill.studio.frames import FILE, PICTURE, AnswerFrame
from infill.studio.option_forms import SETS, name_files
from infill.studio.products import Made, Order, answer_frames, find_product
from infill.studio.reading import Content, read_content
from infill.studio.upload_names import split_suffix

if TYPE_CHECKING:
    from infill.result import Progress

MADE, DOWNLOADS = "made", "downloads"  # folders for files
MORE_OPTIONS = ("pattern", "for", "as")  # that a request may have, whatever the form shows
MOST_RESULTS = 4  # kept in memory; others are made again when they are asked for


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
        self._plans: dict[str, Any] = {}  # of the refilled print that is looked at

    def answer(self, message: Mapping[str, Any], progress: Progress, warnings: list[str]) -> Iterator[AnswerFrame]:
        """Answer one request in frames."""
        actions: dict[str, Callable[[Mapping[str, Any], Progress, list[str]], Iterator[AnswerFrame]]] = {
            "read": self._read,
            "make": self._make,
            "download": self._download,
            "slice": self._slice,
            "layer": self._layer,
        }
        return actions[message["action"]](message, progress, warnings)

    def forget(self) -> None:
        """Forget all results, whose memory is needed."""
        self._results.clear()

    def warm(self, is_awaited: Callable[[], bool]) -> None:
        """Load the library and its compiled loops, until a request waits."""
        for step in (lambda: importlib.import_module("infill.lattices.draft"), self._draft_sample):
            if is_awaited():
                return
            step()

    def _draft_sample(self) -> None:
        """Draft a fill of the sample of a part, coarsely."""
        from infill.lattices.draft import draft_fill
        from infill.lattices.request import check_request
        from infill.samples.bracket import bracket

        draft_fill(bracket(), check_request(pattern="gyroid", own={}, density=0.3, resolution=30))

    def content(self, file_id: str, message: Mapping[str, Any], progress: Progress) -> Content:
        """Return the content of a file; read it if this process has not yet."""
        content = self._contents.get(file_id)
        if content is None:
            facts = message["files"][file_id]
            content = self._contents[file_id] = read_content(facts["name"], facts["kind"], progress, self.memory)
        return content

    def _read(self, message: Mapping[str, Any], progress: Progress, warnings: list[str]) -> Iterator[AnswerFrame]:
        """Read an uploaded file."""
        file_id = message["file"]
        name = message["files"][file_id]["name"]
        content = read_content(name, str(message.get("as", "")), progress, self.memory)
        self._contents[file_id] = content
        yield from content.frames(file_id, warnings)

    def _order(
        self, message: Mapping[str, Any], progress: Progress, options: Mapping[str, Any], result: str | None
    ) -> Order:
        """Return a checked request."""
        from infill.options.declaration import declared_options
        from patterns import PATTERNS

        product = find_product(message["product"])
        files = {file_id: facts["name"] for file_id, facts in message["files"].items()}
        allowed = set(declared_options(product.code.DECLARATION)) - set(product.code.LEFT_OUT) | {*MORE_OPTIONS}
        named = name_files(options, files, allowed, PATTERNS)
        parameters = named.pop(SETS, {})
        if not isinstance(parameters, dict):
            raise UsageError("the parameters of a pattern are names and values")
        parameters = dict(parameters)
        # A parameter of a pattern that the product has as an option.
        named |= {key: parameters.pop(key) for key in parameters.keys() & allowed - named.keys()}
        content = None if message["file"] is None else self.content(message["file"], message, progress)
        layer = message.get("layer")
        suffix = ".gcode" if content is None else split_suffix(content.name)[1]
        return Order(
            options=named,
            parameters=parameters,
            content=content,
            coarse=message["quality"] == "coarse",
            layer=layer if isinstance(layer, int) and layer > 0 else None,
            target=self.folder / MADE / f"{result or 'layer'}{suffix}",
            progress=progress,
            memory=self.memory,
        )

    def _make(self, message: Mapping[str, Any], progress: Progress, warnings: list[str]) -> Iterator[AnswerFrame]:
        """Make a product."""
        name, result = message["product"], message["result"]
        product = find_product(name)
        order = self._order(message, progress, message["options"], result)
        made = product.code.make(order)
        stored = None if order.content is None else order.content.name
        file = product.file_name(stored, (*product.downloads, "stl")[0])
        if result is not None:
            self._keep(result, made)
        yield from answer_frames(name, made, product.code.again(order, file), result, warnings)

    def _keep(self, result: str, made: Made) -> None:
        """Keep a result, the newest ones only."""
        self._results[result] = made
        while len(self._results) > MOST_RESULTS:
            oldest, _ = self._results.popitem(last=False)
            for file in (self.folder / MADE).glob(f"{oldest}.*"):
                file.unlink(missing_ok=True)

    def _made(self, message: Mapping[str, Any], progress: Progress) -> Made:
        """Return a result; make it again if it is not kept any more."""
        request, result = {**message["request"], "files": message["files"]}, message["result"]
        if result not in self._results:
            order = self._order(request, progress, request["options"], result)
            self._keep(result, find_product(request["product"]).code.make(order))
        return self._results[result]

    def _project(self, message: Mapping[str, Any], progress: Progress) -> Made:
        """Return a result as a project for a slicer; that of another slicer has the same part and infill."""
        from infill.studio.fill_product import for_slicer

        request, project = message["request"], f"{message['result']}-project"
        options = {**request["options"], "for": message.get("slicer") or "prusaslicer"}
        order = self._order({**request, "files": message["files"]}, progress, options, None)
        if project not in self._results:
            self._keep(project, find_product(request["product"]).code.make(replace(order, coarse=False)))
        return for_slicer(self._results[project], order)

    def _download(self, message: Mapping[str, Any], progress: Progress, warnings: list[str]) -> Iterator[AnswerFrame]:  # noqa: ARG002 - as all actions
        """Write the file of a result."""
        request, file_format = message["request"], message["format"]
        product = find_product(request["product"])
        if file_format not in product.downloads:
            listed = ", ".join(product.downloads) or "none"
            raise FormatError(f"there is no format {str(file_format)[:20]!r}; choose from {listed}")
        if file_format == "project":
            made = self._project(message, progress)
        else:
            made = self._made(message, progress)
        stored = message["files"].get(request["file"])
        folder = self.folder / DOWNLOADS / secrets.token_hex(8)
        folder.mkdir(parents=True)
        path = folder / product.file_name(stored and stored["name"], file_format)
        product.code.write(made, path)
        yield AnswerFrame.of_json(FILE, {"path": str(path), "name": path.name})

    def _slice(self, message: Mapping[str, Any], progress: Progress, warnings: list[str]) -> Iterator[AnswerFrame]:  # noqa: ARG002
        """Draw a slice of a scan."""
        from infill.studio.scan_reading import draw_slice

        content = self.content(message["file"], message, progress)
        if content.kind != "scan":
            raise UsageError(f"{content.name} is not a scan")
        words = [message.get(key) for key in ("axis", "index", "low", "high")]
        picture = draw_slice(content.data, str(words[0]), str(words[1]), words[2], words[3])
        yield AnswerFrame(kind=PICTURE, payload=picture)

    def _layer(self, message: Mapping[str, Any], progress: Progress, warnings: list[str]) -> Iterator[AnswerFrame]:  # noqa: ARG002
        """Return a layer of a print, or of a refilled one."""
        from infill.studio.print_layers import layer_frame, plan_print

        content, result = self.content(message["file"], message, progress), message.get("result")
        if content.kind != "print":
            raise UsageError(f"{content.name} is not a print")
        number = str(message["layer"])
        if not number.isdecimal():
            raise UsageError.about("layer", "must be a number; layers are counted from 1")
        planned = content.data.planned
        if result is not None:
            if result not in self._plans:
                self._plans.clear()
                self._plans[result] = plan_print(self._made(message, progress).result.path)
            planned = self._plans[result]
        yield layer_frame(planned, int(number))
