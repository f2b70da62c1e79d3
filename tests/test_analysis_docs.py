"""What docs/analysis.md says runs as it stands there."""

import pathlib
import re

import pytest

ROOT = pathlib.Path(__file__).parents[1]


@pytest.mark.slow
def test_the_manuals_python_runs() -> None:
    text = (ROOT / "docs" / "analysis.md").read_text(encoding="utf-8")
    code = "\n".join(re.findall(r"^```python\n(.*?)^```", text, flags=re.M | re.S))
    names: dict[str, object] = {}
    exec(compile(code, "docs/analysis.md", "exec"), names)
    assert names["along"].A.shape == (11, 4, 4)  # type: ignore[attr-defined]
    assert names["regulator"].K.shape == (1, 4)  # type: ignore[attr-defined]
    assert names["hover"].A.shape == (12, 12)  # type: ignore[attr-defined]
    assert abs(names["run"]["hull_x"][-1]) < 0.01  # type: ignore[index]
    assert names["anywhere"][0].moves == ("hull_qz", "hull_qw")  # type: ignore[index]
