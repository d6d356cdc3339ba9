# SPDX-License-Identifier: BSD-3-Clause
"""Folders of results."""
from __future__ import annotations

import fcntl
import os
from contextlib import contextmanager
from pathlib import Path
from typing import Iterable, Iterator, Union

from ._core import write_files_into


def folder_of(name: Union[str, "os.PathLike[str]"]) -> Path:
    """A folder that somebody names.

    Raises:
        ValueError: by the empty name, which would be the folder at hand.
    """
    if not os.fspath(name):
        raise ValueError("folder: a name is needed; '.' is the folder at hand")
    return Path(name)


@contextmanager
def kept_for_one_run(folder: Path, names: Iterable[str], force: bool) -> Iterator[None]:
    """Make a folder, and keep out whoever else would write there: Python and the program, by the same lock.

    Nothing remains of the lock, however the process ends. On a file system without locks it keeps nobody out.

    Args:
        names: what will be written, or goes.
        force: whether that may be there.

    Raises:
        FileExistsError: one of the names is there.
        RuntimeError: the folder cannot be made, or another run is writing there.
    """
    write_files_into(os.fspath(folder), {})
    place = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        try:
            fcntl.flock(place, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise RuntimeError(f"{folder}: another run is writing there") from None
        except OSError:
            pass
        taken = [name for name in names if os.path.lexists(folder / name)]
        if taken and not force:
            raise FileExistsError(f"{folder / taken[0]}: is there already (force=True overwrites it)")
        yield
    finally:
        os.close(place)
