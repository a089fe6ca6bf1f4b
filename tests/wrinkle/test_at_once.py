from __future__ import annotations

import threading

import pytest

from headstudio.wrinkle.at_once import at_once


def test_both_are_worked_on_at_the_same_time() -> None:
    """Each waits for the other one to have begun."""
    here, there = threading.Event(), threading.Event()

    def mine() -> str:
        here.set()
        return "mine" if there.wait(10) else "late"

    def other() -> str:
        there.set()
        return "other" if here.wait(10) else "late"

    assert at_once(mine, other) == ("mine", "other")


def test_work_within_work_is_done_too() -> None:
    assert at_once(lambda: at_once(lambda: 1, lambda: 2), lambda: 3) == ((1, 2), 3)


def test_what_fails_elsewhere_fails_here() -> None:
    with pytest.raises(ZeroDivisionError):
        at_once(lambda: 1, lambda: 1 // 0)
