# SPDX-License-Identifier: BSD-3-Clause
"""The command line: python -m cca_mrpt map LOG [--out FOLDER]."""
import argparse
import sys
from pathlib import Path

from . import LineMap, read_log
from ._core import write_files_into


def map_log(log: str, out: Path) -> str:
    """Write the line map of a log into a folder; what was done, in a sentence."""
    line_map = LineMap()
    trajectory = []
    scans = read_log(log)
    for scan in scans:
        line_map.insert(scan.ranges, scan.angle_min, scan.angle_increment, scan.pose)
        trajectory.append(scan.pose)
    if scans.warnings:
        print(f"{log}: {scans.warnings}", file=sys.stderr)
    write_files_into(
        str(out),
        {
            "lines.csv": line_map.to_csv(),
            "lines.geojson": line_map.to_geojson(trajectory),
            "lines.svg": line_map.to_svg(trajectory),
        },
    )
    return f"{len(line_map.lines())} lines from {len(trajectory)} scans; lines.csv, .geojson and .svg are in {out}"


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(prog="cca_mrpt", description="line maps of laser logs")
    commands = parser.add_subparsers(dest="command", required=True)
    map_command = commands.add_parser("map", help="line map of a whole CARMEN log")
    map_command.add_argument("log", metavar="LOG", help="CARMEN .log or .log.gz with corrected poses")
    map_command.add_argument("--out", type=Path, help="folder to write to (default: out/NAME_OF_LOG)")
    options = parser.parse_args(arguments)
    out = options.out or Path("out") / Path(options.log).name.split(".")[0]
    try:
        print(map_log(options.log, out))
    except (OSError, ValueError, RuntimeError) as error:
        print(f"cca_mrpt: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
