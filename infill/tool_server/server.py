"""The server: it lists the tools, runs their commands one after another, and answers with reports and pictures."""

from __future__ import annotations

import base64
import json
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import anyio
from mcp.server import Server, ServerRequestContext
from mcp.server.stdio import stdio_server
from mcp_types import (
    CallToolRequestParams,
    CallToolResult,
    ImageContent,
    ListToolsResult,
    PaginatedRequestParams,
    TextContent,
    Tool,
    ToolAnnotations,
)

from infill.errors import InfillError, escape_unprintable
from infill.tool_server.command_runs import CommandOutcome, ReportProgress, run_command
from infill.tool_server.folders import AllowedFolders
from infill.tool_server.tools import TOOLS, CommandTool, write_words
from infill.version import __version__
from patterns.errors import PatternError

INSTRUCTIONS = """Infill for 3D printing, and smooth meshes from scans. Lengths are millimetres, angles degrees.
Files lie in {folders}; other files cannot be read or written, and nothing is overwritten unless overwrite is true.
fill, make and smooth write closed meshes; refill rewrites G-code, and verify proves that nothing else changed.
dry_run says first what a long call would cost. Tell the person the verdict and the warnings of a result."""


class ToolServer:
    """The tools on some folders.

    Parameters
    ----------
    folders : AllowedFolders
    """

    def __init__(self, folders: AllowedFolders) -> None:
        self.folders = folders
        self._turn = anyio.Semaphore(1)  # a command may take all memory that is free

    async def list_tools(
        self,
        context: ServerRequestContext[Any],  # noqa: ARG002 - as the SDK calls it
        params: PaginatedRequestParams | None,  # noqa: ARG002
    ) -> ListToolsResult:
        """Return all tools."""
        return ListToolsResult(tools=[describe_tool(name, tool) for name, tool in TOOLS.items()])

    async def call_tool(self, context: ServerRequestContext[Any], params: CallToolRequestParams) -> CallToolResult:
        """Run a tool; an error of the library is a result that says so."""
        tool = TOOLS.get(params.name)
        if tool is None:
            return error_result(f"there is no tool {params.name!r}; choose from {', '.join(TOOLS)}")

        latest = 0.0

        async def report_progress(share: float, stage: str) -> None:
            """Tell the client how far the command is; the share may only grow."""
            nonlocal latest
            if share > latest:
                latest = share
                await context.session.report_progress(share, 1.0, stage)

        try:
            return await self._run(params.name, tool, params.arguments or {}, report_progress)
        except (InfillError, PatternError) as error:
            return error_result(error.spell(lambda name: name))

    async def _run(
        self, name: str, tool: CommandTool, values: Mapping[str, Any], report_progress: ReportProgress
    ) -> CallToolResult:
        """Run the command of a tool and return its result."""
        with tempfile.TemporaryDirectory(prefix="infill-tools-") as scratch:
            picture = Path(scratch, "picture.png")
            words = write_words(name, tool, values, self.folders, picture)
            async with self._turn:
                outcome = await run_command(words, self.folders.roots[0], report_progress)
            return make_result(tool, outcome, picture)


def describe_tool(name: str, tool: CommandTool) -> Tool:
    """Return a tool as a client sees it."""
    return Tool(
        name=name,
        description=tool.help,
        input_schema=tool.schema(),
        annotations=ToolAnnotations(read_only_hint=not tool.writes, open_world_hint=False),
    )


def error_result(message: str) -> CallToolResult:
    """Return an error as the result of a tool."""
    return CallToolResult(content=[TextContent(text=escape_unprintable(message))], is_error=True)


def make_result(tool: CommandTool, outcome: CommandOutcome, picture: Path) -> CallToolResult:
    """Return the outcome of a command as the result of its tool: messages, report and picture."""
    if outcome.report is None or (outcome.error and not tool.judges):
        return error_result(tool.use_keys(outcome.error or outcome.messages or "the command answered nothing"))
    report = outcome.report if isinstance(outcome.report, dict) else {"files": outcome.report}
    if "files" in report and str(picture) in report["files"]:
        report = {**report, "files": [file for file in report["files"] if file != str(picture)]}
    lines = outcome.messages.replace(f", {picture}", "").split("\n")
    text = "\n".join(line for line in lines if str(picture) not in line)
    content: list[Any] = [TextContent(text=tool.use_keys(text))] if text else []
    content.append(TextContent(text=json.dumps(report)))
    if picture.is_file():
        data = base64.b64encode(picture.read_bytes()).decode()
        content.append(ImageContent(data=data, mime_type="image/png"))
    failed = bool(outcome.status) and not tool.judges
    return CallToolResult(content=content, structured_content=report, is_error=failed)


def serve_tools(folders: AllowedFolders) -> None:
    """Serve the tools over stdin and stdout until stdin ends; whatever else is printed goes to stderr."""
    anyio.run(_serve, folders)


async def _serve(folders: AllowedFolders) -> None:
    """Serve the tools."""
    tools = ToolServer(folders)
    server = Server(
        "phasefill",
        title="phasefill",
        version=__version__,
        instructions=INSTRUCTIONS.format(folders=folders),
        on_list_tools=tools.list_tools,
        on_call_tool=tools.call_tool,
    )
    async with stdio_server() as (reading, writing):
        await server.run(reading, writing, server.create_initialization_options())
