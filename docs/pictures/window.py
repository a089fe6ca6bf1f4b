"""Makes window.png, the guide's picture of the window: ``.venv/bin/python docs/pictures/window.py``. No display needed."""

import time
from pathlib import Path

from PIL import Image

from headstudio.app.application import Application
from headstudio.app.studio import Studio
from headstudio.app.window import Window

FRAME = 1 / 30  # [s]
SHAKEN = 1.25  # how long the head shakes before the picture is taken [s]
AT_REST = 4  # frames after which the viewport has drawn what stands still in full


def main() -> None:
    """Open a window that nobody sees, shake the head, stop the time, and write the picture beside this file."""
    window = Window("headstudio", (1280, 800), headless=True)
    studio = Studio()
    application = Application(window, studio)
    while studio.grown is None:
        application.frame(FRAME)
        time.sleep(0.01)
    studio.set("motion.kind", "shake", "Shake")
    for _ in range(round(SHAKEN / FRAME)):
        application.frame(FRAME)
    studio.playback.playing = False
    for _ in range(AT_REST):
        application.frame(FRAME)
    Image.fromarray(window.picture()).save(Path(__file__).with_name("window.png"), "PNG")


if __name__ == "__main__":
    main()
