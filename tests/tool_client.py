"""An assistant without a model: the SDK's own client, on a real server over stdin and stdout."""

from __future__ import annotations

import base64
import contextlib
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Any

from anyio.from_thread import BlockingPortal, start_blocking_portal
from mcp.client import Client
from mcp.client.stdio import StdioServerParameters, stdio_client
from PIL import Image


@dataclass(kw_only=True)
class ToolAnswer:
    """The result of a call, and the progress before it."""

    result: Any
    progress: list[tuple[float, str | None]] = field(default_factory=list)

    @property
    def texts(self) -> list[str]:
        return [block.text for block in self.result.content if block.type == "text"]

    @property
    def error(self) -> str:
        assert self.result.is_error, self.texts
        (text,) = self.texts
        assert "\n" not in text
        return text

    @property
    def report(self) -> dict[str, Any]:
        assert not self.result.is_error, self.texts
        return self.result.structured_content

    @property
    def picture(self) -> Image.Image:
        (block,) = (block for block in self.result.content if block.type == "image")
        assert block.mime_type == "image/png"
        return Image.open(BytesIO(base64.b64decode(block.data)))


@dataclass(kw_only=True)
class ToolClient:
    """A connection to a server."""

    client: Client
    portal: BlockingPortal
    mode: str = "auto"

    def tools(self) -> dict[str, Any]:
        listed = self.portal.call(self.client.list_tools)
        return {tool.name: tool for tool in listed.tools}

    async def acall(self, name: str, arguments: dict[str, Any]) -> ToolAnswer:
        progress: list[tuple[float, str | None]] = []

        async def note(share: float, total: float | None, message: str | None) -> None:
            assert total == 1.0
            progress.append((share, message))

        result = await self.client.call_tool(name, arguments, progress_callback=note)
        return ToolAnswer(result=result, progress=progress)

    def call(self, tool: str, **arguments: Any) -> ToolAnswer:
        return self.portal.call(self.acall, tool, arguments)


@contextlib.contextmanager
def run_client(
    cwd: Path,
    *words: str,
    program: Sequence[str] = (sys.executable, "-m", "infill.cli"),
    mode: str = "auto",
    errors: Any = None,
) -> Iterator[ToolClient]:
    """Start a server in a folder and connect to it."""
    server = StdioServerParameters(command=program[0], args=[*program[1:], "mcp", *words], cwd=cwd)
    transport = stdio_client(server) if errors is None else stdio_client(server, errlog=errors)
    with (
        start_blocking_portal() as portal,
        portal.wrap_async_context_manager(Client(transport, mode=mode)) as client,
    ):
        yield ToolClient(client=client, portal=portal, mode=mode)
