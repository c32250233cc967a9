"""Description of the machine in general words."""

from __future__ import annotations

import os
import platform
import subprocess
from pathlib import Path


def first_line(*command: str) -> str:
    """Returns the first line that a command prints, or reports its absence."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[0].strip()
    except (OSError, subprocess.CalledProcessError, IndexError):
        return f"{command[0]}: absent"


def processor() -> str:
    """Returns the name of the CPU."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or "unknown"
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "unknown")


def describe() -> list[str]:
    """Returns one line for each property that affects the times."""
    import numpy
    import scipy

    return [
        f"CPU: {processor()}, {os.cpu_count()} cores; load average at the start {os.getloadavg()[0]:.1f}",
        f"C: {first_line('gcc', '--version')}",
        f"Rust: {first_line('rustc', '--version')}",
        f"Python {platform.python_version()}, NumPy {numpy.__version__}, SciPy {scipy.__version__}",
        f"{first_line('octave-cli', '--version')}",
    ]
