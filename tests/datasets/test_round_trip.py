"""What goes into a dataset comes out of it, to the bit."""

import hashlib
from pathlib import Path

import numpy as np
import pytest
import rasterio
import xarray as xr
from affine import Affine
from kedro.io import DatasetError, Version

from pcnav_study.datasets import GeoTIFFDataset, JSONLinesDataset, NetCDFDataset
from pcnav_study.errors import InputError
from pcnav_study.scene import Grid, jacksboro

GRIDS = {
    "utm": Grid(
        Affine(30.0, 0, 376313.6554542635, 0, -30.0, 3807917.8276283755), (7, 5), "EPSG:32611"
    ),
    "degrees": Grid(
        Affine(1.6010480136468437e-06, 0, 120.7, 0, -1.45336414997e-06, 24.3), (7, 5), "EPSG:4326"
    ),
    "equirectangular": Grid.of(jacksboro()).window(3, 4, (7, 5)),
}
DATASETS = {"image.tif": GeoTIFFDataset, "image.nc": NetCDFDataset}


def saved(kind: str, folder: Path, data: object, stamp: str = "2026-01-01T00.00.00.000Z"):
    make = DATASETS[kind]
    make(filepath=str(folder / kind), version=Version(None, stamp)).save(data)
    return make(filepath=str(folder / kind), version=Version(None, None)).load()


@pytest.mark.parametrize("kind", DATASETS)
@pytest.mark.parametrize("where", GRIDS)
@pytest.mark.parametrize("dtype", ["uint8", "int16", "float32", "float64"])
@pytest.mark.parametrize("bands", [None, 1, 3])
def test_image_returns_as_it_was(tmp_path, rng, kind, where, dtype, bands):
    grid = GRIDS[where]
    shape = grid.shape if bands is None else (bands, *grid.shape)
    image = grid.image((100 * rng.random(shape)).astype(dtype), "radiance")
    image = image.rio.write_nodata(7)
    image.attrs.update(sun_azimuth=135.5, site="Jacksboro", channels=[1, 2])
    back = saved(kind, tmp_path, image)
    assert back.dtype == image.dtype
    assert back.dims == image.dims
    assert back.name == "radiance"
    np.testing.assert_array_equal(back.values, image.values)
    assert Grid.of(back).transform == grid.transform
    assert back.rio.crs == image.rio.crs
    assert back.rio.nodata == 7
    assert {k: np.asarray(back.attrs[k]).tolist() for k in ("sun_azimuth", "site", "channels")} == {
        "sun_azimuth": 135.5, "site": "Jacksboro", "channels": [1, 2],
    }  # fmt: skip
    np.testing.assert_array_equal(back["y"], image["y"])
    np.testing.assert_array_equal(back["x"], image["x"])


@pytest.mark.parametrize("kind", DATASETS)
def test_not_a_number_and_no_fill_value_survive(tmp_path, kind):
    values = np.array([[np.nan, 1.0], [-0.0, np.inf]], np.float32)
    back = saved(kind, tmp_path, Grid(Affine(2, 0, 0, 0, -3, 0), (2, 2), "EPSG:3857").image(values))
    np.testing.assert_array_equal(back.values, values)
    assert back.rio.nodata is None
    assert back.name is None


def test_multiband_raster_is_not_moved(tmp_path, rng):
    """Rasterio itself sees the transform that was asked for."""
    grid = GRIDS["utm"]
    saved("image.tif", tmp_path, grid.image(rng.random((3, 7, 5)).astype("float32")))
    (path,) = tmp_path.glob("image.tif/*/image.tif")
    with rasterio.open(path) as raster:
        assert raster.transform == grid.transform
        assert raster.count == 3


def test_dataset_with_times_and_text(tmp_path):
    times = np.array(["2016-06-21T14:30", "2016-12-21"], "M8[ns]")
    data = xr.Dataset(
        {"frames": (("frame", "row", "col"), np.arange(24, dtype="uint8").reshape(2, 3, 4))},
        coords={"frame": ["a", "b"], "time": ("frame", times)},
        attrs={"crs": "EPSG:32617", "focal_px": 166.25},
    )  # fmt: skip
    xr.testing.assert_identical(saved("image.nc", tmp_path, data), data)


@pytest.mark.parametrize("kind", DATASETS)
def test_equal_data_give_equal_bytes_and_versions_stay(tmp_path, rng, kind):
    image = GRIDS["utm"].image(rng.random((7, 5)).astype("float32"), "radiance")
    for stamp in ("2026-01-01T00.00.00.000Z", "2026-01-02T00.00.00.000Z"):
        saved(kind, tmp_path, image, stamp)
    files = [p for p in tmp_path.rglob(kind) if p.is_file()]
    assert len(files) == 2
    assert len({hashlib.sha256(p.read_bytes()).hexdigest() for p in files}) == 1


def test_older_version_can_be_asked_for(tmp_path):
    grid = GRIDS["utm"]
    for stamp, value in (("2026-01-01T00.00.00.000Z", 1), ("2026-01-02T00.00.00.000Z", 2)):
        saved("image.tif", tmp_path, grid.image(np.full(grid.shape, value, "uint8")), stamp)
    old = GeoTIFFDataset(
        filepath=str(tmp_path / "image.tif"), version=Version("2026-01-01T00.00.00.000Z", None)
    )
    assert int(old.load()[0, 0]) == 1
    assert old.exists()
    missing = GeoTIFFDataset(filepath=str(tmp_path / "other.tif"), version=Version(None, None))
    assert not missing.exists()


def test_map_without_crs_is_refused_by_name(tmp_path):
    path = tmp_path / "bare.tif"
    with rasterio.open(
        path,
        "w",
        driver="GTiff",
        height=2,
        width=2,
        count=1,
        dtype="uint8",
        transform=Affine(2, 0, 0, 0, -2, 0),
    ) as raster:
        raster.write(np.ones((1, 2, 2), "uint8"))
    with pytest.raises(Exception, match=r"bare\.tif has no CRS; assign one") as caught:
        GeoTIFFDataset(filepath=str(path)).load()
    assert isinstance(caught.value.__cause__ or caught.value, InputError)


def log_rows():
    yield {"step": 0, "error": np.float64(1.5), "far": float("nan"), "corners": [[1.0, 2.0]]}
    yield {"step": 1, "error": 2.5, "far": float("inf"), "corners": [[3.0, 4.0]]}
    yield {"step": 2, "error": np.int64(3), "far": 0.25, "corners": []}


def test_a_log_comes_back_row_by_row(tmp_path):
    version = Version(None, "2026-01-01T00.00.00.000Z")
    log = JSONLinesDataset(filepath=str(tmp_path / "log.jsonl"), version=version)
    log.save(log_rows())
    back = JSONLinesDataset(filepath=str(tmp_path / "log.jsonl"), version=Version(None, None))
    table = back.load()
    assert table["step"].tolist() == [0, 1, 2]
    assert table["error"].tolist() == [1.5, 2.5, 3.0]
    assert np.isnan(table["far"][:2]).all() and table["far"][2] == 0.25
    assert table["corners"][1] == [[3.0, 4.0]]


def test_a_log_that_breaks_off_is_readable_up_to_there(tmp_path):
    def crashing():
        yield from log_rows()
        raise RuntimeError("engine failure")

    version = Version(None, "2026-01-01T00.00.00.000Z")
    log = JSONLinesDataset(filepath=str(tmp_path / "log.jsonl"), version=version)
    with pytest.raises(DatasetError, match="engine failure"):
        log.save(crashing())
    assert len(log.load()) == 3


def test_a_log_is_on_the_disk_while_it_grows_and_a_cut_line_is_left_out(tmp_path):
    log = JSONLinesDataset(filepath=str(tmp_path / "log.jsonl"))
    seen = []

    def watched():
        for row in log_rows():
            yield row
            seen.append(len((tmp_path / "log.jsonl").read_text().splitlines()))

    log.save(watched())
    assert seen == [1, 2, 3]
    text = (tmp_path / "log.jsonl").read_text()
    (tmp_path / "log.jsonl").write_text(text[:-9])
    assert log.load()["step"].tolist() == [0, 1]
