"""The code of docs/python.md and the example scripts run."""

import os
import re
import subprocess
import sys

from conftest import ROOT


def test_the_page_runs(tmp_path, monkeypatch):
    text = (ROOT / "docs" / "python.md").read_text()
    blocks = re.findall(r"^```python\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    assert len(blocks) >= 5
    monkeypatch.chdir(tmp_path)
    scope: dict[str, object] = {}
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), scope)


def test_figure_2_is_drawn(tmp_path):
    picture = tmp_path / "fig2.png"
    subprocess.run([sys.executable, "examples/fig2.py", picture], cwd=ROOT, check=True, env=os.environ)
    assert picture.read_bytes().startswith(b"\x89PNG")
