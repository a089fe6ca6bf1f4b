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

from headstudio.commands.documents import choose_view, open_document
from headstudio.commands.limb import limb
from headstudio.commands.pictures import save_picture
from headstudio.commands.wrinkle import with_face, wrinkle
from headstudio.io.contact_sheet import contact_sheet
from headstudio.params import assign
from headstudio.scene.document import Document
from headstudio.scene.skin_presets import with_skin
from headstudio.wrinkle.hand_settings import HandSettings

SIZE = (440, 440)
CLOSE: dict[str, Any] = {"fine.texture_size": 1024, "skin.relief": 3.0}
FROM_ABOVE: dict[str, Any] = {"camera.elevation": 0.8}
# Seen whole, fine wrinkles as nature makes them are thinner than a pixel: up to three times as large, and deeper.
HAND: dict[str, Any] = {"fine.texture_size": 1024, "fine.unit": 0.4e-3, "skin.relief": 1.8}
FOOT: dict[str, Any] = {"fine.texture_size": 1024, "fine.unit": 0.6e-3, "skin.relief": 2.4}
# Limb, pose, from where, age, skin, the joint that is looked at, other settings, caption.
LIMBS: tuple[tuple[str, str, str, float, str | None, str | None, dict[str, Any], str], ...] = (
    ("hand", "open", "front", 0.5, None, None, HAND, "2.16"),
    ("hand", "open", "front", 0.5, None, "middle proximal", CLOSE, "2.17 a, a knuckle at rest"),
    ("hand", "fist", "front", 0.5, None, "middle proximal", CLOSE | FROM_ABOVE, "2.17 b, expanded in a fist"),
    ("foot", "rest", "three-quarter", 0.5, "aged", None, FOOT, "2.18"),
    ("arm", "relaxed", "three-quarter", 0.5, "aged", None, FOOT, "2.19"),
    ("hand", "open", "front", 1.0, "weathered", None, HAND, "2.20, aged hand"),
)
FACES: tuple[tuple[dict[str, Any], str], ...] = (
    ({"head.source": "makehuman", "head.age": 0.95}, "2.20, aged face, MakeHuman"),
    ({"head.source": "mannequin"}, "2.20, aged face, mannequin"),
)


def main(folder: Path) -> None:
    """Write limbs.png."""
    pictures, captions = [], []
    with tempfile.TemporaryDirectory() as scratch:
        out = Path(scratch) / "picture.png"
        for which, pose, view, age, skin, near, settings, caption in LIMBS:
            document = choose_view(open_document(None, (), skin=skin, head_age=age), view)
            document = assign(document, settings)
            for wrinkled in (False, True):
                limb(document, which, assign(HandSettings(), {"pose": pose}), wrinkled, SIZE, out, near)
                pictures.append(_read(out))
                captions.append(_caption(caption, wrinkled))
        for face, caption in FACES:
            for wrinkled in (False, True):
                document = assign(with_skin(Document(), "weathered"), face)
                wrinkle(with_face(document, None, (), wrinkled), out, SIZE, framed=True)
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
