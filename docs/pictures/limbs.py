"""The sheet of hands, arm, foot and aged skin of docs/faces.md (Bando's thesis, figures 2.16 to 2.20).

python docs/pictures/limbs.py [FOLDER]
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from headstudio.commands.documents import choose_view
from headstudio.commands.limb import limb
from headstudio.commands.pictures import save_picture
from headstudio.commands.wrinkle import with_face, wrinkle
from headstudio.io.contact_sheet import contact_sheet
from headstudio.params import assign
from headstudio.scene.document import Document
from headstudio.wrinkle.hand_settings import HandSettings

SIZE = (360, 360)
CLOSE: dict[str, Any] = {"fine.texture_size": 1024, "skin.relief": 3.0}
FROM_ABOVE: dict[str, Any] = {"camera.elevation": 0.8}
# Limb, pose, age, wrinkled, the joint that is looked at, other settings, caption.
SHEET: tuple[tuple[str, str, float, bool, str | None, dict[str, Any], str], ...] = (
    ("hand", "relaxed", 0.5, False, None, {}, "2.16, without wrinkles"),
    ("hand", "relaxed", 0.5, True, None, {}, "2.16, with wrinkles"),
    ("hand", "open", 0.5, True, "middle proximal", CLOSE, "2.17 a, a knuckle at rest"),
    ("hand", "fist", 0.5, True, "middle proximal", CLOSE | FROM_ABOVE, "2.17 b, expanded in a fist"),
    ("foot", "rest", 0.5, False, None, {}, "2.18, without wrinkles"),
    ("foot", "rest", 0.5, True, None, {}, "2.18, with wrinkles"),
    ("arm", "relaxed", 0.5, False, None, {}, "2.19, without wrinkles"),
    ("arm", "relaxed", 0.5, True, None, {}, "2.19, with wrinkles"),
    ("hand", "relaxed", 1.0, True, None, {"skin.relief": 2.0}, "2.20, aged hand"),
)
FACES: tuple[tuple[dict[str, Any], str], ...] = (
    ({"head.source": "makehuman", "head.age": 0.95, "wrinkle.age": 1.0}, "2.20, aged face, MakeHuman"),
    ({"head.source": "mannequin", "wrinkle.age": 1.0}, "2.20, aged face, mannequin"),
    ({"head.source": "makehuman", "head.age": 0.95, "wrinkle.age": 1.0, "wrinkle.shown": False}, "without wrinkles"),
)


def main(folder: Path) -> None:
    """Write limbs.png."""
    pictures, captions = [], []
    with tempfile.TemporaryDirectory() as scratch:
        out = Path(scratch) / "picture.png"
        for which, pose, age, wrinkled, near, settings, caption in SHEET:
            view = "front" if near else "three-quarter"
            document = assign(choose_view(Document(), view), {"head.age": age, **settings})
            limb(document, which, assign(HandSettings(), {"pose": pose}), wrinkled, SIZE, out, near)
            pictures.append(_read(out))
            captions.append(caption)
        for face, caption in FACES:
            document = with_face(assign(Document(), face), None, (), face.get("wrinkle.shown", True))
            wrinkle(document, out, SIZE, framed=True)
            pictures.append(_read(out))
            captions.append(caption)
    save_picture(contact_sheet(pictures, captions, 4), folder / "limbs.png")


def _read(path: Path) -> np.ndarray:
    with Image.open(path) as picture:
        return np.asarray(picture)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
