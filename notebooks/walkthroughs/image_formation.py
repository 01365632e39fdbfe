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
# # How light makes the picture
#
# From relief to shading to the slope-aspect-intensity surface: what a change of sun does to an
# image of mountains, on real ground, with every step checked.
#
# Marks: **[seed]** the paper says so; **[literature]** another source does; **[ours]** our
# reconstruction.

# %% tags=["parameters"]
env = None
versions = {}

# %%
import numpy as np

from pcnav_study.figures import image_row, slope_aspect_surface
from pcnav_study.notebook import open_catalog
from pcnav_study.scene import Grid, SunPosition, shade, slope_aspect

catalog = open_catalog(env=env, versions=versions)
elevation = catalog.load("elevation")
suns = catalog.load("suns")
dy, dx = Grid.of(elevation).pixel_size
print(
    f"{elevation.shape[0]} x {elevation.shape[1]} pixels of {dy:.1f} m (north-south) x {dx:.1f} m (east-west)"
)

# %% [markdown]
# ## 1. Relief
#
# Heights $z$ are all we start from. Their steepness is the **slope** $s$; the compass direction
# a slope faces, downhill, is its **aspect** $A$. The pixels are not square, so the two directions
# are differenced with different steps.

# %%
slope, aspect = slope_aspect(elevation.values, (dy, dx))
image_row(
    {"elevation, m": elevation.values, "slope, deg": slope, "aspect, deg": aspect},
    "Relief",
    aspect=dy / dx,
    colours="Viridis",
)

# %%
# A plane that rises 1 m in 10 m towards the east faces west, whatever the pixels' shape.
rows, cols = np.mgrid[0:8, 0:8]
plane_slope, plane_aspect = slope_aspect(0.1 * cols * dx, (dy, dx))
assert np.allclose(plane_slope, np.degrees(np.arctan(0.1)))
assert np.allclose(plane_aspect, 270)
# One that rises towards the south (down the rows) faces north.
assert np.allclose(slope_aspect(0.1 * rows * dy, (dy, dx))[1] % 360, 0)

# %% [markdown]
# ## 2. Shading
#
# **[literature]** A matt (Lambertian) ground under a sun of zenith angle $\varphi$ and azimuth
# $\tau$ is as bright as the cosine between its normal and the sun:
#
# $$I = \max(0, \cos\varphi \cos s + \sin\varphi \sin s \cos(\tau - A))$$
#
# **[seed]** Shade lies on one slope in the morning and on the other in the afternoon.

# %%
morning, evening = SunPosition(118, 58), SunPosition(254, 69)
pictures = {
    f"sun azimuth {sun.azimuth:.0f}°, zenith {sun.zenith:.0f}°": shade(elevation, sun=sun).values
    for sun in (morning, evening)
}
image_row(pictures, "The same ground, morning and late afternoon", aspect=dy / dx)

# %%
flat = shade(np.zeros((4, 4)), (dy, dx), morning)
assert np.allclose(flat, np.cos(np.radians(58))), "level ground is lit by the cosine of the zenith"

zenith, azimuth = np.radians([morning.zenith, morning.azimuth])
s, a = np.radians(slope), np.radians(aspect)
formula = np.cos(zenith) * np.cos(s) + np.sin(zenith) * np.sin(s) * np.cos(azimuth - a)
assert np.allclose(np.maximum(formula, 0), pictures[next(iter(pictures))], atol=1e-6)

likeness = np.corrcoef(*(image.ravel() for image in pictures.values()))[0, 1]
print(f"grey values of the two pictures correlate by {likeness:+.2f}")
assert likeness < 0, "under these suns, bright and dark have changed places"

# %% [markdown]
# ## 3. The slope-aspect-intensity surface
#
# **[literature]** Plot intensity over slope and aspect, and every pixel of an image falls on one
# surface: a cosine ridge towards the sun. Move the sun with the slider. A change of **azimuth**
# slides the surface along the aspect axis and keeps its shape; a change of **zenith** alters it.
# Cast shadows, noise and the ground's own colour are what lifts points off it.

# %%
shown = [
    SunPosition(float(azimuth), float(zenith))
    for azimuth, zenith in suns[["azimuth", "zenith"]][1:].values
]
slope_aspect_surface(shown, slope, aspect, [shade(elevation, sun=sun).values for sun in shown])


# %%
def intensity(s, a, sun):
    """A small facet of slope s and aspect a (degrees), shaded by the library."""
    rise = -np.tan(np.radians(s))
    east, north = rise * np.sin(np.radians(a)), rise * np.cos(np.radians(a))
    facet = np.fromfunction(lambda row, col: east * col - north * row, (3, 3))
    return shade(facet, (1.0, 1.0), sun)[1, 1]


for s in (5, 20, 40):
    for a in (0, 70, 200):
        turned = intensity(s, a, SunPosition(130, 50))
        assert np.isclose(turned, intensity(s, a - 30, SunPosition(100, 50))), (
            "azimuth slides along aspect"
        )
changed = [
    intensity(20, a, SunPosition(130, 50)) / intensity(20, a, SunPosition(130, 20))
    for a in (0, 130)
]
assert not np.isclose(*changed), "a zenith change is no mere change of brightness"

# %% [markdown]
# ## 4. What this means for matching
#
# **[literature]** For gentle slopes, expand to first order: the sun enters only through the
# component of the gradient along its azimuth,
#
# $$I \approx \cos\varphi - \sin\varphi \left(\sin\tau \frac{\partial z}{\partial x} + \cos\tau \frac{\partial z}{\partial y}\right).$$
#
# **[ours]** Two suns 180° apart then see pictures of opposite contrast, and two suns 90° apart see
# two unrelated derivatives of one relief. That is why grey values cannot be compared, and why the
# sign of the spectrum, direction by direction, is what changes.

# %%
gentle = elevation.values.astype(float) / 50
low, opposite = (shade(gentle, (dy, dx), SunPosition(t, 45)) for t in (100, 280))
contrast = np.corrcoef(low.ravel(), opposite.ravel())[0, 1]
print(f"gentle relief, suns 180° apart: correlation {contrast:+.3f}")
assert contrast < -0.99

across = shade(gentle, (dy, dx), SunPosition(190, 45))
print(
    f"gentle relief, suns 90° apart: correlation {np.corrcoef(low.ravel(), across.ravel())[0, 1]:+.3f}"
)
