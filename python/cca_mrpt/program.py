# SPDX-License-Identifier: BSD-3-Clause
"""The command `cca-mrpt` that comes with the package: the C++ program where one is installed, else Python's part."""
import os
import sys
from pathlib import Path
from typing import Optional


def installed_program() -> Optional[str]:
    """The path of the C++ program `cca-mrpt`, the first one in PATH; None: there is none."""
    for folder in os.get_exec_path():
        candidate = Path(folder or ".") / "cca-mrpt"
        try:
            with candidate.open("rb") as file:
                if file.read(4) == b"\x7fELF" and os.access(candidate, os.X_OK):
                    return str(candidate)
        except OSError:  # not there, or not ours to read
            continue
    return None


def main() -> int:
    program = installed_program()
    if program:
        os.execv(program, [program, *sys.argv[1:]])
    from .__main__ import main as python_main

    return python_main()
