# SPDX-License-Identifier: BSD-3-Clause
"""The live page of a mapper, by its requests."""
import http.client
import json
import re
import subprocess
import sys
import threading
import time
from urllib.parse import urlsplit

import numpy as np
import pytest

import cca_mrpt
from conftest import FULL_TURN

PATIENCE = 20  # s


class Viewer:
    def __init__(self, url):
        self.parts = urlsplit(url)
        self.origin = f"http://{self.parts.netloc}"

    def ask(self, method, path, body=None, **headers):
        connection = http.client.HTTPConnection(self.parts.netloc, timeout=PATIENCE)
        query = "?" + self.parts.query if self.parts.query else ""
        connection.request(method, path + query, body, headers)
        return connection.getresponse()

    def command(self, **body):
        return self.ask("POST", "/command", json.dumps(body), Origin=self.origin).status

    def wait(self, wanted):
        end = time.time() + PATIENCE
        for line in self.ask("GET", "/events"):
            if line.startswith(b"data: "):
                told = json.loads(line[6:])
                if wanted(told):
                    return told
            assert time.time() < end, "in vain"
        raise AssertionError("the run has ended")


@pytest.fixture
def served():
    mapper = cca_mrpt.Mapper()
    try:
        url = mapper.serve(port=0, title="a drive")
    except RuntimeError as error:
        if "cpp-httplib" in str(error):
            pytest.skip("built without cpp-httplib")
        raise
    return mapper, Viewer(url)


@pytest.fixture
def records(two_rooms, scan_of):
    return [cca_mrpt.LogRecord(scan_of(two_rooms, (0.1 * k, 0, 0), beams=360, **FULL_TURN), **FULL_TURN, time=k / 5,
                               odometry=(0.1 * k, 0, 0)) for k in range(15)]


def test_a_mapper_is_shown_as_it_grows(served, records):
    mapper, viewer = served
    assert b'class="live"' in viewer.ask("GET", "/").read()
    assert viewer.wait(lambda e: True)["empty"]
    for record in records:
        mapper.step(record)
        time.sleep(0.06)  # as a robot does; the page is told 20 times a second
    told = viewer.wait(lambda e: e["robot"]["x"] > 1.2)
    assert not told["has_robot"] and not told["paused"] and told["end"] == "" and "whole" in told
    assert viewer.command(do="home") == 409 and viewer.command(do="go", x=1, y=1) == 409
    ends = []
    watch = threading.Thread(target=lambda: ends.append(viewer.wait(lambda e: e["end"])))
    watch.start()
    line_map = mapper.finish()
    watch.join()
    assert ends[0]["end"] == "all is mapped" and len(line_map) > 4
    with pytest.raises(RuntimeError, match="served already"):
        mapper.serve(port=0)


def test_what_is_shown_is_the_same_map(records):
    alone, seen = cca_mrpt.Mapper(), cca_mrpt.Mapper()
    try:
        seen.serve(port=0)
    except RuntimeError:
        pytest.skip("built without cpp-httplib")
    for record in records:
        alone.step(record)
        seen.step(record)
    assert seen.finish()._files == alone.finish()._files


def test_a_viewer_pauses_it_and_nobody_else(served, records):
    mapper, viewer = served
    mapper.step(records[0])
    for headers in {}, {"Origin": "http://evil.example"}, {"Origin": viewer.origin, "Host": "evil.example"}:
        assert viewer.ask("POST", "/command", '{"do": "pause"}', **headers).status == 403
    mapper.step(records[1])  # returns
    assert viewer.command(do="pause") == 204
    stepped = threading.Event()

    def step():
        mapper.step(records[2])
        stepped.set()

    threading.Thread(target=step, daemon=True).start()
    viewer.wait(lambda e: e["paused"])
    assert not stepped.wait(0.5) and len(mapper) == 2  # others may look at it meanwhile
    assert viewer.command(do="start") == 204
    assert stepped.wait(PATIENCE) and len(mapper) == 3


def test_at_another_address_there_is_a_token(records):
    mapper = cca_mrpt.Mapper()
    try:
        url = mapper.serve(port=0, address="127.0.0.2")
    except RuntimeError:
        pytest.skip("built without cpp-httplib")
    assert re.search(r"\?token=[0-9a-f]{32}$", url)
    viewer, stranger = Viewer(url), Viewer(url.split("?")[0])
    assert stranger.ask("GET", "/").status == 403 and stranger.command(do="pause") == 403
    mapper.step(records[0])  # nobody has paused it
    assert viewer.ask("GET", "/").status == 200


@pytest.mark.parametrize("port, address, error, named", [
    (-1, "127.0.0.1", ValueError, "port"), (65536, "127.0.0.1", ValueError, "port"),
    (0, "203.0.113.9", RuntimeError, "203.0.113.9"), (0, "nonsense", RuntimeError, "nonsense"),
])
def test_wrong_places_are_named(port, address, error, named):
    with pytest.raises(error, match=named):
        cca_mrpt.Mapper().serve(port, address)


def test_a_port_in_use_is_named(served):
    _, viewer = served
    with pytest.raises(RuntimeError, match=f"127.0.0.1:{viewer.parts.port}"):
        cca_mrpt.Mapper().serve(viewer.parts.port)


def test_the_page_goes_with_its_mapper():
    mapper = cca_mrpt.Mapper()
    try:
        viewer = Viewer(mapper.serve(port=0))
    except RuntimeError:
        pytest.skip("built without cpp-httplib")
    assert viewer.ask("GET", "/").status == 200
    del mapper
    with pytest.raises(OSError):
        viewer.ask("GET", "/")


def test_a_log_is_shown_while_it_is_mapped(log, tmp_path):
    command = [sys.executable, "-m", "cca_mrpt", "map", str(log), "--out", str(tmp_path / "map"), "--serve", "0"]
    done = subprocess.run(command, capture_output=True, text=True)
    if "cpp-httplib" in done.stderr:
        pytest.skip("built without cpp-httplib")
    assert done.returncode == 0 and "the run can be seen at http://127.0.0.1:" in done.stderr
    assert np.array_equal(cca_mrpt.load(tmp_path / "map").lines["id"], cca_mrpt.map(log).lines["id"])
