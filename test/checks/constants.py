#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Each named constant of the algorithm layers has its unit and its reason beside it.

usage: constants.py [--count]

A constant is `constexpr ... kName = ...`, and a number that a field of a `struct ...Tuning` begins with. Its reason is
the comment on its lines, below them in the same column, or right above: five words at least. What follows from other
constants alone (`2.0 * M_PI / kSectors`, an infinity, names) needs none.

Exit status 1 where one lacks it. --count prints for each layer how many there are.
"""
import collections
import pathlib
import re
import sys

LAYERS = "geometry motion sensing localisation mapping slam known_map navigation session floor_plan".split()
FEWEST_WORDS = 5
ROOT = pathlib.Path(__file__).resolve().parents[2]
CONSTANT = re.compile(r"\bconstexpr\b[^(;]*?\b(k[A-Z]\w*)\s*(?:\[\w*\])?\s*[={]")
FIELD = re.compile(r"^\s+(?:int|float|double|unsigned|std::size_t)\s+(\w+)\s*[={]\s*-?[\d.]")
FOLLOWS = re.compile(r"\bk[A-Z]\w*|\bM_PI\b|numeric_limits|\"")


def declaration(lines, first):
    """The code of the declaration that begins in a line, without comments, and the number of its last line."""
    last = first
    while ";" not in lines[last].split("//")[0] and last + 1 < len(lines):
        last += 1
    return " ".join(line.split("//")[0] for line in lines[first:last + 1]), last


def follows_from_others(code):
    value = re.split(r"[={]", code, maxsplit=1)[1]
    numbers = re.findall(r"(?<![\w.])(?:0x[\da-fA-F]+|\d+\.?\d*(?:[eE][-+]?\d+)?)", value)
    return bool(FOLLOWS.search(value)) and all(number in ("0", "0.0", "1", "1.0", "2", "2.0") for number in numbers)


def reason(lines, first, last):
    """The words of the comments that belong to a declaration."""
    def said(line):
        return re.split(r"//[/!]?<?", line, maxsplit=1)[1].split()

    words = []
    indent = len(lines[first]) - len(lines[first].lstrip())
    for above in reversed(lines[:first]):
        if above.find("//") != indent:
            break
        words += said(above)
    for line in lines[first:last + 1]:
        words += said(line) if "//" in line else []
    column = lines[last].find("//")
    for below in lines[last + 1:]:
        if column < 0 or below.find("//") != column or below[:column].strip():
            break
        words += said(below)
    return words


def constants(path):
    """(line, name, whether it has its reason) of each."""
    lines = path.read_text().split("\n")
    in_tuning = False
    for first, line in enumerate(lines):
        in_tuning = (in_tuning or bool(re.match(r"\s*struct \w*Tuning\b[^;]*$", line))) and not re.match(r"\s*\};", line)
        bare = line.split("//")[0]
        found = CONSTANT.search(bare) or (FIELD.search(bare) if in_tuning else None)
        if found:
            code, last = declaration(lines, first)
            has_reason = len(reason(lines, first, last)) >= FEWEST_WORDS
            yield first + 1, found.group(1), has_reason or follows_from_others(code)


def main():
    counts, lacking = collections.Counter(), []
    for layer in LAYERS:
        for folder in "include/cca_mrpt", "src":
            for path in sorted((ROOT / folder / layer).rglob("*.[ch]pp")):
                for line, name, has_reason in constants(path):
                    counts[layer] += 1
                    if not has_reason:
                        lacking.append(f"{path.relative_to(ROOT)}:{line}: {name} has no unit and reason beside it")
    if "--count" in sys.argv:
        for layer in LAYERS:
            print(f"{layer}: {counts[layer]}")
    print("\n".join(lacking) if lacking else f"constants: {sum(counts.values())}, each with its reason")
    return 1 if lacking else 0


sys.exit(main())
