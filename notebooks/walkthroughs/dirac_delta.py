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
# # From a Dirac delta to an alarm
#
# Why the height of a peak is a cosine, what unrelated windows reach by chance, why a near miss
# still looks good, and how evidence becomes a probability with a guaranteed alarm. Every step is
# checked.
#
# Marks: **[seed]** the paper says so; **[literature]** another source does; **[ours]** our
# reconstruction.

# %% tags=["parameters"]
env = None
versions = {}

# %%
import numpy as np
from scipy import fft

from pcnav_study.figures import evidence_by_distance, null_histogram
from pcnav_study.matching import match, prepare
from pcnav_study.matching.overlap import overlap_of
from pcnav_study.matching.pair import Pair
from pcnav_study.matching.refine import delta_quality
from pcnav_study.notebook import open_catalog
from pcnav_study.quality import delta_similarity, evidence_of, frozen, sector_null_level, trust
from pcnav_study.quality.calibration import conformal_threshold
from pcnav_study.quality.null import density, expected_null
from pcnav_study.scene import Grid, SunPosition
from pcnav_study.scene.trials import Conditions, Site

catalog = open_catalog(env=env, versions=versions)
elevation = catalog.load("elevation")
site = Site(elevation.values.astype(float), Grid.of(elevation).pixel_size)
rng = np.random.default_rng(7)
N = 64

# %% [markdown]
# ## 1. Parseval: the height of the peak is a cosine
#
# **[seed]** The paper judges a match by its likeness to a Dirac delta; its formula is not at hand.
# **[ours]** The normalised cross-power spectrum has modulus 1 throughout, so by Parseval's theorem
# its surface $r$ has unit energy, and the cosine similarity of $r$ with a delta at $x$ is
#
# $$\frac{\langle r, \delta_x \rangle}{\|r\| \|\delta_x\|} = r(x).$$

# %%
a, b = rng.standard_normal((2, N, N))
product = fft.fft2(a) * fft.fft2(a + b).conj()
r = fft.ifft2(product / np.abs(product)).real
peak = tuple(int(v) for v in np.unravel_index(r.argmax(), r.shape))
delta = np.zeros((N, N))
delta[peak] = 1
cosine = (r * delta).sum() / np.linalg.norm(r) / np.linalg.norm(delta)
print(f"energy {np.sum(r**2):.6f}, cosine {cosine:.6f}, height {r[peak]:.6f}")
assert np.isclose((r**2).sum(), 1), "unit energy"
assert np.isclose(cosine, r[peak])
assert np.isclose(delta_similarity(r, peak, radius=0), r[peak])

# %% [markdown]
# **[ours]** Under another sun whole sectors of the spectrum change sign. So the surface is taken
# sector by sector, under one low-pass of unit sum, and their absolute values are added: the same
# cosine, after every sector's sign is repaired. A perfect match still has quality 1, and a reversed
# one too.

# %%
windows = prepare(a), prepare(-a)
still = np.zeros(2)
for other in (a, -a):
    overlap = overlap_of(Pair(prepare(a), prepare(other), (4, 4)), still)
    assert np.isclose(delta_quality(overlap, still), 1, atol=1e-4)

# %% [markdown]
# ## 2. The null: what chance reaches
#
# **[ours]** Unrelated windows have uniform phases, so each sector's surface is nearly normal. Its
# variance follows from the low-pass and from the taper, which makes neighbouring coefficients alike
# **[literature: Middleton 1948]**; the density of the quality is the convolution of half-normal ones.

# %%
qualities = []
for _ in range(600):
    pair = Pair(*(prepare(rng.standard_normal((N, N))) for _ in range(2)), (4, 4))
    qualities.append(delta_quality(overlap_of(pair, still), still))
qualities = np.array(qualities)
level = sector_null_level((N, N), false_match_rate=0.01)
print(f"mean {qualities.mean():.4f}, in theory {expected_null((N, N)):.4f}")
print(f"above the 1 % level {level:.3f}: {np.mean(qualities > level):.3f}")
assert np.isclose(qualities.mean(), expected_null((N, N)), rtol=0.05)
assert np.mean(qualities > level) < 0.03
null_histogram(qualities, *density((N, N)), level)

# %% [markdown]
# The level is for one shift. The best of many is bounded by their union.
#
# ## 3. A near miss keeps much of its quality
#
# The null tells overlap from none. It does not tell a right shift from one next to it: each sector's
# surface is a ridge across its own direction, and some ridges still run through a shift a pixel or
# two off. **[ours]** What is lost is agreement: where each sector would move the shift (*pull*), the
# share of energy at the shift, and whether the shift is the *summit* of its surroundings.

# %%
distance = np.arange(0, 5.01, 0.25)
curves = {"quality": [], "share": [], "summit": [], "pull": []}
for difference in (0, 45, 90, 135, 180):
    suns = SunPosition(100, 45), SunPosition(100 + difference, 45)
    trials = site.draw(Conditions(*suns, noise=0.15, albedo_contrast=0.1), 2 * N, 3, rng)
    for one, other, shift in zip(trials.reference, trials.moving, trials.shift, strict=True):
        ours, theirs = prepare(one), prepare(other)
        surface = match(ours, theirs).surface
        angle = rng.uniform(0, 2 * np.pi)
        way = np.array([np.sin(angle), np.cos(angle)])
        seen = [evidence_of(ours, theirs, shift + far * way, surface) for far in distance]
        for name, values in curves.items():
            values.append([getattr(one_seen, name) for one_seen in seen])
curves = {name: np.array(values) for name, values in curves.items()}
right, beside = curves["quality"][:, 0], curves["quality"][:, 4]
assert beside.max() > right.min(), "no level of quality alone parts them, suns pooled"
assert np.median(curves["pull"][:, 4]) > 1.3 * np.median(curves["pull"][:, 0])
evidence_by_distance(distance, curves)

# %% [markdown]
# ## 4. The alarm
#
# **[ours]** A logistic regression of that evidence ranks the matches, an isotonic one on other sites
# turns the rank into a probability. **[literature: Vovk, Gammerman, Shafer 2005]** The threshold is a
# conformal quantile: the $\lfloor \alpha (n + 1) \rfloor$-th smallest score of $n$ right matches. A new
# right match is as likely to take any rank among them, so it falls below with probability $\alpha$ at
# most, whatever the scores' distribution.

# %%
alpha, n = 0.05, 60
false = []
for _ in range(4000):
    old, new = rng.gamma(2.0, size=n), rng.gamma(2.0)
    false.append(new < conformal_threshold(old, alpha))
print(f"promised {alpha:.3f}, simulated {np.mean(false):.3f}")
assert np.mean(false) < alpha + 3 * np.sqrt(alpha / 4000)

# %% [markdown]
# In use it is one call after a match.

# %%
known = frozen()
trials = site.draw(Conditions(SunPosition(100, 45), SunPosition(190, 45)), 2 * N, 1, rng)
one, other, shift = trials.reference[0], trials.moving[0], trials.shift[0]
found = match(one, other)
good = trust(found, one, other)
print(f"right: p = {good.probability:.3f}, radius {good.radius_px:.2f} px, alarm {good.alarm}")
empty = np.full((2 * N, 2 * N), 7.0)
nothing = trust(match(one, empty), one, empty)
noise = rng.standard_normal((2 * N, 2 * N))
chance = trust(match(one, noise), one, noise)
print(f"noise: p = {chance.probability:.3f}, alarm {chance.alarm}; empty: alarm {nothing.alarm}")
assert not good.alarm
assert good.probability > 0.9
assert np.hypot(*(found.shift - shift)) <= good.radius_px
assert chance.alarm
assert nothing.alarm
