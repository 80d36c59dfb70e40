"""`serve`: run the studio until it is interrupted."""

from __future__ import annotations

import contextlib
import socket
import threading
import webbrowser
from collections.abc import Callable
from pathlib import Path

import uvicorn

from infill.errors import FormatError, OutputError, ParameterError
from infill.files.broken import missing_file
from infill.studio.app import Studio, build_app
from infill.studio.limits import StudioLimits
from infill.studio.pages import Pages
from infill.studio.work_folder import make_work_folder

LAST_SECONDS = 3  # for requests that run when the studio ends
MOST_PORT = 65535


def serve(
    opened: Path | None = None,
    *,
    host: str = "127.0.0.1",
    port: int = 0,
    browser: bool = True,
    limits: StudioLimits | None = None,
    announce: Callable[[str], None] = print,
) -> None:
    """Serve the studio until it is interrupted.

    Parameters
    ----------
    opened : Path, optional
        A file, or a folder of DICOM, that pages open at once.
    host : str
        Name or number of the network interface.
    port : int
        0 for any that is free.
    browser : bool
        Open the page in the browser.
    limits : StudioLimits, optional
        By default, those that suit this machine.
    announce : callable
        Called with the address of the page once the studio answers.

    Raises
    ------
    FormatError
        If the file does not exist.
    OutputError
        If the port is taken, or may not be used.
    """
    if opened is not None and not opened.exists():
        raise FormatError(missing_file(opened))
    if not 0 <= port <= MOST_PORT:
        raise ParameterError.about("port", f"is {port}; give a number from 0, for any that is free, to {MOST_PORT}")
    limits = limits or StudioLimits.of_machine()
    with _listen(host, port) as listener, make_work_folder() as folder:
        number = listener.getsockname()[1]
        studio = Studio(pages=Pages(folder, limits), limits=limits, opened=opened and opened.absolute())
        app = build_app(studio, host=host, port=number)
        shown = "127.0.0.1" if host in ("", "0.0.0.0") else f"[{host}]" if ":" in host else host  # noqa: S104
        address = f"http://{shown}:{number}/{app.token}/"

        def begin() -> None:
            """Announce the address, and open it."""
            announce(address)
            if browser:
                threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()

        config = uvicorn.Config(
            app,
            log_level="warning",
            access_log=False,
            server_header=False,
            date_header=False,
            ws="none",
            lifespan="on",
            timeout_graceful_shutdown=LAST_SECONDS,
        )
        with contextlib.suppress(KeyboardInterrupt):
            _Server(config, begin, studio).run(sockets=[listener])


class _Server(uvicorn.Server):
    """A server that says when it answers, and ends the streams of pages when it is to stop."""

    def __init__(self, config: uvicorn.Config, begin: Callable[[], None], studio: Studio) -> None:
        super().__init__(config)
        self._begin = begin
        self._studio = studio

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Start to listen, and announce it."""
        await super().startup(sockets)
        if self.started:
            self._begin()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Close all pages first, whose streams would keep the server waiting."""
        await self._studio.pages.close_all()
        await super().shutdown(sockets)


def _listen(host: str, port: int) -> socket.socket:
    """Return a socket that listens; raise OutputError if there can be none."""
    try:
        return socket.create_server((host, port), family=socket.AF_INET6 if ":" in host else socket.AF_INET)
    except (OSError, OverflowError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise OutputError(f"cannot listen at {host} port {port}: {reason}; give another port, or none") from error
