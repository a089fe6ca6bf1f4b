"""Skinned meshes out of GLB files."""

from __future__ import annotations

import json
import struct

import numpy as np
import pytest

from headstudio.head.head import HeadError
from headstudio.head.rigged import load_rigged


def glb(document: dict, binary: bytes) -> bytes:
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


def tube(names=("base", "end"), chained=True, normalized=False, interleave=False) -> tuple[dict, bytes]:
    """Two joints at y = 0 and y = 1 and four points between them, one of them twice as along a seam."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0]], np.float32)
    corners = np.array([0, 1, 2, 4, 3, 2], np.uint16)
    joints = np.array([[0, 1, 0, 0]] * 5, np.uint8)
    share = np.array([[1, 0], [1, 0], [0.25, 0.75], [0, 1], [1, 0]])
    weights = np.zeros((5, 4), np.uint8 if normalized else np.float32)
    weights[:, :2] = np.rint(255 * share) if normalized else share
    inverse = np.tile(np.eye(4, dtype=np.float32), (2, 1, 1))
    inverse[1, 3, 1] = -1.0
    if interleave:
        points = np.concatenate([points, np.full((5, 1), 9, np.float32)], axis=1)
    blocks = [array.tobytes() for array in (points, corners, joints, weights, inverse)]
    views, start = [], 0
    for block in blocks:
        views.append({"buffer": 0, "byteOffset": start, "byteLength": len(block)})
        start += len(block) + -len(block) % 4
    if interleave:
        views[0]["byteStride"] = 16
    binary = b"".join(block + b"\0" * (-len(block) % 4) for block in blocks)
    kinds = [(5126, 5, "VEC3"), (5123, 6, "SCALAR"), (5121, 5, "VEC4"), (5121 if normalized else 5126, 5, "VEC4")]
    kinds.append((5126, 2, "MAT4"))
    accessors = [
        {"bufferView": k, "componentType": kind, "count": count, "type": shape, "normalized": normalized and k == 3}
        for k, (kind, count, shape) in enumerate(kinds)
    ]
    attributes = {"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3}
    nodes = [{"name": names[0]}, {"name": names[1]}, {"mesh": 0, "skin": 0}]
    if chained:
        nodes[0]["children"] = [1]
    document = {
        "asset": {"version": "2.0"},
        "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 1}]}],
        "skins": [{"joints": [0, 1], "inverseBindMatrices": 4}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(binary)}],
    }
    return document, binary


@pytest.mark.parametrize("options", [{}, {"normalized": True}, {"interleave": True}])
def test_mesh_joints_and_weights_are_read_and_seams_welded(tmp_path, options):
    path = tmp_path / "tube.glb"
    path.write_bytes(glb(*tube(**options)))
    part = load_rigged(path)
    assert part.name == "tube"
    assert part.skin.vertices.shape == (4, 3)
    assert part.skin.faces.shape == (2, 3)
    rig = part.rig
    assert rig.names == ("base", "end")
    assert rig.parents.tolist() == [-1, 0]
    np.testing.assert_allclose(rig.positions, [[0, 0, 0], [0, 1, 0]], atol=1e-7)
    weights = rig.weights.toarray()
    corner = np.linalg.norm(part.skin.vertices - [0, 1, 0], axis=1).argmin()
    np.testing.assert_allclose(weights[corner], [0.25, 0.75], atol=0.002)
    np.testing.assert_allclose(weights.sum(axis=1), 1.0)


def test_joints_come_after_what_they_hang_on(tmp_path):
    document, binary = tube()
    document["nodes"][0].pop("children")
    document["nodes"][1]["children"] = [0]
    (tmp_path / "turned.glb").write_bytes(glb(document, binary))
    rig = load_rigged(tmp_path / "turned.glb").rig
    assert rig.names == ("end", "base")
    assert rig.parents.tolist() == [-1, 0]
    np.testing.assert_allclose(rig.positions[0], [0, 1, 0], atol=1e-7)


def test_a_hand_of_webxr_is_turned_upright_and_chained_by_name(tmp_path):
    document, binary = hand_of_webxr()
    (tmp_path / "hand.glb").write_bytes(glb(document, binary))
    rig = load_rigged(tmp_path / "hand.glb").rig
    parent = {name: rig.names[k] if k >= 0 else None for name, k in zip(rig.names, rig.parents)}
    assert parent["wrist"] is None
    assert parent["little intermediate"] == "little proximal"
    assert parent["thumb distal"] == "thumb proximal"
    assert parent["index metacarpal"] == "wrist"
    np.testing.assert_allclose(rig.at("wrist"), 0.0, atol=1e-7)
    along = rig.at("middle proximal")
    np.testing.assert_allclose(along / np.linalg.norm(along), [0, 1, 0], atol=1e-6)
    assert rig.at("thumb tip")[2] < 0


def hand_of_webxr() -> tuple[dict, bytes]:
    """All 25 joints side by side on one node, the hand lying askew; its skin is one triangle on the wrist."""
    names, places = ["wrist"], [(0.0, 0.0, 0.0)]
    for finger, x in (("thumb", 0.05), ("index-finger", 0.025), ("middle-finger", 0.0), ("ring-finger", -0.02)):
        names, places = _finger(names, places, finger, x)
    names, places = _finger(names, places, "pinky-finger", -0.04)
    turned = np.array(places) @ np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    inverse = np.tile(np.eye(4, dtype=np.float32), (len(names), 1, 1))
    inverse[:, 3, :3] = -turned
    points = np.array([[0, 0, 0], [0.01, 0, 0], [0, 0.01, 0]], np.float32)
    blocks = [
        points.tobytes(),
        np.zeros((3, 4), np.uint8).tobytes(),
        np.tile([1, 0, 0, 0], (3, 1)).astype("<f4").tobytes(),
    ]
    blocks.append(inverse.tobytes())
    starts = np.cumsum([0] + [len(block) for block in blocks[:-1]]).tolist()
    shapes = [(5126, 3, "VEC3"), (5121, 3, "VEC4"), (5126, 3, "VEC4"), (5126, len(names), "MAT4")]
    joints = list(range(len(names)))
    document = {
        "nodes": [*({"name": name} for name in names), {"children": joints}, {"mesh": 0, "skin": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
        "skins": [{"joints": joints, "inverseBindMatrices": 3}],
        "accessors": [
            {"bufferView": k, "componentType": kind, "count": count, "type": shape}
            for k, (kind, count, shape) in enumerate(shapes)
        ],
        "bufferViews": [{"byteOffset": start, "byteLength": len(block)} for start, block in zip(starts, blocks)],
    }
    return document, b"".join(blocks)


def _finger(names: list, places: list, finger: str, x: float) -> tuple[list, list]:
    thumb = finger == "thumb"
    bones = ["metacarpal", "phalanx-proximal", *([] if thumb else ["phalanx-intermediate"]), "phalanx-distal", "tip"]
    levels = (0.02, 0.05, 0.07, 0.09) if thumb else (0.02, 0.09, 0.13, 0.15, 0.17)
    bent = [(x * (0.3 + min(level, 0.09) / 0.13), level, -0.1 * max(level - 0.05, 0)) for level in levels]
    return names + [f"{finger}-{bone}" for bone in bones], places + bent


def test_a_file_without_a_skeleton_is_a_part_that_holds_still(tmp_path):
    document, binary = tube()
    document["nodes"][2].pop("skin")
    document["nodes"][2]["translation"] = [0.0, 0.0, 2.0]
    document["scenes"], document["scene"] = [{"nodes": [2]}], 0
    (tmp_path / "still.glb").write_bytes(glb(document, binary))
    part = load_rigged(tmp_path / "still.glb")
    assert part.rig is None
    assert "holds still" in part.notes[-1]
    np.testing.assert_allclose(part.skin.vertices[:, 2], 2.0)
    assert len(part.skin.vertices) == 4


@pytest.mark.parametrize("spoil", ["text", "cut", "weights", "loop"])
def test_a_file_that_cannot_be_used_is_one_line(tmp_path, spoil):
    document, binary = tube()
    if spoil == "weights":
        document["meshes"][0]["primitives"][0]["attributes"].pop("WEIGHTS_0")
    if spoil == "loop":
        document["nodes"][1]["children"] = [0]
    content = {"text": b"solid hand", "cut": glb(document, binary)[:400]}.get(spoil, glb(document, binary))
    path = tmp_path / "spoiled.glb"
    path.write_bytes(content)
    with pytest.raises(HeadError) as error:
        load_rigged(path)
    assert "\n" not in str(error.value)
    assert "spoiled" in str(error.value)


def test_a_file_that_is_not_there_is_one_line(tmp_path):
    with pytest.raises(HeadError, match="cannot be read"):
        load_rigged(tmp_path / "nothing.glb")
