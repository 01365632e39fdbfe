"""Cameras from JSON and from EXIF."""

import json

import pytest

from pcnav_study.errors import InputError
from pcnav_study.frames import camera_from_file, camera_from_metadata

GOOD = {
    "type": "pinhole",
    "image_size_px": [640, 1152],
    "focal_length_mm": 120.0,
    "sensor_size_mm": [92.16, 165.888],
}


def written(tmp_path, spec):
    path = tmp_path / "camera.json"
    path.write_text(spec if isinstance(spec, str) else json.dumps(spec))
    return path


def test_a_camera_file_gives_rows_columns_and_focal_length_in_pixels(tmp_path):
    camera = camera_from_file(written(tmp_path, GOOD))
    assert camera.shape == (1152, 640)
    assert camera.focal_px == pytest.approx(120 / (92.16 / 640))
    assert camera.centre == pytest.approx((575.5, 319.5))


def test_the_principal_point_is_right_then_down(tmp_path):
    camera = camera_from_file(written(tmp_path, GOOD | {"principal_point": [10, -4]}))
    assert camera.centre == pytest.approx((575.5 - 4, 319.5 + 10))


def test_a_camera_without_a_type_is_a_pinhole(tmp_path):
    spec = {k: v for k, v in GOOD.items() if k != "type"}
    assert camera_from_file(written(tmp_path, spec)).shape == (1152, 640)


@pytest.mark.parametrize("key", ["image_size_px", "focal_length_mm", "sensor_size_mm"])
def test_a_missing_key_is_named(tmp_path, key):
    path = written(tmp_path, {k: v for k, v in GOOD.items() if k != key})
    with pytest.raises(InputError, match=rf"camera\.json.*{key}.*add it"):
        camera_from_file(path)


@pytest.mark.parametrize("text", ["{", "", "{'image_size_px': 3}", "not json"])
def test_malformed_json_is_refused_by_name(tmp_path, text):
    with pytest.raises(InputError, match=r"camera\.json is not valid JSON"):
        camera_from_file(written(tmp_path, text))


@pytest.mark.parametrize(
    "change",
    [
        {"focal_length_mm": "long"},
        {"focal_length_mm": None},
        {"focal_length_mm": 0},
        {"focal_length_mm": -35},
        {"sensor_size_mm": [0, 0]},
        {"sensor_size_mm": 92.16},
        {"sensor_size_mm": []},
        {"image_size_px": [640]},
        {"image_size_px": 640},
        {"image_size_px": [640, "tall"]},
        {"image_size_px": [0, 0]},
        {"principal_point": ["left", "up"]},
        {"principal_point": [1, 2, 3]},
        {"principal_point": None},
    ],
    ids=str,
)
def test_a_malformed_value_is_refused_by_the_files_name(tmp_path, change):
    with pytest.raises(InputError, match=r"camera\.json"):
        camera_from_file(written(tmp_path, GOOD | change))


def test_a_list_is_no_camera(tmp_path):
    with pytest.raises(InputError, match=r"camera\.json holds a malformed value"):
        camera_from_file(written(tmp_path, [1, 2]))


def test_a_camera_that_is_no_pinhole_is_refused_by_its_type(tmp_path):
    with pytest.raises(InputError, match=r"fisheye.*use pinhole or brown"):
        camera_from_file(written(tmp_path, GOOD | {"type": "fisheye"}))


def test_a_known_model_takes_its_sensor_width_from_the_table():
    seen = {"shape": (1125, 2000), "model": "FC7303", "focal_mm": 4.49, "focal_35mm": 24.0}
    camera = camera_from_metadata(seen)
    assert camera.shape == (1125, 2000)
    assert camera.focal_px == pytest.approx(4.49 / 6.17 * 2000)


@pytest.mark.parametrize("model", ["UNKNOWN 1", None])
def test_an_unknown_model_falls_back_on_the_35_mm_equivalent(model):
    seen = {"shape": (600, 900), "focal_mm": 8.8, "focal_35mm": 24.0}
    camera = camera_from_metadata(seen | ({"model": model} if model else {}))
    assert camera.focal_px == pytest.approx(24 / 36 * 900)


@pytest.mark.parametrize(
    "seen",
    [
        {},
        {"shape": (600, 900)},
        {"shape": (600, 900), "focal_mm": 8.8},
        {"shape": (600, 900), "model": "FC7303"},
        {"shape": (600, 900), "focal_35mm": 0.0},
        {"focal_35mm": 24.0},
    ],
    ids=str,
)
def test_a_frame_without_a_focal_length_is_refused_with_the_remedy(seen):
    with pytest.raises(InputError, match=r"no focal length.*camera\.json"):
        camera_from_metadata(seen)


@pytest.mark.parametrize("model", ["FC7303", "UNKNOWN"])
def test_a_focal_length_that_is_no_number_gives_no_camera(model):
    nan = float("nan")
    with pytest.raises(InputError):
        camera_from_metadata({"shape": (6, 9), "model": model, "focal_mm": nan, "focal_35mm": nan})


def test_a_brown_camera_reads_its_coefficients_and_a_pinhole_does_not(tmp_path):
    lens = {"k1": -0.2, "k2": 0.05, "k3": 0.001, "p1": 0.0003, "p2": -0.0004}
    brown = camera_from_file(written(tmp_path, GOOD | {"type": "brown"} | lens))
    assert brown.distortion._asdict() == lens
    assert not any(camera_from_file(written(tmp_path, GOOD | lens)).distortion)
