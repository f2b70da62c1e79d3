"""The house's own rules: floors, types, style, public names, rooms, and the README's commands."""

import ast
import importlib.util
import pathlib
import re
import shutil
import subprocess
import sys
from functools import cache

import pytest
from hypothesis import HealthCheck, settings

import lagrangian

ROOT = pathlib.Path(__file__).parent.parent
SOURCE = ROOT / "src" / "lagrangian"
FILES = sorted(SOURCE.rglob("*.py"))


@cache
def nodes(file: pathlib.Path) -> list[ast.AST]:
    """Everything in a source file, parsed once."""
    return list(ast.walk(ast.parse(file.read_text(encoding="utf-8"))))


def run(*command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", *command], cwd=ROOT, capture_output=True, text=True)


@pytest.mark.slow
def test_floors_import_downward_only() -> None:
    done = subprocess.run(
        [sys.executable, "-c", "from importlinter.cli import lint_imports; raise SystemExit(lint_imports())"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.slow
def test_the_linter_finds_nothing() -> None:
    done = run("ruff", "check", ".")
    assert done.returncode == 0, done.stdout


def test_the_format_is_kept() -> None:
    done = run("ruff", "format", "--check", ".")
    assert done.returncode == 0, done.stdout


@pytest.mark.slow
def test_the_types_hold() -> None:
    done = run("pyright", "--pythonpath", sys.executable)
    assert done.returncode == 0, done.stdout[-4000:]


def test_all_is_the_sorted_public_names() -> None:
    assert lagrangian.__all__ == sorted(lagrangian.__all__)
    assert all(hasattr(lagrangian, name) for name in lagrangian.__all__)


def test_text_is_never_run() -> None:
    called = [
        (str(file.relative_to(SOURCE)), node.func.id if isinstance(node.func, ast.Name) else node.func.attr)
        for file in FILES
        for node in nodes(file)
        if isinstance(node, ast.Call) and isinstance(node.func, (ast.Name, ast.Attribute))
    ]
    assert len(called) > 1000
    assert not [(file, name) for file, name in called if name in {"eval", "exec", "parse_expr", "lambdify"}]


def test_scripts_import_names_that_exist() -> None:
    """No test runs all of ``bench/`` and ``tools/``: a name that was moved would be found by a user."""
    scripts = [file for folder in ("bench", "tools") for file in sorted((ROOT / folder).glob("*.py"))]
    asked = [
        (file.name, str(node.module), alias.name)
        for file in scripts
        for node in nodes(file)
        if isinstance(node, ast.ImportFrom) and str(node.module).split(".")[0] == "lagrangian"
        for alias in node.names
    ]
    assert len(asked) > 20
    assert not [x for x in asked if not hasattr(importlib.import_module(x[1]), x[2]) and not _is_module(x[1], x[2])]


def _is_module(package: str, name: str) -> bool:
    return importlib.util.find_spec(f"{package}.{name}") is not None


CLOCKS = {"perf_counter", "process_time", "thread_time", "monotonic", "timeit", "getrusage", "clock_gettime"}
CLOCKS |= {f"{name}_ns" for name in CLOCKS}
TESTS = sorted((ROOT / "tests").rglob("*.py"))


def _reads_a_clock(node: ast.AST) -> bool:
    """Whether a node asks what time it is, or gives another program only so many seconds."""
    if isinstance(node, ast.ImportFrom):
        asked = {alias.name for alias in node.names}
        return bool(asked & CLOCKS) or (node.module == "time" and "time" in asked)
    if isinstance(node, ast.Attribute):
        of_time = isinstance(node.value, ast.Name) and node.value.id == "time" and node.attr in ("time", "time_ns")
        return of_time or (isinstance(node.ctx, ast.Load) and node.attr in CLOCKS)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        of_process = isinstance(node.func.value, ast.Name) and node.func.value.id == "subprocess"
        return (of_process or node.func.attr == "communicate") and any(k.arg == "timeout" for k in node.keywords)
    return False


def test_no_test_measures_time() -> None:
    """A busy machine is slow, and a slow one is no fault: tests count calls and steps, ``bench/`` measures."""
    word = re.compile(rf"\b(?:{'|'.join(sorted(CLOCKS))})\b|\btime\.time|from time import|\btimeout\b")
    suspects = [file for file in TESTS if word.search(file.read_text(encoding="utf-8"))]
    assert suspects
    found = [(file.name, node.lineno) for file in suspects for node in nodes(file) if _reads_a_clock(node)]  # type: ignore[attr-defined]
    assert not found


def test_no_random_test_measures_time() -> None:
    """Beside other work Hypothesis would call its examples slow, and fail."""
    assert settings.default is not None
    assert settings.default.deadline is None
    assert HealthCheck.too_slow in settings.default.suppress_health_check


def test_every_file_of_tests_has_a_name_of_its_own() -> None:
    """pytest imports tests by the names of their files: of two with one name it collects neither."""
    names = [file.name for file in (ROOT / "tests").rglob("*.py") if file.name not in ("__init__.py", "conftest.py")]
    assert sorted(names) == sorted(set(names))


def test_no_room_without_a_purpose() -> None:
    names = {p.name for p in SOURCE.rglob("*") if p.is_dir()} | {p.stem for p in FILES}
    assert not names & {"utils", "common", "helpers", "misc"}


def test_every_dependency_has_its_reason() -> None:
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    lines = [x for x in text.splitlines() if re.match(r'\s+"[\w-]+>=[\d.]+', x)]
    assert len(lines) > 8
    assert not [x for x in lines if "#" not in x]


def test_continuous_integration_runs_the_readmes_test_command() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    command = re.search(r"<!-- test command -->\n```\n(.+)\n```", readme)
    assert command is not None and "pytest" in command[1]
    script = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    extract = re.search(r"command=\$\((awk '.*' README\.md)\)", script)
    assert extract is not None and 'bash -euo pipefail -c "$command"' in script
    assert script.splitlines()[-1] == "scripts/test slow"
    if shutil.which("awk"):
        done = subprocess.run(["sh", "-c", extract[1]], cwd=ROOT, capture_output=True, text=True, check=True)
        assert done.stdout.strip() == command[1]


def test_a_class_name_occurs_once() -> None:
    """Whoever searches for a class finds one; private ones, of one file alone, may repeat."""
    found: dict[str, list[str]] = {}
    for file in FILES:
        for node in nodes(file):
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                found.setdefault(node.name, []).append(str(file.relative_to(SOURCE)))
    assert not {name: files for name, files in found.items() if len(files) > 1}


MAX_FILE, MAX_FUNCTION = 400, 60


def test_files_and_functions_are_short() -> None:
    """What outgrows a page or two has parts with names of their own; parameters and docstrings count."""
    assert not [file for file in FILES if len(file.read_text(encoding="utf-8").splitlines()) > MAX_FILE]
    functions = [
        (str(file.relative_to(SOURCE)), node.name, (node.end_lineno or 0) - node.lineno + 1)
        for file in FILES
        for node in nodes(file)
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))
    ]
    assert not [found for found in functions if found[2] > MAX_FUNCTION]


def functions_of_a_script(text: str) -> list[tuple[int, int]]:
    """Line and length of every function in JavaScript: from where it opens to the brace at the same indentation."""
    lines = text.splitlines()
    found = []
    for k, line in enumerate(lines):
        if re.search(r"(\bfunction\b.*|=>|^ +(async |static |get )?#?\w+\(.*\)) \(?\{$", line):
            closing = " " * (len(line) - len(line.lstrip())) + "}"
            end = next((n for n in range(k + 1, len(lines)) if lines[n].startswith(closing)), len(lines))
            found.append((k + 1, end - k + 1))
    return found


def test_scripts_and_their_functions_are_short() -> None:
    """What holds for Python holds for the scripts of pages: one question, one function or class."""
    scripts = {str(file.relative_to(SOURCE)): file.read_text(encoding="utf-8") for file in SOURCE.rglob("*.js")}
    functions = {name: functions_of_a_script(text) for name, text in scripts.items()}
    assert sum(map(len, functions.values())) > 200
    assert not [name for name, text in scripts.items() if len(text.splitlines()) > MAX_FILE]
    assert not [(name, line) for name, found in functions.items() for line, length in found if length > MAX_FUNCTION]


def test_no_module_is_named_like_one_of_the_standard_library() -> None:
    names = {p.stem for p in FILES} | {p.name for p in SOURCE.rglob("*") if p.is_dir()}
    assert not (names & sys.stdlib_module_names) - {"__init__", "__main__", "__pycache__"}


def test_the_names_of_the_package_are_those_of_all() -> None:
    """Rooms are no names of the package, whatever was imported: ``lg.derive`` is not a module that cannot be called."""
    code = "import lagrangian as lg, lagrangian.cli.app, lagrangian.derive.pages, lagrangian.simulate.sweeping\n"
    code += "[getattr(lg, name) for name in lg.__all__]\n"
    code += "print(sorted(set(vars(lg)) ^ set(lg.__all__)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    left = ast.literal_eval(done.stdout or "['nothing']")
    assert not [name for name in left if not name.startswith("_")], done.stdout + done.stderr
