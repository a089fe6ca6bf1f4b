"""Ears lift hair that falls over them and do not throw it outward; before them hair that is led back rises."""

import numpy as np
import pytest

from headstudio.wisp.ears import at_ears, before_ears
from headstudio.wisp.field import force_field

from .dressed import body, hair, plain_styling, styled


@pytest.mark.parametrize("kappa", [0.5, 1.2])
def test_an_ear_throws_no_hair_outward(kappa):
    _, scalp, surroundings = body()
    joints = styled(hair(scalp, 800), bending_stiffness=kappa, density_threshold=1.0)[0].joints
    places = surroundings.proportions.measure(joints)
    over = at_ears(places.reshape(-1, 3)).reshape(places.shape[:2]).any(axis=1)
    height = np.abs(places[:, :, 1] + 1.3).argmin(axis=1)
    aside = np.abs(places[np.arange(len(places)), height, 0])[over]
    assert over.sum() > 100
    # Without the give of the ear the outermost hangs 0.3 and more farther out than most.
    assert aside.max() < np.median(aside) + 0.2


def test_what_is_pulled_back_rises_before_an_ear_and_nowhere_else():
    _, _, surroundings = body()
    field = force_field(plain_styling(back=1.0, gravity=0.0), surroundings)
    places = np.array([[1.0, -0.3, 0.2], [-1.0, -0.3, 0.2], [0.9, 0.6, 0.2], [0.0, -0.3, 1.0], [1.0, -0.3, -0.6]])
    np.testing.assert_allclose(before_ears(places) > 0.5, [True, True, False, False, False])
    rise = field.at(surroundings.proportions.place(places))[:, 1]
    assert np.all(rise[:2] > 0.6)
    assert abs(rise[2]) < 0.5
