#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Run the code of a page as a reader does, word for word: run_page.py PAGE FOLDER install|examples

install: its first block of shell commands. examples: all others, each by itself, in order. Exit status 1 where one
fails. What needs MRPT or the program says so and is left out where they are not.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

BLOCK = re.compile(r"^```(sh|python)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# The page names what Debian has; where all of it is installed there is nothing to do.
APT = 'apt() { shift; dpkg -s "$@" >/dev/null 2>&1 || command apt-get install -y --no-install-recommends "$@"; }\n'


def missing_for(code):
    """What a block needs and this machine lacks, in words; None: it can run."""
    if re.search(r"batch\.explore|^cca-mrpt", code, re.MULTILINE) and not shutil.which("cca-mrpt"):
        return "the program cca-mrpt"
    if "environment" in code and subprocess.run(["python", "-c", "from cca_mrpt import Simulation"], capture_output=True).returncode:
        return "the simulator, which needs MRPT"
    return None


def run(kind, code, folder):
    """As one who copies it into a script of his own."""
    if kind == "sh":
        return subprocess.run(["bash", "-eu", "-c", APT + code], cwd=folder).returncode == 0
    script = Path(folder) / "example.py"
    script.write_text(code, encoding="utf-8")
    return subprocess.run(["python", script.name], cwd=folder).returncode == 0


def main(page, folder, part):
    text = Path(page).read_text(encoding="utf-8")
    blocks = [(text.count("\n", 0, found.start()) + 1, found[1], found[2]) for found in BLOCK.finditer(text)]
    install = next((block for block in blocks if block[1] == "sh"), None)
    failed = 0
    for line, kind, code in [install] if part == "install" else [b for b in blocks if b != install]:
        missing = missing_for(code)
        passed = bool(missing) or run(kind, code, os.path.abspath(folder))
        print(f"{page}:{line}: " + (f"SKIPPED (needs {missing})" if missing else "passed" if passed else "FAILED"), flush=True)
        failed += not passed
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
