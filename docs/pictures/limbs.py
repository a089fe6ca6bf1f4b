"""The sheet of hands, arm and foot of docs/faces.md (Bando's thesis, figures 2.16 to 2.20).

python docs/pictures/limbs.py [FOLDER]
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

from headstudio.commands.documents import choose_view
from headstudio.commands.limb import limb
from headstudio.commands.pictures import save_picture
from headstudio.io.contact_sheet import contact_sheet
from headstudio.params import assign
from headstudio.scene.document import Document
from headstudio.wrinkle.hand_settings import HandSettings

SIZE = (400, 400)
SHEET = (
    ("hand", "relaxed", 0.5, False, "hand, without wrinkles"),
    ("hand", "relaxed", 0.5, True, "hand, with wrinkles"),
    ("hand", "relaxed", 1.0, True, "aged hand"),
    ("hand", "fist", 0.7, True, "fist"),
    ("arm", "relaxed", 0.5, True, "hand with arm"),
    ("foot", "rest", 0.5, True, "foot"),
)


def main(folder: Path) -> None:
    """Write limbs.png."""
    pictures, captions = [], []
    with tempfile.TemporaryDirectory() as scratch:
        for which, pose, age, wrinkled, caption in SHEET:
            document = choose_view(assign(Document(), {"head.age": age}), "three-quarter")
            out = Path(scratch) / "limb.png"
            limb(document, which, assign(HandSettings(), {"pose": pose}), wrinkled, SIZE, out)
            with Image.open(out) as picture:
                pictures.append(np.asarray(picture))
            captions.append(caption)
    save_picture(contact_sheet(pictures, captions, 3), folder / "limbs.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
