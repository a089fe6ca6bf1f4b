from __future__ import annotations

import pytest

from headstudio.params import ParameterError
from headstudio.scene.document import Document
from headstudio.scene.skin_presets import SKIN_PRESETS, with_skin


def test_presets_go_from_young_to_old_and_leave_the_rest() -> None:
    documents = [with_skin(Document(), name) for name in SKIN_PRESETS]
    for older, younger in zip(documents[1:], documents):
        assert older.wrinkle.age > younger.wrinkle.age
        assert older.fine.depth > younger.fine.depth
        assert older.fine.initial_amplitude > younger.fine.initial_amplitude
        assert older.look == Document().look


def test_a_name_that_is_no_skin_is_one_line() -> None:
    with pytest.raises(ParameterError, match="a skin is one of child, young, grown, aged, weathered; got 'wax'"):
        with_skin(Document(), "wax")
