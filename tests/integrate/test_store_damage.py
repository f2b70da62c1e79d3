"""Damaged stores: what is read is what was written, or a named error; resume makes it good or is refused."""

import json
import pathlib
import random
import shutil
import tracemalloc
from collections.abc import Callable, Iterator

import numpy as np
import pytest

import lagrangian as lg
from lagrangian.errors import Error
from lagrangian.integrate import store
from lagrangian.integrate.chunks import Portions
from lagrangian.integrate.status import RunStatus
from lagrangian.integrate.store import ChunkPlan, Variable
from lagrangian.integrate.stored import Stored

PORTIONS = Portions((2, 3), (1, 3))
RESULTS = {
    "x": Variable("float64", ("k", "run", "time"), (2, 3, 3), {"units": "m"}),
    "count e": Variable("int64", ("k", "run"), (2, 3)),
    "status": Variable("int8", ("k", "run"), (2, 3)),
}


def plan(rtol: float = 1e-9, k: float = 1.0) -> ChunkPlan:
    coordinates = {
        "k": (Variable("float64", ("k",), (2,)), [np.array([k]), np.array([2 * k])]),
        "g": (Variable("float64", (), ()), [np.array(9.81)]),
    }
    task = {"system": "test", "rtol": rtol, "options": {"atol": 1e-12}, "varied": {"k": k}, "method": "rk4"}
    return ChunkPlan(PORTIONS, RESULTS, coordinates, task, {"title": "test"})


def values(index: int, scale: float = 1.0) -> dict[str, np.ndarray]:
    """Of a chunk; all counts are 0, the value that stands where nothing was written."""
    runs = scale * np.arange(*PORTIONS.range(index), dtype=float)
    zeros = np.zeros(len(runs), np.int64)
    return {"x": np.sin(runs[:, None] + np.arange(3)), "count e": zeros, "status": zeros.astype(np.int8)}


def made(path: pathlib.Path, which: ChunkPlan, scale: float = 1.0, chunks: int = len(PORTIONS)) -> pathlib.Path:
    with store.create(path, which) as sink:
        for index in range(chunks):
            sink.write(index, PORTIONS.box(index), values(index, scale))
    return path


def contents(path: pathlib.Path, *, lost: bool = False) -> dict[str, np.ndarray]:
    stored = Stored(path, lost=lost)
    return {**{name: result[...] for name, result in stored.results.items()}, **stored.coordinates}


@pytest.fixture(scope="module")
def stores(tmp_path_factory: pytest.TempPathFactory) -> dict[str, pathlib.Path]:
    """A store, and two others: one whose task differs in a tolerance alone, and one along another axis."""
    folder = tmp_path_factory.mktemp("stores")
    return {
        "whole": made(folder / "a.zarr", plan()),
        "tolerance": made(folder / "b.zarr", plan(rtol=1e-6), 1.001),
        "axis": made(folder / "c.zarr", plan(k=3.0), 3.0),
    }


def deleted(file: pathlib.Path, _: pathlib.Path) -> Iterator[None]:
    file.unlink()
    yield


def cut_off(file: pathlib.Path, _: pathlib.Path) -> Iterator[None]:
    data = file.read_bytes()
    file.write_bytes(data[: random.Random(len(data)).randrange(len(data))])
    yield


def flipped(file: pathlib.Path, _: pathlib.Path) -> Iterator[None]:
    data, source = file.read_bytes(), random.Random(file.as_posix()[-20:])
    for _turn in range(10 if file.parent.name == "t.zarr" else 1):
        place = source.randrange(len(data))
        changed = bytes([data[place] ^ (1 << source.randrange(8))])
        file.write_bytes(data[:place] + changed + data[place + 1 :])
        yield


def another_stores(file: pathlib.Path, others: pathlib.Path) -> Iterator[None]:
    for name in ("b.zarr", "c.zarr"):
        other = others / name / file.relative_to(next(p for p in file.parents if p.suffix == ".zarr"))
        if other.read_bytes() != file.read_bytes():
            shutil.copyfile(other, file)
            yield


def another_chunks(file: pathlib.Path, _: pathlib.Path) -> Iterator[None]:
    data = file.read_bytes()
    siblings = [p for folder in file.parents if folder.name == "c" for p in sorted(folder.rglob("[0-9]"))]
    for sibling in [p for p in siblings if p.is_file() and p.read_bytes() != data][:1]:
        shutil.copyfile(sibling, file)
        yield


Damaging = Callable[[pathlib.Path, pathlib.Path], Iterator[None]]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("damage", [deleted, cut_off, flipped, another_stores, another_chunks])
@pytest.mark.slow
def test_every_file_damaged(stores: dict[str, pathlib.Path], tmp_path: pathlib.Path, damage: Damaging) -> None:
    right, told = contents(stores["whole"]), 0
    for original in sorted(p for p in stores["whole"].rglob("*") if p.is_file()):
        path = tmp_path / "t.zarr"
        shutil.copytree(stores["whole"], path)
        for _ in damage(path / original.relative_to(stores["whole"]), stores["whole"].parent):
            refused = is_right_or_refused(path, right)
            told += refused
            if refused:
                marked_as_lost(path, right)
            copy = shutil.copytree(path, tmp_path / "r.zarr")
            assert resumed_or_refused(copy, right) or not refused, original
            shutil.rmtree(copy)
        shutil.rmtree(path)
    assert told >= (2 if damage is another_chunks else 5)


def is_right_or_refused(path: pathlib.Path, right: dict[str, np.ndarray]) -> bool:
    """Whether reading was refused; where it was not, everything is as it was written."""
    try:
        there = contents(path)
    except Error as trouble:
        assert trouble.code in ("E803", "E804")
        assert trouble.fix
        return True
    for name, expected in right.items():
        np.testing.assert_array_equal(there[name], expected)
    return False


def marked_as_lost(path: pathlib.Path, right: dict[str, np.ndarray]) -> None:
    """Read in spite of damage, a run is right or marked."""
    try:
        there = contents(path, lost=True)
    except Error as trouble:
        assert trouble.code in ("E803", "E804")
        return
    good = there["status"] == 0
    assert set(there["status"][~good].tolist()) <= {RunStatus.LOST, RunStatus.NOT_RUN}
    for name in RESULTS:
        np.testing.assert_array_equal(there[name][good], right[name][good])
    assert np.isnan(there["x"][~good]).all()


def resumed_or_refused(path: pathlib.Path, right: dict[str, np.ndarray]) -> bool:
    """Go on with a store; whether that was refused or it was told that something is made good, which it then is."""
    try:
        with store.resume(path, plan()) as again:
            notices, todo = again.notices, np.flatnonzero(~again.done).tolist()
            for index in todo:
                again.write(index, PORTIONS.box(index), values(index))
    except Error as trouble:
        assert trouble.code in ("E803", "E804")
        return True
    assert bool(notices) >= bool(todo)
    assert not is_right_or_refused(path, right)
    if notices:
        with store.resume(path, plan()) as whole:
            assert whole.done.all()
            assert whole.notices == []
    return bool(notices)


def test_a_lost_chunk_alone_is_computed_again(stores: dict[str, pathlib.Path], tmp_path: pathlib.Path) -> None:
    path = shutil.copytree(stores["whole"], tmp_path / "t.zarr")
    (path / "x" / "c" / "1" / "0" / "0").unlink()
    with pytest.raises(lg.RunError, match=r"E804[\s\S]*1 damaged chunk \(3 runs\): 'x/c/1/0/0' is missing"):
        lg.Ensemble.of_store(path)
    others = lg.Ensemble.of_store(path, lost=True)
    assert others.counts == {"the end was reached": 3, "its results are damaged": 3}
    assert not others.success
    assert "1 damaged chunk" in repr(others)
    with store.resume(path, plan()) as again:
        assert again.done.tolist() == [True, False]
        assert again.notices == [f"'{path}' has 1 damaged chunk (3 runs): 'x/c/1/0/0' is missing: it is computed again"]


@pytest.mark.parametrize(
    ("at", "value", "named"),
    [
        (("lagrangian", "task", "rtol"), 1e-6, "lagrangian.task.rtol"),
        (("lagrangian", "task", "system"), 3, "lagrangian.task.system"),
        (("lagrangian", "task"), "none", "lagrangian.task."),
        (("lagrangian", "block"), [2, 3], "lagrangian.block"),
        (("lagrangian", "block"), None, "lagrangian.block"),
        (("lagrangian", "results"), ["x", "y"], "lagrangian.results"),
        (("lagrangian", "results"), 7, "lagrangian.results"),
        (("lagrangian", "coordinates"), [], "lagrangian.coordinates"),
        (("lagrangian", "seal"), {}, "lagrangian.seal"),
        (("lagrangian", "seal", "lagrangian.block"), "0", "lagrangian.block"),
        (("lagrangian", "format"), 77, "format 77, known is 2"),
        (("lagrangian",), "mine", "is not a store of a sweep"),
    ],
)
def test_an_edited_attribute_is_named(
    stores: dict[str, pathlib.Path], tmp_path: pathlib.Path, at: tuple[str, ...], value: object, named: str
) -> None:
    path = shutil.copytree(stores["whole"], tmp_path / "t.zarr")
    edit(path / "zarr.json", ("attributes", *at), value)
    for use in (Stored, lambda path: store.resume(path, plan())):
        with pytest.raises(Error) as caught:
            use(path)
        assert named in str(caught.value)
        assert caught.value.fix


def edit(file: pathlib.Path, at: tuple[str, ...], value: object) -> None:
    root = json.loads(file.read_text())
    target = root
    for key in at[:-1]:
        target = target[key]
    target[at[-1]] = value
    file.write_text(json.dumps(root))


def test_units_that_were_edited_are_named_and_notes_are_welcome(
    stores: dict[str, pathlib.Path], tmp_path: pathlib.Path
) -> None:
    path = shutil.copytree(stores["whole"], tmp_path / "t.zarr")
    edit(path / "zarr.json", ("attributes", "note"), "for chapter 3")
    edit(path / "x" / "zarr.json", ("attributes", "note"), "the greatest")
    Stored(path)
    with store.resume(path, plan()) as again:
        assert again.notices == []
    at = ("consolidated_metadata", "metadata", "x", "attributes", "units")
    edit(path / "zarr.json", at, "km")
    with pytest.raises(lg.RunError, match="'units of x' is not what was written"):
        Stored(path)


def test_a_chunk_written_in_part_is_not_done(
    stores: dict[str, pathlib.Path], tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = made(tmp_path / "a.zarr", plan(), chunks=1)
    with store.resume(path, plan()) as sink:
        monkeypatch.setattr(sink, "_mark", lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
        with pytest.raises(KeyboardInterrupt):
            sink.write(1, PORTIONS.box(1), values(1, 5.0))
    (path / "x" / "c" / "1" / "0" / "0").write_bytes(b"half")
    there = contents(path)
    assert (there["status"] == RunStatus.NOT_RUN).sum() == 3
    assert np.isnan(there["x"]).all(axis=2).sum() == 3
    with store.resume(path, plan()) as sink:
        assert np.flatnonzero(~sink.done).tolist() == [1]
        assert sink.notices == []
        sink.write(1, PORTIONS.box(1), values(1))
    for name, expected in contents(stores["whole"]).items():
        np.testing.assert_array_equal(contents(path)[name], expected)


@pytest.mark.parametrize(
    ("what", "words"),
    [
        ("group", "it is a Zarr group of another program (temperature)"),
        ("array", "it is a Zarr array of another program"),
        ("folder", "it is a folder without zarr.json (thesis.tex)"),
        ("file", "it is a file"),
        ("link", "it is a link"),
        ("guest", "'thesis.tex' in it was not written by a sweep"),
        ("broken", "its zarr.json cannot be read"),
    ],
)
def test_only_our_own_stores_are_removed(tmp_path: pathlib.Path, what: str, words: str) -> None:
    import zarr

    path = tmp_path / "a.zarr"
    if what == "group":
        zarr.create_group(path, attributes={"lagrangian": "a word"}).create_array("temperature", shape=(3,), dtype="f8")
    elif what == "array":
        zarr.create_array(path, shape=(3,), dtype="f8")
    elif what == "file":
        path.write_text("precious")
    elif what == "folder":
        path.mkdir()
        (path / "thesis.tex").write_text("precious")
    else:
        made(tmp_path / "b.zarr" if what == "link" else path, plan())
    if what == "link":
        path.symlink_to(tmp_path / "b.zarr")
    elif what == "guest":
        (path / "thesis.tex").write_text("precious")
    elif what == "broken":
        (path / "zarr.json").write_text("{")
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(Error) as caught:
        store.create(path, plan(), overwrite=True)
    assert words in str(caught.value)
    assert caught.value.fix
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("file", ["zarr.json", "x/c/0/0/0", "done/c/0"])
def test_a_folder_in_the_place_of_a_file_is_named(
    stores: dict[str, pathlib.Path], tmp_path: pathlib.Path, file: str
) -> None:
    path = shutil.copytree(stores["whole"], tmp_path / "a.zarr")
    (path / file).unlink()
    (path / file).mkdir()
    for use in (contents, lambda path: store.resume(path, plan())):
        with pytest.raises(Error, match=r"a\.zarr"):
            use(path)


def test_opening_a_store_takes_no_more_memory_than_its_list_of_chunks(stores: dict[str, pathlib.Path]) -> None:
    tracemalloc.start()
    try:
        store.resume(stores["whole"], plan()).close()
        assert tracemalloc.get_traced_memory()[1] < 2**26
    finally:
        tracemalloc.stop()


def test_a_store_that_cannot_be_replaced_stays(
    stores: dict[str, pathlib.Path], tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = shutil.copytree(stores["whole"], tmp_path / "a.zarr")
    rename = pathlib.Path.rename

    def refused(self: pathlib.Path, target: pathlib.Path) -> pathlib.Path:
        if self.name == "new":
            raise PermissionError(13, "Permission denied")
        return rename(self, target)

    monkeypatch.setattr(pathlib.Path, "rename", refused)
    with pytest.raises(Error, match=r"cannot make .*: permission denied"):
        store.create(path, plan(k=3.0), overwrite=True)
    assert [p.name for p in tmp_path.iterdir()] == ["a.zarr"]
    for name, expected in contents(stores["whole"]).items():
        np.testing.assert_array_equal(contents(path)[name], expected)
