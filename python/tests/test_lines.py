# SPDX-License-Identifier: BSD-3-Clause
import threading

import numpy as np
import pytest

import cca_mrpt
from conftest import FULL_TURN


@pytest.fixture
def ranges(room, scan_of):
    clean = scan_of(room, (0, 0, 0), beams=360, **FULL_TURN)
    return clean + np.random.default_rng(1).normal(0, 0.01, clean.shape)


def test_finds_the_four_walls_of_a_room(ranges):
    lines = cca_mrpt.extract_lines(ranges, **FULL_TURN)
    assert lines.dtype == cca_mrpt.LINE
    assert len(lines) == 4
    length = np.linalg.norm(lines["ends"][:, 1] - lines["ends"][:, 0], axis=1)
    assert np.allclose(sorted(length), [4, 4, 6, 6], atol=0.05)
    assert lines["returns"].sum() <= 360
    assert (np.linalg.eigvalsh(lines["covariance"]) >= 0).all()


@pytest.mark.parametrize("given", [
    lambda r: r.tolist(), lambda r: np.repeat(r, 2)[::2], lambda r: np.asfortranarray(r[::-1])[::-1]])
def test_any_one_dimensional_array_will_do(ranges, given):
    expected = cca_mrpt.extract_lines(ranges, **FULL_TURN)
    assert np.array_equal(cca_mrpt.extract_lines(given(ranges), **FULL_TURN), expected)


def test_single_precision_is_read_as_it_is(ranges):
    single = ranges.astype(np.float32)
    assert np.array_equal(cca_mrpt.extract_lines(single, **FULL_TURN),
                          cca_mrpt.extract_lines(single.astype(float), **FULL_TURN))


def test_no_returns_give_no_lines():
    for ranges in (np.array([]), np.full(360, np.inf), np.full(360, np.nan), np.array([1.0, 1.0])):
        lines = cca_mrpt.extract_lines(ranges, **FULL_TURN)
        assert lines.shape == (0,) and lines.dtype == cca_mrpt.LINE


@pytest.mark.parametrize("ranges, angle_min, angle_increment, keywords, named", [
    (np.ones((2, 3)), 0.0, 0.1, {}, r"ranges: .*\(2, 3\)"),
    (["a", "b"], 0.0, 0.1, {}, "ranges: "),
    (None, 0.0, 0.1, {}, "ranges: "),
    (np.ones(3, dtype=complex), 0.0, 0.1, {}, "ranges: .*complex128"),
    (np.ones(3), np.nan, 0.1, {}, "angle_min: "),
    (np.ones(3), 0.0, 0.0, {}, "angle_increment: "),
    (np.ones(3), 0.0, 0.1, {"similarity_cut": 2.0}, r"similarity_cut: 2.0 is not in \[0.01, 1.0\]"),
    (np.ones(3), 0.0, 0.1, {"vertex_price": "low"}, "vertex_price: a number"),
    (np.ones(3), 0.0, 0.1, {"similarity": 0.5}, "similarity: no such parameter"),
])
def test_wrong_arguments_are_named(ranges, angle_min, angle_increment, keywords, named):
    with pytest.raises(ValueError, match=named):
        cca_mrpt.extract_lines(ranges, angle_min, angle_increment, **keywords)


def test_parameters_reach_the_algorithm():
    inside_a_barrel = np.full(360, 2.0) + np.random.default_rng(1).normal(0, 0.01, 360)
    few = cca_mrpt.extract_lines(inside_a_barrel, **FULL_TURN, vertex_price=50.0)
    many = cca_mrpt.extract_lines(inside_a_barrel, **FULL_TURN, vertex_price=4.0)
    assert len(few) < len(many)


def test_there_are_fifteen_baselines_and_each_finds_walls(ranges):
    assert len(cca_mrpt.baselines) == 15
    for name, baseline in cca_mrpt.baselines.items():
        assert baseline.name == name and baseline.paper
        for tuned in (False, True):
            lines = baseline.extract_lines(ranges, **FULL_TURN, tuned=tuned)
            assert lines.dtype == cca_mrpt.LINE and len(lines) > 0, (name, tuned)


def test_threads_do_not_disturb_each_other(ranges):
    expected = cca_mrpt.extract_lines(ranges, **FULL_TURN)
    equal = []

    def work():
        equal.append(all(np.array_equal(cca_mrpt.extract_lines(ranges, **FULL_TURN), expected)
                         for _ in range(200)))

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert equal == [True] * 4
