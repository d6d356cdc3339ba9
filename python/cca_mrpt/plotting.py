# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of line maps by matplotlib, which is asked for only here."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._core import LineMap


def plot(lines: Union[LineMap, NDArray[np.void], Any], trajectory: Optional[ArrayLike] = None,
         ax: Optional[Axes] = None) -> Axes:
    """Draw a line map to scale.

    Args:
        lines: a LineMap, or an array with a field `ends`, as `extract_lines` gives.
        trajectory: (N, 2 or more) m, drawn thin below the lines.
        ax: matplotlib axes; the present ones where None.

    Returns:
        The axes.
    """
    from matplotlib import pyplot
    from matplotlib.collections import LineCollection

    axes = pyplot.gca() if ax is None else ax
    if trajectory is not None:
        way = np.asarray(trajectory, dtype=float)
        if way.ndim != 2 or way.shape[1] < 2:
            raise ValueError(f"trajectory: (N, 2 or more) is needed, not shape {way.shape}")
        axes.plot(way[:, 0], way[:, 1], color="tab:orange", linewidth=0.7, label="trajectory")
    held: Any = getattr(lines, "lines", lines)
    records = held() if callable(held) else held
    axes.add_collection(LineCollection(records["ends"], colors="tab:blue", linewidths=1.5))
    axes.set_aspect("equal", adjustable="datalim")
    axes.autoscale_view()
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    return axes
