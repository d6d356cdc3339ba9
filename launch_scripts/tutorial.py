#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands of docs/tutorial.md and puts what they say below them.

usage: tutorial.py PROGRAM [--intel LOG] [--check]

A block of the page that begins with `$ cca-mrpt ...` is run line by line in an empty folder; blocks of
commands without output below them are run as well, and stay. With --check the page stays as it is, and
the exit status is 1 where a command says something else, seconds aside. A command may end with status 3, where
wheels contradict the map that they make. Without the Intel log, blocks that use it are left out.
"""
import os
import re
import subprocess
import sys
import tempfile

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "docs", "tutorial.md")
SENA = "/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog"
SECONDS = re.compile(r" in [0-9.]+ s\b")


def run(command, program, intel, folder):
    script = 'cca-mrpt() { "%s" "$@"; }; SENA="%s"; INTEL=%s; %s' % (program, SENA, os.path.basename(intel or "none"), command)
    done = subprocess.run(["bash", "-c", script], cwd=folder, capture_output=True, text=True)
    if done.returncode not in (0, 3):
        raise SystemExit("%s: status %d: %s" % (command, done.returncode, done.stderr))
    return done.stdout.rstrip("\n").split("\n") if done.stdout else []


def main():
    arguments = sys.argv[1:]
    check = "--check" in arguments
    intel = arguments[arguments.index("--intel") + 1] if "--intel" in arguments else None
    if not arguments or arguments[0].startswith("-"):
        raise SystemExit(__doc__)
    if intel and not os.path.exists(intel):
        print("skipped, is missing: " + intel)
        intel = None
    program = os.path.abspath(arguments[0])
    text = open(PAGE, encoding="utf-8").read()
    differs = []
    with tempfile.TemporaryDirectory() as folder:
        if intel:
            os.symlink(os.path.abspath(intel), os.path.join(folder, os.path.basename(intel)))

        def renew(match):
            lines = match.group(1).strip("\n").split("\n")
            if not lines[0].startswith("$ cca-mrpt") or ("INTEL" in match.group(1) and not intel):
                return match.group(0)
            shows = any(not line.startswith("$") for line in lines)
            new = []
            for line in lines:
                if line.startswith("$"):
                    said = run(line[2:], program, intel, folder)
                    new += [line] + (said if shows else [])
            bare = [[SECONDS.sub("", line) for line in some] for some in (lines, new)]
            differs.extend("- %s\n+ %s" % pair for pair in zip(*bare) if pair[0] != pair[1])
            return "```\n" + "\n".join(new) + "\n```"

        text = re.sub(r"^```\n(.*?)^```$", renew, text, flags=re.S | re.M)
    if check:
        print("\n".join(differs) or "the tutorial says what the program says")
        raise SystemExit(1 if differs else 0)
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
