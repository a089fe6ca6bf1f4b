"""A body part from a GLB file, with its skeleton if it has one: skins of glTF 2.0, as far as a rest pose needs."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from .head import HeadError
from .mesh import Floats, Ints, TriangleMesh
from .read import read_mesh
from .repair import repair
from .rig import FINGERS, PHALANGES, BodyPart, Rig, hand_frame, hand_parents, is_hand

_MAGIC, _JSON_CHUNK, _BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942
_COMPONENTS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_TRIANGLES = 4
# Vertices nearer than this are one that was split along a texture seam [m].
_WELD = 1e-6

# Names of joints in WebXR's hands, and what their parts are called here.
_WORDS = {"pinky": "little", "phalanx": "", "finger": ""}


def load_rigged(path: str | Path) -> BodyPart:
    """The skinned mesh of a GLB file and its skeleton; from a file without one all its meshes, which hold still.

    A hand (WebXR's names of joints, or those of ``Rig``) is turned as ``makehuman_hand`` is, and its chain of joints
    follows from their names even where the file hangs all of them on one node. Raises HeadError, one line for the
    user, when there is no such file or it is damaged.
    """
    path = Path(path)
    try:
        content = path.read_bytes()
    except OSError as error:
        raise HeadError(f"{path} cannot be read: {error.strerror or error}") from None
    try:
        glb = _Glb(content)
        node = next((node for node in glb.json["nodes"] if "skin" in node and "mesh" in node), None)
        return _still_part(path) if node is None else _body_part(glb, node, path.stem)
    except (struct.error, ValueError, KeyError, IndexError, TypeError, AttributeError) as error:
        if isinstance(error, HeadError):
            raise
        raise HeadError(f"{path.name} is damaged or no GLB file: export it again") from None


class _Glb:
    """The JSON and the binary part of a GLB file."""

    def __init__(self, content: bytes) -> None:
        magic, version, _ = struct.unpack_from("<III", content)
        if magic != _MAGIC or version != 2:
            raise ValueError
        chunks, start = {}, 12
        while start < len(content):
            length, kind = struct.unpack_from("<II", content, start)
            chunks[kind] = content[start + 8 : start + 8 + length]
            start += 8 + length
        self.json: dict[str, Any] = json.loads(chunks[_JSON_CHUNK])
        self._binary = chunks[_BINARY_CHUNK]

    def array(self, accessor: int) -> NDArray[Any]:
        """What an accessor points to, (count, width); whole numbers that stand for 0 to 1 as such."""
        entry = self.json["accessors"][accessor]
        if "sparse" in entry or entry["componentType"] not in _COMPONENTS:
            raise ValueError
        view = self.json["bufferViews"][entry["bufferView"]]
        kind, width, count = np.dtype(_COMPONENTS[entry["componentType"]]), _WIDTHS[entry["type"]], entry["count"]
        stride = view.get("byteStride", kind.itemsize * width)
        start = view.get("byteOffset", 0) + entry.get("byteOffset", 0)
        values = np.ndarray((count, width), kind, self._binary, start, (stride, kind.itemsize))
        return values / float(np.iinfo(str(kind)).max) if entry.get("normalized") else values.copy()


def _still_part(path: Path) -> BodyPart:
    skin, repairs = repair(read_mesh(path))
    size = f"{len(skin.vertices):,} vertices and {len(skin.faces):,} triangles"
    still = "no skin hangs on a skeleton: it holds still, and there are no joints to crease"
    # Its texture coordinates may lie over each other, as games have them; those of wrinkles must not.
    return BodyPart(path.stem, TriangleMesh(skin.vertices, skin.faces), None, (size, *repairs.lines(), still))


def _body_part(glb: _Glb, node: dict[str, Any], name: str) -> BodyPart:
    joints = glb.json["skins"][node["skin"]]["joints"]
    names = tuple(_joint_name(glb.json["nodes"][joint].get("name", f"joint {joint}")) for joint in joints)
    # A joint rests where its inverse bind matrix, which glTF stores by columns, takes it to the origin.
    inverse = glb.array(glb.json["skins"][node["skin"]]["inverseBindMatrices"]).reshape(-1, 4, 4).swapaxes(1, 2)
    positions = np.linalg.inv(inverse.astype(np.float64))[:, :3, 3]
    vertices, faces, weights = _skinned_surface(glb, glb.json["meshes"][node["mesh"]], len(joints))

    parents = hand_parents(names) if is_hand(names) else _parents(glb, joints)
    if is_hand(names):
        axes = hand_frame(names, positions)
        wrist = positions[names.index("wrist")]
        vertices, positions = (vertices - wrist) @ axes.T, (positions - wrist) @ axes.T
    order = _parents_first(parents)
    place = np.argsort(order)
    parents = np.where(parents[order] < 0, -1, place[parents[order]])
    rig = Rig(tuple(names[k] for k in order), parents, positions[order], sparse.csr_array(weights[:, order]))
    notes = (f"{len(vertices):,} vertices, {len(faces):,} triangles and {len(joints)} joints",)
    return BodyPart(name, TriangleMesh(vertices, faces), rig, notes)


def _joint_name(name: str) -> str:
    """A joint of a WebXR hand by the name it has here; any other name as it is."""
    words = [_WORDS.get(word, word) for word in name.split("-")]
    known = " ".join(word for word in words if word)
    finger, _, bone = known.partition(" ")
    return known if finger in FINGERS and bone in PHALANGES else name


def _skinned_surface(glb: _Glb, mesh: dict[str, Any], joints: int) -> tuple[Floats, Ints, Floats]:
    """Vertices (n, 3), faces (m, 3) and weights (n, joints) of all triangles of a mesh, welded along its seams."""
    points, faces, shares = [], [], []
    start = 0
    for piece in mesh["primitives"]:
        if piece.get("mode", _TRIANGLES) != _TRIANGLES:
            continue
        at = piece["attributes"]
        position = glb.array(at["POSITION"]).astype(np.float64)
        share = np.zeros((len(position), joints))
        np.add.at(share, (np.arange(len(position))[:, None], glb.array(at["JOINTS_0"])), glb.array(at["WEIGHTS_0"]))
        corner = glb.array(piece["indices"]).ravel() if "indices" in piece else np.arange(len(position))
        points.append(position)
        shares.append(share)
        faces.append(corner.astype(np.int64).reshape(-1, 3) + start)
        start += len(position)
    vertices, weights, corners = np.concatenate(points), np.concatenate(shares), np.concatenate(faces)
    total = weights.sum(axis=1, keepdims=True)
    if not np.isfinite(vertices).all() or (total <= 0).any() or corners.max() >= len(vertices):
        raise ValueError
    _, first, welded = np.unique(np.rint(vertices / _WELD), axis=0, return_index=True, return_inverse=True)
    corners = welded.ravel()[corners]
    whole = (corners != np.roll(corners, 1, axis=1)).all(axis=1)
    return vertices[first], corners[whole], (weights / total)[first]


def _parents(glb: _Glb, joints: list[int]) -> Ints:
    place = {joint: k for k, joint in enumerate(joints)}
    parents = np.full(len(joints), -1)
    for node, entry in enumerate(glb.json["nodes"]):
        for child in entry.get("children", ()):
            if child in place:
                parents[place[child]] = place.get(node, -1)
    return parents


def _parents_first(parents: Ints) -> Ints:
    """An order of the joints in which each comes after what it hangs on. Raises ValueError for a loop."""
    depth = np.zeros(len(parents), dtype=np.int64)
    above = parents.copy()
    for _ in range(len(parents)):
        if (above < 0).all():
            return np.argsort(depth, kind="stable")
        depth += above >= 0
        above = np.where(above >= 0, parents[above], -1)
    if (above >= 0).any():
        raise ValueError
    return np.argsort(depth, kind="stable")
