"""The examples of pages of docs/ print what stands there, and those of README.md and docstrings run."""

import doctest
import re
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

import pytest
import stiction
import stiction.laws
import stiction.units

ROOT = Path(__file__).parents[3]
BLOCKS = re.compile(r"```python\n(.*?)```(?:\s*```text\n(.*?)```)?", re.DOTALL)


@pytest.mark.parametrize("page", ["accuracy.md", "python.md", "studies.md", "tutorial.md"])
def test_the_page_prints_what_it_says(
    page: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    blocks = BLOCKS.findall((ROOT / "docs" / page).read_text(encoding="utf-8"))
    assert len(blocks) >= 4
    for code, expected in blocks:
        said = StringIO()
        with redirect_stdout(said):
            exec(code, names)
        assert said.getvalue().rstrip() == expected.rstrip()


def test_the_readme_prints_and_plots(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    [(code, _)] = BLOCKS.findall((ROOT / "README.md").read_text(encoding="utf-8"))
    exec(code, {})
    assert "mean" in capsys.readouterr().out
    assert (tmp_path / "friction.svg").stat().st_size > 1000


@pytest.mark.parametrize("module", [stiction, stiction.laws, stiction.units])
def test_docstrings(module: object, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    found = doctest.testmod(module)  # type: ignore[arg-type]
    assert found.attempted > 0 and found.failed == 0
