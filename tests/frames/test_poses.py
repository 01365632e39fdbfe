"""Which source a pose comes from, and what broken tables say."""

from pathlib import Path

import pytest

from pcnav_study.errors import InputError
from pcnav_study.frames import pose_records

FRAMES = (Path("frames/a.jpg"), Path("frames/b.jpg"))
POSE_CSV = """frame,easting_m,northing_m,altitude_m,omega_deg,phi_deg,kappa_deg
a.jpg,500000.5,4000000.25,1500,0.5,-0.25,170
"""
LOG_CSV = """frame,latitude_deg,longitude_deg,height_above_ground_m,flight_yaw_deg
a.jpg,10,20,111,45
b.jpg,11,21,112,46
"""
XMP = {
    "AbsoluteAltitude": "+375.5",
    "RelativeAltitude": "+120.25",
    "FlightYawDegree": "152.1",
    "GimbalYawDegree": "+150.0",
    "GimbalPitchDegree": "-90.00",
    "GimbalRollDegree": "+1.5",
}
EXIF = {"latitude": 12.0, "longitude": 22.0, "altitude": 99.0}


def records(tmp_path, pose=None, log=None, metadata=None):
    paths = {}
    for name, content in (("camera_pose", pose), ("flight_log", log)):
        if content is not None:
            paths[name] = tmp_path / f"{name}.csv"
            paths[name].write_text(content)
    return pose_records(FRAMES, metadata or {}, **paths)


def test_every_frame_has_a_record_in_the_given_order(tmp_path):
    found = records(tmp_path, POSE_CSV)
    assert list(found) == ["a.jpg", "b.jpg"]
    assert found["a.jpg"].has_position
    assert not found["b.jpg"].has_position
    assert found["b.jpg"].values == {} and found["b.jpg"].source == ""


def test_better_sources_go_first_and_each_value_tells_its_own(tmp_path):
    metadata = {"a.jpg": {"xmp": XMP} | EXIF}
    found = records(tmp_path, POSE_CSV, LOG_CSV, metadata)["a.jpg"]
    assert found.values == {
        "easting": 500000.5,
        "northing": 4000000.25,
        "altitude": 1500,
        "omega": 0.5,
        "phi": -0.25,
        "kappa": 170,
        "latitude": 10,
        "longitude": 20,
        "height_above_ground": 111,
        "yaw": 45,
        "pitch": 0,
        "roll": 1.5,
    }
    assert found.sources["altitude"] == "camera_pose.csv"
    assert found.sources["latitude"] == "flight_log.csv"
    assert found.sources["roll"] == "XMP"
    assert found.source == "camera_pose.csv+flight_log.csv+XMP"


@pytest.mark.parametrize(
    ("log", "metadata", "expected"),
    [
        (LOG_CSV, {"xmp": XMP} | EXIF, ("flight_log.csv", "XMP")),
        (None, {"xmp": XMP} | EXIF, ("EXIF", "XMP")),
        (None, EXIF, ("EXIF", "EXIF")),
    ],
)
def test_position_and_altitude_fall_back_source_by_source(tmp_path, log, metadata, expected):
    found = records(tmp_path, None, log, {"a.jpg": metadata})["a.jpg"]
    assert (found.sources["latitude"], found.sources["altitude"]) == expected


def test_frames_may_be_listed_without_their_suffix(tmp_path):
    found = records(tmp_path, POSE_CSV.replace("a.jpg", "a"), LOG_CSV.replace(".jpg", ""))
    assert found["a.jpg"].values["easting"] == 500000.5
    assert found["b.jpg"].values["latitude"] == 11


def test_frame_names_that_look_like_numbers_keep_their_zeros(tmp_path):
    (tmp_path / "log.csv").write_text("frame,latitude_deg,longitude_deg\n007,1,2\n7,3,4\n")
    found = pose_records((Path("007.jpg"), Path("7.jpg")), {}, None, tmp_path / "log.csv")
    assert [found[n].values["latitude"] for n in ("007.jpg", "7.jpg")] == [1, 3]


def test_a_blank_cell_is_taken_from_the_next_source(tmp_path):
    log = "frame,latitude_deg,longitude_deg,gps_altitude_m\na.jpg,10,20,\n"
    found = records(tmp_path, None, log, {"a.jpg": EXIF})["a.jpg"]
    assert found.values["altitude"] == 99 and found.sources["altitude"] == "EXIF"


def test_a_gimbal_looking_down_has_no_pitch(tmp_path):
    values = records(tmp_path, metadata={"a.jpg": {"xmp": XMP}})["a.jpg"].values
    assert (values["yaw"], values["pitch"], values["roll"]) == (150, 0, 1.5)


@pytest.mark.parametrize(("gimbal", "pitch"), [("-80.0", 10), ("-100.0", -10), ("-45", 45)])
def test_a_gimbal_looking_ahead_has_its_nose_up(tmp_path, gimbal, pitch):
    xmp = XMP | {"GimbalPitchDegree": gimbal}
    assert records(tmp_path, metadata={"a.jpg": {"xmp": xmp}})["a.jpg"].values["pitch"] == pitch


def test_a_gimbal_of_zeros_was_not_recorded_and_the_aircraft_gives_the_yaw(tmp_path):
    zeros = {f"Gimbal{axis}Degree": "+0.00" for axis in ("Yaw", "Pitch", "Roll")}
    values = records(tmp_path, metadata={"a.jpg": {"xmp": XMP | zeros}})["a.jpg"].values
    assert values["yaw"] == 152.1
    assert not {"pitch", "roll"} & values.keys()


@pytest.mark.parametrize("value", ["", "none", "1,5"])
def test_xmp_text_that_is_no_number_is_left_out(tmp_path, value):
    xmp = XMP | {"RelativeAltitude": value}
    values = records(tmp_path, metadata={"a.jpg": {"xmp": xmp}})["a.jpg"].values
    assert "height_above_ground" not in values
    assert values["altitude"] == 375.5


@pytest.mark.parametrize(
    "column", ["frame", "easting_m", "northing_m", "altitude_m", "omega_deg", "kappa_deg"]
)
def test_a_missing_pose_column_is_named(tmp_path, column):
    with pytest.raises(InputError, match=rf"camera_pose\.csv lacks the column {column}"):
        records(tmp_path, POSE_CSV.replace(column, "other"))


@pytest.mark.parametrize("column", ["frame", "latitude_deg", "longitude_deg"])
def test_a_missing_log_column_is_named(tmp_path, column):
    with pytest.raises(InputError, match=rf"flight_log\.csv lacks the column {column}"):
        records(tmp_path, log=LOG_CSV.replace(column, "other"))


@pytest.mark.parametrize(
    "column", ["latitude_deg", "longitude_deg", "height_above_ground_m", "flight_yaw_deg"]
)
def test_text_in_a_number_column_is_named_with_its_frame(tmp_path, column):
    header, one, other = LOG_CSV.splitlines()
    cells = other.split(",")
    cells[header.split(",").index(column)] = "north"
    with pytest.raises(InputError, match=rf"flight_log\.csv column {column}, frame b\.jpg"):
        records(tmp_path, log="\n".join([header, one, ",".join(cells)]))


def test_text_in_columns_of_no_interest_is_no_fault(tmp_path):
    log = "frame,latitude_deg,longitude_deg,pilot\na.jpg,10,20,Ada\n"
    assert records(tmp_path, log=log)["a.jpg"].values == {"latitude": 10, "longitude": 20}


def test_a_frame_listed_twice_is_refused_by_name(tmp_path):
    with pytest.raises(InputError, match=r"flight_log\.csv.*a\.jpg twice"):
        records(tmp_path, log=LOG_CSV + "a.jpg,1,2,3,4\n")


@pytest.mark.parametrize("content", ["", "\n\n", 'frame,"latitude_deg\n1,2,3\n'])
def test_a_table_that_is_no_csv_is_refused_by_name(tmp_path, content):
    with pytest.raises(InputError, match=r"flight_log\.csv"):
        records(tmp_path, log=content)


def test_a_table_of_bytes_is_refused_by_name(tmp_path):
    (tmp_path / "log.csv").write_bytes(bytes(range(128, 256)) * 4)
    with pytest.raises(InputError, match=r"log\.csv"):
        pose_records(FRAMES, {}, None, tmp_path / "log.csv")
