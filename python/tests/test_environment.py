# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

import cca_mrpt

gymnasium = pytest.importorskip("gymnasium")
pytestmark = pytest.mark.skipif(not hasattr(cca_mrpt, "Simulation"), reason="built without the simulator")


def make(**arguments):
    import cca_mrpt.environment  # noqa: F401 (registers it)

    return gymnasium.make("cca_mrpt/Explore-v0", **arguments)


@pytest.fixture
def walls():
    """7 m x 4 m, a wall across it that leaves a door of 1 m; cells of 5 cm."""
    cells = np.zeros((80, 140), bool)
    cells[[0, -1], :] = cells[:, [0, -1]] = True
    cells[:60, 70:73] = True
    return cells


def test_it_is_what_gymnasium_asks_for():
    from gymnasium.utils.env_checker import check_env

    check_env(make(world="maze", beams=91, render_mode="rgb_array").unwrapped)


def test_equal_seeds_and_actions_give_equal_episodes(walls):
    def episode(seed):
        env = make(world=walls, beams=61)
        seen = [env.reset(seed=seed)[0]["ranges"]]
        for k in range(20):
            observation, reward, *_ = env.step([0.5, np.sin(k)])
            seen.append(np.append(observation["ranges"], reward))
        return np.concatenate(seen)

    assert np.array_equal(episode(4), episode(4))
    assert not np.array_equal(episode(4), episode(5))


def test_a_drawn_building_is_another_one_with_another_seed():
    env = make(world="random", beams=31)
    buildings = []
    for seed in (1, 1, 2):
        env.reset(seed=seed)
        buildings.append(env.unwrapped.simulation.obstacles)
    assert np.array_equal(buildings[0], buildings[1])
    assert buildings[0].shape != buildings[2].shape or not np.array_equal(buildings[0], buildings[2])


def test_what_is_seen_is_rewarded_and_what_is_driven_and_touched_costs(walls):
    env = make(world=walls, way_cost=0.5, contact_cost=7.0, enough=1.0)
    start = (1.0, 1.0, np.pi / 2)
    env.reset(seed=1, options={"start": start})
    assert env.step([0.0, 0.0])[1] < 0.2, "nothing new"
    new, contacts = 0.0, 0
    for _ in range(60):  # past the wall's end, where the other room comes into view
        _, reward, _, _, info = env.step([1.0, 0.0])
        new += reward + 0.5 * 0.07
        contacts = info["contacts"]
    assert contacts == 1 and info["pose"][1] == pytest.approx(4.0 - 0.05 - 0.25, abs=0.02)
    assert new + 7.0 > 1.0


def test_the_explorer_sees_all_and_ends_the_episode(walls):
    """Its line map is that of the walls; the reward is the area that was not in sight from the start."""
    env = make(world=walls, period=0.2)
    observation, info = env.reset(seed=3, options={"start": (1.0, 1.0, 0.0)})
    robot = env.unwrapped.simulation
    explorer, total, ended, step = cca_mrpt.Explorer(), 0.0, False, 0
    while not ended and step < 1000:
        action = explorer.step(observation["ranges"], robot.angle_min, robot.angle_increment, info["pose"],
                               time=info["time_s"], velocity=observation["velocity"], free_range_without_return=8.0)
        observation, reward, ended, cut, info = env.step(np.array(action.velocity) / robot.limits)
        total, step = total + reward, step + 1
    assert ended and info["seen"] >= 0.99 and info["contacts"] == 0
    assert 5.0 < total < 28.0
    assert info["distance_m"] < 12.0


def test_lost_beams_free_nothing_behind_walls(walls):
    free = [make(world=walls, dropout=share, missing="inf", range=30.0).reset(seed=3, options={"start": (1.0, 1.0, 0.0)})[0]
            ["map"] == int(cca_mrpt.CellState.FREE) for share in (0.0, 0.05)]
    assert (free[1] & ~free[0]).sum() < 0.02 * free[0].sum()


@pytest.mark.parametrize("arguments, named", [
    (dict(world="no_such_file.yaml"), "world: "),
    (dict(world=np.zeros((2, 2), bool)), "world: "),
    (dict(beams=0), "beams: "),
    (dict(period=0.0), "period: "),
    (dict(speed=1.0), "speed: no such parameter"),
    (dict(render_mode="human"), "render_mode: "),
])
def test_wrong_arguments_are_named(arguments, named):
    from cca_mrpt.environment import ExploreEnv

    with pytest.raises(ValueError, match=named):
        ExploreEnv(**arguments)


def test_a_start_in_a_wall_is_refused(walls):
    with pytest.raises(ValueError, match="world: "):
        make(world=walls).reset(options={"start": (3.55, 1.0, 0.0)})
