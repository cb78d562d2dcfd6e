"""COLMAP models as other programs write them."""
import re
import unittest

from colmap_scene import Scene, write_model
from corpus import Case


class Colmap(Case):
    @classmethod
    def setUpClass(cls):
        cls.scene = Scene()

    def setUp(self):
        super().setUp()
        self.scene.write_images(self.folder / "images")

    def imported(self, model, images="images", code=0):
        """Imports a model into a new project; returns what was said and the number of points."""
        self.made = getattr(self, "made", 0) + 1
        project = f"p{self.made}.lararium"
        self.new_project(project)
        arguments = ["--images", images] if images else []
        said = self.editor("import-colmap", project, model, *arguments, "--place", "here", code=code)
        counts = re.search(r"here: (\d+) images, (\d+) points", said)
        return said, (int(counts[1]), int(counts[2])) if counts else None

    def test_texts_of_other_programs(self):
        scene = self.scene
        write_model(self.folder / "plain", scene.cameras, scene.images, scene.points)
        _, plain = self.imported("plain")
        self.assertEqual(plain[0], len(scene.images))
        self.assertGreater(plain[1], 60)
        plus = [(re.sub(r" (\d)", r" +\1", a, count=1), b) for a, b in scene.images]
        blanks = [(a + "  ", b + " \t ") for a, b in scene.images]
        exponents = [re.sub(r" (-?\d+\.\d+)", lambda m: f" {float(m[1]):.12e}".replace("e-0", "e-00").replace("e+0", "e+00"), p)
                     for p in scene.points]
        full = [scene.cameras[0].replace("PINHOLE", "FULL_OPENCV") + " 0 0 0 0 0 0 0 0"]
        for i, (cameras, images, points, options) in enumerate((
                (scene.cameras, scene.images, scene.points, {"mark": b"\xef\xbb\xbf"}),
                (scene.cameras, scene.images, scene.points, {"mark": b"\xef\xbb\xbf", "end": "\r\n"}),
                (scene.cameras, plus, scene.points, {}), (scene.cameras, blanks, scene.points, {}),
                (scene.cameras, scene.images[::-1], scene.points[::-1], {}), (scene.cameras, scene.images, exponents, {}),
                (full, scene.images, scene.points, {}))):
            write_model(self.folder / f"m{i}", cameras, images, points, **options)
            said, counts = self.imported(f"m{i}")
            self.assertEqual(counts, plain, said)
            self.assertNotIn("warning", said)

    def test_what_cannot_be_read_is_one_line_with_its_place(self):
        scene = self.scene
        for i, (cameras, images, points, told) in enumerate((
                (scene.cameras, scene.images, [p.replace(".", ",") for p in scene.points], "points3D.txt:2"),
                (scene.cameras, scene.images, [p.replace(" 0.5 ", " nan ") for p in scene.points], "points3D.txt:2"),
                ([scene.cameras[0].replace("PINHOLE", "EUCM")+" 0.5 1"], scene.images, scene.points, "EUCM"),
                ([scene.cameras[0].replace("PINHOLE", "FANCY")], scene.images, scene.points, "FANCY"))):
            write_model(self.folder / f"m{i}", cameras, images, points)
            said, _ = self.imported(f"m{i}", code=1)
            self.assertEqual(len(said.strip().splitlines()), 1, said)
            self.assertIn(told, said)

    def test_models_without_tracks_are_triangulated(self):
        scene = self.scene
        bare = [" ".join(p.split(" ")[:8]) for p in scene.points]
        for i, (points, options) in enumerate(((bare, {}), ([], {}), ([], {"blank": False}), (None, {}))):
            write_model(self.folder / f"m{i}", scene.cameras, [(a, "") for a, _ in scene.images], points, **options)
            said, counts = self.imported(f"m{i}")
            self.assertRegex(said, r"warning: the model has no tracks; \d+ points were triangulated")
            self.assertEqual(counts[0], len(scene.images))
            self.assertGreater(counts[1], 60)

    def test_references_of_one_side_suffice(self):
        scene = self.scene
        bare = [" ".join(p.split(" ")[:8]) for p in scene.points]
        for i, (images, points, told) in enumerate((
                (scene.images, bare, "its points list no observations; those of the features were taken"),
                ([(a, "") for a, _ in scene.images], scene.points, "its images list no features"),
                (scene.images[:-2], scene.points, "observations are listed by a point or by an image only"))):
            write_model(self.folder / f"m{i}", scene.cameras, images, points)
            said, counts = self.imported(f"m{i}")
            self.assertIn(told, said)
            self.assertGreater(counts[1], 60)

    def test_names_of_another_machine_find_their_files(self):
        scene = self.scene
        for i, rename in enumerate((str.upper, lambda name: name.replace(".jpg", ".png"),
                                    lambda name: "C:\\Users\\me\\photos\\" + name, lambda name: "/home/me/photos/" + name)):
            images = [(a.rsplit(" ", 1)[0] + " " + rename(name), b) for (a, b), name in zip(scene.images, scene.names)]
            write_model(self.folder / f"m{i}", scene.cameras, images, scene.points)
            said, counts = self.imported(f"m{i}")
            self.assertEqual(counts[0], len(scene.images), said)
            self.assertRegex(said, r"warning: 6 of 6 images have other names in the model, such as \S+ for frame00.jpg")
        scene.write_images(self.folder / "sub", ["cam/" + name for name in scene.names])
        images = [(a.rsplit(" ", 1)[0] + " cam\\" + name, b) for (a, b), name in zip(scene.images, scene.names)]
        write_model(self.folder / "back", scene.cameras, images, scene.points)
        self.assertEqual(self.imported("back", images="sub")[1][0], len(scene.images))

    def test_an_image_that_is_missing_or_damaged_costs_that_image(self):
        scene = self.scene
        write_model(self.folder / "m", scene.cameras, scene.images, scene.points)
        (self.folder / "images" / scene.names[2]).unlink()
        file = self.folder / "images" / scene.names[4]
        file.write_bytes(file.read_bytes()[:5000])
        said, counts = self.imported("m")
        self.assertEqual(counts[0], len(scene.images) - 2, said)
        self.assertIn(f"{scene.names[2]}: does not exist", said)
        self.assertIn(f"{scene.names[4]}: the image is damaged", said)
        for name in scene.names[:2]:
            (self.folder / "images" / name).unlink()
        said, _ = self.imported("m", code=1)
        self.assertIn("does not exist; name the folder of the model's images", said)

    def test_images_in_subfolders_and_names_with_blanks(self):
        scene = self.scene
        names = [f"cam{i % 2}/A walk (part {i}) #1.jpg" for i in range(len(scene.names))]
        images = [(a.rsplit(" ", 1)[0] + " " + name, b) for (a, b), name in zip(scene.images, names)]
        scene.write_images(self.folder / "proj" / "images", names)
        for model in ("proj/sparse/0", "proj/colmap/sparse/0"):
            write_model(self.folder / model, scene.cameras, images, scene.points)
        (self.folder / "proj/sparse/0/rigs.txt").write_text("# Rig\n1 1 CAMERA 1\n")
        for model in ("proj", "proj/sparse/0", "proj/colmap"):
            said, counts = self.imported(model, images=None)
            self.assertEqual(counts[0], len(names), said)
        self.assertIn("no problems", self.editor("check", "p1.lararium", "--seconds", "1"))
        self.assertIn("cam1/A walk", self.editor("place", "p1.lararium", "--images"))


if __name__ == "__main__":
    unittest.main()
