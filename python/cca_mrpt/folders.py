# SPDX-License-Identifier: BSD-3-Clause
"""Folders of results, and what is in them."""
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


def text_of(path: Path) -> str:
    """The text of a file. Raises ValueError naming it where it holds none, and OSError."""
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise ValueError(f"{path}: is damaged: no text ({error})") from None


def require_writable(folder: Path, names: Iterable[str], force: bool) -> None:
    """See that files may be written into a folder, which need not be there yet: before the work, and before any is.

    Args:
        force: whether files of these names may be there. Into devices and pipes anybody may write.

    Raises:
        FileExistsError: one of the names is there, and `force` is not given.
        OSError: the folder is none, or cannot be written to, or a folder has one of the names.
    """
    nearest = folder
    while not os.path.lexists(nearest):
        nearest = nearest.parent
    if not nearest.is_dir():
        raise NotADirectoryError(f"{nearest}: is no folder")
    if not os.access(nearest, os.W_OK | os.X_OK):
        raise PermissionError(f"{nearest}: cannot be written to")
    for path in (folder / name for name in names):
        if path.is_dir():
            raise IsADirectoryError(f"{path}: is a folder")
        is_device = path.exists() and not path.is_file()
        if os.path.lexists(path) and not force and not is_device:
            raise FileExistsError(f"{path}: is there already (force=True overwrites it)")


@contextmanager
def kept_for_one_run(folder: Path, names: Iterable[str], force: bool) -> Iterator[None]:
    """Make a folder, and keep out whoever else would write there: Python and the program, by the same lock.

    Nothing remains of the lock, however the process ends. On a file system without locks it keeps nobody out.

    Args:
        names: what will be written, or goes.
        force: whether that may be there.

    Raises:
        OSError: see `require_writable`.
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
        require_writable(folder, names, force)
        yield
    finally:
        os.close(place)
