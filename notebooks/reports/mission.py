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
# # A flight that finds itself
#
# A UAV without GPS flies over mountains. Its only map is a picture taken under another sun. After every
# leg it takes one photograph, and from that works out where it is, where the next leg will take it, and
# whether to believe either. Then a gust carries it off.

# %% tags=["parameters"]
env = None
versions = {}

# %%
import numpy as np
from IPython.display import Markdown

from pcnav_study.figures import mission_animation, mission_panels
from pcnav_study.navigation.loop.outcomes import ARRIVED_PX, WRONG_PX
from pcnav_study.notebook import open_catalog
from pcnav_study.scene.grid import Grid

catalog = open_catalog(env=env, versions=versions)
log = catalog.load("mission_log")
picture = catalog.load("mission_map")
pixel = float(np.sqrt(np.prod(Grid.of(picture).pixel_size)))
flights = {method: rows for method, rows in log.groupby("method", sort=False)}
first = next(iter(flights))
route = np.array(picture.attrs["route"]).reshape(-1, 2)
length = np.hypot(*np.diff(route, axis=0).T).sum()
apart = abs((picture.attrs["flight_azimuth"] - picture.attrs["map_azimuth"] + 180) % 360 - 180)

# %%
lines = [
    f"The route is {length / 1000:.1f} km long, a pixel of the map {pixel:.0f} m wide. On the map the sun stands "
    f"at azimuth {picture.attrs['map_azimuth']:.0f}°, on the flight ({picture.attrs['time']}) at "
    f"{picture.attrs['flight_azimuth']:.0f}°: {apart:.0f}° apart. Many a slope that was lit is in shade, and the other way round. "
    f"The same wind, gust and noise meet every method.",
    "",
]
for method, flight in flights.items():
    end = flight.iloc[-1]
    near = end["to_end_m"] <= ARRIVED_PX * pixel
    ending = end["ending"]
    if ending == "arrived":
        ending = f"arrived, {end['to_end_m']:.0f} m from the route's end"
        ending += "" if near else f" (**it is mistaken**: farther than {ARRIVED_PX:g} px)"
    trusted = flight.loc[flight["trusted"], "error_m"]
    text = f"- **{method}**: {ending}, after {len(flight)} frames; "
    if len(trusted):
        text += (
            f"off by at most {trusted.max():.0f} m ({trusted.max() / pixel:.2f} px) while it trusted its position "
            f"(n = {len(trusted)} frames)"
        )
        wrong = int((trusted > WRONG_PX * pixel).sum())
        text += f", by over {WRONG_PX:g} px in {wrong} of them" if wrong else ""
    else:
        text += "it never trusted its position"
    vain = int((flight["alarm"] & (flight["push_m"] == 0)).sum())
    text += f"; {vain or 'no'} alarm{'' if vain == 1 else 's'} apart from the gust's"
    lines.append(text + ".")
Markdown("\n".join(lines))

# %% [markdown]
# ## Frame by frame
#
# Press *play*, or move the slider. What to look at:
#
# - the **outline** is what the photograph shows of the ground. It turns orange under an alarm;
# - the **dashed line** is the gust. The UAV does not feel it: it believes itself on the route until the
#   next photograph contradicts it;
# - the **curves** are the error of the position, and of the position predicted one leg before from the
#   previous photograph. No prediction knows of a gust, so it peaks there;
# - the **quality** is that of the first match, believed or not; what the alarm finds instead is not in it.

# %%
mission_animation(log, picture, first)


# %%
def later(frames):
    return f"{frames} frame{'' if frames == 1 else 's'} later" if frames else "from that very frame"


lines = []
for method, flight in flights.items():
    for step in flight.loc[flight["push_m"] > 0, "step"]:
        now = flight[flight["step"] == step].iloc[0]
        after = flight[flight["step"] >= step]
        knows = after[after["trusted"] & (after["error_m"] <= WRONG_PX * pixel)]
        back = knows[~knows["note"].str.contains("re-planned")]
        text = f"- **{method}**: before frame {step} a gust carries it {now['push_m']:.0f} m away. "
        text += f"Alarm: {now['reason']}. " if now["alarm"] else "**No alarm.** "
        text += (
            f"It knows again where it is {later(knows['step'].iloc[0] - step)} ({knows['action'].iloc[0]}, "
            f"off by {knows['error_m'].iloc[0]:.0f} m)"
            if len(knows)
            else "It never knows again where it is"
        )
        text += (
            f", and is on its route again {later(back['step'].iloc[0] - step)}."
            if len(back)
            else ", and does not come back to its route."
        )
        lines.append(text)
    if not (flight["push_m"] > 0).any():
        lines.append(f"- **{method}**: its flight ends before any gust.")
Markdown("\n".join(lines))

# %% [markdown]
# ## The same flight under every method
#
# One slider for all. A flight that is over stays at its last frame and says how it ended.

# %%
mission_panels(log, picture)

# %% [markdown]
# ## What it decided, and why
#
# Every frame with an alarm or a note. **[ours]** An alarm sounds if the match is too unlikely to be right,
# or if the motion model cannot explain the position found. The UAV then searches wider, next with the whole
# frame. If nothing is to be trusted, it holds its course by dead reckoning, then turns back to the last
# point it trusted. **[literature]** It steers by pure pursuit (Coulter 1992): towards the point of the route
# one leg ahead of the nearest one.

# %%
told = log[log["alarm"] | (log["note"] != "")]
told = told[["method", "step", "action", "reason", "note"]].rename(columns={"step": "frame"})
left = [{"selector": "th, td", "props": "text-align: left"}]
told.style.hide(axis="index").set_table_styles(left).set_uuid("decisions")
