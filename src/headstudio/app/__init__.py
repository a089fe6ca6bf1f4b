"""The window: viewport, tools, panels and plots over the scene."""

from .main import main
from .window import WindowError

__all__ = ["WindowError", "main"]
