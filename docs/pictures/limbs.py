"""The sheet of hands, arm, foot and aged skin of docs/faces.md, each without and with wrinkles
(Bando's thesis, figures 2.16 to 2.20).

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

SIZE = (440, 440)
CLOSE: dict[str, Any] = {"fine.texture_size": 1024, "skin.relief": 3.0}
FROM_ABOVE: dict[str, Any] = {"camera.elevation": 0.8}
# Seen whole, fine wrinkles as nature makes them are thinner than a pixel: three times as large, and more than twice as deep.
WHOLE: dict[str, Any] = {"fine.texture_size": 1024, "fine.unit": 0.6e-3, "skin.relief": 2.5}
OLD: dict[str, Any] = {"wrinkle.age": 1.0}
# Limb, pose, age, the joint that is looked at, other settings, caption.
LIMBS: tuple[tuple[str, str, float, str | None, dict[str, Any], str], ...] = (
    ("hand", "relaxed", 0.5, None, {}, "2.16"),
    ("hand", "open", 0.5, "middle proximal", CLOSE, "2.17 a, a knuckle at rest"),
    ("hand", "fist", 0.5, "middle proximal", CLOSE | FROM_ABOVE, "2.17 b, expanded in a fist"),
    ("foot", "rest", 0.5, None, WHOLE, "2.18"),
    ("arm", "relaxed", 0.5, None, WHOLE, "2.19"),
    ("hand", "relaxed", 1.0, None, {"skin.relief": 2.0}, "2.20, aged hand"),
)
FACES: tuple[tuple[dict[str, Any], str], ...] = (
    (OLD | {"head.source": "makehuman", "head.age": 0.95}, "2.20, aged face, MakeHuman"),
    (OLD | {"head.source": "mannequin"}, "2.20, aged face, mannequin"),
)


def main(folder: Path) -> None:
    """Write limbs.png."""
    pictures, captions = [], []
    with tempfile.TemporaryDirectory() as scratch:
        out = Path(scratch) / "picture.png"
        for which, pose, age, near, settings, caption in LIMBS:
            view = "front" if near else "three-quarter"
            document = assign(choose_view(Document(), view), {"head.age": age, **settings})
            for wrinkled in (False, True):
                limb(document, which, assign(HandSettings(), {"pose": pose}), wrinkled, SIZE, out, near)
                pictures.append(_read(out))
                captions.append(_caption(caption, wrinkled))
        for face, caption in FACES:
            for wrinkled in (False, True):
                wrinkle(with_face(assign(Document(), face), None, (), wrinkled), out, SIZE, framed=True)
                pictures.append(_read(out))
                captions.append(_caption(caption, wrinkled))
    save_picture(contact_sheet(pictures, captions, 4), folder / "limbs.png")


def _caption(figure: str, wrinkled: bool) -> str:
    return f"{figure}, {'with' if wrinkled else 'without'} wrinkles"


def _read(path: Path) -> np.ndarray:
    with Image.open(path) as picture:
        return np.asarray(picture)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
