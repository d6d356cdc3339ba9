# SPDX-License-Identifier: BSD-3-Clause
"""Wall time of Python's map over the program's: wall_time.py PROGRAM LOG..., where nothing else is running."""
import filecmp
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import List

RUNS = 9  # of each, in turns: a busy moment meets both


def seconds_of(command: List[str]) -> float:
    begin = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - begin


def compare(program: str, log: str) -> None:
    programs = {"program": [program], "python": [sys.executable, "-m", "cca_mrpt"]}
    taken = {name: [] for name in programs}  # type: dict[str, List[float]]
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(RUNS):
            for name, command in programs.items():
                taken[name].append(seconds_of([*command, "map", log, "--force", "--out", str(Path(folder) / name)]))
        same = filecmp.cmp(Path(folder) / "program/lines.csv", Path(folder) / "python/lines.csv", shallow=False)
    ours, its = (statistics.median(taken[name]) for name in ("python", "program"))
    print(f"{log}: Python {ours:.2f} s, program {its:.2f} s, ratio {ours / its:.2f}, {'the same' if same else 'OTHER'} lines")


if __name__ == "__main__":
    for each in sys.argv[2:]:
        compare(sys.argv[1], each)
