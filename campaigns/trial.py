"""One command of a scenario at work in a folder of its own."""

import os
import resource
import shutil
import subprocess

from scenarios import prepare

#: Longest time until a command ends by itself.
LIMIT_S = 600.0
BUSY = "another process"


class Violation(Exception):
    """What must not happen."""


class Trial:
    """One scenario in one folder."""

    def __init__(self, scenario, program, folder, is_mounted):
        self.scenario, self.program, self.folder, self.is_mounted = scenario, program, folder, is_mounted
        #: A stopped command may have written the finished part of its result.
        self.may_be_partial = False
        self.disk, self.out = folder / "disk", folder / "disk" / "out"
        self.environment = {**os.environ, "JOUNCE_CACHE": str(self.disk / "cache"), "TMPDIR": str(self.disk / "tmp")}

    def __enter__(self):
        self.disk.mkdir(parents=True)
        if self.is_mounted:
            subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256m", "jounce", self.disk], check=True)
        prepare(self.folder, self.scenario, self.program, self.environment)
        return self

    def __exit__(self, *_):
        if self.is_mounted:
            subprocess.run(["umount", "-l", self.disk], check=True)
        shutil.rmtree(self.folder, ignore_errors=True)

    def remount(self, option):
        """Changes the disk: its size, or whether it can be written."""
        return subprocess.run(["mount", "-o", f"remount,{option}", self.disk], capture_output=True, check=False).returncode == 0

    def used_pages(self):
        """Pages of 4 kB in use."""
        disk = os.statvfs(self.disk)
        return (disk.f_blocks - disk.f_bfree) * disk.f_frsize // 4096

    def start(self, largest_file=None, commands=None):
        """Starts the commands of the scenario, or some of them; the size of their files may be limited."""
        commands = commands or self.scenario.commands
        limit = None if largest_file is None else (lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file)))
        options = {"cwd": self.folder, "env": self.environment, "stdout": subprocess.DEVNULL, "text": True, "preexec_fn": limit}
        # Python ignores SIGXFSZ, and so does a program that it starts without the default signals: writing fails.
        options |= {"restore_signals": largest_file is None, "start_new_session": True}
        processes = []
        for number, command in enumerate(commands):
            log = self.folder / f"stderr-{number}"
            with log.open("w") as file:
                processes.append((subprocess.Popen([self.program, *command], stderr=file, **options), log))
        return processes

    def finish(self, processes, allowed):
        """Waits for the commands; returns their exit codes and what they wrote on stderr."""
        ends = []
        for process, log in processes:
            code = process.wait(LIMIT_S)
            text = log.read_text()
            is_refused = code == 4 and BUSY in text and len(processes) > 1
            if "panicked" in text or not (code in allowed or is_refused):
                raise Violation(f"exit code {code}: {text.strip()[-300:]}")
            ends.append((code, text))
        return ends

    def complete(self):
        """Runs the commands to their end, one after the other."""
        return [end for command in self.scenario.commands for end in self.finish(self.start(commands=[command]), {0})]

    def files(self):
        """The result: the content of each file by name."""
        paths = [path for path in self.out.rglob("*") if path.is_file() and not path.name.startswith(".")]
        return {str(path.relative_to(self.out)): path.read_bytes() for path in paths}

    def abandoned(self):
        """Temporary files that a process left, without locks."""
        return [path for path in self.disk.rglob("*") if path.name.startswith(".jounce-") or path.parent.name == "tmp"]

    def parts(self):
        """Inode and time of each finished part of a study."""
        states = {path: path.stat() for path in self.out.glob("parts/part-*")}
        return {path: (state.st_ino, state.st_mtime_ns) for path, state in states.items()}

    def journal(self):
        """Lines of the journal; None where there is none."""
        journals = list((self.disk / "cache").glob("*.jsonl"))
        if len(journals) > 1:
            raise Violation(f"{len(journals)} journals of one command")
        return [line for line in journals[0].read_bytes().splitlines(True) if line.endswith(b"\n")] if journals else None

    def size(self):
        """Changes with every new name and every written byte."""
        try:
            return [(entry.name, entry.stat().st_size) for folder in (self.out, self.out / "parts", self.disk / "cache")
                    if folder.is_dir() for entry in os.scandir(folder)]  # fmt: skip
        except OSError:
            return None
