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
# # Does it find its way?
#
# Fleets of simulated flights over relief: a map made under one sun, flights under others, with wind,
# faulty instruments and gusts. Every method flies the same routes in the same wind. Does the UAV arrive,
# how well does it know where it is, and does it notice when it does not?

# %% tags=["parameters"]
env = None
versions = {}

# %%
import numpy as np
import pandas as pd
from IPython.display import Markdown

from pcnav_study.figures import (
    alarm_outcomes,
    arrival_by_sun,
    drift,
    error_by_hour,
    error_by_sun_difference,
    time_parts,
)
from pcnav_study.navigation.loop import Setup
from pcnav_study.navigation.loop.outcomes import ARRIVED_PX, RIGHT_PX, WRONG_PX
from pcnav_study.navigation.verdicts import STEP_MS, pooled, verdicts
from pcnav_study.notebook import open_catalog

catalog = open_catalog(env=env, versions=versions)
everything = catalog.load("navigation_summary")
summary = everything[everything["sweep"] == "difference"]
by_hour = everything[everything["sweep"] == "hour"]
slopes = catalog.load("navigation_slopes")
lost = catalog.load("navigation_lost")
timing = catalog.load("navigation_timing")
METHOD, DEAF = "pc-sectors", "pc-sectors, alarm off"


def interval(row):
    return f"{row['low']:.1%} to {row['high']:.1%}"


# %%
differences = sorted(summary["sun_difference_deg"].round().unique())
shown = ", ".join(f"{d:.0f}°" for d in differences)
if len(differences) > 15:
    shown = f"{differences[0]:.0f}° to {differences[-1]:.0f}°"
flights = sorted({int(summary["flights"].min()), int(summary["flights"].max())})
Markdown(
    f"{summary['flights'].sum()} flights over {', '.join(summary['site'].unique())}: "
    f"{' to '.join(f'{n}' for n in flights)} for each of {summary['method'].nunique()} methods, each gust and each of "
    f"{len(differences)} sun differences ({shown}); a pixel of the map is "
    f"{summary['pixel_m'].mean():.0f} m wide. The same routes, winds and gusts come back under every sun, so flights "
    f"pooled over the suns are not independent, and intervals over them are somewhat too narrow."
)

# %% [markdown]
# ## What was demanded, and what was found
#
# Of `pc-sectors`. Arrivals and errors are those of the worst sun difference; the alarm's outcomes are of all
# flights together. *Unproven*: the demand is met, but the interval reaches beyond it, so that more flights
# are needed to be sure.

# %%
lines = ["| demanded | found | 95 % interval | n | where | verdict |", "|" + " --- |" * 6]
for row in verdicts(summary, timing, METHOD).to_dict("records"):
    share = row["limit"] < 1 and "RMSE" not in row["demand"]
    sign = "at least" if row["least"] else "at most"
    limit = f"{row['limit']:.0%}" if share else f"{row['limit']:g}"
    demand = f"{row['demand']}: {sign} {limit}"
    if pd.isna(row["value"]):
        found = "never trusted" if row["n"] else "not measured"
        verdict = "**does not hold**" if row["n"] else "-"
        lines.append(f"| {demand} | {found} | | {row['n'] or ''} | {row['where']} | {verdict} |")
        continue
    verdict = "holds" if row["holds"] else "**does not hold**"
    bounds = ""
    if not pd.isna(row["low"]):
        bounds = interval(row) if share else f"{row['low']:.2f} to {row['high']:.2f}"
        beyond = row["low"] < row["limit"] if row["least"] else row["high"] > row["limit"]
        verdict += ", unproven" if row["holds"] and beyond else ""
    found = f"{row['value']:.1%}" if share else f"{row['value']:.2f}"
    lines.append(
        f"| {demand} | {found} | {bounds} | {row['n'] or ''} | {row['where']} | {verdict} |"
    )
Markdown("\n".join(lines))

# %% [markdown]
# ## Does it arrive?
#
# **[ours]** A flight has arrived if the UAV believes so and is right. It is lost after too many alarms in a
# row, off the map, or out of time. Odometry has no map and no alarm; it is flown without gusts only.
# A gust displaces the UAV once, by a tenth of the frame's width up to the size named. The thick line is
# `pc-sectors`.

# %%
own = summary[summary["method"] == METHOD]
low = own.loc[own["arrival_rate"].idxmin()]
Markdown(
    f"Right means within {ARRIVED_PX:g} px of the route's end. `{METHOD}` arrives least often with the suns "
    f"{low['sun_difference_deg']:.0f}° apart and {'a gust' if low['gust'] else 'no gust'}: {low['arrival_rate']:.1%} "
    f"({low['arrival_low']:.1%} to {low['arrival_high']:.1%}, n = {low['flights']})."
    if low["arrival_rate"] < 1
    else f"Right means within {ARRIVED_PX:g} px of the route's end. `{METHOD}` arrives every time, n = {own['flights'].sum()}."
)

# %%
arrival_by_sun(summary)

# %% [markdown]
# ## How well does it know its position, and the next one?
#
# Only moments at which the UAV trusts its position count. The next position is predicted from the same
# frame, one leg ahead: by the part of the picture that lies there, and the leg to fly. Wind and the
# instruments' errors on that leg are in its error; gusts are not. Dashed: the demands.

# %%
error_by_sun_difference(summary)

# %% [markdown]
# Each number at the sun difference at which it is worst:

# %%
worst = summary.assign(gust=np.where(summary["gust"] > 0, "yes", "no")).groupby(["method", "gust"])
table = worst.agg(
    arrived=("arrival_rate", "min"),
    rmse=("rmse_px", "max"),
    next_rmse=("next_rmse_px", "max"),
    trusted=("trusted_share", "min"),
    wrong=("wrong_rate", "max"),
).reset_index()
names = {
    "arrived": "arrived (lowest)",
    "rmse": "RMSE, px (highest)",
    "next_rmse": "next RMSE, px (highest)",
    "trusted": "frames trusted (lowest)",
    "wrong": f"trusted, yet off by over {WRONG_PX:g} px (highest)",
}
table = table.rename(columns=names)
formats = dict.fromkeys(table.columns[2:], "{:.0%}") | dict.fromkeys(table.columns[3:5], "{:.2f}")
table.style.format(formats, na_rep="-").hide(axis="index").set_uuid("worst")

# %% [markdown]
# ## From sunrise to sunset
#
# The same map, made at one hour, flown with at every hour of other days.

# %%
error_by_hour(by_hour) if len(by_hour) else Markdown(
    "This run flew at no other hours; `kedro run --env=full --pipelines=navigate` does."
)

# %% [markdown]
# ## What the alarm is worth
#
# The same gusts meet a UAV that heeds the alarm and one that believes every fix. All suns pooled.

# %%
pair = summary[summary["method"].isin([METHOD, DEAF]) & (summary["gust"] > 0)]
outcomes = pooled(pair, ["gust", "method"])
alarm_outcomes(outcomes) if len(outcomes) else Markdown("No flight met a gust.")

# %%
whole = pooled(summary[summary["method"].isin([METHOD, DEAF])], ["method"])
whole = whole.set_index(["method", "outcome"])
words = {
    "alarm_recall": "gusts that raised an alarm in the very next frame",
    "false_alarm_rate": f"false alarms among fixes of an undisturbed UAV that were right within {RIGHT_PX:g} px",
    "recovery_rate": "flights that came back to the route after the gust and knew where they were",
}
lines = []
for (method, outcome), row in whole.iterrows():
    if outcome in words:
        text = f"**{method}**, {words[outcome]}: {row['value']:.1%} ({interval(row)}, n = {row['n']:.0f})"
        lines.append(f"- {text}.")
Markdown("\n".join(lines))

# %% [markdown]
# ## Drift
#
# **[literature]** Odometry adds up its errors leg by leg. A fix on the map starts anew every time. The slope
# is that of a line through what each flight without gusts has added to the error of its take-off, averaged
# over the suns; the interval is over routes.

# %%
drift(slopes) if len(slopes) else Markdown("No flight was without gusts.")

# %%
lines = []
for site, rows in slopes.groupby("site"):
    rows = rows.set_index("method")
    for method in rows.index:
        row = rows.loc[method]
        if method != METHOD and "odometry" not in method:
            continue
        low, high = row["slope_low"], row["slope_high"]
        known = not np.isnan(low)
        grows = "grows" if low > 0 else "shrinks" if high < 0 else "no growth to be seen"
        text = f"{row['slope_m_per_km']:+.2f} m per km"
        text += f" ({low:+.2f} to {high:+.2f}): {grows}" if known else ""
        lines.append(f"- {site}, **{method}**: {text}; n = {row['routes']:.0f} routes.")
Markdown("\n".join(lines))

# %% [markdown]
# ## Where each method is lost
#
# The first sun difference at which fewer than 95 % of its flights without gusts arrive (a dash: at none
# tried).

# %%
gone = lost.pivot(index="method", columns="site", values="lost_from_deg").rename_axis(columns=None)
gone = gone.reset_index()
gone.style.format(dict.fromkeys(gone.columns[1:], "{:.0f}°"), na_rep="-").hide(
    axis="index"
).set_uuid("lost")

# %% [markdown]
# ## Where the time goes
#
# An ordinary step: one photograph, its position, trust in it, the next position, and where to steer.
# After an alarm the wider searches come on top.

# %%
time_parts(timing, STEP_MS)

# %%
steps = timing[timing["part"] == "whole step"]
Markdown(
    "\n".join(
        f"- frames of {row.frame_px} px: {row.ms:.1f} ms a step, "
        f"{'within' if row.ms <= STEP_MS else '**beyond**'} {STEP_MS:g} ms"
        for row in steps.itertuples()
    )
)

# %% [markdown]
# ## What the simulation leaves out

# %%
setup = Setup()
focal = setup.camera.focal_px * setup.frame_px / setup.camera_px
floor = np.sqrt(2) * focal * np.tan(np.radians(setup.instruments.attitude_deg))
Markdown(
    f"- The attitude is measured with an error of {setup.instruments.attitude_deg:g}° (standard deviation, default "
    f"set-up). From the flight's height, {focal:.0f} px, that alone is {floor:.2f} px: no method gets below it.\n"
    "- The velocity sensor does not feel the gust: the UAV is carried off without any sign of it. A real one "
    "would notice something; this is the worst case.\n"
    "- The sun stands still during a flight.\n"
    "- The elevation model on board is without error, and so are the map's georeference and the camera's calibration.\n"
    "- The ground is Lambertian: no gloss, no vegetation, no snow, no clouds, no seasons.\n"
    "- The trust calibration ships with the package. It was made on other sites, and its probability holds for "
    "their mixture of right and wrong matches."
)
