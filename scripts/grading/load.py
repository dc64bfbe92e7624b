"""Processes that keep the processors busy while something else is measured."""

import contextlib
import subprocess
import sys


@contextlib.contextmanager
def busy(count):
    """`count` processes that never rest, as long as the block runs."""
    started = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
    finally:
        for process in started:
            process.kill()
        for process in started:
            process.wait()
