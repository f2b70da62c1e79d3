"""Object code on disk: found again, never trusted blindly, never in the way."""

import dataclasses
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from compile_programs import double_pendulum, program

from lagrangian.codegen import cache, compile, native
from lagrangian.codegen.build import Options, fingerprint

Q, V = np.array([0.3, -0.4]), np.array([1.0, 2.0])
OPTIONAL = {"u": 0.0, "t": 0.0}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    place = tmp_path / "cache"
    monkeypatch.setenv("LAGRANGIAN_CACHE_DIR", str(place))
    return place


@pytest.fixture
def compilations(monkeypatch):
    """Counts how often LLVM is asked for object code."""
    made = []
    original = native.object_code
    monkeypatch.setattr(native, "object_code", lambda *a: made.append(1) or original(*a))
    return made


def fresh():
    return compile(double_pendulum(), optional=OPTIONAL)


@pytest.mark.slow
def test_the_second_kernel_comes_from_disk(folder, compilations):
    first = fresh()(Q, V)
    assert len(compilations) == 1
    kernel = fresh()
    np.testing.assert_array_equal(kernel(Q, V), first)
    assert len(compilations) == 1
    assert kernel.build._lowered is None  # nothing was lowered or printed either
    batch = fresh()(np.tile(Q, (9, 1)), V)
    sweep = fresh()(Q, V, p={"g": np.full(9, 9.81)})
    assert len(compilations) == 3
    np.testing.assert_array_equal(fresh()(np.tile(Q, (9, 1)), V), batch)
    np.testing.assert_array_equal(fresh()(Q, V, p={"g": np.full(9, 9.81)}), sweep)
    assert len(compilations) == 3
    assert all(file.suffix == ".o" for file in folder.iterdir())


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "damage",
    [
        lambda b: b[:100],
        lambda b: b"",
        lambda b: b[:-1] + bytes([b[-1] ^ 1]),
        lambda b: b[:200] + b"\x00" * 50 + b[250:],
        lambda b: b"something else entirely",
        lambda b: b + b"more",
    ],
)
def test_a_damaged_file_is_made_again(folder, compilations, damage):
    want = fresh()(Q, V)
    (file,) = folder.iterdir()
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    np.testing.assert_array_equal(fresh()(Q, V), want)
    assert len(compilations) == 2
    assert file.read_bytes() == whole
    fresh()(Q, V)
    assert len(compilations) == 2


def test_an_empty_name_turns_keeping_off(monkeypatch, tmp_path, compilations):
    monkeypatch.setenv("LAGRANGIAN_CACHE_DIR", "")
    monkeypatch.chdir(tmp_path)
    assert cache.directory() is None
    fresh()(Q, V)
    fresh()(Q, V)
    assert len(compilations) == 2
    assert not list(tmp_path.iterdir())


def test_the_default_place_is_the_users_cache(monkeypatch):
    monkeypatch.delenv("LAGRANGIAN_CACHE_DIR", raising=False)
    place = cache.directory()
    assert place is not None
    assert "lagrangian" in place.parts


@pytest.mark.parametrize("kind", ["a file", "below a file", "forbidden", "missing parent"])
def test_a_directory_that_cannot_be_written(tmp_path, monkeypatch, kind):
    place = tmp_path / "place"
    if kind == "a file":
        place.write_text("occupied")
    elif kind == "below a file":
        place.write_text("occupied")
        place = place / "below"
    elif kind == "forbidden":
        place = Path("/proc/lagrangian") if Path("/proc").is_dir() else tmp_path / "\0"
    else:
        place = tmp_path / "a" / "b" / "c"
    monkeypatch.setenv("LAGRANGIAN_CACHE_DIR", str(place))
    np.testing.assert_allclose(fresh()(Q, V), fresh()(Q, V))
    assert cache.write("0" * 64, b"code") is (kind == "missing parent")


@pytest.mark.skipif(os.name != "posix", reason="needs permissions")
def test_a_directory_others_can_write_is_not_used(folder, compilations):
    folder.mkdir()
    folder.chmod(0o777)
    fresh()(Q, V)
    assert not list(folder.iterdir())
    folder.chmod(0o700)
    fresh()(Q, V)
    assert len(list(folder.iterdir())) == 1
    folder.chmod(0o722)
    fresh()(Q, V)
    assert len(compilations) == 3


@pytest.mark.slow
def test_two_processes_at_once(folder):
    """Several interpreters start together on an empty directory; all answer, and what they leave is whole."""
    code = (
        "import numpy as np, sys\n"
        f"sys.path.insert(0, {str(Path(__file__).parent)!r})\n"
        "from compile_programs import double_pendulum\n"
        "from lagrangian.codegen import compile\n"
        "k = compile(double_pendulum(), optional={'u': 0.0, 't': 0.0})\n"
        "print(k(np.array([0.3, -0.4]), np.array([1.0, 2.0])).tolist())\n"
    )
    running = [subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) for _ in range(2)]
    answers = {process.communicate()[0] for process in running}
    assert all(process.returncode == 0 for process in running)
    assert len(answers) == 1
    (file,) = folder.iterdir()
    assert cache.read(file.stem) is not None


def test_what_is_kept_is_seldom_counted(folder, monkeypatch):
    looks = []
    trim = cache._trim
    monkeypatch.setattr(cache, "_trim", lambda place: looks.append(place) or trim(place))
    for k in range(20):
        assert cache.write(f"{k:064}", bytes(1000))
    assert looks == [folder]


def test_old_files_make_room(folder, monkeypatch):
    monkeypatch.setattr(cache, "LIMIT", 5000)
    for k in range(10):
        assert cache.write(f"{k:064}", bytes(1000))
        os.utime(folder / f"{k:064}.o", (k, k))
    left = sorted(int(file.stem) for file in folder.iterdir())
    assert left == [6, 7, 8, 9]


def key(made, **changes):
    target = dataclasses.replace(native.host(), **{k: v for k, v in changes.items() if k in ("cpu", "fma")})
    options = Options(**{"lanes": 8, **{k: v for k, v in changes.items() if k in ("lanes", "hoist", "level")}})
    return fingerprint(made, options, target)


def test_what_decides_the_key():
    def formula(c, n=3, names=("a", "b")):
        return program(lambda g, x: {"f": [(x[names[0]] * c + x[names[1]]) ** n]}, q=names)

    base = key(formula(2.5))
    assert base == key(formula(2.5, names=("x", "y")))  # names do not
    unused = formula(2.5)
    unused.graph.sin(unused.ids[0])
    assert base == key(unused)  # nor what no output needs
    others = [
        key(formula(2.5000000000000004)),
        key(formula(2.5, n=4)),
        key(formula(2.5), lanes=4),
        key(formula(2.5), hoist=("q",)),
        key(formula(2.5), level=1),
        key(formula(2.5), cpu="other"),
        key(formula(2.5), fma=False),
        key(program(lambda g, x: {"f": (x["a"] * 2.5 + x["b"]) ** 3, "g": x["a"]}, q=("a", "b"))),
        key(program(lambda g, x: {"f": [(x["a"] * 2.5 + x["b"]) ** 3]}, q=("a", "b", "c"))),
    ]
    assert len({base, *others}) == len(others) + 1


def test_a_relative_folder_counts_from_the_working_directory(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LAGRANGIAN_CACHE_DIR", "kept/code")
    assert cache.directory() == tmp_path / "kept" / "code"
    assert cache.write("key", b"code") and cache.read("key") == b"code"
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("LAGRANGIAN_CACHE_DIR", "~/kept/code")
    assert cache.read("key") == b"code"
