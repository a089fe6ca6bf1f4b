"""The list of projects opened last."""

import pytest

from headstudio.scene.recent import LONGEST, config_folder, recent_projects, remember_project


@pytest.fixture(autouse=True)
def own_config(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))


def project_file(folder, name):
    path = folder / f"{name}.headstudio"
    path.touch()
    return path


def test_it_begins_empty():
    assert recent_projects() == []


def test_the_newest_is_first_and_stands_once(tmp_path):
    a, b = project_file(tmp_path, "a"), project_file(tmp_path, "b")
    for path in (a, b, a):
        remember_project(path)
    assert recent_projects() == [a, b]


def test_what_is_gone_is_not_offered(tmp_path):
    a, b = project_file(tmp_path, "a"), project_file(tmp_path, "b")
    remember_project(a)
    remember_project(b)
    b.unlink()
    assert recent_projects() == [a]


def test_the_list_stays_short(tmp_path):
    paths = [project_file(tmp_path, str(number)) for number in range(LONGEST + 3)]
    for path in paths:
        remember_project(path)
    assert recent_projects() == paths[: -LONGEST - 1 : -1]


@pytest.mark.parametrize("content", ["{", "3", "[3, null]"])
def test_a_damaged_list_is_an_empty_one(content):
    config_folder().mkdir(parents=True)
    (config_folder() / "recent.json").write_text(content)
    assert recent_projects() == []
