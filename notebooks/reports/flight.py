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
# # A flight, found on its map
#
# Every photograph of a flight folder, rectified by its recorded pose, sought on the map, and placed
# there: where the camera was, how far that is from the recorded position, and whether to believe it.

# %% tags=["parameters"]
env = None
versions = {}

# %%
from IPython.display import Markdown

from pcnav_study.figures import flight_errors, flight_map, frame_pictures
from pcnav_study.notebook import open_catalog

catalog = open_catalog(env=env, versions=versions)
table = catalog.load("flight_positions")
footprints = catalog.load("flight_footprints")
constants = catalog.load("flight_calibration")
pictures = catalog.load("flight_pictures")
alarmed = table["alarm"].astype(bool)
placed = table["easting"].notna()

# %%
believed = table.loc[placed & ~alarmed, "error_m"]
lines = [
    f"{len(table)} frames, method `{table['method'].iloc[0]}`: {placed.sum()} placed on the map, "
    f"{(placed & alarmed).sum()} of them with an alarm; {(~placed).sum()} could not be placed."
]
if len(believed):
    lines.append(
        f"Of the {len(believed)} without alarm, the distance from the recorded position has a median of "
        f"{believed.median():.1f} m, and nine in ten lie within {believed.quantile(0.9):.1f} m "
        f"(largest {believed.max():.1f} m). The priors were wrong by {table['prior_error_m'].median():.1f} m in the median."
    )
if constants["frames"]:
    lines.append(
        f"The camera looks {constants['look_along_m']:+.1f} m along and {constants['look_across_m']:+.1f} m across the "
        f"heading, and the map lies {constants['bias_east_m']:+.1f} m east and {constants['bias_north_m']:+.1f} m north "
        f"(n = {constants['frames']} frames, scatter {constants['scatter_m']:.1f} m per axis). "
        f"Calibration: {table.loc[placed, 'calibration'].iloc[0]}."
    )
Markdown("\n\n".join(lines))

# %% [markdown]
# ## The route on the map
#
# The outline of each picture on the ground, the camera's position found, and the recorded route. An
# alarm says: do not believe this one.

# %%
flight_map(table, footprints, pictures)

# %% [markdown]
# ## How far from the record

# %%
flight_errors(table) if placed.any() else Markdown("No frame was placed.")

# %%
names = [
    "frame",
    "status",
    "easting",
    "northing",
    "error_m",
    "quality",
    "agreement",
    "iterations",
    "sun",
]
digits = {"easting": 1, "northing": 1, "error_m": 2, "quality": 3, "agreement": 2, "iterations": 0}
shown = table[names].astype({name: float for name in digits})
shown.style.format({name: f"{{:.{n}f}}" for name, n in digits.items()}, na_rep="-").hide(
    axis="index"
).set_uuid("flight")

# %% [markdown]
# ## A handful of frames, seen
#
# As taken; as the map would show it; the map at the place found; and the coarse search's score of
# every shift within reach of the prior, its best bright.

# %%
from IPython.display import display

status = table.set_index("frame")["status"]
for frame in pictures["frame"].values:
    display(frame_pictures(pictures, str(frame), status[str(frame)]))
