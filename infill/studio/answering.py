"""An answer in frames over HTTP, and the stream of life of a page; both end as soon as the browser is gone."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncGenerator, Awaitable, Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from starlette.types import Receive, Scope, Send

HEARTBEAT = 10.0  # s


@dataclass(frozen=True, kw_only=True)
class StreamedAnswer:
    """An ASGI response that sends pieces as they come, and closes their source once the browser has gone.

    Parameters
    ----------
    pieces : asynchronous generator of bytes
    media_type : str
    at_end : callable, optional
        Awaited at the end, in either case.
    """

    pieces: AsyncGenerator[bytes, None]
    media_type: str = "application/octet-stream"
    at_end: Callable[[], Awaitable[None]] | None = None

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:  # noqa: ARG002 - as ASGI calls it
        """Send the pieces."""
        sending = asyncio.create_task(self._send(send))
        leaving = asyncio.create_task(_wait_for_disconnect(receive))
        try:
            await asyncio.wait({sending, leaving}, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in (sending, leaving):
                task.cancel()
            await asyncio.gather(sending, leaving, return_exceptions=True)
            with contextlib.suppress(RuntimeError):
                await self.pieces.aclose()
            if self.at_end is not None:
                await self.at_end()
        if not sending.cancelled() and (error := sending.exception()) is not None and not isinstance(error, OSError):
            raise error

    async def _send(self, send: Send) -> None:
        """Send the head, the pieces and the end."""
        headers = [(b"content-type", self.media_type.encode())]
        await send({"type": "http.response.start", "status": 200, "headers": headers})
        async for piece in self.pieces:
            await send({"type": "http.response.body", "body": piece, "more_body": True})
        await send({"type": "http.response.body", "body": b"", "more_body": False})


async def _wait_for_disconnect(receive: Receive) -> None:
    """Wait until the browser closes the connection."""
    while True:
        message = await receive()
        if message["type"] == "http.disconnect":
            return


async def beat(*stops: asyncio.Event) -> AsyncGenerator[bytes, None]:
    """Yield a comment of an event stream now and then, until one of several events."""
    yield b": here\n\n"
    waits = [asyncio.create_task(stop.wait()) for stop in stops]
    try:
        while not any(stop.is_set() for stop in stops):
            await asyncio.wait(waits, timeout=HEARTBEAT, return_when=asyncio.FIRST_COMPLETED)
            yield b": here\n\n"
    finally:
        for wait in waits:
            wait.cancel()
