# SPDX-License-Identifier: BSD-3-Clause
"""Exploration as a Gymnasium environment, for explorers that learn.

    import gymnasium
    import cca_mrpt.environment  # registers it
    env = gymnasium.make("cca_mrpt/Explore-v0", world="apartment")

Needs gymnasium (``pip install 'cca-mrpt[gym]'``) and a build of this package where MRPT was.
"""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Optional, Tuple, Union

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import ArrayLike, NDArray

from . import CellState, ExplorationGrid, LogRecord, MissingReturns

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._simulation import Simulation  # type: ignore[import-not-found, unused-ignore]
    from .parameters import SimulationParameters

Observation = Dict[str, NDArray[Any]]

ID = "cca_mrpt/Explore-v0"
_COLOURS = {
    CellState.UNKNOWN: (128, 128, 128),
    CellState.PRESUMED_FREE: (235, 235, 235),
    CellState.PRESUMED_WALL: (60, 40, 40),
    CellState.FREE: (255, 255, 255),
    CellState.OCCUPIED: (0, 0, 0),
}


class ExploreEnv(gymnasium.Env[Observation, NDArray[np.float32]]):
    """A robot with a laser in a building that it does not know.

    **Action**: (2,) in [-1, 1]: velocity forwards and turning rate to the left, as shares of the robot's limits,
    towards which it accelerates for `period` seconds.

    **Observation**: a dict of
        ranges    (beams,) float32, m; a beam without return, or an invalid one, shows the laser's range
        map       (cells, cells) uint8 of `CellState`, centred on the robot, rows along the map's y, columns along x
        pose      (3,) float32: x, y from the start [m] in the map's axes, theta [rad]: the true ones
        velocity  (2,) float32: m/s, rad/s

    **Reward**: m^2 of floor and walls newly in the map, less `way_cost` a metre and `contact_cost` a contact.

    **Ends** when `enough` of all that can be seen has been seen; a time limit is Gymnasium's: 2000 steps as
    registered.

    ``reset(seed=...)`` fixes the noise and, where `world` is a kind of building, the building: without one, each
    episode has another. ``reset(options={"start": (x, y, theta)})`` says where the robot begins.

    Args:
        world: as `Simulation` takes it.
        period: s, between two observations.
        enough: share in (0, 1].
        way_cost: m^2 a metre.
        contact_cost: m^2 a contact.
        window: m, side of `map`.
        render_mode: "rgb_array": render() gives the whole map so far and the robot in it.
        parameters: keyword parameters of `Simulation`, and its `resolution`.

    Raises:
        ImportError: the package was built without the simulator.
        ValueError: naming the argument.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 10}

    def __init__(self, world: Union[str, ArrayLike] = "apartment", *, period: float = 0.1, enough: float = 0.99,
                 way_cost: float = 0.0125, contact_cost: float = 1.0, window: float = 8.0,
                 render_mode: Optional[str] = None, **parameters: Unpack[SimulationParameters]) -> None:
        try:
            from ._simulation import Simulation  # type: ignore[import-not-found, unused-ignore]
        except ImportError:
            raise ImportError("ExploreEnv needs cca_mrpt.Simulation: MRPT, here and where it was built") from None
        for name, value, lowest, highest in (("period", period, 0.01, 1.0), ("enough", enough, 0.01, 1.0),
                                             ("way_cost", way_cost, 0.0, 1e6),
                                             ("contact_cost", contact_cost, 0.0, 1e6),
                                             ("window", window, 0.1, 1000.0)):
            if not lowest <= value <= highest:
                raise ValueError(f"{name}: must be in [{lowest:g}, {highest:g}], not {value}")
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"render_mode: None or rgb_array, not {render_mode!r}")

        def make(seed: int, start: Optional[Tuple[float, float, float]]) -> Simulation:
            return Simulation(world, start=start, seed=seed, **parameters)

        self._make = make
        self._tells_lost_beams = parameters.get("missing", "told") == "told"
        self._period, self._enough = period, enough
        self._way_cost, self._contact_cost = way_cost, contact_cost
        self.render_mode = render_mode
        self.simulation = self._make(1, None)  # tells what the spaces need, and that the arguments are right
        self._cells = int(round(window / self.simulation.resolution)) | 1
        longest = np.float32(self.simulation.free_range_without_return)
        linear, angular = self._limits = np.array(self.simulation.limits)
        beams = len(self.simulation.observe())
        self.action_space = spaces.Box(-1.0, 1.0, (2,), np.float32)
        shown: Any = spaces.Dict({
            "ranges": spaces.Box(0.0, longest, (beams,), np.float32),
            "map": spaces.Box(0, max(int(state) for state in CellState), (self._cells, self._cells), np.uint8),
            "pose": spaces.Box(np.array([-np.inf, -np.inf, -np.pi], np.float32),
                               np.array([np.inf, np.inf, np.pi], np.float32), (3,), np.float32),
            "velocity": spaces.Box(np.array([-linear, -angular], np.float32), np.array([linear, angular], np.float32),
                                   (2,), np.float32),
        })
        self.observation_space = shown

    def reset(self, *, seed: Optional[int] = None,
              options: Optional[Dict[str, Any]] = None) -> Tuple[Observation, Dict[str, Any]]:
        super().reset(seed=seed)
        start = (options or {}).get("start")
        self.simulation = self._make(int(self.np_random.integers(1, 2**31 - 1)), start)
        self._start = np.array(self.simulation.pose[:2])
        self._grid, self._missing_returns = ExplorationGrid(self.simulation.resolution), MissingReturns()
        self._revealed = self._distance = 0.0
        self._contacts = 0
        observation = self._look()
        self._reward()  # what is seen from the start is nobody's merit
        return observation, self._info()

    def step(self, action: NDArray[np.float32]) -> Tuple[Observation, float, bool, bool, Dict[str, Any]]:
        linear, angular = np.clip(np.asarray(action, dtype=float), -1.0, 1.0) * self._limits
        self.simulation.drive(linear, angular, self._period)
        observation = self._look()
        info = self._info()
        return observation, self._reward(), info["seen"] >= self._enough, False, info

    def render(self) -> Optional[NDArray[np.uint8]]:
        """(rows, columns, 3) uint8, the highest y first; None without render_mode."""
        if self.render_mode is None:
            return None
        states = self._grid.states()
        colours = np.zeros((max(int(state) for state in CellState) + 1, 3), np.uint8)
        for state, colour in _COLOURS.items():
            colours[int(state)] = colour
        picture = colours[states]
        x, y = (np.array(self.simulation.pose[:2]) - self._grid.origin) / self._grid.resolution
        rows, columns = np.ogrid[:states.shape[0], :states.shape[1]]
        picture[(columns - x) ** 2 + (rows - y) ** 2 <= (0.25 / self._grid.resolution) ** 2] = (200, 30, 30)
        return picture[::-1]

    def _look(self) -> Observation:
        ranges = self.simulation.observe()
        first, between = self.simulation.angle_min, self.simulation.angle_increment
        longest = self.simulation.free_range_without_return
        x, y, theta = self.simulation.pose
        record = LogRecord(ranges, first, between, free_range_without_return=longest)
        if not self._tells_lost_beams:
            self._missing_returns.judge(record)
        self._grid.insert(record.ranges, first, between, (x, y, theta), record.free_range_without_return)
        shown = np.where(np.isfinite(ranges), ranges, longest).clip(0.0, longest)
        around = self._grid.states_around((x, y), self._cells)
        velocity = np.clip(self.simulation.velocity, -self._limits, self._limits)
        heading = (theta + np.pi) % (2.0 * np.pi) - np.pi
        return {
            "ranges": shown.astype(np.float32),
            "map": around,
            "pose": np.array([*(np.array([x, y]) - self._start), np.clip(heading, -3.1415925, 3.1415925)], np.float32),
            "velocity": velocity.astype(np.float32),
        }

    def _reward(self) -> float:
        area = self._grid.revealed * self._grid.resolution**2
        distance, contacts = self.simulation.distance, self.simulation.contacts
        reward = (area - self._revealed - self._way_cost * (distance - self._distance)
                  - self._contact_cost * (contacts - self._contacts))
        self._revealed, self._distance, self._contacts = area, distance, contacts
        return float(reward)

    def _info(self) -> Dict[str, Any]:
        return {"seen": self.simulation.share_seen, "distance_m": self.simulation.distance, "time_s": self.simulation.time,
                "contacts": self.simulation.contacts, "pose": self.simulation.pose}


gymnasium.register(ID, entry_point="cca_mrpt.environment:ExploreEnv", max_episode_steps=2000)
