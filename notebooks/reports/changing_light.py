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
# # Matching under changing light
#
# Every method on the same window pairs, at every azimuth difference and zenith; then one thing after
# another made worse until each method breaks.

# %% tags=["parameters"]
env = None
versions = {}

# %%
from IPython.display import Markdown

from pcnav_study.figures import light_maps, sweep_curves
from pcnav_study.notebook import open_catalog

catalog = open_catalog(env=env, versions=versions)
light = catalog.load("light_table")
sweeps = catalog.load("sweep_table")
breaks = catalog.load("break_points")

# %%
first = light.iloc[0]
cell = (
    light[light["method"] == first["method"]]
    .groupby(["azimuth_difference", "moving_zenith"])["n"]
    .sum()
)
Markdown(
    f"Windows of {first['size']} px on {' and '.join(light['site'].unique())} relief, n = {cell.min()} a cell; "
    f"shifts up to a sixth of the window; noise {first['noise']:.0%}, albedo contrast "
    f"{first['albedo_contrast']:.0%}, {'with' if first['shadows'] else 'without'} cast shadows; reference sun at "
    f"zenith {first['reference_zenith']:.0f}°. Correct means within {first['tolerance_px']:g} px."
)

# %% [markdown]
# ## Correct matches

# %%
light_maps(light, "success", "Share of correct matches")

# %%
lines = []
for method, rows in light.groupby("method", sort=False):
    totals = rows.assign(hits=rows["success"] * rows["n"]).groupby(
        ["azimuth_difference", "moving_zenith"]
    )
    share = totals["hits"].sum() / totals["n"].sum()
    azimuth, zenith = share.idxmin()
    lines.append(
        f"- **{method}**: worst cell {share.min():.2f}, at {azimuth:.0f}° azimuth difference, zenith {zenith:.0f}°"
    )
Markdown("\n".join(lines))

# %% [markdown]
# ## Accuracy of the correct ones
#
# Radial RMSE in px; a dash where no match was correct.

# %%
light_maps(light, "rmse_px", "RMSE of correct matches, px")

# %% [markdown]
# ## Where each method breaks
#
# Suns of one zenith, 45°. The dotted line is 95 %.

# %%
sweep_curves(sweeps, "noise")

# %%
sweep_curves(sweeps, "size")

# %%
sweep_curves(sweeps, "rotation")

# %%
sweep_curves(sweeps, "scale")

# %%
sweep_curves(sweeps, "relief_displacement")

# %%
sweep_curves(sweeps, "albedo_change")

# %% [markdown]
# First value at which success falls under 95 % (a dash: at none tried):

# %%
table = breaks.pivot(index=["varied", "azimuth_difference"], columns="method", values="breaks_at")
table = (
    table[list(light["method"].unique())]
    .reset_index()
    .rename(columns={"azimuth_difference": "suns apart, deg"})
)
numbers = dict.fromkeys(table.columns[1:], "{:g}")
table.style.format(numbers, na_rep="-").hide(axis="index").set_uuid("breaks")
