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
# # Speed and accuracy against peers
#
# The study's matchers, other people's, and the template methods roaming window pair by window pair as
# the paper describes them: in turn on the same arrays, in one process, on one thread.

# %% tags=["parameters"]
env = None
versions = {}

# %%
from IPython.display import Markdown

from pcnav_study.figures import time_bars
from pcnav_study.notebook import open_catalog

catalog = open_catalog(env=env, versions=versions)
table = catalog.load("benchmark_table")
measured = table[table["n"] > 0]
absent = table[table["n"] == 0].groupby("method")["note"].first()
Markdown(
    "\n".join(f"- *{name}*: {note}" for name, note in absent.items()) or "All peers took part."
)

# %% [markdown]
# ## Time
#
# **[seed]** The paper finds phase correlation faster than NCC and MI. That depends on whose NCC and MI:
# as roaming windows they are slow; by FFT and running sums NCC is as fast as phase correlation.
# **[ours]** all three at their best.

# %%
time_bars(table)

# %%
ratio = measured.pivot_table(
    index="method", columns="size", values="ratio_to_fastest_peer", aggfunc="median", sort=False
)
ratio.style.format("{:.2f}", na_rep="-").set_uuid("ratio").set_caption(
    "time, over the fastest peer of the same kind"
)

# %% [markdown]
# ## Success and accuracy on the same pairs

# %%
cells = measured[measured["whose"] != "paper"]
success = cells.assign(hits=cells["success"] * cells["n"]).groupby(
    ["method", "size", "azimuth_difference"], sort=False
)
share = (success["hits"].sum() / success["n"].sum()).unstack("azimuth_difference")
share.style.format("{:.2f}", na_rep="-").set_uuid("share").set_caption(
    "share within 1 px, by azimuth difference, deg"
)

# %%
error = cells.pivot_table(
    index=["method", "size"],
    columns="azimuth_difference",
    values="rmse_px",
    aggfunc="mean",
    sort=False,
)
error.style.format("{:.3f}", na_rep="-").set_uuid("error").set_caption(
    "RMSE of correct matches, px"
)
