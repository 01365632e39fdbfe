"""Pixels and metadata of frames, whole and broken."""

import time

import numpy as np
import pytest
import rasterio
from affine import Affine
from PIL import Image
from rasterio.enums import ColorInterp

from pcnav_study.errors import InputError
from pcnav_study.frames import read_grey, read_metadata

XMP = """<?xpacket begin="" id="W5M0MpCehiHzreSzNTczkc9d"?>
<x:xmpmeta xmlns:x="adobe:ns:meta/">
 <rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
  <rdf:Description rdf:about="DJI Meta Data" xmlns:drone-dji="http://www.dji.com/drone-dji/1.0/"
   drone-dji:AbsoluteAltitude="+375.61" drone-dji:RelativeAltitude="+120.40"
   drone-dji:GimbalYawDegree="+150.00" drone-dji:GimbalPitchDegree="-90.00"
   drone-dji:GimbalRollDegree="+0.00" drone-dji:FlightYawDegree="+152.10"/>
 </rdf:RDF>
</x:xmpmeta>
<?xpacket end="w"?>"""

BOMB = (
    '<?xml version="1.0"?><!DOCTYPE x ['
    '<!ENTITY a0 "boom">'
    + "".join(f'<!ENTITY a{k + 1} "{f"&a{k};" * 20}">' for k in range(12))
    + ']><x:xmpmeta xmlns:x="adobe:ns:meta/">&a12;</x:xmpmeta>'
)


def colours(rng, shape=(24, 32)):
    return rng.integers(0, 256, (*shape, 3), dtype=np.uint8)


def write_tiff(path, bands, **profile):
    settings = {
        "driver": "GTiff",
        "count": len(bands),
        "height": bands[0].shape[0],
        "width": bands[0].shape[1],
        "dtype": bands[0].dtype,
        "crs": "EPSG:32616",
        "transform": Affine(1, 0, 5e5, 0, -1, 4e6),
    }
    with rasterio.open(path, "w", **settings | profile) as raster:
        raster.write(np.stack(bands))


@pytest.mark.parametrize("suffix", [".png", ".PNG", ".tif", ".tiff"])
def test_a_colour_image_is_read_as_the_mean_of_its_bands(tmp_path, rng, suffix):
    pixels = colours(rng)
    path = tmp_path / f"frame{suffix}"
    Image.fromarray(pixels).save(path)
    grey = read_grey(path)
    assert grey.dtype == np.float32
    np.testing.assert_allclose(grey, pixels.astype(float).mean(axis=2), atol=1e-4)


def test_a_jpeg_is_read_nearly_as_it_was_written(tmp_path):
    rows, cols = np.indices((40, 60))
    pixels = np.stack([rows * 4, cols * 3, rows + cols], axis=2).astype(np.uint8)
    Image.fromarray(pixels).save(tmp_path / "f.jpg", quality=95, subsampling=0)
    grey = read_grey(tmp_path / "f.jpg")
    assert np.abs(grey - pixels.astype(float).mean(axis=2)).mean() < 2


@pytest.mark.parametrize("mode", ["L", "P", "RGBA"])
def test_grey_palette_and_transparent_images_are_read_too(tmp_path, mode):
    level = np.repeat(np.arange(0, 240, 10, dtype=np.uint8)[None], 8, axis=0)
    Image.fromarray(level).convert(mode).save(tmp_path / "f.png")
    np.testing.assert_allclose(read_grey(tmp_path / "f.png"), level, atol=1)


@pytest.mark.parametrize("suffix", [".png", ".tif"])
def test_sixteen_bit_images_keep_their_range(tmp_path, rng, suffix):
    pixels = rng.integers(0, 65535, (20, 30), dtype=np.uint16)
    Image.fromarray(pixels).save(tmp_path / f"f{suffix}")
    np.testing.assert_array_equal(read_grey(tmp_path / f"f{suffix}"), pixels)


def test_no_data_of_a_tiff_becomes_nan(tmp_path, rng):
    bands = [rng.integers(1, 256, (20, 20), dtype=np.uint8) for _ in range(3)]
    for band in bands:
        band[3:6, 4:9] = 0
    write_tiff(tmp_path / "f.tif", bands, nodata=0)
    grey = read_grey(tmp_path / "f.tif")
    missing = np.zeros((20, 20), bool)
    missing[3:6, 4:9] = True
    np.testing.assert_array_equal(np.isnan(grey), missing)
    np.testing.assert_allclose(grey[~missing], np.mean(bands, axis=0)[~missing], rtol=1e-5)


def test_only_the_first_three_bands_of_a_tiff_count(tmp_path):
    bands = [np.full((10, 10), v, np.float32) for v in (3, 6, 9, 1000, 2000)]
    write_tiff(tmp_path / "f.tif", bands)
    np.testing.assert_array_equal(read_grey(tmp_path / "f.tif"), np.full((10, 10), 6))


def test_transparency_of_a_tiff_is_no_brightness(tmp_path):
    bands = [np.full((10, 10), 40, np.uint8), np.full((10, 10), 255, np.uint8)]
    bands[1][:2] = 0
    write_tiff(tmp_path / "f.tif", bands)
    with rasterio.open(tmp_path / "f.tif", "r+") as raster:
        raster.colorinterp = [ColorInterp.gray, ColorInterp.alpha]
    grey = read_grey(tmp_path / "f.tif")
    assert np.isnan(grey[:2]).all()
    assert (grey[2:] == 40).all()


def truncated_jpeg(path):
    Image.effect_noise((200, 150), 80).convert("RGB").save(path)
    path.write_bytes(path.read_bytes()[:3000])


def truncated_tiff(path):
    write_tiff(path, [np.arange(40000, dtype=np.uint16).reshape(200, 200)])
    path.write_bytes(path.read_bytes()[:5000])


def text(path):
    path.write_text("this is no image\n" * 50)


def nothing(path):
    path.write_bytes(b"")


@pytest.mark.parametrize(
    ("name", "write"),
    [
        ("cut.jpg", truncated_jpeg),
        ("cut.tif", truncated_tiff),
        ("text.jpg", text),
        ("text.png", text),
        ("text.tif", text),
        ("empty.jpg", nothing),
        ("empty.png", nothing),
        ("empty.tif", nothing),
        ("folder.jpg", lambda path: path.mkdir()),
        ("absent.png", lambda path: None),
        ("absent.tif", lambda path: None),
    ],
)
def test_a_broken_image_is_refused_by_name_and_has_no_crash_in_its_metadata(tmp_path, name, write):
    write(tmp_path / name)
    with pytest.raises(InputError, match=f"{name} cannot be read as an image.*replace it"):
        read_grey(tmp_path / name)
    assert not {"latitude", "focal_mm"} & read_metadata(tmp_path / name).keys()


@pytest.mark.parametrize("suffix", [".png", ".jpg", ".tif"])
def test_an_image_that_would_fill_the_memory_is_refused_by_name(tmp_path, rng, monkeypatch, suffix):
    path = tmp_path / f"huge{suffix}"
    Image.fromarray(colours(rng)).save(path)
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 24 * 32 // 3)
    with pytest.raises(InputError, match=rf"huge\{suffix}.*too large"):
        read_grey(path)
    assert read_metadata(path) == {}


def write_photo(path, gps=None, details=None, main=None, xmp=None):
    exif = Image.Exif()
    exif.update(main or {})
    exif.get_ifd(0x8769).update(details or {})
    exif.get_ifd(0x8825).update(gps or {})
    extra = {"xmp": xmp.encode()} if xmp else {}
    Image.new("RGB", (64, 48), "grey").save(path, exif=exif, **extra)


@pytest.mark.parametrize(("ns", "sign_ns"), [("N", 1), ("S", -1)])
@pytest.mark.parametrize(("ew", "sign_ew"), [("E", 1), ("W", -1)])
def test_exif_positions_carry_the_sign_of_their_hemisphere(tmp_path, ns, sign_ns, ew, sign_ew):
    gps = {1: ns, 2: (24.0, 15.0, 43.5), 3: ew, 4: (120.0, 43.0, 12.25), 5: b"\x00", 6: 375.5}
    write_photo(tmp_path / "f.jpg", gps)
    found = read_metadata(tmp_path / "f.jpg")
    assert found["latitude"] == pytest.approx(sign_ns * (24 + 15 / 60 + 43.5 / 3600), abs=1e-8)
    assert found["longitude"] == pytest.approx(sign_ew * (120 + 43 / 60 + 12.25 / 3600), abs=1e-8)
    assert found["altitude"] == pytest.approx(375.5)


def test_an_exif_altitude_below_the_sea_is_negative(tmp_path):
    write_photo(tmp_path / "f.jpg", {5: b"\x01", 6: 12.5})
    assert read_metadata(tmp_path / "f.jpg")["altitude"] == pytest.approx(-12.5)


def test_camera_and_time_are_read_from_exif(tmp_path):
    details = {0x920A: 4.49, 0xA405: 24, 0x9003: "2024:10:30 10:05:15", 0x9011: "+08:00"}
    write_photo(tmp_path / "f.jpg", details=details, main={0x0110: "FC7303"})
    found = read_metadata(tmp_path / "f.jpg")
    assert found["shape"] == (48, 64)
    assert found["model"] == "FC7303"
    assert found["focal_mm"] == pytest.approx(4.49)
    assert found["focal_35mm"] == 24
    assert found["time"] == "2024:10:30 10:05:15"
    assert found["utc_offset"] == "+08:00"


def test_drone_values_are_read_from_xmp(tmp_path):
    write_photo(tmp_path / "f.jpg", xmp=XMP)
    xmp = read_metadata(tmp_path / "f.jpg")["xmp"]
    assert float(xmp["RelativeAltitude"]) == 120.4
    assert float(xmp["AbsoluteAltitude"]) == 375.61
    assert float(xmp["GimbalPitchDegree"]) == -90
    assert float(xmp["FlightYawDegree"]) == 152.1


@pytest.mark.parametrize("xmp", [BOMB, "<x:xmpmeta><unclosed>", "no XML at all"])
def test_hostile_or_malformed_xmp_costs_neither_time_nor_the_exif_position(tmp_path, xmp):
    gps = {1: "N", 2: (24.0, 30.0, 0.0), 3: "E", 4: (120.0, 0.0, 0.0)}
    write_photo(tmp_path / "f.jpg", gps, xmp=xmp)
    start = time.perf_counter()
    found = read_metadata(tmp_path / "f.jpg")
    assert time.perf_counter() - start < 2
    assert len(str(found)) < 2000
    assert found["latitude"] == pytest.approx(24.5)


@pytest.mark.parametrize(
    "gps", [{1: "N", 2: (24.0, 30.0)}, {1: "N", 2: 24.5}, {1: "N", 2: (24.0, 30.0, 5.0, 1.0)}]
)
def test_a_malformed_exif_position_is_no_position_and_no_crash(tmp_path, gps):
    write_photo(tmp_path / "f.jpg", gps)
    assert "latitude" not in read_metadata(tmp_path / "f.jpg")


def test_text_for_a_focal_length_is_no_number_and_no_crash(tmp_path):
    write_photo(tmp_path / "f.jpg", details={0xA405: "wide"})
    assert np.isnan(read_metadata(tmp_path / "f.jpg").get("focal_35mm", np.nan))


def test_an_image_without_metadata_has_a_shape_alone(tmp_path):
    Image.new("L", (30, 20)).save(tmp_path / "f.png")
    assert read_metadata(tmp_path / "f.png") == {"shape": (20, 30), "xmp": {}}
    Image.new("L", (30, 20)).save(tmp_path / "f.tif")
    assert read_metadata(tmp_path / "f.tif") == {}
