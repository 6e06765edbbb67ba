"""What the tests share: the recipe of the project's quickstart, and an atlas made of it."""

from pathlib import Path

import pytest
import spiral_atlas

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def recipe() -> Path:
    return ROOT / "atlases" / "quickstart.toml"


@pytest.fixture(scope="session")
def atlas_path(recipe, tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("atlases")
    (atlas,) = spiral_atlas.generate(recipe, folder)
    return Path(atlas.path)


@pytest.fixture
def atlas(atlas_path) -> spiral_atlas.Atlas:
    return spiral_atlas.open(atlas_path)
