"""The worked notebooks run from top to bottom, and are kept without outputs."""

import json
import pathlib
import re

import pytest

FOLDER = pathlib.Path(__file__).parent.parent / "docs" / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def test_notebooks_are_kept_without_outputs_and_the_manual_links_them() -> None:
    assert len(NOTEBOOKS) >= 10
    index = (FOLDER.parent / "index.md").read_text(encoding="utf-8")
    for path in NOTEBOOKS:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        assert all(not c["outputs"] and c["execution_count"] is None for c in cells if c["cell_type"] == "code")
        assert f"notebooks/{path.name}" in index


@pytest.mark.slow
@pytest.mark.filterwarnings("default")  # of the kernel's own making
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_a_notebook_runs_from_top_to_bottom(
    path: pathlib.Path, tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("MPLBACKEND", raising=False)  # plots are shown as the kernel shows them
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(notebook, timeout=None, resources={"metadata": {"path": str(tmp_path)}}).execute()
    shown = [c for c in notebook.cells if c.cell_type == "code" and any("data" in o for o in c.outputs)]
    assert len(shown) >= 2
    for cell in notebook.cells:
        if cell.cell_type == "code" and re.search(r"\.plot\(.*\);$", cell.source):
            assert any("image/png" in o.get("data", ()) for o in cell.outputs), cell.source
    viewed = [o for c in shown for o in c.outputs if "data" in o and {"text/html", "image/png"} & set(o.data)]
    assert len(viewed) >= 2
