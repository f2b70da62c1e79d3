"""The project around the code: workflows, scripts, papers and decisions say the same as ``pyproject.toml``."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib
from typing import Any

import pytest
import yaml

ROOT = pathlib.Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
FORMS = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"))
SCRIPTS = sorted((ROOT / "scripts").iterdir())
DECISIONS = sorted((ROOT / "docs" / "decisions").glob("0*.md"))


def read(path: pathlib.Path) -> Any:
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def jobs(path: pathlib.Path) -> dict[str, dict[str, Any]]:
    return read(path)["jobs"]


def steps(path: pathlib.Path) -> list[dict[str, Any]]:
    return [step for job in jobs(path).values() for step in job.get("steps", ())]


def test_every_supported_python_is_tested_on_every_system() -> None:
    prefix = "Programming Language :: Python :: 3."
    named = [
        c.removeprefix("Programming Language :: Python :: ") for c in PROJECT["classifiers"] if c.startswith(prefix)
    ]
    assert PROJECT["requires-python"] == f">={named[0]}"
    matrix = jobs(ROOT / ".github" / "workflows" / "test.yml")["test"]["strategy"]["matrix"]
    assert matrix["python"] == named
    assert {system.partition("-")[0] for system in matrix["os"]} == {"ubuntu", "macos", "windows"}


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda p: p.name)
def test_a_workflow_may_read_alone_and_pins_what_it_uses(path: pathlib.Path) -> None:
    workflow = read(path)
    assert workflow["permissions"] == {"contents": "read"}
    assert workflow["concurrency"]["group"].partition("-")[0] == workflow["name"] == path.stem
    used = [step["uses"] for step in steps(path) if "uses" in step]
    assert used
    assert not [action for action in used if not re.search(r"@(release/)?v\d+$", action)]


def test_publishing_holds_no_secret_and_waits_for_tests_and_contents() -> None:
    path = ROOT / ".github" / "workflows" / "release.yml"
    publish = jobs(path)["publish"]
    assert publish["permissions"] == {"id-token": "write"}
    assert publish["environment"] == {"name": "release"}
    assert set(publish["needs"]) == {"test", "build"}
    assert "secrets" not in path.read_text(encoding="utf-8")


def test_workflows_run_the_scripts_and_the_readmes_set_up() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    extras, arguments = re.search(r"(-e '\S+') && \.venv/bin/python -m pytest (.+)", readme).groups()  # type: ignore[union-attr]
    script = (ROOT / "scripts" / "test").read_text(encoding="utf-8")
    assert f'"") set -- {arguments} ;;' in script
    assert "set -- -n auto --dist worksteal -m slow" in script
    run = [step["run"] for path in WORKFLOWS for step in steps(path) if "run" in step]
    assert any(extras in command for command in run)
    assert {f"scripts/{path.name}" for path in SCRIPTS} <= set(run)


@pytest.mark.parametrize("path", FORMS, ids=lambda p: p.name)
def test_an_issue_form_can_be_read(path: pathlib.Path) -> None:
    form = read(path)
    if path.name != "config.yml":
        assert form["name"] and form["description"]
        asked = [part for part in form["body"] if part["type"] != "markdown"]
        assert len({part["id"] for part in asked}) == len(asked)
        assert all(part["attributes"]["label"] for part in asked)


def test_wrong_equations_come_with_the_model_and_what_verify_says() -> None:
    body = read(ROOT / ".github" / "ISSUE_TEMPLATE" / "wrong-equations.yml")["body"]
    needed = {part["id"] for part in body if part.get("validations", {}).get("required")}
    assert {"model", "verify"} <= needed


def test_hooks_ask_for_the_versions_of_the_project() -> None:
    extras = {line for lines in PROJECT["optional-dependencies"].values() for line in lines}
    hooks = read(ROOT / ".pre-commit-config.yaml")["repos"][0]["hooks"]
    wanted = {
        name for hook in hooks for name in hook["additional_dependencies"] if name.startswith(("ruff", "codespell"))
    }
    assert len(wanted) == 2
    assert wanted <= extras


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda p: p.name)
def test_a_script_can_be_run(path: pathlib.Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert text.startswith("#!/bin/sh\n# ") and "\nset -eu\n" in text
    assert sys.platform == "win32" or os.access(path, os.X_OK)
    if shell := shutil.which("sh"):
        subprocess.run([shell, "-n", str(path)], check=True)


def test_the_papers_name_the_version() -> None:
    citation = read(ROOT / "CITATION.cff")
    assert citation["version"] == PROJECT["version"]
    assert f"version = {{{PROJECT['version']}}}" in " ".join((ROOT / "docs" / "citing.md").read_text("utf-8").split())
    assert citation["license"] == PROJECT["license"]
    assert citation["keywords"] == PROJECT["keywords"]
    assert citation["abstract"] == PROJECT["description"]
    headings = re.findall(r"^## (.+)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), flags=re.M)
    assert headings[0] == "Unreleased"
    assert all(re.fullmatch(r"\d+\.\d+\.\d+ \(\d{4}-\d\d-\d\d\)", heading) for heading in headings[1:])


def test_decisions_are_counted_and_listed() -> None:
    index = (ROOT / "docs" / "decisions" / "README.md").read_text(encoding="utf-8")
    listed = re.findall(r"^\| (\d+) \| \[(.+)\]\((.+)\) \| (.+) \|$", index, flags=re.M)
    assert [int(number) for number, *_ in listed] == list(range(1, len(DECISIONS) + 1))
    for (number, title, name, status), path in zip(listed, DECISIONS, strict=True):
        text = path.read_text(encoding="utf-8")
        assert name == path.name and name.startswith(f"{int(number):04}-")
        assert text.startswith(f"# {number}. {title}\n\nStatus: {status}, ")
        assert re.findall(r"^## (.+)$", text, flags=re.M) == ["Context", "Decision", "Consequences"]
        assert re.search(r"\d", text.partition("## Context")[2])
