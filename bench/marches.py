"""Times jounce on tasks without a peer, a second stop, noise and a recording, and writes MARCHES.md.

`python3 bench/marches.py --help` lists the options. Needs only Python 3.11 and the program.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from harness import machine, marches

HERE = Path(__file__).resolve().parent


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jounce", type=Path, default=HERE.parent / "target" / "release" / "jounce", help="the program")
    parser.add_argument("--spec", type=Path, default=HERE.parent / "examples" / "impact-harvester-2019" / "harvester.toml")
    parser.add_argument("--repeats", type=int, default=14, help="repetitions of each task, all in turn")
    parser.add_argument("--cap", type=float, default=300.0, help="seconds after which one run is stopped")
    parser.add_argument("--keep", action="store_true", help="leave MARCHES.md as it is")
    return parser.parse_args()


def main() -> None:
    """Measures and writes."""
    chosen = options()
    described = [
        f"CPU: {machine.processor()}, {os.cpu_count()} cores; load average at the start {os.getloadavg()[0]:.1f}",
        f"Each run is a separate process on one thread; the time is the integration time that jounce reports. {chosen.repeats} runs of each.",
    ]
    found = marches.marches(chosen.jounce.resolve(strict=True), HERE / "plant.toml", chosen.spec.resolve(), chosen.repeats, chosen.cap)
    text = marches.report(described, found)
    if not chosen.keep:
        (HERE / "MARCHES.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
