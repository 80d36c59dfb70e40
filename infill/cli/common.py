"""Flags that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

FILES, RUN = "Files", "Run"

Config = Annotated[
    Path | None, typer.Option(metavar="FILE", help="TOML file of options; flags override it.", rich_help_panel=FILES)
]
SaveConfig = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", help="TOML file to write all options to, for --config; - for stdout.", rich_help_panel=FILES
    ),
]
TrustFiles = Annotated[
    bool, typer.Option("--trust", help="Let the config file name files outside of its folder.", rich_help_panel=FILES)
]
TrustCode = Annotated[
    bool,
    typer.Option(
        "--trust",
        help="Let the config file name code to run, and files outside of its folder.",
        rich_help_panel=FILES,
    ),
]
AsciiStl = Annotated[bool, typer.Option("--ascii", help="Write STL as text.", rich_help_panel=FILES)]
Force = Annotated[bool, typer.Option("--force", help="Overwrite existing files.", rich_help_panel=FILES)]
Threads = Annotated[
    int | None, typer.Option(metavar="N", help="Threads to use. (default: one per core)", rich_help_panel=RUN)
]
MaxMemory = Annotated[
    str | None,
    typer.Option(
        metavar="SIZE", help="Memory to use at most, such as 2G. (default: what is free)", rich_help_panel=RUN
    ),
]
Json = Annotated[
    bool, typer.Option("--json", help="Print the report as one JSON object to stdout.", rich_help_panel=RUN)
]
Quiet = Annotated[bool, typer.Option("-q", "--quiet", help="Print errors only.", rich_help_panel=RUN)]
Verbose = Annotated[bool, typer.Option("-v", "--verbose", help="Say more.", rich_help_panel=RUN)]
