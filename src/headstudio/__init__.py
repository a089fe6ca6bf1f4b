"""headstudio: hair that is shaken live, wisps that are styled, wrinkles that deepen as the face moves, on one head."""

__version__ = "0.4.0"
