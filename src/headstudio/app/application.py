"""The application: a studio, its window, and the commands that connect them."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from imgui_bundle import imgui
from PIL import Image

from ..params import ParameterError
from ..scene.project import SUFFIX
from ..scene.recent import recent_projects
from . import navigation, shell, status, theme, toasts
from .commands import Command, run_pressed
from .dialogs import Dialogs
from .editors import EDITORS, Editor
from .file_browser import FileWish
from .parameter_rows import ParameterRows
from .recorder import FILM_ENDINGS, Recorder
from .sidebar import Sidebar
from .studio import Studio
from .transport import Transport
from .ui import Ui
from .viewport import Viewport
from .window import Window

HEAD_ENDINGS = (".obj", ".ply", ".stl", ".off", ".glb", ".gltf")
IDLE_WAIT = 0.1  # [s] between two looks for events while nothing moves
