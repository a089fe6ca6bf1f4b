from __future__ import annotations

import numpy as np
import pytest

from headstudio.render.fibre import (
    ABSORPTIONS,
    AZIMUTHS,
    LOBES,
    SINES,
    Fibre,
    Sent,
    azimuthal,
    colour_absorption,
    fibre_tables,
    longitudinal,
    melanin_absorption,
    pile,
    scattering,
    sent_on,
)

THETA = (np.arange(600) + 0.5) / 600 * np.pi - np.pi / 2
PHI = (np.arange(256) + 0.5) / 256 * 2 * np.pi


def albedo(sin_out: float, absorption: float, fibre: Fibre) -> float:
    """The integral over all directions of the light."""
    lobes = scattering(np.sin(THETA), sin_out, PHI, absorption, fibre)
    return float((lobes * np.cos(THETA)[:, None]).sum() * (np.pi / 600) * (2 * np.pi / 256))


@pytest.mark.parametrize("roughness", [0.1, 0.3, 0.8])
@pytest.mark.parametrize("sin_out", [0.0, 0.4, -0.7, 0.95])
def test_furnace(roughness: float, sin_out: float) -> None:
    """Without absorption a fibre loses no light, whatever the angle."""
    assert 0.95 < albedo(sin_out, 0.0, Fibre(roughness, roughness)) < 1.05


def test_pigment_takes_light_away() -> None:
    albedos = [albedo(0.3, absorption, Fibre()) for absorption in (0.0, 0.1, 0.5, 2.0)]
    assert (np.diff(albedos) < -0.02).all()
    assert albedos[-1] > 0.03  # what the surface reflects stays


@pytest.mark.parametrize("variance", [0.003, 0.05, 0.4])
def test_longitudinal_lobe_is_normalised_and_peaks_at_the_mirrored_angle(variance: float) -> None:
    lobe = longitudinal(np.sin(THETA), np.full(len(THETA), -np.sin(0.5)), variance)
    assert (lobe * np.cos(THETA)).sum() * np.pi / 600 == pytest.approx(1.0, abs=0.01)
    if variance < 0.1:
        assert THETA[np.argmax(lobe)] == pytest.approx(-0.5, abs=0.05)


def test_light_passes_forward_through_light_hair_and_hardly_through_dark() -> None:
    tables = fibre_tables(Fibre())
    back, forward = tables.turned[0, SINES // 2].reshape(2, -1).sum(axis=1)
    assert forward + back == pytest.approx(1.0, abs=0.01)
    assert forward > 0.8
    dark_back, dark_forward = tables.turned[-4, SINES // 2].reshape(2, -1).sum(axis=1)
    assert dark_forward < 0.1
    assert dark_back < back


def test_tables_hold_the_reference() -> None:
    fibre = Fibre(roughness=0.4)
    tables = fibre_tables(fibre)
    assert tables.around.shape == tables.spread.shape == (ABSORPTIONS, SINES, AZIMUTHS, LOBES)
    phi, sine = (20 + 0.5) / AZIMUTHS * np.pi, (7 + 0.5) / SINES
    coded = np.linspace(0, 0.98, ABSORPTIONS)[9]
    wanted = azimuthal(np.array([phi]), np.array([sine]), np.array([coded / (1 - coded)]), fibre)[0, 0, 0]
    np.testing.assert_allclose(tables.around[9, 7, 20], wanted)
    # Light from anywhere keeps its sum.
    np.testing.assert_allclose(tables.spread.sum(axis=2), tables.around.sum(axis=2), rtol=1e-9)


def test_melanin_is_blenders() -> None:
    np.testing.assert_allclose(melanin_absorption(0.75, 0.0), -np.log(0.25) * np.array([0.506, 0.841, 1.653]))
    np.testing.assert_allclose(melanin_absorption(0.5, 1.0), -np.log(0.5) * np.array([0.343, 0.733, 1.924]))
    assert np.isfinite(melanin_absorption(1.0, 0.5)).all()
    np.testing.assert_array_equal(melanin_absorption(0.0, 0.5), 0.0)


def test_lighter_colours_absorb_less_and_pass_more_on() -> None:
    tables = fibre_tables(Fibre())
    absorption = colour_absorption(np.array([0.05, 0.3, 0.8]), 0.3)
    assert (np.diff(absorption) < 0).all()
    rate, endless = pile(sent_on(tables, absorption))
    assert (np.diff(rate) < 0).all()
    assert (np.diff(endless) > 0).all()
    assert pile(sent_on(tables, np.zeros(3)))[0] == pytest.approx(0.0, abs=0.05)


def test_a_pile_without_end_sends_back_as_much_with_a_strand_more() -> None:
    forward, back = np.array([0.8, 0.5, 0.1]), np.array([0.15, 0.12, 0.05])
    rate, endless = pile(Sent(forward, back))
    # A thin layer d over it: d of the light is met on either way, and what is sent back on each side comes back or not.
    np.testing.assert_allclose(back - 2 * (1 - forward) * endless + back * endless**2, 0.0, atol=1e-12)
    np.testing.assert_allclose(rate, 1 - forward - back * endless)


def test_parts_of_the_azimuth_hold_what_the_lobes_turn_there() -> None:
    fibre = Fibre()
    place, sine = 6, 3
    coded = np.linspace(0, 0.98, ABSORPTIONS)[place]
    phi = (np.arange(400) + 0.5) / 400 * np.pi
    around = azimuthal(phi, np.array([(sine + 0.5) / SINES]), np.array([coded / (1 - coded)]), fibre)[:, 0, 0].sum(
        axis=1
    )
    eighths = around.reshape(8, -1).sum(axis=1) * 2 * np.pi / 400
    np.testing.assert_allclose(fibre_tables(fibre).turned[place, sine], [*eighths[:4], *eighths[:3:-1]], rtol=0.02)


def test_a_pile_sends_back_what_any_light_from_above_does() -> None:
    """Against a sum over the azimuths that light comes from and goes to."""
    fibre = Fibre()
    tables = fibre_tables(fibre)
    azimuth = (
        np.arange(180) + 0.5
    ) / 180 * np.pi - np.pi / 2  # from above; weighted by the light through a level surface
    turned = np.abs((azimuth[:, None] - PHI + np.pi) % (2 * np.pi) - np.pi)
    place = 5
    coded = np.linspace(0, 0.98, ABSORPTIONS)[place]
    around = azimuthal(PHI, np.array([(SINES // 2 + 0.5) / SINES]), np.array([coded / (1 - coded)]), fibre)[
        :, 0, 0
    ].sum(axis=1)
    upward = turned < np.pi / 2  # PHI is the azimuth from where the light comes to where it goes
    sent = (np.cos(azimuth) / np.cos(azimuth).sum()) @ (upward @ around) * (2 * np.pi / len(PHI))
    forward, back, _ = sent_on(tables, np.full(1, coded / (1 - coded)))
    assert back[0] == pytest.approx(sent, rel=0.03)
    assert forward[0] + back[0] == pytest.approx(around.sum() * 2 * np.pi / len(PHI), rel=0.01)
