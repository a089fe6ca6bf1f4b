"""What tests of the editor of wrinkles share: a face with few furrows, and where its places are in the window."""

from itertools import pairwise

import numpy as np

from headstudio.app.wrinkles.face_places import places_of
from headstudio.app.wrinkles.skin_canvas import HeadCanvas
from headstudio.wrinkle.default_furrows import default_furrows

SMALL = {"fine.on": False, "wrinkle.fineness": 1.0, "look.shadows": False}
NAMES = ("forehead 2", "nasolabial left", "nasolabial right")
FURROWS = tuple(furrow for furrow in default_furrows(0.5) if furrow.name in NAMES)


def furrows_of(driver):
    return driver.studio.document.wrinkle.furrows


def head_canvas(driver):
    """The face in the viewport, as the tools see it."""
    viewport, studio = driver.app.viewport, driver.studio
    corner = (viewport.rect.x, viewport.rect.y)
    return HeadCanvas(places_of(studio), viewport.view, viewport.frame, studio.stage.skin.posed, corner)


def texture_canvas(driver):
    """The same face in texture space."""
    return driver.app.beside.canvas(places_of(driver.studio), driver.rect("Texture"))


def on_screen(canvas, *chart):
    """Where points of the face chart [m], (x, y) each, are in the window."""
    places, reached = canvas.faces.of_chart(np.array(chart))
    assert reached.all()
    return [(float(x), float(y)) for x, y in canvas.on_screen(places)]


def draw_stroke(driver, points, keys=(), steps=3):
    """Press at the first of ``points`` of the window, go through the others, let go at the last."""
    driver.move(*points[0])
    driver._hold(keys)
    driver.press()
    for start, end in pairwise(points):
        for x, y in np.linspace(start, end, steps + 1)[1:]:
            driver.move(float(x), float(y))
    driver.release()
    driver._let_go(keys)
    driver.frames()


def tool(driver, label):
    """The tool of the open tab with this label."""
    return tool_of(driver.app, label)


def tool_of(application, label):
    (found,) = (each for each in application.tools if each.label == label)
    return found
