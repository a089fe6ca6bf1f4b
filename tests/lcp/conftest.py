"""What is dear to make is made once."""

from __future__ import annotations

import pytest

from headstudio.lcp.grow import grow_hair
from headstudio.lcp.settings import HairSettings

from .dome import DomeScalp, ball_body


@pytest.fixture(scope="session")
def dome():
    return DomeScalp()


@pytest.fixture(scope="session")
def ball():
    return ball_body()


@pytest.fixture(scope="session")
def hair(dome, ball):
    """A small head of hair, 20 cm long."""
    return grow_hair(dome, ball, HairSettings(particles=300, length=0.2))
