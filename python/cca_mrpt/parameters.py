# SPDX-License-Identifier: BSD-3-Clause
"""Keyword parameters by name and type, for who passes them on; `help(LineMap)` tells ranges and meaning."""
from typing import Literal, TypedDict


class MapParameters(TypedDict, total=False):
    """Of `extract_lines` and `LineMap`."""

    similarity_cut: float
    vertex_price: float
    straightness: float


class SimulationParameters(TypedDict, total=False):
    """Of `Simulation`, and its resolution."""

    resolution: float
    range: float
    field_of_view_deg: float
    beams: int
    range_noise: float
    angle_noise_deg: float
    range_noise_share: float
    dropout: float
    missing: Literal['told', 'inf', 'zero', 'range_max']
    sweep: float
    caster: Literal['exact', 'mrpt']
    radius: float
    safety_margin: float
    max_linear_velocity: float
    max_angular_velocity: float
    max_linear_acceleration: float
    max_angular_acceleration: float
    latency: float
    distance_noise: float
    turn_noise_deg: float
    drift_noise_deg: float
