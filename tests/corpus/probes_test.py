"""Light probes as programs write them: every variant of a sky must give the light of the plain one."""
import math
import struct
import unittest

from corpus import Case

WIDTH, HEIGHT = 64, 32


def sky():
    """Rows of linear pixels: a gradient with a sun of many times its brightness, and a dark ground."""
    rows = []
    for y in range(HEIGHT):
        row = []
        for x in range(WIDTH):
            base = 2.0 - 1.8 * y / HEIGHT
            pixel = [0.5 * base, 0.8 * base, base]
            if 40 <= x < 42 and 8 <= y < 10:
                pixel = [400.0, 350.0, 250.0]
            row.append(pixel)
        rows.append(row)
    return rows


def rgbe(pixel):
    largest = max(pixel)
    if largest < 1e-32:
        return bytes(4)
    mantissa, exponent = math.frexp(largest)
    scale = mantissa * 256.0 / largest
    return bytes([int(value * scale) for value in pixel] + [exponent + 128])


def runs(values):
    """A channel of a row in runs of one value or of different ones."""
    out = bytearray()
    at = 0
    while at < len(values):
        end = at + 1
        while end < len(values) and values[end] == values[at] and end - at < 127:
            end += 1
        if end - at > 2:
            out += bytes([128 + end - at, values[at]])
            at = end
        else:
            out += bytes([1, values[at]])
            at += 1
    return bytes(out)


def radiance(rows, header=("FORMAT=32-bit_rle_rgbe",), order="-Y {h} +X {w}", new=False, magic="#?RADIANCE",
             end="\n"):
    height, width = len(rows), len(rows[0])
    text = magic + end + "".join(line + end for line in header) + end + order.format(h=height, w=width) + end
    out = bytearray(text.encode())
    for row in rows:
        pixels = [rgbe(pixel) for pixel in row]
        if new:
            out += bytes([2, 2, width >> 8, width & 255])
            for channel in range(4):
                out += runs([pixel[channel] for pixel in pixels])
        else:
            out += b"".join(pixels)
    return bytes(out)


def exr(rows, display=None, data=(0, 0), channels="RGB", kind=2, attributes=(), prefix=""):
    """An uncompressed OpenEXR file. kind: 1 half, 2 float. data: the place of the pixels' corner."""
    height, width = len(rows), len(rows[0])
    right, bottom = data[0] + width - 1, data[1] + height - 1
    display = display or (0, 0, width - 1, height - 1)

    def attribute(name, type_name, value):
        return name.encode() + b"\0" + type_name.encode() + b"\0" + struct.pack("<I", len(value)) + value

    names = sorted(prefix + channel for channel in channels)
    listed = b"".join(name.encode() + b"\0" + struct.pack("<IBBBBII", kind, 0, 0, 0, 0, 1, 1) for name in names)
    head = b"\x76\x2f\x31\x01" + struct.pack("<I", 2)
    head += attribute("channels", "chlist", listed + b"\0")
    head += attribute("compression", "compression", b"\0")
    head += attribute("dataWindow", "box2i", struct.pack("<4i", data[0], data[1], right, bottom))
    head += attribute("displayWindow", "box2i", struct.pack("<4i", *display))
    head += attribute("lineOrder", "lineOrder", b"\0")
    head += attribute("pixelAspectRatio", "float", struct.pack("<f", 1.0))
    head += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1.0))
    for added in attributes:
        head += attribute(*added)
    head += b"\0"
    size = 8 + len(names) * width * (2 if kind == 1 else 4)
    begin = len(head) + 8 * height
    out = bytearray(head) + b"".join(struct.pack("<Q", begin + i * size) for i in range(height))
    for y, row in enumerate(rows):
        out += struct.pack("<iI", data[1] + y, size - 8)
        for name in names:
            index = "RGB".find(name[-1])
            values = [pixel[index] if index >= 0 else 7.0 for pixel in row]
            out += struct.pack(f"<{width}{'e' if kind == 1 else 'f'}", *values)
    return bytes(out)


class Probes(Case):
    def light(self, name, content, warns=()):
        """Writes a probe and returns what is measured of its light."""
        (self.folder / name).write_bytes(content)
        info = self.editor_json("probe", "info", name)
        for text in warns:
            self.assertIn(text, " ".join(info["warnings"]))
        if not warns:
            self.assertEqual(info["warnings"], [], name)
        return info

    def assert_same(self, a, b, tolerance=0.02):
        for key in ("azimuth_deg", "elevation_deg"):
            self.assertAlmostEqual(a["brightest"][key], b["brightest"][key], delta=0.5)
        for x, y in zip(a["floor_irradiance"], b["floor_irradiance"]):
            self.assertLess(abs(x / y - 1.0), tolerance, (a, b))

    def refused(self, name, content, *texts):
        (self.folder / name).write_bytes(content)
        said = self.editor("probe", "info", name, code=1)
        for text in texts:
            self.assertIn(text, said)


class Radiance(Probes):
    def setUp(self):
        super().setUp()
        self.rows = sky()
        self.plain = self.light("plain.hdr", radiance(self.rows))

    def scaled(self, r, g, b):
        return [[[p[0] * r, p[1] * g, p[2] * b] for p in row] for row in self.rows]

    def test_exposure_is_divided_out(self):
        for name, factor, header in (
                ("once", 4, ["FORMAT=32-bit_rle_rgbe", "EXPOSURE=4"]),
                ("twice", 4, ["EXPOSURE= 2.0", "# made by hand", "FORMAT=32-bit_rle_rgbe", "EXPOSURE=2"]),
                ("exponent", 0.25, ["EXPOSURE=2.5e-1", "FORMAT=32-bit_rle_rgbe"])):
            self.assert_same(self.light(f"{name}.hdr", radiance(self.scaled(factor, factor, factor), header)),
                             self.plain)
        for value in ("0", "-1", "bright", "nan", "1 2"):
            self.refused("bad.hdr", radiance(self.rows, [f"EXPOSURE={value}"]), f"EXPOSURE={value}")

    def test_colour_correction_is_divided_out(self):
        self.assert_same(self.light("c.hdr", radiance(self.scaled(2, 1, 0.5), ["COLORCORR= 2 1 .5"])), self.plain)

    def test_every_order_of_rows_and_columns(self):
        rows = self.rows
        columns = [list(column) for column in zip(*rows)]
        flip = [row[::-1] for row in rows]
        flip_columns = [column[::-1] for column in columns]
        for name, stored, order in (
                ("a", rows[::-1], "+Y {h} +X {w}"), ("b", flip, "-Y {h} -X {w}"),
                ("c", flip[::-1], "+Y {h} -X {w}"), ("d", columns, "+X {h} -Y {w}"),
                ("e", columns[::-1], "-X {h} -Y {w}"), ("f", flip_columns, "+X {h} +Y {w}"),
                ("g", flip_columns[::-1], "-X {h} +Y {w}")):
            self.assert_same(self.light(f"{name}.hdr", radiance(stored, order=order)), self.plain)

    def test_headers_as_programs_write_them(self):
        for name, content in (
                ("new", radiance(self.rows, new=True)), ("rgbe", radiance(self.rows, magic="#?RGBE")),
                ("none", radiance(self.rows, ["SOFTWARE=x"])), ("crlf", radiance(self.rows, end="\r\n")),
                ("blanks", radiance(self.rows, ["FORMAT = 32-bit_rle_rgbe "])),
                ("long", radiance(self.rows, ["SOFTWARE=" + "x" * 3000]))):
            self.assert_same(self.light(f"{name}.hdr", content), self.plain)
        self.assert_same(self.light("plain.pic", radiance(self.rows)), self.plain)
        self.assert_same(self.light("LOUD.HDR", radiance(self.rows)), self.plain)

    def test_what_cannot_be_honoured_is_told(self):
        self.refused("xyze.hdr", radiance(self.rows, ["FORMAT=32-bit_rle_xyze"]), "red, green and blue")
        self.light("gamma.hdr", radiance(self.rows, ["GAMMA=2.2"]), warns=["GAMMA=2.2"])

    def test_wrong_aspect_is_told(self):
        self.refused("square.hdr", radiance([row[:HEIGHT] for row in self.rows]), "not twice as wide")


class OpenExr(Probes):
    def setUp(self):
        super().setUp()
        self.rows = sky()
        self.plain = self.light("plain.exr", exr(self.rows))

    def test_half_and_float(self):
        self.assert_same(self.light("half.exr", exr(self.rows, kind=1)), self.plain)

    def test_data_window_lies_where_it_says(self):
        """The sun must not turn where a program stored only what is not black."""
        cut = [row[16:] for row in self.rows[4:]]
        black = [[[0.0] * 3 for _ in row] for row in self.rows]
        for y, row in enumerate(cut):
            black[4 + y][16:] = row
        full = self.light("full.exr", exr(black))
        part = self.light("part.exr", exr(cut, display=(0, 0, WIDTH - 1, HEIGHT - 1), data=(16, 4)),
                          warns=["data window"])
        self.assert_same(part, full)

    def test_overscan_is_cut_off(self):
        wide = [[[0.1] * 3] * 8 + row + [[0.1] * 3] * 8 for row in self.rows]
        self.assert_same(self.light("over.exr", exr(wide, display=(0, 0, WIDTH - 1, HEIGHT - 1), data=(-8, 0))),
                         self.plain)

    def test_layers(self):
        self.assert_same(self.light("beauty.exr", exr(self.rows, prefix="beauty.")), self.plain)
        self.assert_same(self.light("blender.exr", exr(self.rows, prefix="ViewLayer.Combined.", channels="RGBA")),
                         self.plain)
        self.assert_same(self.light("odd.exr", exr(self.rows, prefix="first light."), warns=["first light"]),
                         self.plain)
        self.assert_same(self.light("alpha.exr", exr(self.rows, channels="RGBAZ")), self.plain)

    def test_chromaticities(self):
        """ACEScg: the same light in primaries of its own."""
        to_ap1 = ((0.6131, 0.3395, 0.0474), (0.0702, 0.9164, 0.0134), (0.0206, 0.1096, 0.8698))
        other = [[[sum(m * v for m, v in zip(line, p)) for line in to_ap1] for p in row] for row in self.rows]
        values = struct.pack("<8f", 0.713, 0.293, 0.165, 0.830, 0.128, 0.044, 0.32168, 0.33767)
        self.assert_same(
            self.light("ap1.exr", exr(other, attributes=[("chromaticities", "chromaticities", values)]),
                       warns=["primaries"]), self.plain)

    def test_what_cannot_be_read_is_told(self):
        self.refused("depth.exr", exr(self.rows, channels="Z"), "no channels R, G and B", "Z")
        cube = [("envmap", "envmap", b"\1")]
        self.refused("cube.exr", exr(self.rows, attributes=cube), "cube map")
        self.refused("cut.exr", exr(self.rows)[:-100], "cannot be read as OpenEXR")

    def test_names_do_not_decide(self):
        self.assert_same(self.light("really_exr.hdr", exr(self.rows)), self.plain)


if __name__ == "__main__":
    unittest.main()
