"""The addresses of the studio: its page, its abilities, and the requests of pages."""

from __future__ import annotations

import json
import shutil
from collections.abc import AsyncGenerator, AsyncIterator, Awaitable, Callable, Mapping
from contextlib import ExitStack, asynccontextmanager
from dataclasses import dataclass, field
from functools import wraps
from pathlib import Path
from typing import Any
from urllib.parse import quote

from starlette.applications import Starlette
from starlette.background import BackgroundTask
from starlette.concurrency import run_in_threadpool
from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import Route

from infill.errors import InfillError
from infill.samples.catalogue import find_sample, write_sample
from infill.studio.answering import StreamedAnswer, beat
from infill.studio.frames import ANSWER, ERROR, FILE, AnswerFrame
from infill.studio.guard import Guard, make_token
from infill.studio.limits import StudioLimits
from infill.studio.pages import Page, Pages, StoredFile
from infill.studio.upload_names import choose_name

BUNDLE = Path(__file__).parent / "bundle"
TYPES = {".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".txt": "text/plain", ".png": "image/png"}
PLACEHOLDER = b"<!doctype html><title>infill studio</title><p>The page of the studio is not built: run make page.</p>\n"
STATUS_OF_TOO_MUCH, STATUS_OF_BUSY, STATUS_OF_MISSING, STATUS_OF_WRONG = 413, 503, 404, 400
Endpoint = Callable[["Studio", Request], Awaitable[Any]]


class RequestError(Exception):
    """A request that gets a message in place of an answer."""

    def __init__(self, message: str, status: int = STATUS_OF_WRONG) -> None:
        super().__init__(message)
        self.status = status


@dataclass(kw_only=True, eq=False)
class Studio:
    """A running studio.

    Parameters
    ----------
    pages : Pages
    limits : StudioLimits
    opened : Path, optional
        The file or folder that was named on the command line.
    """

    pages: Pages
    limits: StudioLimits
    opened: Path | None = None
    made: dict[str, bytes] = field(default_factory=dict)  # answers that stay the same

    @asynccontextmanager
    async def run(self, app: Starlette) -> AsyncIterator[None]:  # noqa: ARG002 - as Starlette calls it
        """Prepare a worker, and close all pages at the end."""
        await self.pages.prepare()
        try:
            yield
        finally:
            await self.pages.close_all()


def build_app(studio: Studio, *, host: str, port: int, token: str | None = None) -> Guard:
    """Return the application that answers requests for a studio."""
    page, stored = "/api/pages/{page}", "/api/pages/{page}/files/{file}"
    routes: list[tuple[str, str, Endpoint]] = [
        ("GET", "/api/about", send_about),
        ("GET", "/api/patterns", send_patterns),
        ("GET", "/api/patterns/{picture}", send_picture),
        ("POST", "/api/pages", open_page),
        ("GET", f"{page}/alive", stay_alive),
        ("POST", f"{page}/files", receive_file),
        ("POST", f"{page}/requests", answer_request),
        ("GET", f"{page}/results/{{result}}", send_result),
        ("GET", f"{stored}/slice", send_slice),
        ("GET", f"{stored}/layers/{{layer}}", send_layer),
        ("GET", "/{asset}", send_asset),
        ("GET", "/", send_asset),
    ]
    app = Starlette(
        routes=[Route(path, _endpoint(studio, answer), methods=[method]) for method, path, answer in routes],
        lifespan=studio.run,
    )
    return Guard(app=app, token=token or make_token(), host=host, port=port)


def _endpoint(studio: Studio, answer: Endpoint) -> Callable[[Request], Awaitable[Any]]:
    """Return an endpoint of Starlette's: errors of a user become a message."""

    @wraps(answer)
    async def respond(request: Request) -> Any:  # noqa: ANN401 - any response
        try:
            return await answer(studio, request)
        except RequestError as error:
            return JSONResponse({"message": str(error), "parameter": None}, error.status)
        except InfillError as error:
            return JSONResponse({"message": str(error), "parameter": error.parameter}, STATUS_OF_WRONG)

    return respond


# --- the page itself -------------------------------------------------------------------------------------------


async def send_asset(studio: Studio, request: Request) -> Response:  # noqa: ARG001 - as all endpoints
    """Send the page, or one of its files."""
    name = request.path_params.get("asset") or "index.html"
    path = BUNDLE / Path(name).name
    if path.name != name or path.suffix not in TYPES or not path.is_file():
        if name == "index.html":
            return Response(PLACEHOLDER, media_type="text/html")
        raise RequestError("there is no such file", STATUS_OF_MISSING)
    return FileResponse(path, media_type=TYPES[path.suffix])


async def send_about(studio: Studio, request: Request) -> Response:  # noqa: ARG001
    """Send the version, the limits, and the options of all products."""
    from infill.studio.catalogue import describe_studio

    if "about" not in studio.made:
        opened = None if studio.opened is None else studio.opened.name
        about = await run_in_threadpool(describe_studio, studio.limits.facts(), opened)
        studio.made["about"] = json.dumps(about).encode()
    return Response(studio.made["about"], media_type="application/json")


async def send_patterns(studio: Studio, request: Request) -> Response:  # noqa: ARG001
    """Send all patterns, with facts and parameters."""
    from infill.studio.catalogue import describe_patterns

    if "patterns" not in studio.made:
        studio.made["patterns"] = json.dumps(await run_in_threadpool(describe_patterns)).encode()
    return Response(studio.made["patterns"], media_type="application/json")


async def send_picture(studio: Studio, request: Request) -> Response:
    """Send the picture of a pattern."""
    from infill.studio.catalogue import draw_pattern

    name = request.path_params["picture"].removesuffix(".png")
    key = f"picture {name}"
    if key not in studio.made:
        picture = await run_in_threadpool(draw_pattern, name)
        if picture is None:
            raise RequestError("there is no such pattern", STATUS_OF_MISSING)
        studio.made[key] = picture
    return Response(studio.made[key], media_type="image/png")


# --- pages -----------------------------------------------------------------------------------------------------


async def open_page(studio: Studio, request: Request) -> Response:  # noqa: ARG001
    """Open a page, with a worker of its own."""
    try:
        page = await studio.pages.open()
    except InfillError as error:
        raise RequestError(str(error), STATUS_OF_BUSY) from error
    return JSONResponse({"page": page.name})


def _find_page(studio: Studio, request: Request) -> Page:
    """Return the page of an address."""
    page = studio.pages.find(request.path_params["page"])
    if page is None:
        raise RequestError("this page is gone; load it again", STATUS_OF_MISSING)
    return page


async def stay_alive(studio: Studio, request: Request) -> StreamedAnswer:
    """Send signs of life until the browser leaves; then the page is closed."""
    page = _find_page(studio, request)
    page.living += 1

    async def leave() -> None:
        """Close the page at the end of its last stream."""
        page.living -= 1
        if not page.living:
            await studio.pages.close(page)

    return StreamedAnswer(pieces=beat(page.gone), media_type="text/event-stream", at_end=leave)


async def receive_file(studio: Studio, request: Request) -> StreamedAnswer:
    """Store an uploaded file and let the worker read it.

    With `given=1` it is the file of the command line, with `sample=part`, `scan` or `print` a small one made here.
    """
    page, limits = _find_page(studio, request), studio.limits
    if len(page.files) >= limits.files:
        raise RequestError(f"this page holds {limits.files} files; load it again", STATUS_OF_TOO_MUCH)
    opened = request.query_params.get("given") and studio.opened
    sample = request.query_params.get("sample")
    requested = opened.name if opened else find_sample(sample).file if sample else request.query_params.get("name", "")
    name = choose_name(requested, {stored.name for stored in page.files.values()})
    file_id, path = page.new_name("f"), page.folder / name
    stored = StoredFile(name=name, size=0)
    page.files[file_id] = stored

    def drop() -> None:
        """Forget the file."""
        page.files.pop(file_id, None)
        _remove(path)

    with ExitStack() as unless_stored:
        unless_stored.callback(drop)
        if opened:
            await run_in_threadpool(_copy, opened, path)
        elif sample:
            await run_in_threadpool(write_sample, sample, path)
        else:
            await _store(request, path, limits, page)
        stored.size = _size_of(path)
        unless_stored.pop_all()
    message = {"action": "read", "file": file_id, "as": request.query_params.get("as", "")}

    async def frames() -> AsyncGenerator[bytes, None]:
        """Yield the frames of the answer; forget the file if it cannot be read."""
        is_read = False
        try:
            async for frame in _ask(page, message, None):
                if frame.kind == ANSWER:
                    is_read = True
                    stored.kind = json.loads(frame.payload)["kind"]
                yield frame.to_http()
        finally:
            if not is_read:
                await run_in_threadpool(drop)

    return StreamedAnswer(pieces=frames())


def _copy(source: Path, target: Path) -> None:
    """Copy a file or a folder."""
    if source.is_dir():
        shutil.copytree(source, target)
    else:
        shutil.copyfile(source, target)


def _size_of(path: Path) -> int:
    """Return the bytes of a file, or of all files of a folder."""
    files = (path, *path.rglob("*")) if path.is_dir() else (path,)
    return sum(file.stat().st_size for file in files if file.is_file())


def _remove(path: Path) -> None:
    """Remove a file or a folder, if it exists."""
    if path.is_dir():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)


async def _store(request: Request, path: Path, limits: StudioLimits, page: Page) -> None:
    """Write the body of a request to a file, up to the limits."""
    limit = min(limits.upload_bytes, limits.page_bytes - page.stored_bytes)
    too_large = RequestError(
        f"this file is larger than {limit / 2**20:,.0f} MiB, the most that the studio takes; use the command line",
        STATUS_OF_TOO_MUCH,
    )
    length = request.headers.get("content-length", "")
    if length.isdecimal() and int(length) > limit:
        raise too_large
    size = 0
    try:
        with open(path, "xb") as file:
            async for piece in request.stream():
                size += len(piece)
                if size > limit:
                    raise too_large
                await run_in_threadpool(file.write, piece)
    except ClientDisconnect:
        raise RequestError("the upload was interrupted") from None
    except OSError as error:
        raise RequestError(f"the upload cannot be stored: {error.strerror or error}", 507) from error
    if not size:
        raise RequestError(f"{path.name} is empty; choose another file")


# --- requests --------------------------------------------------------------------------------------------------


def _describe(page: Page, message: Mapping[str, Any]) -> dict[str, Any]:
    """Return a message to the worker with names and kinds of the files of the page."""
    return {**message, "files": {name: stored.facts() for name, stored in page.files.items()}}


async def _ask(page: Page, message: Mapping[str, Any], lane: str | None) -> AsyncGenerator[AnswerFrame, None]:
    """Yield the frames of a request; an error of the server's becomes one too."""
    try:
        async for frame in page.run(_describe(page, message), lane):
            yield frame
    except InfillError as error:
        yield AnswerFrame.of_json(ERROR, {"message": str(error), "parameter": error.parameter})


async def _read_json(request: Request, limits: StudioLimits) -> dict[str, Any]:
    """Return the JSON of a request, an object."""
    body = b""
    async for piece in request.stream():
        body += piece
        if len(body) > limits.request_bytes:
            raise RequestError("this request is too large", STATUS_OF_TOO_MUCH)
    try:
        value = json.loads(body)
    except (ValueError, RecursionError):
        raise RequestError("this request is not JSON") from None
    if not isinstance(value, dict):
        raise RequestError("this request is not a JSON object")
    return value


def _known_file(page: Page, name: object) -> str:
    """Return the id of a file of a page."""
    if not isinstance(name, str) or name not in page.files:
        raise RequestError(f"there is no file {str(name)[:40]!r} on this page", STATUS_OF_MISSING)
    return name


async def answer_request(studio: Studio, request: Request) -> StreamedAnswer:
    """Let the worker make a product; the newest request of a lane cancels those before."""
    page = _find_page(studio, request)
    wish = await _read_json(request, studio.limits)
    product, options = wish.get("product"), wish.get("options", {})
    if not isinstance(product, str) or not isinstance(options, dict):
        raise RequestError("a request has a product and options")
    quality = wish.get("quality", "exact")
    if quality not in ("coarse", "exact"):
        raise RequestError("the quality is coarse or exact")
    file_id = None if wish.get("file") is None else _known_file(page, wish["file"])
    result = page.new_name("r") if quality == "exact" else None
    message = {
        "action": "make",
        "product": product,
        "file": file_id,
        "options": options,
        "quality": quality,
        "layer": wish.get("layer"),
        "result": result,
    }

    async def frames() -> AsyncGenerator[bytes, None]:
        """Yield the frames of the answer, and remember the request of the result."""
        async for frame in _ask(page, message, str(wish.get("lane", product))):
            if frame.kind == ANSWER and result is not None:
                page.results[result] = message
            yield frame.to_http()

    return StreamedAnswer(pieces=frames())


async def _take_one(page: Page, message: Mapping[str, Any]) -> AnswerFrame:
    """Return the one frame that answers a request; raise its error."""
    async for frame in _ask(page, message, None):
        if frame.kind == ERROR:
            raise RequestError(json.loads(frame.payload)["message"])
        if frame.kind not in (0, 1):
            return frame
    raise RequestError("there is no answer")


async def send_result(studio: Studio, request: Request) -> Response:
    """Send the file of a result, in a format."""
    page, query = _find_page(studio, request), request.query_params
    result = request.path_params["result"]
    if result not in page.results:
        raise RequestError("there is no such result; make it again", STATUS_OF_MISSING)
    message = {
        "action": "download",
        "result": result,
        "request": page.results[result],
        "format": query.get("format", ""),
        "slicer": query.get("slicer"),
    }
    frame = await _take_one(page, message)
    assert frame.kind == FILE
    made = json.loads(frame.payload)
    disposition = f"attachment; filename*=UTF-8''{quote(made['name'])}"
    return FileResponse(
        made["path"],
        media_type="application/octet-stream",
        headers={"content-disposition": disposition},
        background=BackgroundTask(_remove, Path(made["path"]).parent),
    )


async def send_slice(studio: Studio, request: Request) -> Response:
    """Send a slice of a scan as a grey picture."""
    page, query = _find_page(studio, request), request.query_params
    file_id = _known_file(page, request.path_params["file"])
    message = {"action": "slice", "file": file_id, **{key: query.get(key) for key in ("axis", "index", "low", "high")}}
    frame = await _take_one(page, message)
    return Response(frame.payload, media_type="image/png")


async def send_layer(studio: Studio, request: Request) -> Response:
    """Send a layer of a print: its beads, with speed and feature."""
    page = _find_page(studio, request)
    file_id, result = _known_file(page, request.path_params["file"]), request.query_params.get("result")
    if result is not None and result not in page.results:
        raise RequestError("there is no such result; make it again", STATUS_OF_MISSING)
    message = {
        "action": "layer",
        "file": file_id,
        "layer": request.path_params["layer"],
        "result": result,
        "request": None if result is None else page.results[result],
    }
    frame = await _take_one(page, message)
    return Response(frame.payload, media_type="application/octet-stream")
