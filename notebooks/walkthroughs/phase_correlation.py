# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # Phase correlation, and what the sun does to it
#
# From the Fourier shift theorem to a Dirac delta; then a second sun: which sectors of the spectrum
# flip, why 90° of azimuth kills the plain peak, what zenith does, and how to find the place all the
# same. Every step is checked on real relief.
#
# Marks: **[seed]** the paper says so; **[literature]** another source does; **[ours]** our
# reconstruction.

# %% tags=["parameters"]
env = None
versions = {}

# %%
import numpy as np
from scipy import fft
from scipy.signal.windows import hann

from pcnav_study.figures import image_row, peak_by_azimuth, signs_and_surface
from pcnav_study.matching import match
from pcnav_study.matching.derivation import (
    cross_power_spectrum,
    expected_peak,
    fringes,
    sign_pattern,
)
from pcnav_study.matching.overlap import light_patterns
from pcnav_study.notebook import open_catalog
from pcnav_study.scene import Grid, SunPosition, shade

catalog = open_catalog(env=env, versions=versions)
elevation = catalog.load("elevation")
pixel_size = Grid.of(elevation).pixel_size
heights = elevation.values.astype(float)
N = 128

# %% [markdown]
# ## 1. The shift theorem
#
# **[literature]** Displace an image by $d$, and its spectrum is multiplied by a wave. Divide the
# magnitudes away and only the wave is left, the **normalised cross-power spectrum**
#
# $$Q(w) = \frac{F_1(w) \overline{F_2(w)}}{|F_1(w) \overline{F_2(w)}|} = e^{-i w \cdot d}$$
#
# whose inverse transform is a **Dirac delta** at $d$. The shift, in scikit-image's sign, is what must
# be applied to the moving image to register it.

# %%
morning = SunPosition(118, 58)
window = shade(heights, pixel_size, morning)[100 : 100 + N, 150 : 150 + N]
moved = np.roll(window, (-7, 12), axis=(0, 1))  # so (7, -12) brings it back

Q = cross_power_spectrum(window, moved)
delta = fft.ifft2(Q).real
peak = np.unravel_index(delta.argmax(), delta.shape)
shift = tuple(int((p + N // 2) % N - N // 2) for p in peak)
print(f"peak of height {delta.max():.6f} at shift {shift}")

assert shift == (7, -12)
assert np.isclose(delta.max(), 1), "all the energy is in one pixel"
assert np.allclose(Q[np.abs(Q) > 0], fringes((N, N), (7, -12))[np.abs(Q) > 0]), (
    "nothing but a wave is left"
)
assert np.isclose((delta**2).sum(), (np.abs(Q) ** 2).mean()), "Parseval"

# %% [markdown]
# **[ours]** With modulus 1 throughout, Parseval's theorem gives the surface $r$ unit energy, so the
# cosine similarity of $r$ with a delta at its peak is the peak's height itself. That is the
# **Dirac-delta quality** in its plainest form.
#
# ## 2. Real windows are not circular
#
# New ground comes in at one rim and leaves at the other. A taper hides the rims; the peak sinks below
# one, but stays where it belongs.

# %%
picture = shade(heights, pixel_size, morning)
reference, frame = picture[100 : 100 + N, 150 : 150 + N], picture[107 : 107 + N, 138 : 138 + N]
found = match(reference, frame, method="pc")
print(f"shift {found.shift.round(2)}, quality {found.quality:.2f}")
assert np.allclose(found.shift, (7, -12), atol=0.5)
assert 0.3 < found.quality < 1

# %% [markdown]
# ## 3. Another azimuth: sectors flip
#
# **[literature]** On gentle slopes a sun of azimuth $\tau$ gives the relief $z$ the spectrum
#
# $$F_I(w, \theta) = i w \sin\varphi \cos(\theta - \tau) F_z(w, \theta)$$
#
# so between two suns the wave keeps its fringes but is multiplied by a sign **[ours, from the above]**
#
# $$Q(w, \theta) = \mathrm{sgn}[\cos(\theta - \tau_1) \cos(\theta - \tau_2)] e^{-i w \cdot d}$$
#
# In the sectors between the two suns' perpendiculars, black and white change places. Slide the second
# sun away and watch the sectors open, and the delta die.

# %%
taper = np.outer(hann(N, sym=False), hann(N, sym=False))
frequency = np.hypot(*np.meshgrid(fft.fftfreq(N), fft.fftfreq(N)))
band = (frequency > 0.02) & (frequency < 0.25)
true = (7, -12)


def tapered(image, row, col):
    part = image[row : row + N, col : col + N]
    return (part - part.mean()) * taper


def without_fringes(relief, one, other, row=100, col=150, shift=true):
    """Cross-power spectrum under two suns, the shift's own wave taken out."""
    first = tapered(shade(relief, pixel_size, one), row, col)
    second = tapered(shade(relief, pixel_size, other), row + shift[0], col + shift[1])
    return cross_power_spectrum(first, second) * np.conj(fringes((N, N), shift))


gentle = heights / 5
differences = [0, 30, 60, 90, 120, 150, 180]
measured, predicted, surfaces = [], [], []
for difference in differences:
    clean = without_fringes(gentle, SunPosition(100, 45), SunPosition(100 + difference, 45))
    pattern = sign_pattern((N, N), (100, 100 + difference), pixel_size)
    agreement = (np.sign(clean.real) == pattern)[band].mean()
    assert agreement > 0.9, (
        f"the sign pattern explains {agreement:.0%} of the band at {difference} deg"
    )
    inner = np.s_[N // 2 - 32 : N // 2 + 32, N // 2 - 32 : N // 2 + 32]
    measured.append(fft.fftshift(clean.real)[inner])
    predicted.append(fft.fftshift(pattern)[inner])
    surfaces.append(
        fft.fftshift(fft.ifft2(clean * band).real)[N // 2 - 8 : N // 2 + 9, N // 2 - 8 : N // 2 + 9]
    )

signs_and_surface(
    [f"{d}°" for d in differences],
    measured,
    predicted,
    surfaces,
    "Signs of the cross-power spectrum under two suns (gentle relief)",
    frequency_step=1 / N,
    prefix="azimuth difference: ",
    first=differences.index(90),
)

# %% [markdown]
# ## 4. Why 90° kills the plain peak
#
# **[ours]** The reversed share of all directions is $\Delta\tau / 180°$, and what is reversed counts
# against. On square pixels the correlation at the true shift is therefore $1 - 2 \Delta\tau / 180°$:
# **zero at 90°, negative beyond**. (On other pixels, as here, it is the mean of the sign pattern.)
# New ground at the rims costs a factor that is the same under every sun; it is read off at 0°, and
# theory must give the rest. So the plain signed peak cannot be invariant to azimuth where shading is
# all there is. Where the ground has texture of its own, that texture does not reverse, and holds the
# peak up.

# %%
places = [(60, 60), (60, 200), (130, 120), (190, 60), (190, 220), (100, 250)]
in_band = np.array(
    [
        [
            without_fringes(gentle, SunPosition(100, 45), SunPosition(100 + d, 45), *place)
            .real[band]
            .mean()
            for place in places
        ]
        for d in differences
    ]
)
middle = np.median(in_band, axis=1)
pattern_mean = [sign_pattern((N, N), (100, 100 + d), pixel_size)[band].mean() for d in differences]
expected = middle[0] * np.array(pattern_mean)
assert np.allclose(middle, expected, atol=0.05)
assert np.allclose(pattern_mean, [expected_peak(d) for d in differences], atol=0.1), "nearly square"
assert abs(middle[differences.index(90)]) < 0.1, "gone at 90 deg"
assert middle[differences.index(150)] < -0.5, "upside down beyond"
peak_by_azimuth(differences, in_band, expected)

# %% [markdown]
# ## 5. Zenith reverses nothing
#
# **[literature]** A change of zenith flips no sector. It only disturbs the phase, and the more so the
# larger the change and the steeper the ground.

# %%
spread = {}
for name, relief in (("gentle", gentle), ("as it is", heights)):
    for change in (10, 30):
        suns = SunPosition(100, 40), SunPosition(100, 40 + change)
        clean = without_fringes(relief, *suns, shift=(0, 0))  # the same ground, so no rims
        assert (clean.real > 0)[band].mean() > 0.8, "a zenith change turned signs around"
        spread[name, change] = np.degrees(np.sqrt((np.angle(clean[band]) ** 2).mean()))
        print(
            f"{name:9} relief, zenith changed by {change} deg: phase scatter {spread[name, change]:.0f} deg"
        )
assert spread["as it is", 10] < spread["as it is", 30]
assert spread["gentle", 30] < spread["as it is", 30]

# %% [markdown]
# ## 6. Blind to every sign
#
# **[ours]** Whatever the two suns, the product of their cosines is a constant and a wave of twice the
# angle,
#
# $$\cos(\theta-\tau_1)\cos(\theta-\tau_2)=\tfrac12\left[\cos(\tau_1-\tau_2)+\cos(2\theta-\tau_1-\tau_2)\right],$$
#
# and reflectance, which no sun turns, only adds to the constant. So weigh $Q$ with each of the three
# patterns $1$, $\cos 2\theta$, $\sin 2\theta$, transform each one, and add the *squared* surfaces: the
# sum peaks at the true shift under any suns, and none need be known. At the peak each sector's sign
# is read off, the spectrum repaired, and the shift refined below a pixel. That is the study's
# default, `pc-sectors`.

# %%
f_rows, f_cols = np.meshgrid(fft.fftfreq(N), fft.fftfreq(N), indexing="ij")
basis, angle = light_patterns(f_rows, f_cols).reshape(3, -1).T, np.arctan2(f_rows, f_cols)
for one, other in np.random.default_rng(3).uniform(0, 2 * np.pi, (5, 2)):
    light = (np.cos(angle - one) * np.cos(angle - other)).ravel()
    weights, *_ = np.linalg.lstsq(basis, light, rcond=None)
    assert np.allclose(basis @ weights, light), "two suns make no other pattern"

# %%
first = shade(heights, pixel_size, SunPosition(100, 50))
for difference in differences:
    second = shade(heights, pixel_size, SunPosition(100 + difference, 50))
    pair = first[100 : 100 + N, 150 : 150 + N], second[107 : 107 + N, 138 : 138 + N]
    plain, sectors = (match(*pair, method=method) for method in ("pc", "pc-sectors"))
    miss = {r.method: np.hypot(*(r.shift - true)) for r in (plain, sectors)}
    print(
        f"{difference:3d} deg: plain misses by {miss['pc']:5.2f} px, patterns by {miss['pc-sectors']:.2f} px"
    )
    assert miss["pc-sectors"] < 1
    if difference == 90:
        assert miss["pc"] > 1, "at 90 deg the plain peak is not on the shift"
        plain_90, sectors_90 = plain.surface.values, sectors.surface.values

# %%
image_row(
    {"plain, signed": plain_90, "three patterns, squared": sectors_90},
    "Score of every shift at 90° of azimuth difference",
    colours="Viridis",
)
