"""Motion as other programs write it. Pictures at one time of a walk are compared with those of a plain BVH."""
import unittest

import corpus
import figures


class Motion(corpus.Case):
    def setUp(self):
        super().setUp()
        self.new_project()
        self.editor("cast", "p.lararium", "--name", "keeper", "--plain")
        figures.write_bvh(self.folder / "plain.bvh")
        self.assertNotIn("warning", self.clip("plain.bvh"))
        self.plain = self.picture()

    def clip(self, file, **options):
        return self.editor("cast", "p.lararium", "--name", "keeper", "--add-clip", file, "--clip-name", "walked",
                           **options)

    def picture(self):
        self.editor("portrait", "p.lararium/cast/keeper.larhuman", "--out", "k.png", "--clip", "walked",
                    "--time", "0.25")
        self.ffmpeg("-i", "k.png", "-f", "rawvideo", "-pix_fmt", "gray", "k.raw")
        return (self.folder / "k.raw").read_bytes()

    def difference(self):
        """Mean difference of the picture from that of the plain BVH, in grey values of 255."""
        now = self.picture()
        self.assertEqual(len(now), len(self.plain))
        return sum(abs(a - b) for a, b in zip(now, self.plain)) / len(now)

    def test_bvh_is_read_as_leniently_as_elsewhere(self):
        for what, options in {
                "names with blanks": {"name": lambda n: "Bip01 " + n},
                "Windows' line ends, byte order mark": {"eol": "\r\n", "bom": True},
                "old line ends": {"eol": "\r"},
                "comment": {"prefix": "# made by us\n\n"},
                "small channels": {"channel": str.lower},
                "decimal commas": {"number": lambda x: ("%.5f" % x).replace(".", ",")},
                "exponents": {"number": lambda x: "%e" % x},
                "no offset of ends": {"end_site": []},
                "channels of ends": {"end_site": ["OFFSET 0 5 0", "CHANNELS 0"]},
                "names in Latin-1": {"name": lambda n: n + "_\u00e9", "encoding": "latin-1"},
                "another order": {"order": "XYZ"}}.items():
            figures.write_bvh(self.folder / "odd.bvh", **options)
            self.assertNotIn("warning", self.clip("odd.bvh"), what)
            self.assertLess(self.difference(), 0.1, what)

    def test_wrong_counts_and_times_are_told(self):
        for options, told in (({"stated_frames": 0}, "60 frames"), ({"stated_frames": 99}, "60 frames"),
                              ({"frame_time": "0"}, "no frame time"), ({"frame_time": "30"}, "frames a second")):
            figures.write_bvh(self.folder / "odd.bvh", **options)
            self.assertIn("warning: keeper, walked: ", said := self.clip("odd.bvh"))
            self.assertIn(told, said)
            self.assertLess(self.difference(), 0.1, told)

    def test_a_zero_pose_that_is_no_pose_of_a_person_does_not_matter(self):
        figures.write_bvh(self.folder / "odd.bvh", frame_of=figures.along_bone)
        self.assertIn("its pose at rest is taken", self.clip("odd.bvh"))
        self.assertLess(self.difference(), 0.5)

    def test_a_motion_stands_where_its_zero_pose_would_lie(self):
        figures.write_bvh(self.folder / "odd.bvh", up=figures.rotation("X", 90))
        self.assertIn("its pose at rest is taken", self.clip("odd.bvh"))
        self.assertLess(self.difference(), 0.5)

    def test_pre_rotations_of_fbx_without_meshes_count_once(self):
        for unit in (1.0, 2.54, 100.0):
            figures.write_fbx(self.folder / "walk.fbx", unit)
            self.assertNotIn("warning", self.clip("walk.fbx"))
            self.assertLess(self.difference(), 0.5, unit)


if __name__ == "__main__":
    unittest.main()
