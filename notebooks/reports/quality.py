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
# # A quality that can be trusted
#
# Every case has a known truth: right matches, near misses, places off the route, repeated texture,
# cloud, water, flat ground, another season. The calibration that ships with the package judges them;
# it was made on other sites and other suns.

# %% tags=["parameters"]
env = None
versions = {}

# %%
from IPython.display import Markdown
from sklearn.metrics import roc_curve

from pcnav_study.figures import mistake_pictures, reliability_diagram, roc_curves
from pcnav_study.notebook import open_catalog
from pcnav_study.quality import frozen
from pcnav_study.quality.judge import NEAR_MISS, OFF_ROUTE, auc, reliability, scores

catalog = open_catalog(env=env, versions=versions)
cases = catalog.load("quality_cases")
report = catalog.load("quality_calibration")
measures = catalog.load("quality_measures")
mistakes = catalog.load("quality_mistakes")
calibration = frozen()
right = (cases["error_px"] <= calibration.tolerance_px).to_numpy()
score = scores(cases, calibration)
clear = right & (cases["kind"] == "match").to_numpy()
near = ~right & cases["kind"].isin(NEAR_MISS).to_numpy()
off = ~right & cases["kind"].isin(OFF_ROUTE).to_numpy()

# %%
meaning = {
    "auc_near_miss": "AUC against near misses (1-5 px), all suns pooled",
    "auc_off_route": "AUC against windows off the route, all suns pooled",
    "false_alarm_rate": "false alarms among right matches in a clear view",
    "missed_alarm_rate": "missed alarms among near misses and windows off the route",
    "expected_calibration_error": "expected calibration error, all cases",
    "radius_coverage": "truth within the stated radius, where there is no alarm",
    "false_alarm_rate_all": "false alarms among all right matches, clouds and seasons included",
    "missed_alarm_rate_all": "missed alarms among wrong shifts of every kind",
    "missed_alarm_rate_beyond_2_px": "the same, of those wrong by over 2 px",
}
lines = ["| | measured | 95 % interval | n |", "| --- | --- | --- | --- |"]
for name, words in meaning.items():
    entry = report[name]
    if entry["value"] is not None:
        lines.append(
            f"| {words} | {entry['value']:.4f} | {entry['low']:.4f} to {entry['high']:.4f} | {entry['n']} |"
        )
Markdown("\n".join(lines))

# %%
Markdown(
    f"The alarm's threshold promises at most {report['promised_false_alarm_rate']:.0%} false alarms for matches "
    f"exchangeable with the {calibration.made_from['n_calibration']} of the calibration. Of the cases here "
    f"{report['base_rate']:.0%} are right; the probability holds for such a mixture."
)

# %% [markdown]
# ## Does the probability mean what it says?

# %%
reliability_diagram(
    reliability(cases["probability"].to_numpy(), right),
    report["expected_calibration_error"]["value"],
)

# %% [markdown]
# ## By sun difference
#
# Near misses and windows off the route together, against right matches under suns so far apart.

# %%
curves = {}
bands = {"0-30°": (0, 30), "31-100°": (31, 100), "101-180°": (101, 180), "all suns": (0, 180)}
for name, (low, high) in bands.items():
    here = cases["difference"].between(low, high).to_numpy()
    wrong = (near | off) & here
    if wrong.any() and (clear & here).any():
        chosen = wrong | (clear & here)
        missed, kept, _ = roc_curve(right[chosen], score[chosen])
        curves[name] = (missed, 1 - kept, auc(score[clear & here], score[wrong])[0])
roc_curves(curves, "Calibrated quality, by the suns' difference of azimuth")

# %% [markdown]
# ## Against other measures
#
# All suns pooled; every measure is given the same windows and the same shift.

# %%
table = measures.pivot(index="measure", columns="against", values="auc")
known = table[["near miss", "off route"]].dropna().sort_values("near miss", ascending=False)
known.style.format("{:.4f}").set_uuid("measures")

# %%
missing = measures[measures["auc"].isna()]
Markdown(
    "\n".join(f"- {m.measure}: {m.against}" for m in missing.itertuples())
    or "No measure was left out."
)

# %% [markdown]
# ## What it misses, by kind

# %%
lines = ["| wrong shift | missed | 95 % interval | n |", "| --- | --- | --- | --- |"]
names = {
    "beside": "beside the truth (1-5 px)", "plain_pc": "plain pc's near misses",
    "match": "the default method's own errors", "off_route": "off the route",
    "repeated": "repeated texture", "season": "another season", "vignette": "flat, shared vignette",
}  # fmt: skip
for kind, entry in report["missed_by_kind"].items():
    lines.append(
        f"| {names.get(kind, kind)} | {entry['value']:.3f} | {entry['low']:.3f} to {entry['high']:.3f} | {entry['n']} |"
    )
own = cases[(cases["kind"] == "match") & ~right & ~cases["alarm"]]["error_px"]
if len(own):
    lines += [
        "",
        f"The default method's own missed errors reach from {own.min():.2f} to {own.max():.2f} px.",
    ]
Markdown("\n".join(lines))

# %%
none = Markdown("It got no case wrong.")
mistake_pictures(mistakes) if mistakes.sizes["case"] else none
