"""The programs of docs/guides/python.md, one after the other, print what stands there; the gallery draws its pictures."""

import contextlib
import io
import re
import runpy
import sys
from pathlib import Path

from test_files import FITTED

ROOT = Path(__file__).parents[2]


def test_the_documents_programs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "kevlar-identified.toml").write_text(FITTED, encoding="utf-8")
    text = (ROOT / "docs/guides/python.md").read_text(encoding="utf-8")
    programs = re.findall(r"```python\n(.*?)```\n(?:\n```text\n(.*?)```)?", text, flags=re.DOTALL)
    assert len(programs) >= 7
    names: dict = {}
    for program, expected in programs:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(program, names)
        assert printed.getvalue() == expected
        if "savefig" in program:
            drawn = dict(names)
    # What the figure shows: nothing is carried after the failure.
    stress, failed = drawn["stress"], drawn["failure"][:, 1] == 1
    assert 0 < failed.argmax() < 390 and not stress[failed.argmax() + 1 :].any() and 2700 < stress.max() < 2800
    assert (tmp_path / "yarn.png").stat().st_size > 10_000


def test_the_gallery(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["gallery.py", str(tmp_path)])
    runpy.run_path(str(ROOT / "examples/python/gallery.py"), run_name="__main__")
    for name in ("modes", "failure-surface"):
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000
