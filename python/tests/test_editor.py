"""The JSON Schema in an editor: faults, hover text and completion from the TOML language server Tombi."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT, SPEC

import jounce

TOMBI = shutil.which("tombi", path=Path(sys.executable).parent) or shutil.which("tombi")
pytestmark = pytest.mark.skipif(TOMBI is None, reason="the TOML server tombi is not installed: pip install tombi")

PAPER = SPEC.read_text(encoding="utf-8")

#: Changes of the paper's spec, each with one fault that a schema can know: text, replacement, and the line that the editor must mark.
WRONG = [
    ('length = "315 mm"', "length = 315", "length = 315"),
    ('length = "315 mm"', 'length = "-315 mm"', 'length = "-315 mm"'),
    ('length = "315 mm"', 'length = "0 mm"', 'length = "0 mm"'),
    ('length = "315 mm"', 'length = "315"', 'length = "315"'),
    ('length = "315 mm"', 'length = "315 mn"', 'length = "315 mn"'),
    ('length = "315 mm"', 'length = "0,315 m"', 'length = "0,315 m"'),
    ('length = "315 mm"', "", "[beam.beam]"),
    ('youngs_modulus = "65 GPa"', 'youngs_modulus = "65 GHz"', 'youngs_modulus = "65 GHz"'),
    ('resistance = "1 Mohm"', 'resistance = "1 MOHM"', 'resistance = "1 MOHM"'),
    ('frequency = "13 Hz"', 'frequency = "13 Hertz"', 'frequency = "13 Hertz"'),
    ('amplitude = "200 N"', 'amplitude = "200 mm"', 'amplitude = "200 mm"'),
    ('capacitance = "177 nF"', 'capacitance = "177 nH"', 'capacitance = "177 nH"'),
    ('law = "hertz"', "", "[stop.tip]"),
    ('law = "hertz"', 'law = "herz"', 'law = "herz"'),
    ('law = "hertz"', 'law = "hertz"\nrestitution = 0.5', "restitution = 0.5"),
    ('law = "hertz"', 'law = "hertz"\nexponent = 0.5', "exponent = 0.5"),
    ('gap = "1 mm"', 'gap = "1 mm"\ngapp = "1 mm"', 'gapp = "1 mm"'),
    ("damping_ratio = 0.3", 'damping_ratio = 0.3\nstiffness = "1 N/m"', 'stiffness = "1 N/m"'),
    ("ratios = [0.00194,", "ratios = [-0.00194,", "ratios = [-0.00194,"),
    ("modes = 8", "modes = 8.5", "modes = 8.5"),
    ('start = "rest"', 'start = "rset"', 'start = "rset"'),
    ("[mass.table]", '[mass."my table"]', '[mass."my table"]'),
    ("[reduction]", "[redcution]", "[redcution]"),
]


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """A folder with the schema and the settings of the server that the book shows."""
    folder = tmp_path_factory.mktemp("project")
    (folder / "jounce.schema.json").write_text(json.dumps(jounce.schema()), encoding="utf-8")
    page = (ROOT / "book/src/howto/editors.md").read_text(encoding="utf-8")
    (settings,) = re.findall(r"^```text\n(\[schema\]\ncatalog.*?)^```", page, re.MULTILINE | re.DOTALL)
    (folder / "tombi.toml").write_text(settings, encoding="utf-8")
    return folder


def errors(project, texts):
    """The errors of each text as pairs of line and message, from one call of the server's linter."""
    names = [f"spec-{number}.toml" for number in range(len(texts))]
    for name, text in zip(names, texts):
        (project / name).write_text(text, encoding="utf-8")
    report = project / "report.json"
    command = [TOMBI, "lint", "--offline", "--quiet", "--diagnostics-format", "json", "--diagnostics-file", report, *names]
    subprocess.run(command, cwd=project, check=False, capture_output=True)
    found = {name: [] for name in names}
    for issue in json.loads(report.read_text(encoding="utf-8")):
        if issue["level"] == "error":
            found[issue["path"]].append((issue["range"]["start"]["line"], issue["message"]))
    return list(found.values())


def test_correct_specs_have_no_fault_in_the_editor(project):
    specs = [path for path in ROOT.glob("examples/*/*.toml") if path.stem not in {"expected", "design", "study", "measured"}]
    texts = [path.read_text(encoding="utf-8") for path in specs] + [jounce.new(kind).to_toml() for kind in jounce.starters()]
    assert len(specs) > 20
    for path, found in zip([*specs, *jounce.starters()], errors(project, texts)):
        assert not found, path


def test_a_wrong_spec_is_marked_at_its_line_and_nowhere_else(project):
    texts = [PAPER.replace(old, new) for old, new, _ in WRONG]
    for (old, _, marked), text, found in zip(WRONG, texts, errors(project, texts)):
        assert old in PAPER
        line = 1 + next(at for at, content in enumerate(text.splitlines()) if content.startswith(marked))
        assert {at for at, _ in found} == {line}, (marked, line, found)
        with pytest.raises(jounce.JounceError):
            jounce.Spec(text)


class Server:
    """A language server that speaks over its standard input and output."""

    def __init__(self, folder):
        self.folder = folder
        self.process = subprocess.Popen(
            [TOMBI, "lsp", "--offline"], cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
        )
        self.ids = iter(range(1000))
        capabilities = {"textDocument": {"publishDiagnostics": {}}}
        self.call("initialize", {"processId": None, "rootUri": folder.as_uri(), "capabilities": capabilities})
        self.send({"method": "initialized", "params": {}})

    def send(self, message):
        """Sends a message."""
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))
        self.process.stdin.flush()

    def receive(self):
        """The next message that is not a request of the server; those have an empty result here."""
        while True:
            length = 0
            while (line := self.process.stdout.readline()).strip():
                name, value = line.split(b":", 1)
                length = int(value) if name.lower() == b"content-length" else length
            message = json.loads(self.process.stdout.read(length))
            if "method" not in message or "id" not in message:
                return message
            self.send({"id": message["id"], "result": None})

    def call(self, method, params):
        """Returns the result of a request."""
        number = next(self.ids)
        self.send({"id": number, "method": method, "params": params})
        while (message := self.receive()).get("id") != number:
            pass
        return message["result"]

    def open(self, name, text):
        """Opens a text in the editor and returns its address."""
        uri = (self.folder / name).as_uri()
        document = {"uri": uri, "languageId": "toml", "version": 1, "text": text}
        self.send({"method": "textDocument/didOpen", "params": {"textDocument": document}})
        # The server has read the document and the schema when it publishes the faults.
        while self.receive().get("method") != "textDocument/publishDiagnostics":
            pass
        return uri

    def at(self, method, uri, line, character):
        """Returns the result of a request at a place of a text, counted from 0."""
        position = {"line": line, "character": character}
        return self.call(f"textDocument/{method}", {"textDocument": {"uri": uri}, "position": position})

    def close(self):
        """Ends the server."""
        self.call("shutdown", None)
        self.send({"method": "exit"})
        self.process.communicate(timeout=10)


@pytest.fixture
def server(project):
    server = Server(project)
    yield server
    server.close()


def test_the_first_line_of_a_spec_can_name_the_schema(tmp_path):
    (tmp_path / "jounce.schema.json").write_text(json.dumps(jounce.schema()), encoding="utf-8")
    wrong = PAPER.replace("1 Mohm", "1 MOHM")
    (found,) = errors(tmp_path, ["#:schema ./jounce.schema.json\n" + wrong])
    line = 2 + next(at for at, content in enumerate(wrong.splitlines()) if "MOHM" in content)
    assert {at for at, _ in found} == {line}


def test_the_editor_shows_the_meaning_and_unit_of_a_key(server):
    uri = server.open("hover.toml", PAPER)
    line = PAPER.splitlines().index('gap = "1 mm"')
    text = server.at("hover", uri, line, 1)["contents"]["value"]
    assert "distance to the stop in the undeformed position" in text and "mm, um, cm, m" in text


def test_the_editor_completes_keys_and_words(server):
    text = PAPER.replace('gap = "1 mm"', "").replace('law = "hertz"', 'law = ""')
    uri = server.open("completion.toml", text)
    lines = text.splitlines()
    law = lines.index('law = ""')
    words = {item["label"] for item in server.at("completion", uri, law, 7)}
    assert {'"hertz"', '"rigid"', '"hunt-crossley"'} <= words
    keys = {item["label"] for item in server.at("completion", uri, law + 1, 0)}
    assert {"gap", "side", "exponent"} <= keys
    assert "frame" not in keys, "a key that is there already"
