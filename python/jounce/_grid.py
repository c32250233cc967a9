"""Points of a table on the grid of their coordinates."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ._fields import Variable


def on_grid(
    coords: Mapping[str, Variable], variables: Mapping[str, Variable], *, complete: bool = False
) -> tuple[dict[str, Variable], dict[str, Variable]]:
    """Returns coordinates and variables of points with an axis for each coordinate, named after it.

    A place without a point is NaN, or an empty text. The table is unchanged where two points have one place, and with ``complete`` where
    a place has no point.
    """
    axes, indices = zip(*(_axis(one.values) for one in coords.values()))
    shape, points = tuple(map(len, axes)), len(indices[0])
    if complete and math.prod(shape) != points:
        return dict(coords), dict(variables)
    taken = np.zeros(shape, bool)
    taken[indices] = True
    if taken.sum() < points:
        return dict(coords), dict(variables)

    def spread(one: Variable) -> Variable:
        values = np.asarray(one.values)
        if values.dtype.kind in "OU":
            filled = np.full(shape, "", object)
        else:
            filled = np.zeros(shape, values.dtype) if taken.all() else np.full(shape, np.nan, np.result_type(values, np.float64))
        filled[indices] = values
        return one._replace(dims=tuple(coords), values=filled)

    grid_coords = {name: one._replace(dims=(name,), values=axis) for (name, one), axis in zip(coords.items(), axes)}
    return grid_coords, {name: spread(one) for name, one in variables.items()}


def _axis(values: Any) -> tuple[Any, Any]:
    """Returns the different values, ascending numbers or texts as they appear, and the number of the value of each point."""
    different, first, index = np.unique(np.asarray(values), return_index=True, return_inverse=True)
    if different.dtype.kind in "OU":
        order = np.argsort(first)
        return different[order], np.argsort(order)[index]
    return different, index
