"""Films as phones, camcorders and editing programs write them. Each is filmed from instead of a camera,
so that the recording is what the program sees of it."""
import pathlib
import struct
import subprocess
import time
import unittest

from corpus import Case

WIDTH, HEIGHT = 320, 240
BT709 = "setparams=range=tv:color_primaries=bt709:color_trc=bt709:colorspace=bt709"
LOSSLESS = ["-c:v", "libx264", "-qp", "4", "-pix_fmt", "yuv420p"]


class FilmCase(Case):
    def make(self, name, *options, filters=BT709, source=f"testsrc2=s={WIDTH}x{HEIGHT}:r=25:d=0.4"):
        """A film of a test picture."""
        self.ffmpeg("-f", "lavfi", "-i", source, "-vf", filters, *options, name)
        return name

    def ordinary(self, name="film.mp4", **more):
        return self.make(name, *LOSSLESS, **more)

    def seen(self, film, says=()):
        """What the program sees of a film: the file it records from it."""
        project = f"{pathlib.Path(film).name}.lararium"
        self.editor("new", project)
        said = self.editor("train", project, "--place", "here", "--camera", film, "--seconds", "1",
                           code=None)
        for text in says:
            self.assertIn(text, said)
        recorded = list((self.folder / project).rglob("*.mp4"))
        self.assertEqual(len(recorded), 1, said)
        return recorded[0]

    def size(self, film):
        return self.probe(film, "width,height")

    def probe(self, film, entries):
        done = subprocess.run(
            ["ffprobe", "-v", "error", "-select_streams", "v:0", "-show_entries", f"stream={entries}",
             "-of", "csv=p=0", film], check=True, cwd=self.folder, stdout=subprocess.PIPE)
        return done.stdout.decode().split()[0]

    def first(self, film, filters="null", format="rgb24"):
        """The first picture, as ffmpeg shows it, as bytes."""
        return subprocess.run(
            ["ffmpeg", "-v", "error", "-i", film, "-vf", filters, "-frames:v", "1", "-f", "rawvideo",
             "-pix_fmt", format, "-"], check=True, cwd=self.folder, stdout=subprocess.PIPE).stdout

    def assert_alike(self, a, b, mean=4.0):
        self.assertEqual(len(a), len(b))
        difference = sum(abs(x - y) for x, y in zip(a, b)) / len(a)
        self.assertLess(difference, mean)


class Shapes(FilmCase):
    def test_phone_held_upright(self):
        self.ordinary("side.mp4")
        for turn in (90, 180, 270):
            film = f"turned{turn}.mp4"
            self.ffmpeg("-i", "side.mp4", "-metadata:s:v", f"rotate={turn}", "-c", "copy", film)
            seen = self.seen(film)
            self.assertEqual(self.size(seen), "240,320" if turn != 180 else "320,240")
            self.assert_alike(self.first(seen), self.first(film))

    def test_mirrored_film_of_a_front_camera(self):
        self.ordinary("side.mp4")
        content = bytearray((self.folder / "side.mp4").read_bytes())
        at = content.index(b"tkhd") + 4 + 40  # The matrix of the track's header.
        one = 1 << 16
        for name, matrix, filters in (("mirror", (-one, 0, 0, one), "hflip"),
                                      ("upright", (0, one, one, 0), "transpose=0")):
            a, b, c, d = matrix
            content[at:at + 36] = struct.pack(">9i", a, b, 0, c, d, 0, 0, 0, 1 << 30)
            (self.folder / f"{name}.mp4").write_bytes(content)
            self.assert_alike(self.first(self.seen(f"{name}.mp4")), self.first("side.mp4", filters))

    def test_anamorphic_pixels_become_square(self):
        for film, codec, aspect, width in (("hdv.mkv", LOSSLESS, "4/3", 426),
                                           ("dv.mov", ["-c:v", "mpeg4", "-q:v", "2"], "16/15", 340),
                                           ("narrow.mp4", LOSSLESS, "8/9", 284)):
            self.make(film, *codec, filters=f"{BT709},setsar={aspect}")
            seen = self.seen(film)
            self.assertEqual(self.size(seen), f"{width},240")
            self.assert_alike(self.first(seen), self.first(film, f"scale={width}:240,setsar=1"))

    def test_anamorphic_and_upright(self):
        self.make("side.mp4", *LOSSLESS, filters=f"{BT709},setsar=4/3")
        self.ffmpeg("-i", "side.mp4", "-metadata:s:v", "rotate=90", "-c", "copy", "film.mp4")
        self.assertEqual(self.size(self.seen("film.mp4")), "240,426")

    def test_interlaced_film_shows_one_moment(self):
        """A bar that moves 16 pixels between two fields has one edge in each picture, not two."""
        weave = f"{BT709},geq=lum='if(between(X,16*N+40,16*N+79),235,16)':cb=128:cr=128,tinterlace=4"
        self.make("film.mp4", *LOSSLESS, "-flags", "+ildct+ilme", "-x264opts", "tff=1",
                  filters=weave, source="color=black:s=320x240:r=50:d=0.4")
        self.assertIn(self.probe("film.mp4", "field_order"), ("tt", "tb"))
        row = self.first(self.seen("film.mp4"), format="gray")
        for y in range(100, 140):
            line = row[320 * y:320 * y + 320]
            edges = sum(1 for x in range(319) if (line[x] > 127) != (line[x + 1] > 127))
            self.assertEqual(edges, 2, y)
            self.assertGreater(line[60], 200)
            self.assertLess(line[86], 60)


class Times(FilmCase):
    def joined(self, jump):
        """Two films as one file; the second one begins `jump` seconds after the first."""
        pieces = []
        for offset in (0, jump):
            self.ffmpeg("-f", "lavfi", "-i", f"testsrc2=s={WIDTH}x{HEIGHT}:r=25:d=0.4", "-vf", BT709, *LOSSLESS, "-g", "5",
                        "-output_ts_offset", str(offset), "-f", "mpegts", "piece.ts")
            pieces.append((self.folder / "piece.ts").read_bytes())
        (self.folder / "joined.ts").write_bytes(b"".join(pieces))
        return "joined.ts"

    def test_joined_films_have_no_pause_between_them(self):
        film = self.joined(3600)
        started = time.monotonic()
        seen = self.seen(film)  # Played as a camera: an hour with the pause.
        self.assertLess(time.monotonic() - started, 100)
        self.assertEqual(self.probe(seen, "nb_frames"), "20")
        said = self.editor("train", "joined.ts.lararium", "--place", "again", "--video", film, code=None)
        self.assertIn("joined.ts: its times jump in 1 places", said)

    def test_odd_sizes_lose_a_row_and_a_column_at_most(self):
        self.make("odd.mkv", "-c:v", "ffv1", "-pix_fmt", "yuv420p", filters=BT709 + ",scale=321:241")
        seen = self.seen("odd.mkv")
        self.assertEqual(self.size(seen), "320,240")
        self.assert_alike(self.first(seen), self.first("odd.mkv", "crop=320:240:0:0"))

    def test_a_film_of_a_browser_has_neither_duration_nor_index(self):
        self.make("live.webm", "-c:v", "libvpx", "-b:v", "3M", "-live", "1")
        self.assertEqual(self.probe(self.seen("live.webm"), "nb_frames"), "10")


class Streams(FilmCase):
    def test_cover_is_not_the_film(self):
        self.ordinary()
        self.ffmpeg("-f", "lavfi", "-i", "color=red:s=640x480", "-frames:v", "1", "cover.jpg")
        self.ffmpeg("-i", "cover.jpg", "-i", "film.mp4", "-map", "0", "-map", "1:v", "-c:v:0", "mjpeg",
                    "-c:v:1", "copy", "-disposition:v:0", "attached_pic",
                    "cover.mp4")
        seen = self.seen("cover.mp4")
        self.assertEqual(self.size(seen), "320,240")
        self.assert_alike(self.first(seen), self.first("film.mp4"))

    def test_preview_is_not_the_film(self):
        self.ordinary()
        self.ffmpeg("-i", "film.mp4", "-i", "film.mp4", "-map", "0:v", "-map", "1:v", "-c:v:0",
                    "libx264", "-filter:v:0", "scale=80:60", "-c:v:1", "copy", "preview.mp4")
        self.assertEqual(self.size(self.seen("preview.mp4")), "320,240")

    def test_sound_alone_is_refused(self):
        self.ffmpeg("-f", "lavfi", "-i", "sine=d=1", "-c:a", "aac", "sound.mp4")
        self.editor("new", "p.lararium")
        said = self.editor("train", "p.lararium", "--place", "here", "--video", "sound.mp4", code=1)
        self.assertIn("contains no video", said)

    def test_usual_codecs(self):
        for name, options in (
                ("hevc.mp4", ["-c:v", "libx265", "-x265-params", "log-level=none", "-tag:v", "hvc1"]),
                ("vp9.webm", ["-c:v", "libvpx-vp9", "-deadline", "realtime", "-cpu-used", "8"]),
                ("av1.mkv", ["-c:v", "libsvtav1", "-preset", "12"]),
                ("prores.mov", ["-c:v", "prores_ks", "-profile:v", "1"]),
                ("raw.avi", ["-c:v", "rawvideo", "-pix_fmt", "yuv420p"]),
                ("motion.avi", ["-c:v", "mjpeg", "-q:v", "2", "-pix_fmt", "yuvj420p"])):
            self.make(name, *options)
            self.assert_alike(self.first(self.seen(name)), self.first(name), mean=6.0)


class Colours(FilmCase):
    """The films show the same; ordinary.mp4 is what each must look like."""

    # Colours as things have them: none is purer than BT.709 can show.
    PAINTED = ("format=gbrp,colorchannelmixer=rr=.6:rg=.2:rb=.2:gr=.2:gg=.6:gb=.2:br=.2:bg=.2:bb=.6,gblur=3,"
               "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p," + BT709)

    def twin(self, name, filters, *options, mean=2.5, says=()):
        self.make("ordinary.mp4", *LOSSLESS, filters=self.PAINTED)
        self.ffmpeg("-i", "ordinary.mp4", "-vf", filters, *options, name)
        self.assert_alike(self.first(self.seen(name, says)), self.first("ordinary.mp4"), mean=mean)

    HEVC = ("-c:v", "libx265", "-crf", "4", "-tag:v", "hvc1", "-x265-params")

    def test_hlg(self):
        self.twin("hlg.mp4", "zscale=t=arib-std-b67:p=2020:m=2020_ncl:r=tv:npl=203:agamma=0,format=yuv420p10le",
                  *self.HEVC, "log-level=none:colorprim=bt2020:transfer=arib-std-b67:colormatrix=bt2020nc",
                  says=["HLG"])

    def test_hlg_of_a_display_of_100_nits(self):
        self.twin("hlg.mp4",
                  "zscale=tin=709:min=709:pin=709:t=linear:npl=203,format=gbrpf32le,"
                  "zscale=p=2020:t=arib-std-b67:m=2020_ncl:r=tv:agamma=0,format=yuv420p10le",
                  *self.HEVC, "log-level=none:colorprim=bt2020:transfer=arib-std-b67:colormatrix=bt2020nc")

    def test_pq(self):
        self.twin("pq.mp4", "zscale=t=smpte2084:p=2020:m=2020_ncl:r=tv:npl=203:agamma=0,format=yuv420p10le",
                  *self.HEVC, "log-level=none:colorprim=bt2020:transfer=smpte2084:colormatrix=bt2020nc",
                  says=["PQ"])

    def test_wide_gamut(self):
        self.twin("wide.mp4", "zscale=p=2020:m=2020_ncl:t=2020_10:r=tv,format=yuv420p10le", *self.HEVC,
                  "log-level=none:colorprim=bt2020:transfer=bt2020-10:colormatrix=bt2020nc")

    def test_display_p3(self):
        self.twin("p3.mp4", "zscale=p=smpte432:m=709:t=709:r=tv,format=yuv420p10le", *self.HEVC,
                  "log-level=none:colorprim=smpte432:transfer=bt709:colormatrix=bt709")

    def test_full_range(self):
        self.twin("full.mp4", "scale=out_range=full", *LOSSLESS, "-color_range", "pc")

    def test_old_matrix(self):
        self.twin("old.mp4", "scale=in_color_matrix=bt709:out_color_matrix=bt601", *LOSSLESS,
                  "-colorspace", "smpte170m")

    def test_own_recordings_say_what_they_are(self):
        self.make("ordinary.mp4", *LOSSLESS)
        seen = self.seen("ordinary.mp4")
        self.assertEqual(self.probe(seen, "color_range,color_space,color_transfer,color_primaries"),
                         "tv,bt709,bt709,bt709")


if __name__ == "__main__":
    unittest.main()
