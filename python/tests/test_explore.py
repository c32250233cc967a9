"""The live page from Python: served beside the interpreter, ended by hand, by Ctrl-C, and leaving nothing behind."""

import base64
import os
import pickle
import re
import socket
import socketserver
import subprocess
import sys
import textwrap
import threading
import time
import urllib.error
import urllib.request
from types import SimpleNamespace

import pytest
from conftest import SPEC

import jounce


def page(address):
    """The page, without a proxy between."""
    with urllib.request.build_opener(urllib.request.ProxyHandler({})).open(address, timeout=20) as response:
        return response.read().decode()


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    """A folder of its own for the state of programs."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "state"


def test_a_harvester_without_a_file_is_served_and_leaves_nothing_behind(harvester, home):
    harvester["stop.tip.gap"] = "0.5 mm"
    with jounce.explore(harvester, browser=False) as explorer:
        assert explorer.running and "jounce" in page(explorer.address)
        token = explorer.address.rstrip("/").rsplit("/", 1)[1]
        with pytest.raises(urllib.error.HTTPError) as refused:
            page(explorer.address.replace(token, "0" * 32))
        assert refused.value.code == 403
        refused.value.close()
        assert f'href="{explorer.address}"' in explorer._repr_html_() and explorer.address in repr(explorer)
    assert not explorer.running and "ended" in repr(explorer) and "ended" in explorer._repr_html_()
    explorer.stop()
    with pytest.raises(urllib.error.URLError):
        page(explorer.address)
    assert not home.exists()


def test_the_page_of_a_file_comes_back_at_its_address(home):
    with jounce.explore(SPEC, browser=False) as explorer:
        address = explorer.address
    with jounce.explore(str(SPEC), browser=False) as second_explorer:
        assert second_explorer.address == address and "jounce" in page(address)
    assert len(list(home.rglob("explore-*"))) == 1


def test_the_interpreter_runs_on_and_waiting_ends_with_the_page(harvester):
    explorer = jounce.explore(harvester, browser=False)
    start_time = time.monotonic()
    threading.Timer(0.3, explorer.stop).start()
    explorer.wait()
    assert 0.2 < time.monotonic() - start_time < 30.0 and not explorer.running


def test_ctrl_c_ends_the_page():
    code = textwrap.dedent(f"""
        import jounce, os, signal, threading, urllib.request
        signal.signal(signal.SIGINT, signal.default_int_handler)
        explorer = jounce.explore({str(SPEC)!r}, browser=False)
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        explorer.wait()
        print("ended", explorer.running)
    """)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    assert done.stdout.split() == ["ended", "False"], done.stderr


@pytest.mark.skipif(os.name == "nt", reason="a browser is named in another way")
def test_the_browser_is_opened_by_a_file_that_only_its_owner_may_read(tmp_path, harvester):
    log = tmp_path / "seen"
    folder = tmp_path / "bin"
    folder.mkdir()
    opener = folder / "xdg-open"
    opener.write_text(f'#!/bin/sh\nls -l "$1" > "{log}.part"; cat "$1" >> "{log}.part"; mv "{log}.part" "{log}"\n')
    opener.chmod(0o755)
    code = textwrap.dedent(f"""
        import jounce, pathlib, time
        with jounce.explore({str(SPEC)!r}) as explorer:
            until = time.monotonic() + 20.0
            while not pathlib.Path({str(log)!r}).exists() and time.monotonic() < until:
                time.sleep(0.02)
            print(explorer.address)
    """)
    environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "TMPDIR": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, env=environment, check=False)
    log_text = log.read_text()
    assert done.stdout.strip() in log_text and re.match(r"-rw------- ", log_text), log_text
    assert not list(tmp_path.glob("jounce-*.html"))


def test_invalid_servers_raise_errors(harvester, tmp_path):
    for invalid_call in (lambda: jounce.explore(3), lambda: jounce.explore(harvester, browser=False, listen="somewhere")):
        with pytest.raises(jounce.ArgumentError):
            invalid_call()
    with pytest.raises(jounce.FileError, match="does not exist"):
        jounce.explore(tmp_path / "none.toml", browser=False)
    with socket.create_server(("127.0.0.1", 0)) as occupied_socket, pytest.raises(jounce.ExploreError, match="cannot listen on"):
        jounce.explore(harvester, browser=False, listen=f"127.0.0.1:{occupied_socket.getsockname()[1]}")
    with jounce.explore(harvester, browser=False) as explorer, pytest.raises(TypeError):
        pickle.dumps(explorer)


class Proxy(socketserver.ThreadingTCPServer):
    """A reverse proxy of another origin as jupyter-server-proxy: it drops a prefix of the path and forwards all headers, ``Host`` too."""

    daemon_threads = True

    def __init__(self):
        super().__init__(("127.0.0.1", 0), ProxyHandler)
        self.origin = f"http://localhost:{self.server_address[1]}"
        self.template = f"{self.origin}/user/me/proxy/{{port}}/"


class ProxyHandler(socketserver.StreamRequestHandler):
    def handle(self):
        """Forwards one request and its response."""
        method, path, version = self.rfile.readline().decode().split(" ")
        port, _, rest = path.removeprefix("/user/me/proxy/").partition("/")
        lines = [f"{method} /{rest} {version}".encode()]
        while (line := self.rfile.readline()) not in (b"\r\n", b""):
            lines.append(line)
        with socket.create_connection(("127.0.0.1", int(port)), timeout=20) as upstream:
            upstream.sendall(b"".join([*lines, b"\r\n"]))
            while received := upstream.recv(65536):
                self.wfile.write(received)


@pytest.fixture
def proxy():
    with Proxy() as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server
        server.shutdown()


@pytest.fixture
def notebook(monkeypatch):
    """The kernel of a notebook, as far as the package looks for it."""
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: SimpleNamespace(kernel=object())))


def status_of_socket(address, **headers):
    """Status of the response to a browser that opens the socket of a page."""
    _, _, server, path = address.split("/", 3)
    host, port = server.split(":")
    upgrade = {"Host": server, "Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13"}
    upgrade |= {"Sec-WebSocket-Key": base64.b64encode(bytes(16)).decode(), **headers}
    with socket.create_connection((host, int(port)), timeout=20) as connection:
        lines = [f"GET /{path}socket HTTP/1.1", *(f"{name}: {value}" for name, value in upgrade.items()), "", ""]
        connection.sendall("\r\n".join(lines).encode())
        return int(connection.makefile("rb").readline().split()[1])


def frame_policy(address):
    with urllib.request.build_opener(urllib.request.ProxyHandler({})).open(address, timeout=20) as response:
        return response.headers["X-Frame-Options"], response.headers.get_all("Content-Security-Policy")[1]


def test_a_notebook_shows_the_page_in_a_frame(harvester, notebook, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))  # No browser: it would warn.
    with jounce.explore(harvester, height=432) as explorer:
        frame, link = explorer._repr_html_().split("<br>")
        assert frame.startswith(f'<iframe src="{explorer.address}"') and "height: 432px" in frame and f'href="{explorer.address}"' in link
        assert frame_policy(explorer.address) == (None, "frame-ancestors 'self' http://127.0.0.1:* http://localhost:*")
    assert "iframe" not in explorer._repr_html_()


def test_a_page_outside_notebooks_may_not_be_framed(harvester):
    with jounce.explore(harvester, browser=False) as explorer:
        assert "iframe" not in explorer._repr_html_()
        assert frame_policy(explorer.address) == ("DENY", "frame-ancestors 'none'")


def test_the_page_works_behind_the_proxy_that_is_named_and_no_other(harvester, proxy):
    with jounce.explore(harvester, proxy=proxy.template) as explorer:
        assert (
            explorer.address.startswith(f"{proxy.origin}/user/me/proxy/") and f'<iframe src="{explorer.address}"' in explorer._repr_html_()
        )
        # The page, and its files by their relative addresses.
        assert "jounce" in page(explorer.address) and page(f"{explorer.address}app.js") and page(explorer.address.rstrip("/"))
        assert "'self'" in frame_policy(explorer.address)[1]
        assert status_of_socket(explorer.address, Origin=proxy.origin) == 101
        assert status_of_socket(explorer.address, Origin="https://evil.example") == 403
        assert status_of_socket(explorer.address, Origin=proxy.origin, Host="evil.example") == 421
    with jounce.explore(harvester, browser=False) as explorer:
        port, token = explorer.address.rstrip("/").split(":")[2].split("/")
        with pytest.raises(urllib.error.HTTPError) as refused:
            page(f"{proxy.template.replace('{port}', port)}{token}/")
        assert refused.value.code == 421
        refused.value.close()


@pytest.mark.parametrize("address", ["/proxy/{port}/", "hub.example.org", "https://me@hub.example.org/proxy/{port}/", ""])
def test_a_proxy_has_a_complete_address(harvester, address):
    with pytest.raises(jounce.ArgumentError, match="give the address that the browser shows"):
        jounce.explore(harvester, proxy=address)
