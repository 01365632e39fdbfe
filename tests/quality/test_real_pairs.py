"""The shipped alarm, unchanged, on real pictures and on unseen real relief."""

import os
from pathlib import Path

import numpy as np
import pytest
import rasterio
from rasterio.enums import Resampling
from rasterio.vrt import WarpedVRT

from pcnav_study.matching import match, prepare
from pcnav_study.quality import frozen, trust
from pcnav_study.quality.cases import Plan, collect
from pcnav_study.scene.trials import Site

DATA = Path(os.environ.get("PCNAV_DATA", Path(__file__).parents[2].parent / "shared" / "data"))
SIDE = 128


def picture(*parts, band=1):
    path = DATA.joinpath(*parts)
    if not path.exists():
        pytest.skip(f"real data absent: {path}")
    with rasterio.open(path) as source:
        return source.read(band).astype(np.float32)


def judged(reference, moving, tolerance, step=40):
    """Error, alarm and probability of the window pairs of two co-registered pictures.

    Every frame is sought once where it belongs, displaced by a few px, and once on ground
    that it does not show.
    """
    rng = np.random.default_rng(3)
    rows = []
    corners = [
        (r, c)
        for r in range(20, reference.shape[0] - SIDE - 20, step)
        for c in range(20, reference.shape[1] - SIDE - 20, step)
    ]
    for row, col in corners:
        frame = moving[row : row + SIDE, col : col + SIDE]
        away = rng.integers(-15, 16, 2)
        here = reference[row + away[0] :, col + away[1] :][:SIDE, :SIDE]
        if np.isnan(frame).any() or np.isnan(here).any() or np.ptp(frame) == 0:
            continue
        found = match(here, frame)
        error = float(np.hypot(*(found.shift + away)))
        rows.append((error <= tolerance, *trust(found, prepare(here), prepare(frame))[:2]))
    return rows


def rates(rows):
    right = np.array([r[0] for r in rows], bool)
    alarm = np.array([r[2] for r in rows], bool)
    false = alarm[right].mean() if right.any() else np.nan
    missed = (~alarm[~right]).mean() if (~right).any() else 0.0
    print(
        f"n = {len(rows)}, right {right.sum()}, false alarms {alarm[right].sum()}, "
        f"missed {(~alarm[~right]).sum()} of {(~right).sum()}"
    )
    return right, false, missed


def test_an_orthophoto_on_a_satellite_image():
    folder = DATA / "baviaanskloof"
    orthos = sorted((folder / "orthos").glob("*.tif")) if folder.exists() else []
    if not orthos:
        pytest.skip(f"real data absent: {folder}")
    rows = []
    for path in orthos:
        with rasterio.open(folder / "sentinel2_b432_byte.tif") as satellite:
            with (
                rasterio.open(path) as source,
                WarpedVRT(
                    source, crs=satellite.crs, transform=satellite.transform,
                    width=satellite.width, height=satellite.height, nodata=0,
                    resampling=Resampling.average,
                ) as warped,
            ):  # fmt: skip
                frame = warped.read(1).astype(np.float32)
            whole = satellite.read(1).astype(np.float32)
        frame[frame == 0] = np.nan
        inside = np.argwhere(~np.isnan(frame))
        (top, left), (bottom, right) = inside.min(axis=0), inside.max(axis=0)
        cut = np.s_[max(top - 20, 0) : bottom + 20, max(left - 20, 0) : right + 20]
        rows += judged(whole[cut], frame[cut], tolerance=2.0)
    right, false, missed = rates(rows)
    assert right.mean() > 0.9
    assert false < 0.5
    assert missed <= 0.1


def test_july_and_november():
    july = picture("landsat_july_november", "july4.tif")
    november = picture("landsat_july_november", "nov4.tif")
    right, _, missed = rates(judged(july, november, tolerance=2.0, step=12))
    assert right.any()
    assert missed < 0.5, "the two dates lie 1 to 2 px apart by their makers' word"


def test_ground_that_was_never_in_view():
    july = picture("landsat_july_november", "july4.tif")
    november = picture("landsat_july_november", "nov4.tif")
    alarms = []
    for k in range(0, 140, 10):
        one, other = july[:SIDE, k : k + SIDE], november[160 : 160 + SIDE, k : k + SIDE]
        alarms.append(trust(match(one, other), one, other).alarm)
    assert np.mean(alarms) > 0.95


def test_unseen_real_relief():
    path = DATA / "dem" / "bigtujunga_30m_utm11.tif"
    heights = picture("dem", path.name).astype(np.float64)[300:640, 200:600]
    site = Site(heights, (30.0, 30.0), seed=9)
    rows, _ = collect(site, "bigtujunga", Plan(96, (0.0, 60.0, 90.0, 150.0), 10, 4), frozen())
    wrong = [r for r in rows if r["kind"] in ("beside", "off_route")]
    missed = np.mean([not r["alarm"] for r in wrong])
    clear = [r for r in rows if r["kind"] == "match" and r["error_px"] <= 1]
    false = np.mean([r["alarm"] for r in clear])
    print(f"missed {missed:.4f} of {len(wrong)}, false {false:.4f} of {len(clear)}")
    assert missed < 0.03
    assert false < 0.08
