"""Whole ways of films whose pixels are not what they seem: trained, staged, rendered, played."""
import json
import subprocess
import unittest

from corpus import MAQUETTE
from films_test import BT709, LOSSLESS, FilmCase

TRAINING = MAQUETTE / "places/maquette/training.mp4"
WALK = MAQUETTE / "places/maquette/handheld.mp4"


class WholeWays(FilmCase):
    def train(self, project, film):
        self.editor("new", project)
        return self.editor_json("train", project, "--place", "here", "--video", film, timeout=400)

    def test_sample_aspect_keeps_the_focal_length(self):
        self.ffmpeg("-i", TRAINING, "-vf", "scale=480:480,setsar=4/3", *LOSSLESS, "film.mp4")
        square = self.train("square.lararium", TRAINING)["K"]
        wide = self.train("wide.lararium", "film.mp4")["K"]
        for i in range(2):
            self.assertLess(abs(wide[i] / square[i] - 1.0), 0.005, (wide, square))

    def test_a_film_that_is_cut_off_says_so(self):
        self.ffmpeg("-i", TRAINING, "-map", "0:v", "-c", "copy", "film.mkv")
        data = (self.folder / "film.mkv").read_bytes()
        (self.folder / "film.mkv").write_bytes(data[:len(data) // 2])
        self.assertRegex("\n".join(self.train("cut.lararium", "film.mkv")["warnings"]),
                         r"film.mkv: ends after \d+\.\d s, but states \d+\.\d s: it is cut off")

    def test_phone_held_upright_is_rendered_upright(self):
        self.ffmpeg("-i", TRAINING, "-vf", "transpose=2", *LOSSLESS, "side.mp4")
        self.ffmpeg("-i", "side.mp4", "-metadata:s:v", "rotate=270", "-c", "copy", "phone.mp4")
        self.train("p.lararium", "phone.mp4")
        self.editor("stage", "p.lararium", "--place", "here")
        self.editor("render", "p.lararium", "--video", "phone.mp4", "--out", "out.mp4", timeout=400)
        self.assertEqual(self.size("out.mp4"), self.size(TRAINING))
        self.assert_alike(self.first("out.mp4"), self.first("phone.mp4"), mean=12.0)

    def test_people_are_as_bright_in_hdr_film_as_in_its_ordinary_twin(self):
        self.train("p.lararium", TRAINING)
        self.editor("stage", "p.lararium", "--place", "here")
        self.editor("export", "p.lararium", "--out", "p.larshow", timeout=400)
        gains = {}
        self.ffmpeg("-i", WALK, "-frames:v", "40", *LOSSLESS, "ordinary.mp4")
        self.ffmpeg("-i", WALK, "-frames:v", "40", "-vf",
                    "zscale=tin=709:min=709:pin=709:t=linear:npl=203,"
                    "zscale=p=2020:t=arib-std-b67:m=2020_ncl:r=tv,format=yuv420p10le", "-c:v", "libx265",
                    "-x265-params",
                    "log-level=none:colorprim=bt2020:transfer=arib-std-b67:colormatrix=bt2020nc", "hlg.mp4")
        for film in ("ordinary", "hlg"):
            self.player("p.larshow", "--video", film + ".mp4", "--headless", "--pace", "fast", "--audio",
                        "none", "--quality", "5", "--poses-out", film + ".json", timeout=400)
            images = json.loads((self.folder / (film + ".json")).read_text())["images"]
            found = [image["gain"] for image in images if image.get("gain")]
            self.assertGreater(len(found), 20)
            gains[film] = [sum(gain[c] for gain in found) / len(found) for c in range(3)]
        for a, b in zip(gains["hlg"], gains["ordinary"]):
            self.assertLess(abs(a / b - 1.0), 0.07, gains)  # 0.1 EV


if __name__ == "__main__":
    unittest.main()
