"""Commands that the campaign of `interrupt.py` interrupts, each of 0.1 to 1 s, and the files that they read."""

import dataclasses
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / "examples" / "impact-harvester-2019" / "harvester.toml"

#: Changes of the example that make it short.
SHORT = {'duration = "20 s"': 'duration = "1 s"', 'average_over = "10 s"': 'average_over = "0.5 s"', "modes = 8": "modes = 3"}

STUDY = """spec = "spec.toml"
sampling = "grid"
points_per_part = 1
[vary]
"stop.tip.gap" = "0.5mm:1.5mm:4x"
"drive.shaker.frequency" = "11Hz:13Hz:4x"
[quantity]
command = "run"
"""

DESIGN = """spec = "spec.toml"
evaluations = 8
[free]
"circuit.load.resistance" = "10kohm:3Mohm:log"
"stop.tip.gap" = "0.2mm:3mm"
[goal]
maximise = "expected-power"
starts = 2
"""

OVER = "--over=drive.shaker.frequency="
SWEEP = ("sweep", "spec.toml", f"{OVER}11Hz:13Hz:12x", "--direction=both", "--fixed-duration", "--out=disk/out")
RIG = ("rig", "spec.toml", "--hammer=beam.tip", "--at=beam.tip", "--hold=table", "--hits=2", "--block=4s", "--contact=8ms", "--rate=2kHz")
DIAGRAM = ("diagram", "spec.toml", f"{OVER}12Hz:13Hz:3x", "--no-branches", "--out=disk/out")
RUN_STUDY = ("study", "run", "study.toml", "--out=disk/out")
RUN = ("run", "spec.toml", "--out=disk/out", "--save-state=disk/out/states/state.json")
ENSEMBLE = ("ensemble", "noise.toml", "--members=3", "--set=run.duration=2s", "--set=run.average_over=1s")
PLANE = (f"{OVER}12.4Hz:12.6Hz", "--against=stop.tip.gap=0.99mm:1.01mm", "--seeds=0")


@dataclasses.dataclass(frozen=True)
class Scenario:
    """Commands at work at the same time, which write into the folder `disk/out`."""

    name: str
    commands: tuple[tuple[str, ...], ...]
    #: What keeps finished work: "parts" of a study, a "journal" in the cache, or nothing.
    keeps: str = ""
    #: Ctrl-C lets the command write the finished part of its result.
    partial: bool = False
    #: Trials of this scenario among those of all.
    weight: int = 2
    #: Commands that make the input files.
    before: tuple[tuple[str, ...], ...] = ()


def one(name, *command, **keywords):
    """A scenario of one command."""
    return Scenario(name, (command,), **keywords)


SCENARIOS = [
    one("study", *RUN_STUDY, keeps="parts", weight=8),
    Scenario("study, two shards", tuple((*RUN_STUDY, f"--shard={shard}/2") for shard in (1, 2)), keeps="parts", weight=6),
    Scenario("study, two processes", (RUN_STUDY, RUN_STUDY), keeps="parts", weight=4),
    one("study page", "study", "page", "study", "--out=disk/out/page.html", before=(("study", "run", "study.toml", "--out=study"),)),
    one("sweep", *SWEEP, keeps="journal", weight=8),
    Scenario("sweep, two processes", (SWEEP, SWEEP), keeps="journal", weight=4),
    one("diagram", *DIAGRAM, keeps="journal", partial=True, weight=6),
    one("design", "design", "design.toml", "--out=disk/out", keeps="journal", partial=True, weight=6),
    one("basins", "basins", "spec.toml", "--starts=8", "--out=disk/out", partial=True, weight=4),
    one("branch", "branch", "spec.toml", f"{OVER}12Hz:13Hz", "--seeds=0", "--out=disk/out", partial=True, weight=3),
    one("bifurcations", "bifurcations", "spec.toml", *PLANE, "--out=disk/out", partial=True, weight=1),
    one("ensemble", *ENSEMBLE, "--out=disk/out", partial=True),
    one("run, state", *RUN, weight=6),
    one("run from a state", *RUN, "--start=state.json", before=(("run", "spec.toml", "--save-state=state.json"),)),
    one("modes", "modes", "spec.toml", "--out=disk/out"),
    one("show", "show", "spec.toml", "--out=disk/out/drawing.png"),
    one("export", "export", "spec.toml", "--matrices=disk/out/matrices", "--spice=disk/out/spice.cir"),
    one("new", "new", "ball", "--force", "--out=disk/out/ball.toml"),
    one("rig, UFF", *RIG, "--to=disk/out/rig.uff"),
    one("rig, Parquet", *RIG, "--to=disk/out/rig.parquet"),
    one("read, CSV", "read", "rig.uff", "--to=disk/out/read/rig.csv", "--out=disk/out", before=((*RIG, "--to=rig.uff"),)),
]

#: Takes a quarter of a minute or more, so it is not among the others.
REPRODUCE = one("reproduce", "reproduce", "--out=disk/out")


def prepare(folder, scenario, program, environment):
    """Writes the files that a scenario reads into a new folder."""
    text = EXAMPLE.read_text(encoding="utf-8")
    for old, new in SHORT.items():
        text = text.replace(old, new)
    noise = (ROOT / "examples" / "random-base" / "harvester.toml").read_text(encoding="utf-8")
    for name, content in {"spec.toml": text, "study.toml": STUDY, "design.toml": DESIGN, "noise.toml": noise}.items():
        (folder / name).write_text(content, encoding="utf-8")
    for command in scenario.before:
        subprocess.run([program, *command], cwd=folder, env=environment, check=True, capture_output=True)
    for name in ("cache", "tmp"):
        (folder / "disk" / name).mkdir(parents=True, exist_ok=True)
