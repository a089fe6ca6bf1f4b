"""The project file: what is saved is what is read, and nothing that is read can crash the program."""

import dataclasses
import json
import zipfile

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from PIL import Image

from headstudio.head.head import HeadError
from headstudio.head.scalp_settings import GrayImage, ScalpSettings
from headstudio.params import assign, walk
from headstudio.scene import project
from headstudio.scene.attachments import ATTACHMENTS
from headstudio.scene.document import Document
from headstudio.scene.project import ProjectError, load_project, save_project

same_folder = settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


def values_of(parameter):
    match parameter.kind:
        case "number":
            return st.floats(parameter.low, parameter.high)
        case "integer":
            return st.integers(parameter.low, parameter.high)
        case "switch":
            return st.booleans()
        case "choice":
            return st.sampled_from(parameter.options)
        case "colour":
            return st.tuples(*[st.floats(0, 1)] * 3)
        case "text":
            return st.text()


coordinates = st.floats(-1, 1)
curve = st.lists(st.tuples(coordinates, coordinates, coordinates), min_size=2, max_size=6).map(tuple)
curves = st.one_of(st.just(()), st.lists(curve, min_size=4, max_size=4).map(tuple))
images = st.one_of(
    st.none(),
    arrays.arrays(np.float32, arrays.array_shapes(min_dims=2, max_dims=2), elements=st.floats(0, 1, width=32)).map(
        GrayImage
    ),
)


@st.composite
def documents(draw):
    """Any document that the declarations allow."""
    document = Document()
    declared = {name: parameter for name, parameter, _ in walk(document)}
    chosen = draw(st.lists(st.sampled_from(sorted(declared)), unique=True))
    document = assign(document, {name: draw(values_of(declared[name])) for name in chosen})
    scalp = dataclasses.replace(document.scalp, curves=draw(curves), painted_lengths=draw(images))
    return dataclasses.replace(document, scalp=scalp)


def rewrite(path, **changes):
    """Change members of the zip; None takes one out."""
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    members |= changes
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in members.items():
            if content is not None:
                archive.writestr(name, content)


def edit_manifest(path, edit):
    with zipfile.ZipFile(path) as archive:
        manifest = json.loads(archive.read("project.json"))
    edit(manifest)
    rewrite(path, **{"project.json": json.dumps(manifest)})


@pytest.fixture
def saved(tmp_path):
    path = tmp_path / "hair.headstudio"
    save_project(assign(Document(), {"hair.length": 0.42}), path)
    return path


@same_folder
@given(documents())
def test_saving_and_loading_is_the_identity(tmp_path, document):
    path = tmp_path / "any.headstudio"
    save_project(document, path)
    assert load_project(path) == project.Project(document)


def test_everything_that_is_no_parameter_has_a_file_in_the_project():
    document = Document()
    parameters = {name for name, _, _ in walk(document)}
    fields = {
        f"{part.name}.{field.name}"
        for part in dataclasses.fields(document)
        for field in dataclasses.fields(getattr(document, part.name))
    }
    assert fields - parameters == {attachment.path for attachment in ATTACHMENTS}


def test_the_same_document_gives_the_same_bytes(tmp_path):
    for name in ("a", "b"):
        save_project(Document(), tmp_path / name)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_the_manifest_is_readable_json(saved):
    with zipfile.ZipFile(saved) as archive:
        assert archive.namelist() == ["project.json"]
        manifest = json.loads(archive.read("project.json"))
    assert manifest["program"] == "headstudio"
    assert manifest["schema"] == project.SCHEMA
    assert manifest["parameters"]["hair"]["length"] == 0.42


def test_a_painted_map_is_a_picture_others_can_open_and_edit(tmp_path):
    ramp = GrayImage(np.linspace(0, 1, 12).reshape(3, 4))
    path = tmp_path / "painted.headstudio"
    save_project(dataclasses.replace(Document(), scalp=ScalpSettings(painted_lengths=ramp)), path)
    with zipfile.ZipFile(path) as archive, archive.open("scalp/lengths.png") as file, Image.open(file) as picture:
        assert picture.size == (4, 3)
    edited = tmp_path / "edited.png"
    Image.new("RGB", (5, 2), "white").save(edited)
    rewrite(path, **{"scalp/lengths.png": edited.read_bytes()})
    np.testing.assert_array_equal(load_project(path).document.scalp.painted_lengths.pixels, np.ones((2, 5)))


def test_saving_over_a_project_replaces_it_and_leaves_nothing_else(saved):
    save_project(Document(), saved)
    assert load_project(saved).document == Document()
    assert list(saved.parent.iterdir()) == [saved]


def test_a_failing_save_keeps_the_old_project(saved, monkeypatch):
    def disk_is_full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("headstudio.scene.files.os.fsync", disk_is_full)
    with pytest.raises(OSError, match="No space left"):
        save_project(Document(), saved)
    assert load_project(saved).document.hair.length == 0.42
    assert list(saved.parent.iterdir()) == [saved]


def test_what_is_not_known_is_reported_and_left_out(saved):
    def from_the_future(manifest):
        manifest["parameters"]["hair"]["glitter"] = 3
        manifest["parameters"]["tattoo"] = {"radius": 0.01}

    edit_manifest(saved, from_the_future)
    rewrite(saved, **{"tattoo/pictures.json": b"[]"})
    read = load_project(saved)
    assert read.document.hair.length == 0.42
    assert [warning.split(" is not known")[0] for warning in read.warnings] == [
        "parameter hair.glitter",
        "parameter tattoo.radius",
        "tattoo/pictures.json",
    ]


def test_what_is_missing_keeps_its_default(saved):
    edit_manifest(saved, lambda manifest: manifest["parameters"].pop("look"))
    assert load_project(saved).document == assign(Document(), {"hair.length": 0.42})


@pytest.mark.parametrize(
    ("edit", "complaint"),
    [
        (lambda m: m.update(schema=99), "newer headstudio"),
        (lambda m: m.update(schema="one"), "schema"),
        (lambda m: m.update(program="blender"), "no headstudio project"),
        (lambda m: m.pop("parameters"), "no parameters"),
        (lambda m: m["parameters"].update(hair=[]), "no group of parameters"),
        (lambda m: m["parameters"]["hair"].update(length=1e9), "hair.length goes from 0.02 to 1 m"),
        (lambda m: m["parameters"]["hair"].update(length=10**400), "hair.length takes a number"),
        (lambda m: m["parameters"]["hair"].update(length=None), "hair.length takes a number"),
        (lambda m: m["parameters"]["scalp"].update(length_map="mullet"), "scalp.length_map is one of"),
        (lambda m: m["parameters"]["look"].update(hair_colour=[2, 0, 0]), "look.hair_colour"),
    ],
)
def test_a_damaged_manifest_gives_one_clear_line(saved, edit, complaint):
    edit_manifest(saved, edit)
    with pytest.raises(ProjectError, match=complaint) as caught:
        load_project(saved)
    assert str(saved) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("member", "content", "complaint"),
    [
        ("project.json", b"{", "project.json is damaged"),
        ("project.json", b"[1]", "no headstudio project"),
        ("project.json", None, "no headstudio project"),
        ("scalp/lengths.png", b"not a picture", "scalp/lengths.png is no PNG"),
        ("scalp/curves.json", b"[[[1,2]]]", "scalp/curves.json is no list of curves"),
        ("scalp/curves.json", b"[[[1,2,3],[1,2,3]]]", "does not hold four curves"),
        ("scalp/curves.json", json.dumps([[[float("nan")] * 3] * 2] * 4).encode(), "not finite"),
    ],
)
def test_a_damaged_member_gives_one_clear_line(saved, member, content, complaint):
    rewrite(saved, **{member: content})
    with pytest.raises(ProjectError, match=complaint):
        load_project(saved)


@pytest.mark.parametrize("content", [b"", b"PK", b"solid cube\nendsolid", bytes(5000)])
def test_a_foreign_file_is_no_project(tmp_path, content):
    path = tmp_path / "foreign.headstudio"
    path.write_bytes(content)
    with pytest.raises(ProjectError, match="no headstudio project"):
        load_project(path)


@same_folder
@given(st.data())
def test_no_damage_to_the_bytes_crashes_the_reader(saved, data):
    content = bytearray(saved.read_bytes())
    for place in data.draw(st.lists(st.integers(0, len(content) - 1), min_size=1, max_size=4)):
        content[place] ^= data.draw(st.integers(1, 255))
    damaged = saved.with_name("damaged.headstudio")
    damaged.write_bytes(content[: data.draw(st.integers(0, len(content)))])
    # Damage that misses everything of weight (a time stamp) still gives the document.
    try:
        document = load_project(damaged).document
    except ProjectError:
        document = load_project(saved).document
    assert document.hair.length == 0.42


def test_a_missing_file_is_an_io_error(tmp_path):
    with pytest.raises(FileNotFoundError):
        load_project(tmp_path / "nothing.headstudio")


def test_an_older_schema_is_migrated_step_by_step(saved, monkeypatch):
    def rename(manifest):
        hair = manifest["parameters"]["hair"]
        hair["length"] = hair.pop("longest")
        return manifest

    edit_manifest(saved, lambda m: m["parameters"]["hair"].update(longest=m["parameters"]["hair"].pop("length")))
    edit_manifest(saved, lambda m: m.update(schema=1))
    monkeypatch.setattr(project, "SCHEMA", 3)
    monkeypatch.setattr(project, "MIGRATORS", {1: rename, 2: lambda manifest: manifest})
    assert load_project(saved) == project.Project(assign(Document(), {"hair.length": 0.42}))


def test_a_temperature_by_point_becomes_one_by_coordinate(saved):
    edit_manifest(saved, lambda m: (m.update(schema=1), m["parameters"]["wisp"].update(temperature=0.12)))
    assert load_project(saved).document.wisp.temperature == pytest.approx(0.12 / np.sqrt(3))


def test_there_is_a_migrator_for_every_step():
    assert sorted(project.MIGRATORS) == list(range(1, project.SCHEMA))


@pytest.mark.parametrize("part", ["source", "eyes"])
def test_a_head_that_moved_with_its_project_is_found(tmp_path, part):
    path = tmp_path / "moved.headstudio"
    save_project(assign(Document(), {f"head.{part}": "/home/someone/heads/old.obj"}), path)
    assert getattr(load_project(path).document.head, part) == "/home/someone/heads/old.obj"
    (tmp_path / "old.obj").write_text("v 0 0 0")
    read = load_project(path)
    assert getattr(read.document.head, part) == str(tmp_path / "old.obj")
    assert "lies beside the project" in read.warnings[0]


def test_without_makehuman_a_new_project_has_the_mannequin_and_says_so(monkeypatch):
    def missing():
        raise HeadError("not installed")

    monkeypatch.setattr(project, "data_folder", missing)
    fresh = project.new_project()
    assert fresh.document.head.source == "mannequin"
    assert "mannequin" in fresh.warnings[0]


def test_with_makehuman_a_new_project_is_the_default_document(monkeypatch, tmp_path):
    monkeypatch.setattr(project, "data_folder", lambda: tmp_path)
    assert project.new_project() == project.Project(Document())
