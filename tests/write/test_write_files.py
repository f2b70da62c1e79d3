"""Files appear whole or not at all."""

from __future__ import annotations

import os

import pytest

from lagrangian.errors import Error
from lagrangian.write import write_file


def test_writes_and_replaces(tmp_path):
    path = tmp_path / "a.txt"
    assert write_file(path, "θ̈\n") == path
    assert path.read_bytes() == "θ̈\n".encode()
    path.chmod(0o640)
    write_file(path, "second")
    assert path.read_text() == "second"
    assert path.stat().st_mode & 0o777 == 0o640
    assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]


def test_a_link_keeps_pointing(tmp_path):
    real, link = tmp_path / "real.txt", tmp_path / "link.txt"
    real.write_text("old")
    link.symlink_to(real)
    write_file(link, "new")
    assert link.is_symlink()
    assert real.read_text() == "new"


def test_missing_folder_and_folder_as_file_are_named(tmp_path):
    with pytest.raises(Error, match="there is no folder"):
        write_file(tmp_path / "none" / "a.txt", "x")
    with pytest.raises(Error, match="is a folder"):
        write_file(tmp_path, "x")


def test_a_failure_on_the_way_keeps_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "a.txt"
    path.write_text("old")

    def full(fd: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(Error, match="no space left on device"):
        write_file(path, "new")
    assert path.read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]


def test_no_permission_is_said(tmp_path, monkeypatch):
    def denied(*args: object, **kwargs: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("tempfile.mkstemp", denied)
    with pytest.raises(Error, match="permission denied") as caught:
        write_file(tmp_path / "a.txt", "x")
    assert "choose a folder you may write to" in str(caught.value)
