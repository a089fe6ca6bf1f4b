"""The sheets of faces of docs/faces.md: expressions with and without their wrinkles, on both built-in heads.

python docs/pictures/faces.py [FOLDER [HEAD ...]]
"""

from __future__ import annotations

import sys
from pathlib import Path

from headstudio.commands.documents import animate
from headstudio.commands.pictures import Photographer, save_picture
from headstudio.commands.wrinkle import close_up, with_face
from headstudio.io.contact_sheet import contact_sheet
from headstudio.params import assign
from headstudio.scene.builder import Builder
from headstudio.scene.document import Document

SIZE = (360, 360)
FACES = ("thinking", "smiling", "troubled", "angry", "surprised", "squinting")
HEADS = {
    "woman": {"head.source": "makehuman", "wrinkle.age": 0.3},
    "old man": {"head.source": "makehuman", "head.age": 0.75, "head.masculine": 1.0, "wrinkle.age": 0.8},
    "mannequin": {"head.source": "mannequin", "wrinkle.age": 0.5},
}


def main(folder: Path, wanted: set[str]) -> None:
    """Write faces-HEAD.png for every head, or those wanted: each face without and with wrinkles."""
    photographer = Photographer(SIZE)
    for name, head in HEADS.items():
        if wanted and name not in wanted:
            continue
        builder = Builder()
        pictures, captions = [], []
        for face in FACES:
            for wrinkled in (False, True):
                document = with_face(assign(Document(), head), face, (), wrinkled)
                stage = animate(document, builder).stage()
                seen = close_up(document, stage.head)
                pictures.append(photographer.still(stage, seen, SIZE))
                captions.append(f"{face}, {'with' if wrinkled else 'without'} wrinkles")
        save_picture(contact_sheet(pictures, captions, 4), folder / f"faces-{name.replace(' ', '-')}.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent, set(sys.argv[2:]))
