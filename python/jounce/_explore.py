"""Live page of a harvester."""

from __future__ import annotations

import atexit
import sys
import warnings
from os import PathLike, fspath
from types import TracebackType
from typing import Self

from . import _core
from ._errors import ArgumentError
from ._spec import Spec


class Explorer:
    """Running page: ``explorer.address`` opens it, ``explorer.stop()`` ends it, as does the end of a ``with`` block or of Python.

    A notebook shows the page itself.
    """

    def __init__(self, core: _core.Explorer, proxy: str | None = None, frame_height: int | None = None) -> None:
        self._core = core
        self._proxy = proxy
        self._frame_height = frame_height
        # The file that leads the browser to the page is deleted with the server.
        atexit.register(core.stop)

    @property
    def address(self) -> str:
        """Address of the page, behind a proxy that of the proxy. It contains the access token: anyone who has it can use the page."""
        if self._proxy is None:
            return self._core.address
        _, _, server, token, _ = self._core.address.split("/")
        return f"{self._proxy.replace('{port}', server.rpartition(':')[2]).rstrip('/')}/{token}/"

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
        link = f'<a href="{address}" target="_blank" rel="noopener">The live page of this harvester</a>'
        if not self.running:
            return f"{link} (ended)"
        if self._frame_height is None:
            return link
        style = f"width: 100%; height: {self._frame_height}px; border: 0"
        return f'<iframe src="{address}" style="{style}" allow="clipboard-write" title="Live page"></iframe><br>{link}'


def explore(
    harvester: Spec | str | PathLike[str],
    *,
    browser: bool | None = None,
    listen: str | None = None,
    proxy: str | None = None,
    height: int = 800,
) -> Explorer:
    """Serves the live page of a harvester and opens it: its drawing, branches and orbits follow every slider.

    The page of a :class:`Spec` shows its present state and leaves no file; the page of a path follows the file. The server is a thread of
    this process and is reachable from this machine only, unless ``listen = "ADDRESS:PORT"`` is given. In a script,
    ``jounce.explore(harvester).wait()`` serves until Ctrl-C.

    A notebook shows the page in a frame of ``height`` pixels. If the notebook's server runs on another machine, install
    jupyter-server-proxy there and give the address that it has in the browser, followed by ``proxy/{port}/``, as ``proxy``. The server
    then also accepts requests of that host, and of no other.
    """
    if not isinstance(harvester, (Spec, str, PathLike)):
        raise ArgumentError(f"harvester is of type {type(harvester).__name__}; give a jounce.Spec or the path of one")
    spec, path = (harvester._spec, None) if isinstance(harvester, Spec) else (None, fspath(harvester))
    frames = proxy is not None or _in_notebook()
    core = _core.Explorer(spec=spec, path=path, listen=listen, proxy=None if proxy is None else _origin(proxy), frames=frames)
    explorer = Explorer(core, proxy, height if frames else None)
    if not frames if browser is None else browser:
        try:
            explorer._core.open()
        except OSError as error:
            warnings.warn(f"no browser could be started ({error}); open {explorer.address} yourself", stacklevel=2)
    return explorer


def _in_notebook() -> bool:
    """True in the kernel of a notebook."""
    ipython = sys.modules.get("IPython")
    return ipython is not None and hasattr(ipython.get_ipython(), "kernel")


def _origin(proxy: str) -> str:
    """Returns scheme and host of an address."""
    return "/".join(proxy.split("/")[:3])
