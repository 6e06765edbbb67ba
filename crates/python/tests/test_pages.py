"""The code and the commands of the pages about Python run, and so do the example scripts."""

import os
import re
import subprocess
import sys
from pathlib import Path

from conftest import ROOT


def blocks(page: str, language: str) -> list[str]:
    text = (ROOT / "docs" / page).read_text()
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)


def test_the_page_runs(tmp_path, monkeypatch):
    found = blocks("python.md", "python")
    assert len(found) >= 5
    monkeypatch.chdir(tmp_path)
    scope: dict[str, object] = {}
    for block in found:
        exec(compile(block, "docs/python.md", "exec"), scope)


def test_the_page_of_clusters_runs(tmp_path, monkeypatch):
    """The local cluster, the Python code and the job script; a second machine is not to be had."""
    (recipe,), (code,), (job,) = (blocks("cluster.md", language) for language in ("toml", "python", "bash"))
    (tmp_path / "wide.toml").write_text(recipe)
    # The command that the package has installed.
    monkeypatch.setenv("PATH", str(Path(sys.executable).parent), prepend=os.pathsep)
    monkeypatch.chdir(tmp_path)
    shell = [block for block in blocks("cluster.md", "sh") if block.startswith("spiral-atlas-cluster")]
    assert len(shell) == 3

    def run(script: str, **more: str) -> str:
        done = subprocess.run(["bash", "-e", "-c", script], env=os.environ | more, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    assert "16 shards: 16 written" in run(shell[0])
    assert Path("wide.png").read_bytes().startswith(b"\x89PNG")
    exec(compile(code, "docs/cluster.md", "exec"), {})
    run("rm -r wide.atlas.zarr")
    assert "shards 0 to 15" in run(shell[1])
    for number in "01":
        assert run(job, SLURM_ARRAY_TASK_ID=number).count("written") == 8
    assert "16 shards: 16 there and right" in run(shell[2])


def test_figure_2_is_drawn(tmp_path):
    picture = tmp_path / "fig2.png"
    subprocess.run([sys.executable, "examples/fig2.py", picture], cwd=ROOT, check=True, env=os.environ)
    assert picture.read_bytes().startswith(b"\x89PNG")
