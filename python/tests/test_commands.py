# SPDX-License-Identifier: BSD-3-Clause
"""merge, localize and render: the program's, from Python and by its commands."""
import contextlib
import fcntl
import gzip
import itertools
import json
import operator
import os
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import cca_mrpt
from cca_mrpt.__main__ import main
from cca_mrpt.program import installed_program
from conftest import FULL_TURN

needs_program = pytest.mark.skipif(not installed_program(), reason="needs the program cca-mrpt")
OF_A_MAP = ["lines.csv", "arcs.csv", "lines.geojson", "lines.svg", "lines.dxf", "map.pgm", "map.yaml", "graph.g2o", "map.slam"]


def by(what, *words):
    """Exit status and error output of a command, of the program or of Python."""
    command = [installed_program()] if what == "program" else [sys.executable, "-m", "cca_mrpt"]
    done = subprocess.run([*command, *map(str, words)], capture_output=True, text=True)
    return done.returncode, done.stderr


def write_log(path, records):
    """A CARMEN log of records by ROBOTLASER1 lines, which tell their angles."""
    with gzip.open(path, "wt") as file:
        for record in records:
            head = f"ROBOTLASER1 0 {record.angle_min} {2 * np.pi} {record.angle_increment} 30 0.01 0 {len(record)}"
            ranges = " ".join(f"{r:.4f}" for r in record.ranges)
            wheels = " ".join(f"{number:.6f}" for number in record.odometry)
            file.write(f"{head} {ranges} 0 {wheels} {wheels} 0 0 0 0 0 {record.time} host {record.time}\n")
    return path


@pytest.fixture
def two_drives(two_rooms, scan_of):
    """Records of two drives through the same rooms, the second from elsewhere and the other way about."""
    stubs = [[[-3, 0.5], [-1.5, 0.5]], [[4, -2], [4, -1]], [[6, 2], [6, 1.2]], [[0, 2], [0.7, 1.3]]]
    rooms = np.concatenate([two_rooms, np.array(stubs)])  # which look like themselves from one place only
    drives = []
    for number, (first, last) in enumerate(((0, 4), (4.5, 0.5))):
        way, turn = np.linspace(first, last, 40), np.pi * number
        way = np.concatenate([way, way[::-1]])  # there and back
        driven = np.cos(turn) * (way - way[0])
        drives.append([cca_mrpt.LogRecord(scan_of(rooms, (x, 0.1, turn), beams=360, **FULL_TURN), **FULL_TURN, time=k / 5,
                                          odometry=(1.01 * driven[k], 3e-4 * k, 0)) for k, x in enumerate(way)])
    return drives


@pytest.fixture
def two_maps(two_drives, tmp_path):
    """Their maps' folders."""
    folders = [tmp_path / "map0", tmp_path / "map1"]
    for folder, records in zip(folders, two_drives):
        cca_mrpt.map(records).save(folder)
    return folders


@pytest.fixture
def two_logs(two_drives, tmp_path):
    """Their logs."""
    return [write_log(tmp_path / f"drive{k}.log.gz", records) for k, records in enumerate(two_drives)]


@pytest.fixture
def elsewhere(room, scan_of):
    """Records of a drive that is nowhere in those rooms."""
    small = 0.3 * np.asarray(room)
    return [cca_mrpt.LogRecord(scan_of(small, (0.01 * k, 0, 0), beams=360, **FULL_TURN), **FULL_TURN,
                               odometry=(0.01 * k, 0, 0)) for k in range(10)]


def test_two_maps_become_one(two_maps, tmp_path):
    made = cca_mrpt.merge(two_maps)
    alone = cca_mrpt.load(two_maps[0])
    assert made.summary["maps"] == [str(folder) for folder in two_maps] and made.summary["loops"] > 0
    assert made.shortcoming == "" and len(made.trajectory) == 0
    length = lambda lines: np.linalg.norm(lines["ends"][:, 1] - lines["ends"][:, 0], axis=1).sum()  # noqa: E731
    assert length(alone.lines) - 0.1 < length(made.lines) < length(alone.lines) + 3, "no wall stands twice"
    made.save(tmp_path / "merged")
    assert len(cca_mrpt.merge([tmp_path / "merged", two_maps[1]])) == len(made)


@needs_program
def test_the_program_merges_to_the_same_bytes(two_maps, tmp_path):
    for what in "program", "python":
        status, said = by(what, "merge", *two_maps, "--out", tmp_path / what)
        assert status == 0, said
    for name in OF_A_MAP:
        assert (tmp_path / "program" / name).read_bytes() == (tmp_path / "python" / name).read_bytes(), name


@pytest.mark.parametrize("what", ["python", pytest.param("program", marks=needs_program)])
def test_what_cannot_be_merged_is_named(two_maps, elsewhere, tmp_path, what):
    cca_mrpt.map(elsewhere).save(tmp_path / "other")
    status, said = by(what, "merge", two_maps[0], tmp_path / "other", "--out", tmp_path / "out")
    assert status == 1 and "no place of it was found" in said and str(tmp_path / "other") in said
    (two_maps[1] / "map.slam").write_bytes(b"nonsense")
    status, said = by(what, "merge", *two_maps, "--out", tmp_path / "out")
    assert status == 1 and "map.slam" in said
    assert by(what, "merge", two_maps[0], "--out", tmp_path / "out")[0] == 2
    assert not (tmp_path / "out" / "summary.json").exists()


def test_wrong_maps_raise(two_maps, tmp_path):
    with pytest.raises(ValueError, match="two or more"):
        cca_mrpt.merge(two_maps[:1])
    with pytest.raises(ValueError, match="none: is not there"):
        cca_mrpt.merge([two_maps[0], tmp_path / "none"])


def length_of(line_map):
    return np.linalg.norm(line_map.lines["ends"][:, 1] - line_map.lines["ends"][:, 0], axis=1).sum()


def test_a_map_is_gone_on_with(two_drives, two_maps):
    before, alone = cca_mrpt.load(two_maps[0]), cca_mrpt.load(two_maps[1])
    made = cca_mrpt.map(two_drives[1], resume=two_maps[0])
    assert made.summary["found_in_memory"] and made.summary["resumed"] == str(two_maps[0]) and made.warnings == ""
    assert len(made.trajectory) == 80 and length_of(before) - 0.1 < length_of(made) < length_of(before) + 3
    # In the frame of the first drive, which began at x = 0, looking the other way: .5 m or so from its last place.
    assert np.hypot(*(made.trajectory[0, :2] - (4.5, 0))) < 0.1 and abs(abs(made.trajectory[0, 2]) - np.pi) < 0.05
    assert np.abs(alone.trajectory[0]).max() < 0.01


def test_several_logs_make_one_map(two_drives, two_logs):
    for drives in two_drives, tuple(two_drives), two_logs, [two_drives[0], two_logs[1]], [iter(two_drives[0]), two_logs[1]]:
        made = cca_mrpt.map(drives)
        assert len(made.trajectory) == 160 and made.is_placed.all() and made.summary["pose"] == "slam"
        assert np.hypot(*(made.trajectory[80, :2] - (4.5, 0))) < 0.1
    assert cca_mrpt.map(two_logs).summary["logs"] == [str(log) for log in two_logs]


def test_a_drive_elsewhere_is_told(two_maps, elsewhere, tmp_path, capsys):
    made = cca_mrpt.map(elsewhere, resume=two_maps[0])
    assert not made.summary["found_in_memory"] and len(made) == 4
    assert made.warnings == f"no place of {two_maps[0]} was found: this is the map of the log alone"
    log = write_log(tmp_path / "elsewhere.log.gz", elsewhere)
    assert main(["map", str(log), "--resume", str(two_maps[0]), "--out", str(tmp_path / "out")]) == 0
    assert "this is the map of the log alone" in capsys.readouterr().err


@needs_program
@pytest.mark.parametrize("words", [["drive1.log.gz", "--resume", "map0"], ["drive0.log.gz", "drive1.log.gz"],
                                   ["drive0.log.gz", "drive1.log.gz", "--resume", "map1"]])
def test_the_program_joins_drives_to_the_same_bytes(two_maps, two_logs, tmp_path, words):
    for what in "program", "python":
        told = [word if word.startswith("--") else tmp_path / word for word in words]
        status, said = by(what, "map", *told, "--out", tmp_path / what)
        assert status == 0, said
    for name in [*OF_A_MAP, "poses.csv", "poses.tum"]:
        assert (tmp_path / "program" / name).read_bytes() == (tmp_path / "python" / name).read_bytes(), name
    told = [json.loads((tmp_path / what / "summary.json").read_text()) for what in ("program", "python")]
    for key in "log", "logs", "resumed", "found_in_memory", "loops", "scans", "agreement":
        assert told[0].get(key) == told[1].get(key), key


@pytest.mark.parametrize("words, named", [
    (["{log}", "{log}", "--pose", "odometry"], "joined by"), (["{log}", "--resume", "{none}"], "none"),
    (["{log}", "{none}"], "none"), (["{log}", "--pose", "log", "--resume", "{map}"], "joined by"),
])
@pytest.mark.parametrize("what", ["python", pytest.param("program", marks=needs_program)])
def test_what_cannot_be_joined_is_named(log, two_maps, tmp_path, words, named, what):
    paths = {"log": log, "map": two_maps[0], "none": tmp_path / "none"}
    status, said = by(what, "map", *[word.format(**paths) for word in words], "--out", tmp_path / "out")
    assert status == 1 and named in said and not (tmp_path / "out" / "summary.json").exists()


START = (-1.0, -0.3, 0.0)  # where the log of the room begins


@pytest.fixture
def plan(log, tmp_path):
    cca_mrpt.map(log).save(tmp_path / "plan")
    return tmp_path / "plan"


def test_a_log_is_localised_in_its_map(log, plan):
    truth = np.array([[x, 0.3 * x, 0.1 * k] for k, x in enumerate(np.linspace(-1, 1, 20))])
    found = cca_mrpt.localize(log, plan, START)
    assert len(found) == 20 and repr(found) == "Localisation(20 of 20 scans)" and found.shortcoming == ""
    assert np.abs(found.poses[:, :2] - truth[:, :2]).max() < 0.02
    assert np.array_equal(found.times, np.arange(20.0)) and found.summary["plan"]["kind"] == "CSV"
    records = iter(list(cca_mrpt.read_log(log)))  # also of what can be gone through once only
    assert np.array_equal(cca_mrpt.localize(records, plan, START).poses, found.poses)


def test_nothing_is_localised_where_two_places_look_alike(log, tmp_path, capsys):
    """A room of four right angles looks the same from its other end."""
    plan = tmp_path / "room.csv"
    plan.write_text("x1,y1,x2,y2\n-3,-2,3,-2\n3,-2,3,2\n3,2,-3,2\n-3,2,-3,-2\n")
    found = cca_mrpt.localize(log, plan)
    assert len(found) == 0 and "never localised" in found.shortcoming and "4 lines within 6.0 x 4.0 m" in found.shortcoming
    assert main(["localize", str(log), "--in", str(plan), "--out", str(tmp_path / "out")]) == 3
    assert "never localised" in capsys.readouterr().err
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["localised"] == 0


@needs_program
@pytest.mark.parametrize("kind", ["", "lines.csv", "lines.geojson", "lines.dxf", "map.slam", "plan.geojson", "plan.dxf",
                                  "plan.svg", "map.yaml"])
def test_the_program_localises_to_the_same_bytes(log, kind, tmp_path):
    assert by("program", "map", log, "--pose", "slam", "--out", tmp_path / "plan")[0] == 0
    for what in "program", "python":
        status, said = by(what, "localize", log, "--in", tmp_path / "plan" / kind, "--start", "-1,-0.3,0", "--out",
                          tmp_path / what)
        assert status == 0, said
    for name in "poses.csv", "poses.tum":
        assert (tmp_path / "program" / name).read_bytes() == (tmp_path / "python" / name).read_bytes(), name
    told = [json.loads((tmp_path / what / "summary.json").read_text()) for what in ("program", "python")]
    assert told[0].pop("program")
    assert all(summary.pop("localise_us")["mean"] > 0 for summary in told)
    assert told[0] == told[1]


@pytest.mark.parametrize("what", [pytest.param("program", marks=needs_program), "python"])
def test_poses_do_not_replace_those_of_a_map(log, plan, tmp_path, what):
    shutil.copytree(plan, tmp_path / "map")
    before = {path.name: path.read_bytes() for path in (tmp_path / "map").iterdir()}
    status, said = by(what, "localize", log, "--in", plan, "--start", "-1,-0.3,0", "--out", tmp_path / "map", "--force")
    assert status == 1 and "holds a map" in said
    assert {path.name: path.read_bytes() for path in (tmp_path / "map").iterdir()} == before
    with pytest.raises(FileExistsError, match="holds a map"):
        cca_mrpt.localize(log, plan, START).save(tmp_path / "map", force=True)


@needs_program
def test_a_grid_of_somebody_else_is_read_by_its_own_thresholds(log, tmp_path):
    assert by("program", "map", log, "--out", tmp_path / "plan")[0] == 0
    text, image = (tmp_path / "plan" / "map.yaml").read_text(), (tmp_path / "plan" / "map.pgm").read_bytes()
    head = image[:-len(image.split(b"\n255\n", 1)[1])]
    (tmp_path / "plan" / "map.pgm").write_bytes(head + bytes(255 - b for b in image[len(head):]))
    (tmp_path / "plan" / "map.yaml").write_text(text.replace("negate: 0", "negate: 1"))
    for what in "program", "python":
        assert by(what, "localize", log, "--in", tmp_path / "plan" / "map.yaml", "--start", "-1,-0.3,0", "--out",
                  tmp_path / what) == (0, "")
    assert (tmp_path / "program" / "poses.csv").read_bytes() == (tmp_path / "python" / "poses.csv").read_bytes()


def test_our_own_sheet_is_a_plan_in_metres_of_the_map(log, plan):
    drawing, sheet = (cca_mrpt.localize(log, plan / f"plan.{kind}", START) for kind in ("dxf", "svg"))
    assert len(sheet) == 20 and sheet.summary["plan"]["lines"] == drawing.summary["plan"]["lines"]
    assert sheet.summary["plan"]["extent_m"] == pytest.approx(drawing.summary["plan"]["extent_m"], abs=1e-3)
    assert sheet.poses == pytest.approx(drawing.poses, abs=1e-3)


def test_a_scale_is_heeded_or_refused(log, plan, tmp_path):
    with open(plan / "lines.csv") as file:
        rows = [row.split(",")[:4] for row in file.read().split()]
    for row in rows[1:]:
        row[:] = [f"{1000 * float(number):.1f}" for number in row]
    (tmp_path / "mm.csv").write_text("\n".join(",".join(row) for row in rows) + "\n")
    assert len(cca_mrpt.localize(log, tmp_path / "mm.csv", START, scale=1e-3)) == 20
    cca_mrpt.map(log, origin=(52.5, 13.4, 0.0)).save(tmp_path / "earth")
    cca_mrpt.map(log, pose="slam").save(tmp_path / "slam")
    for refused in plan / "map.yaml", tmp_path / "slam" / "map.slam", tmp_path / "earth" / "lines.geojson":
        with pytest.raises(ValueError, match=f"{refused.name}: .*a scale is for"):
            cca_mrpt.localize(log, refused, START, scale=2.0)


@pytest.mark.parametrize("arguments, named", [
    (dict(scale=-1.0), "scale"), (dict(scale="1"), "scale: '1'"), (dict(scale=np.nan), "scale"), (dict(start=(1.0, 2.0)), "start"),
    (dict(start=(np.nan, 0.0, 0.0)), "start"), (dict(start=(1e9, 0.0, 0.0)), "start: x and y"),
    (dict(start=(0.0, 0.0, 90.0)), "are these degrees"),
])
def test_wrong_arguments_are_named(log, plan, arguments, named):
    with pytest.raises(ValueError, match=named):
        cca_mrpt.localize(log, plan, **arguments)


def test_no_scan_is_nowhere(plan):
    with pytest.raises(ValueError, match="no scan is among them"):
        cca_mrpt.localize([], plan)


def test_what_is_no_plan_is_named(log, tmp_path):
    with pytest.raises(FileNotFoundError, match="none.dxf"):
        cca_mrpt.localize(log, tmp_path / "none.dxf")
    for name, text in ("plan.dxf", "nonsense"), ("plan.txt", ""), ("plan.geojson", "{"), ("map.yaml", "image: x\n"):
        (tmp_path / name).write_text(text)
        with pytest.raises(ValueError, match=name):
            cca_mrpt.localize(log, tmp_path / name)


@needs_program
def test_a_saved_map_replays_as_the_programs(log, tmp_path):
    cca_mrpt.map(log, pose="slam").save(tmp_path / "python")
    assert by("program", "map", log, "--pose", "slam", "--out", tmp_path / "program")[0] == 0
    page = {what: (tmp_path / what / "replay.html").read_text() for what in ("program", "python")}
    assert page["program"] == page["python"]
    assert "." in cca_mrpt._core.runs_of_page(page["python"], "python")[0]  # after the run come the rooms
    again = cca_mrpt.load(tmp_path / "python")
    again.save(tmp_path / "again")
    assert (tmp_path / "again" / "replay.html").read_text() == page["python"]


@needs_program
def test_the_program_renders_the_same_page(log, tmp_path):
    for name, pose in ("a", "slam"), ("b", "log"):
        cca_mrpt.map(log, pose=pose).save(tmp_path / name)
    for beside in [], ["--beside", tmp_path / "b"]:
        for what in "program", "python":
            status, said = by(what, "render", tmp_path / "a", "--html", *beside, "--force", "--out", tmp_path / f"{what}.html")
            assert status == 0, said
        assert (tmp_path / "program.html").read_bytes() == (tmp_path / "python.html").read_bytes()
    assert cca_mrpt.replay_page(tmp_path / "a", tmp_path / "b" / "replay.html") == (tmp_path / "python.html").read_text()


def test_what_holds_no_run_is_named(tmp_path, capsys):
    (tmp_path / "page.html").write_bytes(b"<html>\xff</html>")
    assert main(["render", str(tmp_path / "page.html"), "--out", str(tmp_path / "out.html")]) == 1
    assert main(["render", str(tmp_path / "none"), "--out", str(tmp_path / "out.html")]) == 1
    assert main(["render", str(tmp_path / "page.html"), "--out", str(tmp_path / "out.txt")]) == 2
    said = capsys.readouterr().err
    assert "page.html: holds no run" in said and "none" in said and not (tmp_path / "out.html").exists()


@pytest.fixture
def contradicted(room, scan_of, tmp_path):
    """A log of a robot that turns by 2 degrees a step more than its poses say: the walls turn with it."""
    path = tmp_path / "turning.log.gz"
    with gzip.open(path, "wt") as file:
        for k in range(40):
            ranges = scan_of(room, (0.02 * k, 0.0, -0.035 * k), np.radians(-90), np.radians(1), 181)
            pose = f"{0.02 * k} 0 0"
            file.write(f"FLASER 181 {' '.join(f'{r:.3f}' for r in ranges)} {pose} {pose} {k} host {k}\n")
    return path


@pytest.mark.parametrize("what", ["python", pytest.param("program", marks=needs_program)])
def test_a_map_that_its_scans_contradict_ends_with_status_3(contradicted, tmp_path, what):
    status, said = by(what, "map", contradicted, "--pose", "odometry", "--out", tmp_path / what)
    assert status == 3 and "scans contradict the map" in said
    assert "contradict" in json.loads((tmp_path / what / "summary.json").read_text())["warnings"]


@needs_program
def test_help_of_both_names_the_same_statuses_and_commands():
    told = {what: " ".join(subprocess.run(command, capture_output=True, text=True, check=True).stdout.split())
            for what, command in (("program", [installed_program(), "--help"]),
                                  ("python", [sys.executable, "-m", "cca_mrpt", "--help"]))}
    for words in "0 done", "2 no such command or option", "3 done, but the result falls short":
        assert all(words in text for text in told.values()), words
    for command in "info", "localize", "map", "merge", "plan", "render":
        assert all(command in text for text in told.values()), command


def test_nothing_is_overwritten_unasked(log, plan, tmp_path, capsys):
    before = (plan / "lines.csv").read_bytes()
    (tmp_path / "poses").mkdir()
    (tmp_path / "poses" / "poses.csv").write_text("mine")
    for words in (["map", log, "--out", plan], ["merge", plan, plan, "--out", plan],
                  ["localize", log, "--in", plan, "--out", tmp_path / "poses"]):
        assert main([os.fspath(word) for word in words]) == 1
        assert "is there already (--force overwrites it)" in capsys.readouterr().err
    assert (plan / "lines.csv").read_bytes() == before and (tmp_path / "poses" / "poses.csv").read_text() == "mine"
    shutil.rmtree(tmp_path / "poses")


@pytest.mark.parametrize("what", ["python", pytest.param("program", marks=needs_program)])
def test_a_map_in_which_no_place_was_found_is_not_lost(log, tmp_path, what):
    cca_mrpt.map(log, pose="slam").save(tmp_path / "map")
    before = (tmp_path / "map" / "map.slam").read_bytes()
    for _ in range(2):
        status, said = by(what, "map", log, "--resume", tmp_path / "map", "--out", tmp_path / "map", "--force")
        assert status == 0 and "this is the map of the log alone" in said
    assert (tmp_path / "map" / "earlier.slam").read_bytes() == before
    assert (tmp_path / "map" / "earlier-2.slam").exists()


class Stopped(Exception):
    pass


def test_ctrl_c_ends_what_reads_a_log(two_drives):
    scans = itertools.repeat(two_drives[0][0], 20000)  # more than a minute of work, without a line of Python

    def stop(*_):
        raise Stopped

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    try:
        with pytest.raises(Stopped):
            cca_mrpt.map(scans)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert operator.length_hint(scans) > 0


def test_ctrl_c_ends_the_last_pass(two_drives):
    end = [0.0]

    def stop(*_):
        raise Stopped

    def records(alarm):
        for _ in range(30):
            yield from two_drives[0]
        end[0] = time.monotonic()
        signal.setitimer(signal.ITIMER_REAL, alarm)

    before = signal.signal(signal.SIGALRM, stop)
    try:
        cca_mrpt.map(records(0), pose="slam")
        pass_s = time.monotonic() - end[0]
        with pytest.raises(Stopped):
            cca_mrpt.map(records(0.1 * pass_s), pose="slam")
        assert time.monotonic() - end[0] < 0.5 * pass_s
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


class InterruptedLog(cca_mrpt.logs.Log):
    """A log at whose fiftieth scan somebody presses Ctrl-C."""

    def __iter__(self):
        for number, record in enumerate(super().__iter__()):
            if number == 50:
                os.kill(os.getpid(), signal.SIGINT)
            yield record


@pytest.fixture
def ctrl_c():
    """As in a terminal: who starts tests in the background may have it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("ctrl_c")
@pytest.mark.parametrize("words, said", [
    (["map", "LOG"], "the map so far is in"), (["localize", "LOG", "--in", "MAP"], "the poses so far are in"),
])
def test_an_interrupted_command_saves_what_it_has(monkeypatch, capsys, tmp_path, two_logs, two_maps, words, said):
    for module in "maps", "__main__":
        monkeypatch.setattr(f"cca_mrpt.{module}.read_log", lambda path, **_: InterruptedLog(os.fspath(path)))
    before = signal.getsignal(signal.SIGINT)
    words = [{"LOG": str(two_logs[0]), "MAP": str(two_maps[0])}.get(word, word) for word in words]
    assert main([*words, "--out", str(tmp_path / "out")]) == 1
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert not summary["finished"] and 0 < summary["scans"] < 80 and (tmp_path / "out" / "poses.csv").exists()
    assert f"interrupted after {summary['scans']} scans; {said}" in capsys.readouterr().err
    assert signal.getsignal(signal.SIGINT) is before
    with pytest.raises(KeyboardInterrupt):  # what is no command is told at once
        cca_mrpt.map(InterruptedLog(str(two_logs[0])))


def test_an_interrupted_command_says_so(monkeypatch, capsys, tmp_path, two_logs):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("cca_mrpt.__main__.map_log", interrupted)
    assert main(["map", str(two_logs[0]), "--out", str(tmp_path / "out")]) == 1
    assert "cca_mrpt: interrupted" in capsys.readouterr().err and not (tmp_path / "out").exists()


def test_two_runs_do_not_mix_their_files(two_maps, two_logs, tmp_path):
    found = cca_mrpt.localize(two_logs[0], two_maps[0])
    found.save(tmp_path / "poses")
    for result, folder in (cca_mrpt.load(two_maps[0]), two_maps[0]), (found, tmp_path / "poses"):
        held = os.open(folder, os.O_RDONLY)
        fcntl.flock(held, fcntl.LOCK_EX)
        with pytest.raises(RuntimeError, match=f"{folder.name}: another run is writing there"):
            result.save(folder, force=True)
        os.close(held)
        assert (folder / "summary.json").exists()
    found.save(tmp_path / "poses", force=True)


@pytest.mark.parametrize("what", ["python", pytest.param("program", marks=needs_program)])
def test_output_that_does_not_arrive_is_told(log, what):
    command = [installed_program()] if what == "program" else [sys.executable, "-m", "cca_mrpt"]
    buffered = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    with open("/dev/full", "w") as full:
        done = subprocess.run([*command, "info", str(log)], stdout=full, stderr=subprocess.PIPE, text=True, env=buffered)
    assert done.returncode == 1 and "standard output: " in done.stderr and "Exception" not in done.stderr


@pytest.mark.parametrize("status, told, words", [
    (2, "argument --out: is empty", ["map", "LOG", "--out", ""]),
    (2, "argument --out: is empty", ["plan", "MAP", "--out", ""]),
    (1, "labels.csv: No such file or directory", ["plan", "MAP", "--out", "plan", "--labels", "labels.csv"]),
    (1, "nowhere: No such file or directory", ["render", "nowhere", "--out", "page.html"]),
    (1, "empty.html: is there already (--force overwrites it)", ["render", "MAP", "--out", "empty.html"]),
    (1, "empty.html: is no folder", ["map", "LOG", "--out", "empty.html"]),
    (1, "empty.html: is no folder", ["localize", "LOG", "--in", "MAP", "--out", "empty.html/poses"]),
    (1, "a.json: is a folder", ["evaluate", "MAP", "--log", "LOG", "--out", "a.json", "--force"]),
    (1, "empty.log: is empty", ["map", "empty.log", "--out", "out"]),
    (1, "map/lines.csv: is there already (--force overwrites it)", ["map", "LOG", "--out", "map"]),
])
def test_what_is_wrong_is_named(status, told, words, two_maps, two_logs, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for name in "empty.log", "empty.html":
        (tmp_path / name).touch()
    (tmp_path / "a.json").mkdir()
    shutil.copytree(two_maps[0], "map")
    with contextlib.ExitStack() as stack:
        got = None
        if status == 2:
            ends = stack.enter_context(pytest.raises(SystemExit))
        got = main([{"LOG": str(two_logs[0]), "MAP": "map"}.get(word, word) for word in words])
    assert status == (ends.value.code if status == 2 else got)
    said = capsys.readouterr().err
    assert told in said and "Errno" not in said
    assert not (tmp_path / "out").exists()
