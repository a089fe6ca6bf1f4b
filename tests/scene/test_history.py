"""Undo and redo."""

import dataclasses

from hypothesis import given
from hypothesis import strategies as st

from headstudio.params import assign
from headstudio.scene.document import Document
from headstudio.scene.history import History


def with_length(metres: float) -> Document:
    return assign(Document(), {"hair.length": metres})


def test_a_change_can_be_taken_back_and_done_again():
    history = History(Document())
    history.change(with_length(0.5), "Length")
    assert history.undo_label == "Length"
    assert history.undo()
    assert history.document == Document()
    assert history.redo_label == "Length"
    assert history.redo()
    assert history.document == with_length(0.5)


def test_nothing_to_undo_is_no_error():
    history = History(Document())
    assert not history.undo()
    assert not history.redo()
    assert history.undo_label is None
    assert history.redo_label is None


def test_a_drag_is_one_entry():
    history = History(Document())
    history.begin_gesture("Length")
    for metres in (0.31, 0.35, 0.42):
        history.change(with_length(metres), "Length")
        assert history.document.hair.length == metres
    history.end_gesture()
    history.undo()
    assert history.document == Document()
    assert not history.undo()


def test_a_drag_that_ends_where_it_began_is_no_entry():
    history = History(Document())
    history.begin_gesture("Length")
    history.change(with_length(0.5), "Length")
    history.change(Document(), "Length")
    history.end_gesture()
    assert history.undo_label is None


def test_undo_in_the_middle_of_a_drag_takes_the_whole_drag_back():
    history = History(Document())
    history.begin_gesture("Length")
    history.change(with_length(0.5), "Length")
    assert history.undo_label == "Length"
    history.undo()
    assert not history.in_gesture
    assert history.document == Document()


def test_a_cancelled_drag_leaves_nothing():
    history = History(Document())
    history.begin_gesture("Length")
    history.change(with_length(0.5), "Length")
    history.cancel_gesture()
    assert history.document == Document()
    assert not history.undo()


def test_an_equal_document_is_no_change():
    history = History(Document())
    history.change(dataclasses.replace(Document()), "Nothing")
    assert history.undo_label is None


def test_a_change_after_undo_forgets_what_was_undone():
    history = History(Document())
    history.change(with_length(0.5), "Length")
    history.undo()
    history.change(with_length(0.6), "Length")
    assert not history.redo()


def test_modified_compares_with_what_was_saved():
    history = History(Document())
    assert not history.modified
    history.change(with_length(0.5), "Length")
    assert history.modified
    history.mark_saved()
    assert not history.modified
    history.undo()
    assert history.modified
    history.redo()
    assert not history.modified
    history.change(with_length(0.6), "Length")
    history.change(with_length(0.5), "Length")
    assert not history.modified, "the way there does not matter, the document does"


def test_documents_share_what_a_change_leaves_alone():
    history = History(Document())
    before = history.document
    history.change(with_length(0.5), "Length")
    history.change(assign(history.document, {"lcp.friction": 1.0}), "Friction")
    assert assign(before, {"lcp.friction": 1.0}).hair is before.hair
    history.undo()
    history.undo()
    assert history.document is before


def test_a_document_that_was_opened_has_no_past():
    history = History(Document())
    history.change(with_length(0.5), "Length")
    history.reopen(with_length(0.6))
    assert not history.modified
    assert not history.undo()
    assert history.document == with_length(0.6)


def test_only_the_newest_entries_are_kept():
    history = History(0, limit=3)
    for number in range(1, 10):
        history.change(number, "Count")
    while history.undo():
        pass
    assert history.document == 6


@given(st.lists(st.one_of(st.integers(0, 5), st.sampled_from(["undo", "redo", "begin", "end", "cancel"])), max_size=60))
def test_undoing_everything_always_returns_to_the_start_and_redoing_to_the_end(actions):
    history = History(0)
    verbs = {
        "undo": history.undo,
        "redo": history.redo,
        "begin": lambda: history.begin_gesture("drag"),
        "end": history.end_gesture,
        "cancel": history.cancel_gesture,
    }
    for action in actions:
        if isinstance(action, int):
            history.change(action, "set")
        else:
            verbs[action]()
    history.end_gesture()
    while history.redo():
        pass
    last = history.document
    while history.undo():
        pass
    assert history.document == 0
    while history.redo():
        pass
    assert history.document == last
