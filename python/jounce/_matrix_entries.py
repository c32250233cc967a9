"""Conversion of sparse and full matrices to lists of entries, the form of the compiled module."""

from __future__ import annotations

from collections.abc import Sequence
from numbers import Integral
from typing import Any

import numpy as np

from ._errors import ArgumentError

#: Matrix for the compiled module: name, numbers of rows and columns, and row, column and value of each entry.
MatrixEntries = dict[str, Any]


def entries_of(name: str, matrix: Any) -> MatrixEntries:
    """Returns the entries of a matrix of scipy or numpy that are not zero."""
    if hasattr(matrix, "tocoo"):
        coo = matrix.tocoo()
        row, column, value = coo.row, coo.col, coo.data
        rows, columns = coo.shape
    else:
        array = np.asarray(matrix)
        if array.ndim != 2:
            raise ArgumentError(f"{name} has {array.ndim} axes; give a matrix of scipy.sparse, or an array with two axes")
        row, column = np.nonzero(array)
        value = array[row, column]
        rows, columns = array.shape
    return _entries(name, (rows, columns), row, column, value)


def row_of(what: str, values: Any, size: int) -> Any:
    """Returns a vector of one number for each degree of freedom; a whole number is the index of the only one that is 1."""
    if isinstance(values, Integral) and not isinstance(values, bool):
        index = int(values)
        if not 0 <= index < size:
            raise ArgumentError(f"{what} is {index}; the indices of the {size} degrees of freedom are 0 to {size - 1}")
        row = np.zeros(size)
        row[index] = 1.0
        return row
    array = values.toarray() if hasattr(values, "toarray") else np.asarray(values)
    if array.size != size or array.size != max(array.shape, default=1):
        shape = " x ".join(map(str, array.shape)) or "a single number"
        raise ArgumentError(f"{what} is {shape}; give {size} numbers, one for each degree of freedom")
    return array.reshape(size)


def stacked(name: str, vectors: Sequence[Any], size: int, as_columns: bool = False) -> MatrixEntries:
    """Returns the matrix whose rows, or columns, are vectors."""
    places = [np.nonzero(vector)[0] for vector in vectors]
    of_vector = np.concatenate([np.full(len(place), k) for k, place in enumerate(places)])
    value = np.concatenate([vector[place] for vector, place in zip(vectors, places)])
    along = np.concatenate(places)
    if as_columns:
        return _entries(name, (size, len(vectors)), along, of_vector, value)
    return _entries(name, (len(vectors), size), of_vector, along, value)


def _entries(name: str, shape: tuple[int, int], row: Any, column: Any, value: Any) -> MatrixEntries:
    if np.iscomplexobj(value):
        raise ArgumentError(f"{name} is complex; only real matrices are reduced to modes")
    try:
        numbers = np.ascontiguousarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ArgumentError(f"{name} does not consist of numbers: {error}") from error
    indices = (np.ascontiguousarray(index, dtype=np.int64) for index in (row, column))
    entries = dict(zip(("row", "column"), indices))
    return {"name": name, "rows": int(shape[0]), "columns": int(shape[1]), **entries, "value": numbers}
