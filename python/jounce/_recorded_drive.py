"""Drives from samples in memory: the samples are stored in a file, which the spec names."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from ._errors import ArgumentError, FileError
from ._recording import Recording

#: Keys that the file of the samples makes superfluous, because it has times and units.
_KEYS_OF_SAMPLES = ("sample_rate", "unit")


def folder() -> Path:
    """Returns the folder of stored samples, in that of ``JOUNCE_CACHE`` or in the user's cache folder."""
    given, cache = os.environ.get("JOUNCE_CACHE"), os.environ.get("XDG_CACHE_HOME")
    return (Path(given) if given else (Path(cache) if cache else Path.home() / ".cache") / "jounce") / "recordings"


def recorded(samples: Any, keys: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the keys of a drive by samples, which are written to its ``file``, by default one that their digest names."""
    if keys.get("signal", "recording") != "recording":
        raise ArgumentError(f"signal is {keys['signal']!r}, but a recording is given; omit the signal", {"signal": keys["signal"]})
    if isinstance(samples, (str, os.PathLike)):
        raise ArgumentError(f"recording is the path {os.fspath(samples)}; give it as `file`", {"given": os.fspath(samples)})
    recording = samples if isinstance(samples, Recording) else Recording.of(samples, keys.get("sample_rate"), units=keys.get("unit"))
    if "file" in keys:
        path = Path(keys["file"])
        recording.write(path)
    else:
        path = folder() / f"{recording._sha256()}.csv"
        if not path.exists():
            try:
                path.parent.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                message = f"the samples cannot be stored in {path.parent}: {error}; give the drive a `file`, or set JOUNCE_CACHE"
                raise FileError(message, {"path": str(path.parent), "errno": error.errno}) from error
            recording.write(path)
    others = {key: value for key, value in keys.items() if key not in _KEYS_OF_SAMPLES}
    return {**others, "signal": "recording", "file": str(path)}


def stored_files(tables: Mapping[str, Any]) -> Iterator[tuple[str, Path]]:
    """Yields the name of each drive whose samples are in the folder of stored samples, and their file."""
    for name, keys in tables.get("drive", {}).items():
        file = Path(keys.get("file", ""))
        if file.parent == folder():
            yield name, file


def copy_next_to(spec_path: Path, tables: Mapping[str, Any]) -> dict[str, str]:
    """Copies stored samples next to a spec; returns the new names by file."""
    import shutil

    names = {}
    for name, file in stored_files(tables):
        copy = spec_path.with_name(f"{spec_path.stem}.{name}.csv")
        try:
            shutil.copyfile(file, copy)
        except OSError as error:
            raise FileError(f"the samples {file} cannot be copied to {copy}: {error}", {"path": str(copy), "errno": error.errno}) from error
        names[str(file)] = copy.name
    return names
