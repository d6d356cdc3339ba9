# SPDX-License-Identifier: BSD-3-Clause
"""evaluate: the program's figures, from Python and by its command."""
import json
import subprocess

import pytest

import cca_mrpt
from cca_mrpt.__main__ import main
from cca_mrpt.program import installed_program
import room_log

TRUTH = "-3,-2,3,-2\n3,-2,3,2\n3,2,-3,2\n-3,2,-3,-2\n"


@pytest.fixture(scope="module")
def mapped(tmp_path_factory):
    """A log, the map of it and its folder, and a world."""
    folder = tmp_path_factory.mktemp("mapped")
    log = folder / "room.log.gz"
    room_log.write(log)
    made = cca_mrpt.map(log)
    made.save(folder / "map")
    (folder / "world.truth.csv").write_text(TRUTH)
    return log, made, folder / "map", folder / "world.yaml"


@pytest.mark.skipif(not installed_program(), reason="needs the program cca-mrpt")
def test_evaluate_prints_what_the_program_prints(mapped, capsys):
    log, _, folder, world = mapped
    for against in ["--log", str(log)], ["--world", str(world)]:
        its = subprocess.run([installed_program(), "evaluate", str(folder / "lines.csv"), *against], capture_output=True, text=True)
        assert main(["evaluate", str(folder), *against]) == 0
        assert capsys.readouterr().out == its.stdout != ""


def test_a_map_is_judged_as_its_folder_is(mapped, tmp_path):
    log, made, folder, world = mapped
    figures = cca_mrpt.evaluate(made, log)
    assert figures == cca_mrpt.evaluate(folder, iter(cca_mrpt.read_log(log)))
    assert figures["points"]["explained_10"] > 0.9 and figures["map"]["segments"] == len(made)
    assert set(cca_mrpt.evaluate(made, world=world)) != set(figures)
    assert main(["evaluate", str(folder), "--log", str(log), "--out", str(tmp_path / "score.json")]) == 0
    assert json.loads((tmp_path / "score.json").read_text()) == figures
    (tmp_path / "score.json").write_text("mine")
    again = ["evaluate", str(folder), "--log", str(log), "--out", str(tmp_path / "score.json")]
    assert main(again) == 1 and (tmp_path / "score.json").read_text() == "mine"
    assert main([*again, "--force"]) == 0 and (tmp_path / "score.json").read_text() != "mine"


def test_evaluate_says_what_is_wrong(mapped, tmp_path, capsys):
    log, made, folder, world = mapped
    for against in {}, {"log": log, "world": world}:
        with pytest.raises(ValueError, match="one of them"):
            cca_mrpt.evaluate(made, **against)
    with pytest.raises(ValueError, match="true segments are not known"):
        cca_mrpt.evaluate(made, world=tmp_path / "none.yaml")
    scan_lines = tmp_path / "lines.csv"
    scan_lines.write_text("scan_id,x1,y1,x2,y2\n0,0,0,1,0\n")
    with pytest.raises(ValueError, match="lines of single scans"):
        cca_mrpt.evaluate(scan_lines, log)
    assert main(["evaluate", str(tmp_path / "none"), "--log", str(log)]) == 1
    assert f"{tmp_path / 'none'}: No such file" in capsys.readouterr().err
