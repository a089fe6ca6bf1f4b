import json

import numpy as np
import pytest

from headstudio.head.scalp_settings import GrayImage
from headstudio.wisp import styling_codec as codec
from headstudio.wisp.accessories import Band, HairTie, Pin, Ribbon
from headstudio.wisp.operations import AlongPath, Braid, Bun, Constrain, Cut, InDirection, Tie, ToPoint, Updo
from headstudio.wisp.selection import Selection
from headstudio.wisp.strokes import Stroke

MASK = GrayImage(np.linspace(0, 1, 12, dtype=np.float32).reshape(3, 4))
LASSO = (((0.1, 0.2), (0.5, 0.25), (0.3, 0.9)),)
EVERYTHING = [
    (
        codec.OPERATIONS,
        (
            Tie(Selection("left and v < 0.5"), (1.0, 0.25, -0.5), 0.01, weight=0.7, colour=(0.5, 0.25, 1.0)),
            Braid(path=((0.0, 0.0, -1.0), (1.0, 1.0, 0.5)), groups=5),
            Bun(Selection(mask=MASK)),
            Updo(Selection("top", LASSO)),
            Constrain(steps=(ToPoint(), AlongPath(tolerance=0.02), InDirection(weight=0.25))),
        ),
    ),
    (codec.CUTS, (Cut(), Cut(Selection("bang"), (0.0, 0.4, 1.0), (0.0, -1.0, 0.1), 0.1))),
    (codec.STROKES, (Stroke(((0.0, 1.0, 0.0), (0.0, 1.0, 1.0)), 0.05, 2.0),)),
    (codec.ACCESSORIES, (Band(), Pin((1.0, 0.0, 0.0)), Ribbon(width=0.2), HairTie(direction=(0.0, 1.0, 0.0)))),
    (codec.OPERATIONS, ()),
]


@pytest.mark.parametrize(("kinds", "items"), EVERYTHING)
def test_what_is_written_is_what_is_read(kinds, items):
    content = codec.encode(items, kinds)
    assert codec.decode(content, kinds) == items
    assert content == codec.encode(codec.decode(content, kinds), kinds)


def test_the_file_is_readable():
    plain = json.loads(codec.encode((Tie(Selection("left"), (1.0, 0.0, -0.5)),), codec.OPERATIONS))
    assert plain == [{"kind": "tie", "selection": {"where": "left"}, "place": [1.0, 0.0, -0.5]}]


def test_a_selection_may_be_written_as_its_expression():
    assert codec.from_plain([{"kind": "bun", "selection": "back"}], codec.OPERATIONS) == (Bun(Selection("back")),)


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\xff\xfe",
        b"{}",
        b"[1]",
        b'[{"kind": "perm"}]',
        b'[{"kind": ["tie"]}]',
        b'[{"kind": "tie", "place": [0, 1]}]',
        b'[{"kind": "tie", "place": [0, 1, NaN]}]',
        b'[{"kind": "tie", "place": [0, 1, 1e9]}]',
        b'[{"kind": "tie", "place": "abc"}]',
        b'[{"kind": "tie", "tolerance": 7}]',
        b'[{"kind": "tie", "colour": "red"}]',
        b'[{"kind": "tie", "knot": 1}]',
        b'[{"kind": "tie", "selection": "v <"}]',
        b'[{"kind": "tie", "selection": 3}]',
        b'[{"kind": "tie", "selection": {"who": "me"}}]',
        b'[{"kind": "tie", "selection": {"lasso": [[[0, 0], [1, 1]]]}}]',
        b'[{"kind": "tie", "selection": {"lasso": 5}}]',
        b'[{"kind": "tie", "selection": {"mask": [[1, "x"]]}}]',
        b'[{"kind": "tie", "selection": {"mask": []}}]',
        b'[{"kind": "braid", "groups": 2}]',
        b'[{"kind": "braid", "path": [[0, 0, 0]]}]',
        b'[{"kind": "braid", "path": [[0, 0, 0], [0, 0, 0]]}]',
        b'[{"kind": "constrain", "steps": [{"kind": "tie"}]}]',
        b'[{"kind": "constrain", "steps": 4}]',
        b"[" * 100_000,
    ],
)
def test_bad_content_is_one_line(content):
    with pytest.raises(ValueError, match=r"[a-z]") as error:
        codec.decode(content, codec.OPERATIONS)
    assert "\n" not in str(error.value)


def test_a_cut_without_direction_is_refused():
    with pytest.raises(ValueError, match="no direction"):
        codec.decode(b'[{"kind": "cut", "normal": [0, 0, 0]}]', codec.CUTS)


def test_a_stroke_needs_its_path():
    with pytest.raises(ValueError, match="lacks"):
        codec.decode(b'[{"kind": "stroke", "radius": 0.02}]', codec.STROKES)
