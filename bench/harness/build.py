"""Compiles the peers; a peer that cannot be built is reported and omitted."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
BUILD = HERE / "build"
C_FLAGS = ["-std=gnu11", "-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math"]
FORTRAN_FLAGS = ["-O3", "-march=native", "-fopenmp"]


def say(text: str) -> None:
    """Prints to stderr at once."""
    print(text, file=sys.stderr, flush=True)


def write_coefficients() -> None:
    """Writes the table of DOP853 as a C header, from the table in SciPy."""
    from scipy.integrate._ivp import dop853_coefficients as table

    def row(values: list[float]) -> str:
        return "{" + ", ".join(repr(value) for value in values) + "}"

    lines = [f"static const double DOP853_A[12][12] = {{{', '.join(row(r) for r in table.A[:12, :12].tolist())}}};"]
    for name, values in {"B": table.B, "C": table.C[:12], "E3": table.E3, "E5": table.E5}.items():
        lines.append(f"static const double DOP853_{name}[{len(values)}] = {row(values.tolist())};")
    (BUILD / "dop853_coefficients.h").write_text("\n".join(lines) + "\n")


def compile_c(name: str, modes: int) -> Path | None:
    """Compiles a C peer for a number of modes."""
    compiler = shutil.which("gcc")
    if compiler is None:
        say(f"left out: {name}: gcc is not installed")
        return None
    target = BUILD / f"{name}-{modes}"
    vectors = f"-DVECTORS={(modes + 3) // 4}"
    command = [compiler, *C_FLAGS, vectors, f"-I{BUILD}", str(HERE / "peers" / f"{name}.c"), "-o", str(target), "-lm"]
    subprocess.run(command, check=True)
    return target


def cargo(folder: str, program: str) -> Path | None:
    """Builds a Rust program with its own workspace and target folder."""
    if shutil.which("cargo") is None:
        say(f"left out: {folder}: cargo is not installed")
        return None
    root = HERE / folder
    environment = os.environ | {"CARGO_TARGET_DIR": str(root / "target")}
    subprocess.run(["cargo", "build", "--release", "--quiet"], cwd=root, env=environment, check=True)
    return root / "target" / "release" / program


def compile_rust() -> Path | None:
    """Compiles the Rust libraries that jounce is compared with."""
    return cargo("peers-rust", "peers")


def compile_jounce() -> Path | None:
    """Compiles jounce as a library, from the sources next to this folder."""
    return cargo("peer-jounce", "peer-jounce")


def compile_auto() -> Path | None:
    """Compiles AUTO-07p with the plant's equations, linked as its own `@r` script does."""
    objects = sorted(Path(os.environ.get("AUTO_DIR", "/usr/lib/auto-07p")).glob("lib/*.o"))
    compiler = shutil.which("gfortran")
    if compiler is None or not objects:
        say("left out: AUTO-07p: gfortran or AUTO's object files are not installed (Debian packages gfortran and auto-07p)")
        return None
    target = BUILD / "orbits"
    command = [compiler, *FORTRAN_FLAGS, str(HERE / "peers" / "orbits.f90"), *map(str, objects), "-o", str(target)]
    subprocess.run(command, cwd=BUILD, check=True)
    return target


def find_octave() -> Path | None:
    """Finds Octave's command line, if it is installed."""
    found = shutil.which("octave-cli")
    if found is None:
        say("left out: ode45: octave-cli is not installed (Debian package octave)")
    return Path(found) if found else None
