"""Ctrl-C and closed pipes: one line, the exit code of a signal, never a traceback, whatever the command is doing."""

from __future__ import annotations

import ast
import io
import logging
import os
import signal
import subprocess
import sys
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from lagrangian.cli import CLOSED_PIPE, main
from lagrangian.cli.progress import StatusLine, status

if os.name != "posix":
    pytest.skip("signals and terminals of POSIX", allow_module_level=True)

HEARD = partial(signal.signal, signal.SIGINT, signal.default_int_handler)
"""As a terminal starts a command: tests that run in the background pass on that interrupts are ignored."""

IMPORTED = ["typer", "lagrangian.cli.simulate", "numpy", "sympy", "lagrangian.dynamics", "lagrangian.codegen.native"]

AS_IT_IMPORTS = """
import os, signal, sys, tempfile
from lagrangian.interrupts import interrupts
wanted = set({names!r})
class Interrupt:
    def find_spec(self, name, path=None, target=None):
        if name not in wanted:
            return
        wanted.remove(name)
        with tempfile.TemporaryFile() as said:
            child = os.fork()
            if not child:  # the command as it is now, with a watching thread of its own
                os.dup2(said.fileno(), 1), os.dup2(said.fileno(), 2)
                signal.set_wakeup_fd(-1)
                signal.signal(signal.SIGINT, signal.default_int_handler)
                interrupts.listen()
                sys.meta_path.remove(self)
                signal.raise_signal(signal.SIGINT)
                return
            code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
            said.seek(0)
            print((name, code, said.read().decode()), flush=True)
        if not wanted:
            os._exit(0)
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.meta_path.insert(0, Interrupt())
sys.argv = ["lagrangian", "simulate", "-e", "pendulum", "-d", "1"]
from lagrangian.cli import run
run()
"""


@pytest.fixture(scope="module")
def interrupted() -> dict[str, tuple[int, str]]:
    """The exit code of a command, and all it wrote, by the module whose import was interrupted.

    One command imports them all; where each begins, a copy of the process is interrupted.
    """
    command = [sys.executable, "-W", "ignore", "-c", AS_IT_IMPORTS.format(names=IMPORTED)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return {name: (code, said) for name, code, said in map(ast.literal_eval, done.stdout.splitlines())}


@pytest.mark.sampled(6)
@pytest.mark.parametrize("name", IMPORTED)
def test_an_interrupt_while_something_is_imported_is_one_line(interrupted: Any, name: str) -> None:
    assert interrupted[name] == (130, "interrupted\n")


def test_an_interrupt_before_the_command_can_answer_ends_it_without_a_traceback() -> None:
    code = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
class Interrupt:
    def find_spec(self, name, path=None, target=None):
        if name == "lagrangian.cli":
            signal.raise_signal(signal.SIGINT)
sys.meta_path.insert(0, Interrupt())
import lagrangian.__main__
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")


SWALLOWED = """
import signal, time
signal.signal(signal.SIGINT, signal.default_int_handler)
from lagrangian import cli
def press():
    signal.raise_signal(signal.SIGINT)
class Loud:
    def __del__(self):
        press()
def work():
    {work}
cli.main = work
cli.run()
"""


def test_an_interrupt_before_the_watching_thread_runs_is_one_line() -> None:
    code = """
import signal, threading
signal.signal(signal.SIGINT, signal.default_int_handler)
threading.Thread.start = lambda thread: signal.raise_signal(signal.SIGINT)
from lagrangian import cli
cli.run()
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted\n")


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "work",
    [
        "Loud()\n    while True: time.sleep(0.01)",
        "try: press()\n    except BaseException:\n        while True: time.sleep(0.01)",
        "try: press()\n    except BaseException as e: raise ValueError from e",
        "try: press()\n    finally: press()",
    ],
    ids=["in a finalizer", "swallowed", "made another error", "pressed twice"],
)
def test_an_interrupt_that_a_library_swallows_ends_the_command_all_the_same(work: str) -> None:
    code = SWALLOWED.format(work=work)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted\n")


IGNORED = """
import signal, sys
class Interrupt:
    def find_spec(self, name, path=None, target=None):
        if name == "typer":
            signal.raise_signal(signal.SIGINT)
signal.signal(signal.SIGINT, signal.SIG_IGN)
sys.meta_path.insert(0, Interrupt())
sys.argv = ["lagrangian", "examples"]
from lagrangian.cli import run
run()
"""


def test_an_interrupt_that_is_ignored_stays_ignored() -> None:
    done = subprocess.run([sys.executable, "-c", IGNORED], capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "pendulum" in done.stdout


@pytest.mark.slow
def test_machine_code_shows_that_it_works_and_is_interrupted(tmp_path: Path) -> None:
    pty = pytest.importorskip("pty")
    ours, theirs = pty.openpty()
    target = tmp_path / "run.csv"
    long = ["simulate", "-e", "double-pendulum", "-d", "1e7", "--method", "rk4", "--step", "1e-4", "--samples", "3"]
    command = [sys.executable, "-m", "lagrangian", *long, "--max-steps", "1000000000000", "-o", str(target)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=theirs, preexec_fn=HEARD) as process:
        os.close(theirs)
        said = b""
        while b"integrating 1 run" not in said:
            said += os.read(ours, 4096)
        process.send_signal(signal.SIGINT)
        while chunk := _read(ours):
            said += chunk
        assert process.wait() == 130
        assert process.stdout is not None and process.stdout.read() == b""
    assert said.endswith(b"\r\x1b[Kinterrupted\r\n") and b"Traceback" not in said
    assert list(tmp_path.iterdir()) == []


def _read(terminal: int) -> bytes:
    try:
        return os.read(terminal, 4096)
    except OSError:  # the other end is closed
        return b""


def test_a_reader_that_goes_away_is_quiet_and_ends_like_other_tools() -> None:
    command = [sys.executable, "-m", "lagrangian", "examples"]
    ours, theirs = os.pipe()
    os.close(ours)
    done = subprocess.run(command, stdout=theirs, stderr=subprocess.PIPE, check=False)
    os.close(theirs)
    assert (done.returncode, done.stderr) == (CLOSED_PIPE, b"")


# -- what shows that work goes on ------------------------------------------------------------------------------------


def test_the_line_says_what_is_done_and_fits_the_terminal() -> None:
    made = StatusLine()
    made.words = "deriving: step 2, the kinetic energy of 'a\x1b[31mb'"
    assert made.line(3.2, 80).endswith("deriving: step 2, the kinetic energy of 'a [31mb' … 3 s")
    assert all(len(made.line(12.0, columns)) < columns for columns in (20, 40, 60))


def test_a_derivation_says_each_step_and_a_pipe_sees_nothing(
    capsys: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.INFO, logger="lagrangian"):
        assert main(["derive", "-e", "lecture-1"]) == 0
    said = [record.getMessage() for record in caplog.records]
    assert all(any(f"step {n}, " in words for words in said) for n in (2, 3, 4, 5, 6))
    assert capsys.readouterr().err == ""


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("line", "words"),
    [
        (["check", "-e", "lecture-1", "-"], "checking the answer"),
        (["equilibria", "-e", "pendulum"], "equilibria: searching"),
        (["compare", "-e", "lecture-3a", "-e", "lecture-3b"], "comparing: "),
        (["conserved", "-e", "pendulum"], "conserved: "),
        (["linearize", "-e", "pendulum"], "linearizing: "),
        (["verify", "-e", "pendulum", "--states", "3"], "verifying: "),
        (["export", "-e", "pendulum", "--to", "c", "-o", "OUT"], "writing c"),
        (["simulate", "-e", "pendulum", "-d", "1"], "simulating from"),
    ],
)
def test_every_verb_says_what_it_does(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, tmp_path: Path, line: list[str], words: str
) -> None:
    class Stdin:
        buffer = io.BytesIO(b"x'' = 0")

    monkeypatch.setattr(sys, "stdin", Stdin())
    with caplog.at_level(logging.INFO, logger="lagrangian"):
        main([str(tmp_path) if word == "OUT" else word for word in line])
    assert any(record.getMessage().startswith(words) for record in caplog.records)


def test_the_line_appears_and_goes_before_anything_else_is_written(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(import_module("lagrangian.cli.progress"), "AFTER", 0.0)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with status.showing("working"):
        while "working" not in capsys.readouterr().err:
            logging.getLogger("lagrangian").info("working on")
        status.hide()
        assert capsys.readouterr().err.endswith("\r\x1b[K")
    assert logging.getLogger("lagrangian").handlers == []
