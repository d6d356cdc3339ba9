# SPDX-License-Identifier: BSD-3-Clause
"""Runs to look at again: `cca-mrpt render --html`."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Optional, Union

from ._core import page_of_runs, runs_of_page


def _run_of(source: "Union[str, os.PathLike[str]]") -> str:
    """The run of a folder, or of a page."""
    path = Path(source)
    if path.is_dir():
        path /= "replay.html"
    return runs_of_page(path.read_text(encoding="utf-8", errors="replace"), os.fspath(path))[0]


def replay_page(run: "Union[str, os.PathLike[str]]", beside: "Optional[Union[str, os.PathLike[str]]]" = None) -> str:
    """The page that replays a run, by the package as it is now: one text that asks nothing of any network.

    Args:
        run: the folder of a map, or its replay.html.
        beside: of a second run, to be seen beside it.

    Raises:
        OSError: there is none.
        ValueError: it holds no run; names the file.
    """
    return page_of_runs([_run_of(source) for source in (run, beside) if source is not None])
