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
# # Rectification by hand
#
# From attitude to ground pixel: where a pixel of a tilted picture lies on the map, on level ground
# and on real relief; and why a wrong position must be corrected in turn with the rectification.
#
# The marks: **[seed]** the paper says it, **[literature]** another source does, **[ours]** reconstructed
# here.

# %% tags=["parameters"]
env = None
versions = {}

# %%
import numpy as np

from pcnav_study.figures import image_row
from pcnav_study.frames import rectify
from pcnav_study.matching import match
from pcnav_study.notebook import open_catalog
from pcnav_study.scene import Camera, Grid, Pose

catalog = open_catalog(env=env, versions=versions)
elevation = catalog.load("elevation")
reference = catalog.load("reference_map")
flight = catalog.load("frames")
suns = catalog.load("suns")
frame = flight.isel(frame=int(np.argmin(flight["sun_difference"].values)))
camera = Camera((flight.sizes["row"], flight.sizes["col"]), float(flight.attrs["focal_px"]))
f"{flight.sizes['frame']} frames under {len(suns) - 1} suns; shown: {frame['frame'].values}"

# %% [markdown]
# ## 1. The attitude is a rotation
#
# **[seed]** With altitude and attitude known, scale and geometric distortion can be taken out. The
# paper does not say how; from here on it is photogrammetry's way **[literature]**.
#
# Camera axes: $x$ to the right of the picture, $y$ to its top, $z$ out of its back. Yaw turns clockwise
# from north, a nose up tips the view forward, a right wing down tips it to the left. Each is a turn
# about one axis, and their product takes camera axes to the world's:
#
# $$R = R_z(-\psi)\, R_x(\theta)\, R_y(\rho)$$

# %%
yaw, pitch, roll = (float(frame[name]) for name in ("yaw", "pitch", "roll"))
psi, theta, rho = np.radians([yaw, pitch, roll])
turn_z = np.array([[np.cos(psi), np.sin(psi), 0], [-np.sin(psi), np.cos(psi), 0], [0, 0, 1]])
turn_x = np.array(
    [[1, 0, 0], [0, np.cos(theta), -np.sin(theta)], [0, np.sin(theta), np.cos(theta)]]
)
turn_y = np.array([[np.cos(rho), 0, np.sin(rho)], [0, 1, 0], [-np.sin(rho), 0, np.cos(rho)]])
rotation = turn_z @ turn_x @ turn_y
position = np.array([float(frame["east"]), float(frame["north"]), float(frame["height"])])
pose = Pose.from_yaw_pitch_roll(position, yaw, pitch, roll)
assert np.allclose(rotation, pose.rotation), "by hand as the study does it"
assert np.allclose(rotation @ rotation.T, np.eye(3)), "a turn keeps lengths"
rotation.round(4)

# %% [markdown]
# ## 2. A pixel is a ray, and a ray meets the ground
#
# A pixel $(r, c)$ lies $c - c_0$ to the right of the principal point and $r_0 - r$ above it. Its ray
# $d = R\,[(c - c_0)/f,\ (r_0 - r)/f,\ -1]$ leaves the camera $C$ and meets level ground of height $h$ at
# $C + d\,(h - C_z)/d_z$.

# %%
level = float(elevation.mean())
row, col = 20.0, 70.0
row0, col0 = camera.centre
ray = rotation @ np.array([(col - col0) / camera.focal_px, (row0 - row) / camera.focal_px, -1.0])
ground = position + ray * (level - position[2]) / ray[2]
back_row, back_col = camera.project(ground, pose)
assert np.allclose([back_row, back_col], [row, col]), "there and back again"
assert np.isclose(ground[2], level)
print(f"pixel ({row:g}, {col:g}) looks at {ground[0]:.1f} E, {ground[1]:.1f} N")

# %% [markdown]
# ## 3. On level ground all of it is one matrix
#
# For ground points $(X, Y)$ of one height the way back is a homography **[literature]** (Hartley and
# Zisserman, 2004, 8.1.1): $K R^T [e_1\ e_2\ \ -C']$, with $C' = C - h\,e_3$.

# %%
to_image = np.array([[camera.focal_px, 0, -col0], [0, -camera.focal_px, -row0], [0, 0, -1.0]])
offset = np.array([position[0], position[1], position[2] - level])
homography = to_image @ rotation.T @ np.column_stack([[1, 0, 0], [0, 1, 0], -offset])
x, y, w = homography @ np.array([ground[0], ground[1], 1.0])
assert np.allclose([y / w, x / w], [row, col], atol=1e-6), "the homography agrees with the ray"

# %% [markdown]
# ## 4. Rectify: ask every map pixel where it was seen
#
# Going backward leaves no holes: each map pixel, with its height, is projected into the picture and
# looked up there. With an elevation model in place of one height this is an orthophoto.

# %%
grid = Grid.of(reference)
size = 64
top, left = (round(float(v)) - size // 2 for v in grid.row_col(position[0], position[1]))
part = np.s_[top : top + size, left : left + size]
window = grid.window(top, left, (size, size))
image = frame["frames"].values
flat = rectify(image, camera, pose, window, level)
ortho = rectify(image, camera, pose, window, elevation.values[part])
there = reference.values[part]
image_row(
    {"frame": image, "level ground": flat, "over relief": ortho, "map": there},
    f"yaw {yaw:.0f}°, pitch {pitch:.1f}°, roll {roll:.1f}°",
)


# %%
def alike(one, other):
    """Correlation of two pictures where both see something."""
    both = np.isfinite(one) & np.isfinite(other)
    return float(np.corrcoef(one[both], other[both])[0, 1])


print(f"likeness to the map: level {alike(flat, there):.3f}, over relief {alike(ortho, there):.3f}")
assert alike(ortho, there) > alike(flat, there), "relief displacement is gone"

# %% [markdown]
# ## 5. A height error moves a pixel outward
#
# Ground higher by $\Delta h$, seen at distance $s$ from the nadir from a height $H$ above it, is drawn
# $s\,\Delta h / H$ too far out. That is what the relief costs where there is no elevation model.

# %%
height = position[2] - level
nadir = Pose.from_yaw_pitch_roll(position, 0.0)
aside, rise = 1000.0, 200.0
_, seen = camera.project(position + np.array([aside, 0, rise - height]), nadir)
_, foot = camera.project(position + np.array([aside, 0, -height]), nadir)
drawn = (seen - foot) * height / camera.focal_px
assert np.isclose(drawn, aside * rise / (height - rise)), "exactly, with H above the higher ground"
print(f"{rise:g} m of relief, {aside:g} m aside, from {height:.0f} m: {drawn:.0f} m")

# %% [markdown]
# ## 6. From a wrong position, in turn
#
# The UAV does not know where it is. Rectified from a wrong position over relief, the picture is not
# only displaced but distorted, for each pixel takes another's height. So the study matches, corrects
# the position, rectifies anew, until the shift is below a tenth of a pixel **[ours]**.

# %%
dy, dx = grid.pixel_size
believed = position + np.array([3 * dx, -2 * dy, 0.0])
reach, shifts = 8, []
for _ in range(5):
    at = window.window(reach, reach, (size - 2 * reach, size - 2 * reach))
    inner = np.s_[top + reach : top + size - reach, left + reach : left + size - reach]
    guess = Pose.from_yaw_pitch_roll(believed, yaw, pitch, roll)
    moving = rectify(image, camera, guess, at, elevation.values[inner])
    shift = match(there, moving, max_shift=reach).shift
    believed = believed + np.array([shift[1] * dx, -shift[0] * dy, 0.0])
    shifts.append(float(np.hypot(*shift)))
    if shifts[-1] < 0.1:
        break
left_px = np.hypot((believed[0] - position[0]) / dx, (believed[1] - position[1]) / dy)
print("shifts, px:", [round(s, 3) for s in shifts], f"; {left_px:.2f} px from the truth")
assert shifts[-1] < shifts[0], "each turn leaves less"
assert left_px < 1.0, "within a pixel of the truth"
