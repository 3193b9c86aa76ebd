"""The laws over arrays."""

import numpy as np
import pytest
from stiction import ParameterError, laws


def test_original_slides_sticks_and_blends() -> None:
    law = laws.Original(mu_s=0.3, mu_d=0.2, vs=0.1, c=1.5, dm=0.01)
    found = law.evaluate([-1.0, 0.0, 0.1, 0.125, 1.0])
    # Half way from 0.3 to 0.2 in the middle of the transition, by symmetry of the quintic.
    np.testing.assert_allclose(found.mu, [0.2, 0.0, -0.3, -0.25, -0.2], atol=1e-15)
    np.testing.assert_array_equal(found.regime, [2, 0, 1, 1, 2])
    # At rest half the creep: psi(1/2) = 203/256 of the static coefficient.
    held = law.evaluate(0.0, 0.005)
    assert held.mu == pytest.approx(-0.3 * 203 / 256, rel=1e-15) and held.creep == 0.005
    assert law.evaluate(1.0, 0.005).creep == 0.0


def test_original_is_odd_and_bounded() -> None:
    law = laws.Original(mu_s=0.3, mu_d=0.2)
    v = np.linspace(-1, 1, 1001)[:, None]
    d = np.linspace(-0.01, 0.01, 21)
    found = law.evaluate(v, d).mu
    assert found.shape == (1001, 21) and np.abs(found).max() <= np.nextafter(0.3, 1)
    np.testing.assert_array_equal(found, -law.evaluate(-v, -d).mu)


def test_lugre_is_on_its_stribeck_curve_in_steady_motion() -> None:
    law = laws.LuGre(mu_s=0.3, mu_d=0.25, sigma0=1e4, sigma1=50.0, sigma2=0.4, vs=1e-3)
    v = np.array([-0.1, -1e-3, 0.0, 1e-3, 0.1])
    curve = 0.25 + 0.05 * np.exp(-((v / 1e-3) ** 2))
    np.testing.assert_allclose(law.stribeck(v), curve, rtol=1e-14)
    expected = -np.sign(v) * (curve * 20.0 + 1.0) - 0.4 * v
    np.testing.assert_allclose(law.steady_state(v, load=20.0, preload=1.0), expected, rtol=1e-14)
    # The same as the bristles after a long time, and as bristles that do not change any more.
    long = law.evaluate(v, 0.0, load=20.0, preload=1.0, dt=1e9)
    np.testing.assert_allclose(long.force, expected, rtol=1e-9)
    still = law.evaluate(v, long.deflection, load=20.0, preload=1.0)
    assert np.abs(still.rate).max() < 1e-12


def test_steps_of_the_bristles_converge_with_first_order() -> None:
    """The deflection from rest at a constant speed is G/s0 (1 - exp(-s0 v t/G)) below vs -> 0."""
    law = laws.LuGre(mu_s=0.25, mu_d=0.25, sigma0=1e4, sigma1=0.0)
    level, speed, end = 0.25, 1e-3, 0.05
    exact = level / 1e4 * (1 - np.exp(-1e4 * speed * end / level))
    errors = []
    for count in (100, 200):
        z = np.zeros(())
        for _ in range(count):
            z = law.evaluate(speed, z, dt=end / count).deflection
        errors.append(abs(float(z) - exact))
    assert errors[1] / errors[0] == pytest.approx(0.5, abs=0.02)


def test_parameters_out_of_range_are_refused() -> None:
    for wrong in ({"mu_s": 0.0}, {"mu_d": float("nan")}, {"vs": -1.0}, {"c": 1.0}):
        with pytest.raises(ParameterError, match=next(iter(wrong))):
            laws.Original(**{"mu_s": 0.3, "mu_d": 0.2, **wrong})  # type: ignore[arg-type]
    with pytest.raises(ParameterError, match="effect"):
        laws.Original(0.3, 0.2, effect="none")  # type: ignore[arg-type]
    law = laws.LuGre(0.3, 0.2, sigma1=0.0)
    for name in ("velocity", "deflection", "load", "preload"):
        with pytest.raises(ParameterError, match=name):
            law.evaluate(**{"velocity": 1.0, name: [0.0, float("nan")]})  # type: ignore[arg-type]
    with pytest.raises(ParameterError, match="dt"):
        law.evaluate(1.0, dt=-1.0)
    with pytest.raises(ParameterError, match="negative"):
        law.evaluate(1.0, load=-1.0)
    with pytest.raises(ValueError, match="broadcast"):
        law.evaluate([1.0, 2.0], [1.0, 2.0, 3.0])
