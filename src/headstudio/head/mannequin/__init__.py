"""The built-in head, sculpted by code: ``mannequin()``."""

from .build import mannequin

__all__ = ["mannequin"]
