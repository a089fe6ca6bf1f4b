"""What is built and shown, and in what order, after a change of hair."""

from dataclasses import replace

import pytest

from headstudio.params import assign
from headstudio.scene.animation import needs
from headstudio.scene.document import Document
from headstudio.scene.drafts import DRAFT, drafted, next_to_build, same_hair

WHOLE = assign(Document(), {"look.hair_as": "strands"})


def counts(wanted, shown, *, dragging=False):
    """The strands of all that is shown one after the other until nothing better comes."""
    seen = []
    while shown is None or not same_hair(next_to_build(wanted, shown, dragging=dragging), shown):
        shown = next_to_build(wanted, shown, dragging=dragging)
        seen.append(shown.look.strands_shown)
        assert len(seen) < 5
    return seen


def test_another_shape_is_a_draft_first():
    changed = assign(WHOLE, {"wisp.fuzziness": 0.3})
    assert counts(changed, None) == counts(changed, WHOLE) == [DRAFT, 20_000]
    # Changed again while the draft of the change before is all there is.
    assert counts(assign(changed, {"styling.back": 0.5}), drafted(changed)) == [DRAFT, 20_000]


def test_a_drag_stays_with_the_draft_and_is_made_up_for():
    changed = assign(WHOLE, {"wisp.fuzziness": 0.3})
    assert counts(changed, WHOLE, dragging=True) == [DRAFT]
    assert counts(changed, drafted(changed)) == [20_000]


@pytest.mark.parametrize("dragging", [False, True])
def test_colours_need_no_draft(dragging):
    red = assign(WHOLE, {"colour.pigment": "red"})
    assert counts(red, WHOLE, dragging=dragging) == [20_000]


def test_few_strands_have_no_draft():
    for few in (assign(WHOLE, {"wisp.strands": DRAFT}), assign(WHOLE, {"look.strands_shown": 500})):
        assert drafted(few) is few
        assert len(counts(few, WHOLE)) == 1


def test_loose_hair_is_no_matter_of_strands():
    loose = Document()
    assert needs(drafted(loose)) == needs(loose)
    assert len(counts(replace(loose, hair=replace(loose.hair, seed=7)), loose)) == 1
