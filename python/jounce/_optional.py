"""Packages that only some calls need."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def require(module: str, extra: str) -> Any:
    """Returns the module, or raises an ImportError with the command that installs it."""
    try:
        return import_module(module)
    except ImportError as error:
        package = module.split(".")[0]
        raise ImportError(f'this call needs {package}, which is not installed: pip install "jounce[{extra}]"', name=package) from error
