"""Runs a program against the clock."""

import os
import subprocess
import time
from dataclasses import dataclass


class Failed(Exception):
    """The program ended with an error."""


class TooSlow(Exception):
    """The program was stopped at the limit."""


@dataclass
class Times:
    """In seconds. whole: from the start of the process to its end, with the picture's file closed; processors: how many
    were kept busy during that time."""

    render: float
    whole: float
    processors: float


def run(command, folder, limit, environment=None):
    """Returns (what it printed, seconds, processors kept busy)."""
    with open(os.path.join(folder, "output.txt"), "w+b") as output:
        start = time.perf_counter()
        process = subprocess.Popen(
            [str(word) for word in command],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            env={**os.environ, **(environment or {})},
        )
        # wait4 tells what this process used; a program past the limit is ended.
        while True:
            ended, status, usage = os.wait4(process.pid, os.WNOHANG)
            seconds = time.perf_counter() - start
            if ended:
                break
            if seconds > limit:
                process.kill()
                os.wait4(process.pid, 0)
                process.returncode = -9
                raise TooSlow(f"more than {limit:g} s")
            time.sleep(0.0005 if seconds < 1 else 0.005)
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read().decode(errors="replace")
    if process.returncode != 0:
        raise Failed(f"{' '.join(map(str, command))}\nended with {process.returncode}:\n{text[-2000:]}")
    return text, seconds, (usage.ru_utime + usage.ru_stime) / seconds
