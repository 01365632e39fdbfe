"""Two real pictures of one place, brought onto each other by what relates them."""

import numpy as np
import pytest
import rasterio
from affine import Affine
from PIL import Image

from pcnav_study.errors import InputError
from pcnav_study.experiments import draw_registered, registered, score
from pcnav_study.scene.relief import power_law_field


@pytest.fixture
def picture(rng):
    field = power_law_field((150, 160), 1.2, rng)
    return (128 + 40 * field).clip(0, 255).astype(np.uint8)


def write(path, values, transform):
    with rasterio.open(
        path, "w", driver="GTiff", height=values.shape[0], width=values.shape[1], count=1,
        dtype=values.dtype, crs="EPSG:32618", transform=transform,
    ) as raster:  # fmt: skip
        raster.write(values, 1)
    return str(path)


def test_georeferenced_pictures_meet_on_the_first_one_s_pixels(tmp_path, picture):
    whole = Affine(30, 0, 5e5, 0, -30, 4.4e6)
    part = whole @ Affine.translation(20, 10)
    fixed, moved = registered(
        write(tmp_path / "a.tif", picture, whole),
        write(tmp_path / "b.tif", picture[10:, 20:], part),
    )
    np.testing.assert_array_equal(fixed, picture)
    assert np.isnan(moved[:10]).all()
    assert np.isnan(moved[:, :20]).all()
    np.testing.assert_allclose(moved[10:, 20:], picture[10:, 20:], atol=1e-3)


def test_affine_takes_reference_pixels_to_the_moving_image(tmp_path, picture):
    Image.fromarray(picture).save(tmp_path / "a.png")
    Image.fromarray(np.roll(picture, (3, 5), (0, 1))).save(tmp_path / "b.png")
    (tmp_path / "gt.txt").write_text("1 0 5\n0 1 3\n")
    fixed, moved = registered(*(str(tmp_path / n) for n in ("a.png", "b.png", "gt.txt")))
    np.testing.assert_allclose(moved[:-3, :-5], fixed[:-3, :-5], atol=1e-3)
    (tmp_path / "gt.txt").write_text("1 0 0\n")
    with pytest.raises(InputError, match=r"gt\.txt does not hold 2 x 3 numbers"):
        registered(*(str(tmp_path / n) for n in ("a.png", "b.png", "gt.txt")))


def test_windows_of_equal_pictures_are_found_and_missing_ground_is_avoided(picture):
    moved = picture.astype(np.float32)
    moved[:, :40] = np.nan
    trials = draw_registered(picture.astype(np.float32), moved, 64, 8, np.random.default_rng(5))
    assert np.isnan(trials.moving).mean() <= 0.01
    judged = score(trials, "pc-sectors", 1.0)
    assert (judged["n"], judged["success"]) == (8, 1.0)
    with pytest.raises(InputError, match=r"lower pairs\.window_px"):
        draw_registered(picture.astype(np.float32), moved, 140, 2, np.random.default_rng(5))
