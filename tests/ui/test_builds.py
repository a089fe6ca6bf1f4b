"""The worker behind the window."""

import threading
import time

import pytest

from headstudio.app.builds import Builds
from headstudio.params import assign
from headstudio.scene.document import Document

ONE, TWO, THREE = (assign(Document(), {"hair.particles": count}) for count in (100, 200, 300))


class Slow:
    """A build that goes on when it is told to, and remembers what it was asked for."""

    def __init__(self):
        self.asked = []
        self.go_on = threading.Event()
        self.builds = Builds(self.build)

    def build(self, document):
        self.asked.append(document)
        self.builds.announce("head")
        assert self.go_on.wait(10)
        self.builds.announce("hair")
        if document is TWO:
            raise ValueError("two")
        return document.hair.particles

    def finish(self):
        self.go_on.set()
        deadline = time.perf_counter() + 10
        while time.perf_counter() < deadline:
            finished = self.builds.poll()
            if finished is not None or (self.builds.wanted is None and self.builds.seconds == 0):
                return finished
            time.sleep(0.001)
        pytest.fail("no end")


def test_a_result_comes_with_its_document():
    slow = Slow()
    slow.builds.request(ONE)
    assert slow.builds.poll() is None
    assert slow.builds.wanted is ONE
    finished = slow.finish()
    assert (finished.document, finished.result, finished.error) == (ONE, 100, None)
    assert slow.builds.wanted is None


def test_an_error_comes_as_a_value():
    slow = Slow()
    slow.builds.request(TWO)
    assert str(slow.finish().error) == "two"


def test_the_latest_wish_wins_and_there_are_never_two_at_once():
    slow = Slow()
    slow.builds.request(ONE)
    slow.builds.request(TWO)
    slow.builds.request(THREE)
    assert slow.builds.wanted is THREE
    assert slow.finish().result == 300
    assert slow.asked == [ONE, THREE]


def test_a_cancelled_build_ends_at_its_next_part_and_is_never_seen():
    slow = Slow()
    slow.builds.request(ONE)
    slow.builds.cancel()
    assert slow.builds.wanted is None
    assert slow.finish() is None
    slow.builds.request(THREE)
    assert slow.finish().result == 300


def test_closing_waits_for_the_thread():
    slow = Slow()
    slow.builds.request(ONE)
    slow.builds.close(patience=0.01)
    slow.go_on.set()
    slow.builds.close()
    assert not any(thread.name == "build" and thread.is_alive() for thread in threading.enumerate())
    assert slow.asked == [ONE]
