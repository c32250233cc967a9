"""Results in files: a ZIP archive of ``result.json`` and one ``.npy`` file for each array, without code."""

from __future__ import annotations

import dataclasses
import importlib
import io
import json
import math
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from ._errors import FileError, JounceError
from ._files import write_whole
from ._result import Result, _equal
from ._spec_text import SpecText, _rebuild

if TYPE_CHECKING:
    from zipfile import ZipFile

#: Calls that read files of other kinds.
_OTHERS = "a spec is read with jounce.read, a recording with jounce.read_recordings"

#: Name of the structure in the archive, and its version: that of the format, not of jounce.
_STRUCTURE, _FORMAT = "result.json", 1


def save(result: Result, path: str | PathLike[str]) -> None:
    """Writes a result completely or not at all."""
    import zipfile

    arrays: list[np.ndarray[Any, Any]] = []
    structure = {"format": _FORMAT, "result": _encoded(result, arrays), "call": None}
    if result._call is not None:
        counted = len(arrays)
        try:
            structure["call"] = _encoded(result._call, arrays)
        except TypeError:
            # An argument, such as a quantity of pint, cannot be stored.
            del arrays[counted:]

    def fill(file: BinaryIO) -> None:
        with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr(_STRUCTURE, json.dumps(structure))
            for number, array in enumerate(arrays):
                with archive.open(f"{number}.npy", "w", force_zip64=True) as member:
                    np.lib.format.write_array(member, array, allow_pickle=False)

    write_whole(path, "the result", fill)


def load(path: str | PathLike[str]) -> Any:
    """Reads a result that its ``save`` wrote; it equals the saved one.

    Returns
    -------
    Result
        Result of the class that was saved, with its arrays read-only.

    Raises
    ------
    FileError
        For a file that cannot be read, is no saved result, or is damaged.

    Examples
    --------
    >>> modes = jounce.examples()["impact-harvester-2019"].modes()
    >>> modes.save("modes.jounce")
    >>> jounce.load("modes.jounce") == modes
    True
    """
    import zipfile

    try:
        with zipfile.ZipFile(path) as archive:
            structure = json.loads(archive.read(_STRUCTURE))
            if structure["format"] != _FORMAT:
                raise ValueError(f"its format is {structure['format']}, and this version of jounce reads {_FORMAT}")
            result = _decoded(structure["result"], archive)
            call = structure.get("call")
            object.__setattr__(result, "_call", None if call is None else _decoded(call, archive))
    except OSError as error:
        raise FileError(f"the result {fspath(path)} cannot be read: {error}", {"path": fspath(path), "errno": error.errno}) from error
    except (zipfile.BadZipFile, KeyError, TypeError, ValueError, AttributeError, ImportError, JounceError) as error:
        raise FileError(f"{fspath(path)} is no result that `save` of a result wrote: {error}; {_OTHERS}", {"path": fspath(path)}) from error
    if not isinstance(result, Result):
        raise FileError(f"{fspath(path)} holds no result", {"path": fspath(path)})
    return result


def rerun(path: str | PathLike[str]) -> Any:
    """Makes a saved result again from the call in its file, and compares all values bit by bit.

    The file holds the call with its arguments: the spec, and the recordings themselves. Files that the arguments name must be unchanged. A
    part of a result has no call, nor has a result of a study or of :func:`reproduce`.

    Returns
    -------
    Result
        The new result, equal to the saved one.

    Raises
    ------
    FileError
        For a file without a call, a changed input file, and a result that differs; then ``details["field"]`` names the first field that
        differs.

    Examples
    --------
    >>> modes = jounce.examples()["impact-harvester-2019"].modes()
    >>> modes.save("modes.jounce")
    >>> jounce.rerun("modes.jounce") == modes
    True
    """
    import warnings

    saved = load(path)
    if saved._call is None:
        remedy = "save the complete result of a call, whose arguments can be stored in a file"
        raise FileError(f"{fspath(path)}: the file has no record of its call; {remedy}", {"path": fspath(path)})
    with warnings.catch_warnings():
        # The saved result has had its warnings.
        warnings.simplefilter("ignore")
        again = saved._call.repeat()
    if again == saved:
        return again
    names = [field.name for field in dataclasses.fields(saved) if field.compare]
    differs = next((name for name in names if not _equal(getattr(saved, name), getattr(again, name))), "")
    raise FileError(f"{fspath(path)}: different: {differs}; computed with {saved._call}", {"path": fspath(path), "field": differs})


def _encoded(value: Any, arrays: list[np.ndarray[Any, Any]]) -> Any:
    """Returns a value as JSON; arrays are appended to a list, and objects are a dict of one key that names their kind."""
    if isinstance(value, np.ndarray) and value.dtype != object:
        arrays.append(value)
        return {"array": len(arrays) - 1}
    if isinstance(value, np.generic):
        return _encoded(value.item(), arrays)
    if isinstance(value, float) and not math.isfinite(value):
        return {"float": str(value)}
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, complex):
        return {"complex": [_encoded(value.real, arrays), _encoded(value.imag, arrays)]}
    if isinstance(value, Path):
        return {"path": str(value)}
    if isinstance(value, dict):
        return {"dict": [[_encoded(key, arrays), _encoded(one, arrays)] for key, one in value.items()]}
    if isinstance(value, SpecText):
        return {"spec": [type(value).__name__, *value.__reduce__()[1][1:]]}
    if dataclasses.is_dataclass(value) and type(value).__module__.startswith("jounce."):
        fields = {field.name: _encoded(getattr(value, field.name), arrays) for field in dataclasses.fields(value)}
        return {"class": [type(value).__module__, type(value).__name__], "fields": fields}
    if isinstance(value, (list, tuple, np.ndarray)):
        items = [_encoded(one, arrays) for one in value]
        return items if isinstance(value, list) else {"objects" if isinstance(value, np.ndarray) else "tuple": items}
    raise TypeError(f"a result holds a {type(value).__name__}, which has no form in a file")


def _decoded(value: Any, archive: ZipFile) -> Any:
    """Returns the value of its JSON."""
    if isinstance(value, list):
        return [_decoded(one, archive) for one in value]
    if not isinstance(value, dict):
        return value
    match value:
        case {"array": number}:
            return np.load(io.BytesIO(archive.read(f"{int(number)}.npy")), allow_pickle=False)
        case {"float": text}:
            return float(text)
        case {"path": text}:
            return Path(text)
        case {"complex": [real, imaginary]}:
            return complex(_decoded(real, archive), _decoded(imaginary, archive))
        case {"dict": pairs}:
            return {_decoded(key, archive): _decoded(one, archive) for key, one in pairs}
        case {"tuple": items}:
            return tuple(_decoded(items, archive))
        case {"objects": items}:
            return np.array(_decoded(items, archive), dtype=object)
        case {"spec": [name, text, folder]}:
            return _rebuild(_checked(getattr(importlib.import_module("jounce"), name)), text, folder)
        case {"class": [module, name], "fields": fields} if module.startswith("jounce."):
            kind: Any = getattr(importlib.import_module(module), name)
            if not (isinstance(kind, type) and dataclasses.is_dataclass(kind)):
                raise ValueError(f"{name} is no part of a result")
            return kind(**{field: _decoded(one, archive) for field, one in fields.items()})
    raise ValueError(f"it has a part of unknown kind, {', '.join(value)}")


def _checked(kind: Any) -> type[SpecText]:
    """Returns the class of a spec; raises ValueError for anything else."""
    if not (isinstance(kind, type) and issubclass(kind, SpecText)):
        raise ValueError(f"{kind} is no spec")
    return kind
