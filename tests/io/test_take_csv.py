"""Head motions from a table."""

import numpy as np
import pytest

from headstudio.io.take_csv import read_take
from headstudio.scene.take import TakeError


@pytest.fixture
def written(tmp_path):
    def write(text):
        path = tmp_path / "take.csv"
        path.write_bytes(text.encode() if isinstance(text, str) else text)
        return path

    return write


def test_a_table_is_read_in_degrees_and_metres(written):
    take = read_take(written("time,rx,ry,rz,x,y,z\n0,0,0,0,0,0,0\n0.5,10,20,30,0.1,0.2,0.3\n"))
    np.testing.assert_allclose(take.times, [0, 0.5])
    np.testing.assert_allclose(take.angles[1], np.radians([10, 20, 30]))
    np.testing.assert_allclose(take.translations[1], [0.1, 0.2, 0.3])


def test_columns_come_in_any_order_and_some_may_be_missing(written):
    text = '# by hand\n\n"RY", Time, mood\n0, 0, calm\n\n45, 1, wild\n'
    take = read_take(written("\ufeff" + text))
    np.testing.assert_allclose(take.angles[1], [0, np.radians(45), 0])
    np.testing.assert_allclose(take.translations, 0)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "the file is empty"),
        ("rx,ry\n1,2\n", "line 1: the first line names the columns"),
        ("time,colour\n0,1\n", "line 1: besides time"),
        ("time,rx,rx\n0,1,1\n", "line 1: a column is there twice"),
        ("time,rx\n0,1\n1,left\n", "line 3: rx is no number: 'left'"),
        ("# header below\ntime,rx\n0,1\n1,nan\n", "line 4: rx is not finite"),
        ("time,rx\n0,1\n1\n", "line 3: 1 values for 2 columns"),
        ("time,rx\n0,1\n1,1\n1,2\n", "line 4: the time does not rise"),
        ("time,rx\n0,1\n", "two moments"),
        (b"\xff\xfe\x00time", "no text file"),
    ],
)
def test_what_is_wrong_is_said_with_its_line(written, text, complaint):
    with pytest.raises(TakeError, match=complaint) as caught:
        read_take(written(text))
    assert "take.csv" in str(caught.value)
