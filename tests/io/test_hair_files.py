from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from headstudio.io.hair import READABLE, WRITABLE, HairFileError, read_strands, write_strands
from headstudio.wisp.strands import Strands

ANY_COUNTS = tuple(suffix for suffix in WRITABLE if suffix not in (".npy", ".tfx"))
WITH_RADIUS = (".hair", ".ply", ".usda", ".rib")


def hair(counts, seed=0) -> Strands:
    rng = np.random.default_rng(seed)
    first = np.concatenate([[0], np.cumsum(counts)])
    total = int(first[-1])
    return Strands(
        rng.normal(0, 0.1, (total, 3)).astype(np.float32),
        first,
        rng.uniform(2e-5, 5e-5, total).astype(np.float32),
        rng.random((total, 3)).astype(np.float32),
    )


def same(found: Strands, wanted: Strands) -> None:
    assert np.array_equal(found.first, wanted.first)
    assert np.array_equal(found.points, wanted.points)


@pytest.mark.parametrize("suffix", WRITABLE)
def test_equal_strands_come_back_to_the_last_bit(suffix, tmp_path):
    strands = hair([16] * 25)
    write_strands(strands, tmp_path / f"hair{suffix}")
    same(read_strands(tmp_path / f"hair{suffix}"), strands)


@pytest.mark.parametrize("suffix", ANY_COUNTS)
def test_unequal_strands_come_back_to_the_last_bit(suffix, tmp_path):
    strands = hair([2, 5, 3, 40, 2, 2])
    write_strands(strands, tmp_path / f"hair{suffix}")
    same(read_strands(tmp_path / f"hair{suffix}"), strands)


@pytest.mark.parametrize("suffix", WITH_RADIUS)
def test_radius_and_colour_come_back_to_the_last_bit(suffix, tmp_path):
    strands = hair([4, 6, 3])
    write_strands(strands, tmp_path / f"hair{suffix}")
    found = read_strands(tmp_path / f"hair{suffix}")
    assert np.array_equal(found.radius, strands.radius)
    assert np.array_equal(found.colour, strands.colour)


def test_tressfx_keeps_the_thickness_of_a_strand_and_its_colours(tmp_path):
    strands = hair([8] * 5)
    write_strands(strands, tmp_path / "hair.tfx")
    found = read_strands(tmp_path / "hair.tfx")
    assert np.array_equal(found.radius.reshape(5, 8), strands.radius.reshape(5, 8).max(1, keepdims=True).repeat(8, 1))
    assert np.array_equal(found.colour, strands.colour)


@pytest.mark.parametrize("suffix", [".npy", ".tfx"])
def test_formats_of_one_count_refuse_others(suffix, tmp_path):
    with pytest.raises(HairFileError, match=r"needs strands of"):
        write_strands(hair([4, 5]), tmp_path / f"hair{suffix}")


@pytest.mark.parametrize("suffix", READABLE)
@pytest.mark.parametrize("content", [b"", b"\0" * 3, b"HAIR", b"nothing of the kind\n" * 20, bytes(range(256)) * 4])
def test_a_damaged_file_is_one_line(suffix, content, tmp_path):
    path = tmp_path / f"hair{suffix}"
    path.write_bytes(content)
    with pytest.raises(HairFileError) as refusal:
        read_strands(path)
    assert "\n" not in str(refusal.value)
    assert str(path) in str(refusal.value)


@pytest.mark.parametrize("suffix", [".hair", ".data", ".tfx"])
def test_a_file_cut_short_is_damaged(suffix, tmp_path):
    path = tmp_path / f"hair{suffix}"
    write_strands(hair([8] * 10), path)
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.raises(HairFileError, match="damaged"):
        read_strands(path)


@pytest.mark.parametrize("suffix", READABLE)
def test_a_missing_file_is_an_os_error(suffix, tmp_path):
    with pytest.raises(OSError, match=r"hair|No such"):
        read_strands(tmp_path / f"hair{suffix}")


def test_unknown_endings_name_the_known(tmp_path):
    with pytest.raises(HairFileError, match=r"\.hair, \.data.*\.tfx"):
        read_strands(tmp_path / "hair.xyz")
    with pytest.raises(HairFileError, match=r"\.hair, \.data.*\.tfx"):
        write_strands(hair([3]), tmp_path / "hair.xyz")


def test_bare_points_ask_for_their_count(tmp_path):
    path = tmp_path / "points.ply"
    rows = "\n".join(f"{k} 0 0" for k in range(12))
    head = (
        "ply\nformat ascii 1.0\nelement vertex 12\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
    )
    path.write_text(head + rows + "\n")
    with pytest.raises(HairFileError, match="--points-per-strand"):
        read_strands(path)
    with pytest.raises(HairFileError, match="12 points cannot be strands of 5"):
        read_strands(path, points_per_strand=5)
    assert read_strands(path, points_per_strand=4).counts.tolist() == [4, 4, 4]


def test_edges_written_one_by_one_are_one_strand(tmp_path):
    path = tmp_path / "edges.obj"
    path.write_text("v 0 0 0\nv 0 1 0\nv 0 2 0\nv 5 0 0\nv 5 1 0\nl 1 2\nl 2 3\nl -2 -1\n")
    found = read_strands(path)
    assert found.counts.tolist() == [3, 2]
    assert found.points[:, 1].tolist() == [0, 1, 2, 0, 1]


def test_what_is_no_strand_is_left_out_and_said(tmp_path):
    strands = hair([3, 4, 3])
    broken = strands.points.copy()
    broken[4] = np.nan
    path = tmp_path / "broken.hair"
    write_strands(Strands(broken, strands.first), path)
    lines: list[str] = []
    found = read_strands(path, remark=lines.append)
    assert found.count == 2
    assert len(lines) == 1
    assert "left out 1 strands" in lines[0]


def test_usd_in_centimetres_and_moved_comes_in_metres(tmp_path: Path):
    path = tmp_path / "moved.usda"
    path.write_text(
        '#usda 1.0\n(\n metersPerUnit = 0.01\n upAxis = "Y"\n)\ndef Xform "A" {\n'
        ' double3 xformOp:translate = (100, 0, 0)\n uniform token[] xformOpOrder = ["xformOp:translate"]\n'
        ' def BasisCurves "B" {\n  int[] curveVertexCounts = [2]\n  point3f[] points = [(0, 0, 0), (0, 50, 0)]\n'
        '  float[] widths = [0.01]\n  uniform token type = "linear"\n }\n}\n'
    )
    found = read_strands(path)
    assert np.allclose(found.points, [[1, 0, 0], [1, 0.5, 0]])
    assert np.allclose(found.radius, 5e-5)
