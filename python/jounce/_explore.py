"""Live page of a harvester."""

from __future__ import annotations

import atexit
import warnings
from os import PathLike, fspath
from types import TracebackType
from typing import Self

from . import _core
from ._errors import ArgumentError
from ._spec import Spec


class Explorer:
    """Running page: ``explorer.address`` opens it, ``explorer.stop()`` ends it, as does the end of a ``with`` block or of Python."""

    def __init__(self, core: _core.Explorer) -> None:
        self._core = core
        # The file that leads the browser to the page is deleted with the server.
        atexit.register(core.stop)

    @property
    def address(self) -> str:
        """Address of the page. It contains the access token: anyone who has it can use the page."""
        return self._core.address

    @property
    def running(self) -> bool:
        """True while the page is served."""
        return self._core.running

    def stop(self) -> None:
        """Stops the server, its computations and the open pages. A second call has no effect."""
        atexit.unregister(self._core.stop)
        self._core.stop()

    def wait(self) -> None:
        """Waits until the page ends; Ctrl-C ends it. For scripts, whose end would end the page."""
        try:
            self._core.wait()
        except KeyboardInterrupt:
            pass
        finally:
            self.stop()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None) -> None:
        self.stop()

    def __repr__(self) -> str:
        return f"<jounce.Explorer at {self.address}{'' if self.running else ', ended'}>"

    def _repr_html_(self) -> str:
        import html

        address = html.escape(self.address, quote=True)
        state = "" if self.running else " (ended)"
        return f'<a href="{address}" target="_blank" rel="noopener">The live page of this harvester</a>{state}'


def explore(harvester: Spec | str | PathLike[str], *, browser: bool = True, listen: str | None = None) -> Explorer:
    """Serves the live page of a harvester and opens it: its drawing, branches and orbits follow every slider.

    The page of a :class:`Spec` shows its present state and leaves no file; the page of a path follows the file. The server is a thread of
    this process and is reachable from this machine only, unless ``listen = "ADDRESS:PORT"`` is given. In a script,
    ``jounce.explore(harvester).wait()`` serves until Ctrl-C.
    """
    if isinstance(harvester, Spec):
        explorer = Explorer(_core.Explorer(spec=harvester._spec, listen=listen))
    elif isinstance(harvester, (str, PathLike)):
        explorer = Explorer(_core.Explorer(path=fspath(harvester), listen=listen))
    else:
        raise ArgumentError(f"harvester is of type {type(harvester).__name__}; give a jounce.Spec or the path of one")
    if browser:
        try:
            explorer._core.open()
        except OSError as error:
            warnings.warn(f"no browser could be started ({error}); open {explorer.address} yourself", stacklevel=2)
    return explorer
