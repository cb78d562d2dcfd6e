"""People, objects and occluders as other programs write them."""
import struct
import unittest

import corpus
import figures


class Models(corpus.Case):
    def setUp(self):
        super().setUp()
        self.new_project()

    def person(self, file, **options):
        return self.editor("cast", "p.lararium", "--name", "ada", "--import", file, **options)

    def picture(self, *arguments):
        """The grey values of a portrait, and their number."""
        self.editor("portrait", "p.lararium/cast/ada.larhuman", "--out", "ada.png", *arguments)
        self.ffmpeg("-i", "ada.png", "-f", "rawvideo", "-pix_fmt", "rgb24", "ada.raw")
        return (self.folder / "ada.raw").read_bytes()

    def test_buffers_are_found_however_their_names_are_escaped(self):
        for uri, file in (("my%20person%20%231.bin", "my person #1.bin"), ("my person.bin", None), ("persön.bin", None),
                          ("pers%C3%B6n2.bin", "persön2.bin"), ("half%25.bin", "half%.bin"), ("./a.bin", "a.bin"),
                          ("data:", None)):
            figures.Figure().write_gltf(self.folder / "a.gltf", uri, file)
            self.assertNotIn("warning", self.person("a.gltf"), uri)

    def test_a_missing_buffer_is_named(self):
        figures.Figure().write_gltf(self.folder / "a.gltf", "gone.bin")
        (self.folder / "gone.bin").unlink()
        self.assertIn("'gone.bin' is missing", self.person("a.gltf", code=1))

    def test_scenes_and_bind_matrices_may_be_missing(self):
        def without_scenes(figure):
            del figure.json["scenes"], figure.json["scene"]

        def without_bind_matrices(figure):
            del figure.json["skins"][0]["inverseBindMatrices"]

        def joints_elsewhere(figure):
            figure.json["scenes"] = [{"nodes": [len(figures.BONES)]}]

        figures.Figure().write_glb(self.folder / "a.glb")
        self.person("a.glb")
        plain = self.picture()
        for change in (without_scenes, without_bind_matrices, joints_elsewhere):
            figure = figures.Figure()
            change(figure)
            figure.write_glb(self.folder / "a.glb")
            self.person("a.glb")
            self.assertEqual(self.picture(), plain, change.__name__)

    def test_steps_are_steps_and_curves_are_curves(self):
        arm = {}
        for interpolation in ("LINEAR", "STEP", "CUBICSPLINE"):
            figure = figures.Figure()
            figure.lift_arm(interpolation)
            figure.write_glb(self.folder / "a.glb")
            self.person("a.glb")
            arm[interpolation] = self.picture("--clip", "wave", "--time", "1.8")
            if interpolation == "STEP":
                down = self.picture("--clip", "wave", "--time", "0.5")
        self.assertEqual(arm["STEP"], down)
        self.assertNotEqual(arm["LINEAR"], down)
        self.assertNotIn(arm["CUBICSPLINE"], (down, arm["LINEAR"]))

    def test_the_transform_of_a_texture_chooses_its_part(self):
        red_and_lime = figures.png(32, 32, lambda x, y: (255, 0, 0) if x < 16 else (0, 255, 0))
        for required in (False, True):
            figure = figures.Figure(texture=red_and_lime)
            texture = figure.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
            texture["extensions"] = {"KHR_texture_transform": {"offset": [.1, 0], "scale": [.3, 1]}}
            figure.json["extensionsUsed"] = ["KHR_texture_transform"]
            if required:
                figure.json["extensionsRequired"] = ["KHR_texture_transform"]
            figure.write_glb(self.folder / "a.glb")
            self.person("a.glb")
            pixels = self.picture()
            red = sum(r > 2 * g for r, g in zip(pixels[::3], pixels[1::3]))
            lime = sum(g > 2 * r for r, g in zip(pixels[::3], pixels[1::3]))
            self.assertGreater(red, 1000)
            self.assertEqual(lime, 0)

    def test_what_is_not_taken_over_is_told_each_time(self):
        figure = figures.Figure(texture=b"\xabKTX 20\xbb\r\n\x1a\n" + bytes(64))
        figure.json["materials"][0]["emissiveFactor"] = [1, 1, 1]
        figure.write_glb(self.folder / "a.glb")
        said = self.person("a.glb")
        self.assertIn("warning: ada: people do not shine: the emission of its materials is left out", said)
        self.assertIn("texture 'image 0': is a KTX file for graphics cards", said)
        self.assertIn("emission", self.editor("bake", "p.lararium"))
        self.assertIn("emission", self.editor("bake", "p.lararium"))
        self.assertIn('"warnings": [', self.editor("bake", "p.lararium", "--json"))

    def test_textures_that_must_be_read_and_cannot_are_an_error_of_one_line(self):
        figure = figures.Figure(texture=b"")
        figure.json["textures"] = [{"extensions": {"KHR_texture_basisu": {"source": 0}}}]
        figure.json["extensionsRequired"] = ["KHR_texture_basisu"]
        figure.write_glb(self.folder / "a.glb")
        self.assertIn("KHR_texture_basisu", self.person("a.glb", code=1))

    def test_a_model_can_be_pictured_before_it_is_added(self):
        figure = figures.Figure()
        figure.json["materials"] = [{"emissiveFactor": [1, 1, 1]}]
        figure.json["meshes"][0]["primitives"][0]["material"] = 0
        figure.write_glb(self.folder / "a.glb")
        for options, warnings in (((), 1), (("--thing",), 0)):  # Things shine, people do not.
            told = self.editor_json("portrait", "a.glb", "--out", "a.png", "--size", "64x64", *options)
            self.assertEqual(sum("emission" in warning for warning in told.get("warnings", [])), warnings)
            self.assertEqual((told["width"], told["height"]), (64, 64))
        self.assertIn("is a thing", self.editor("portrait", "a.glb", "--out", "a.png", "--thing", "--sheet", code=1))

    def scan(self, name, move):
        """A room of two walls, as OBJ or PLY with doubles."""
        points = [(x, y, z) for x in (0, 4) for y in (0, 5) for z in (0, 3)]
        faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5)]
        moved = [tuple(a + b for a, b in zip(p, move)) for p in points]
        if name.endswith(".obj"):
            text = "".join("v %.4f %.4f %.4f\n" % p for p in moved)
            text += "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in faces)
            (self.folder / name).write_text(text)
            return
        head = ("ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty double x\nproperty double y\n"
                "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n")
        (self.folder / name).write_bytes(head.encode() + b"".join(struct.pack("<3d", *p) for p in moved) +
                                         b"".join(struct.pack("<B3i", 3, *f) for f in faces))

    def test_marks_before_a_text_and_points_without_faces(self):
        self.new_project("q.lararium")
        self.editor("place", "q.lararium", "--add", "room")
        self.scan("plain.obj", (0.25, 0.5, 0.125))
        text = (self.folder / "plain.obj").read_text()
        (self.folder / "marked.obj").write_text("\ufeff" + text.replace("\n", "\r\n"), encoding="utf-8", newline="")
        for name in ("plain", "marked"):
            self.editor("occluder", "q.lararium", "--add", name, "--model", name + ".obj")
        self.editor("bake", "q.lararium")
        plain, marked = (next((self.folder / "q.lararium").glob(f"**/{name}.larmesh")) for name in ("plain", "marked"))
        self.assertEqual(plain.read_bytes(), marked.read_bytes())
        head = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
        (self.folder / "cloud.ply").write_text(head + "0 0 0\n1 1 1\n")
        self.editor("occluder", "q.lararium", "--add", "cloud", "--model", "cloud.ply")
        said = self.editor("bake", "q.lararium", code=1)
        self.assertIn("cloud.ply: holds points or lines, but no faces; make a mesh of its points", said)

    def test_a_scan_in_survey_coordinates_keeps_its_digits_and_comes_near(self):
        for kind in ("obj", "ply"):
            self.scan("near." + kind, (234.125, -321.875, 30))
            self.scan("far." + kind, (451234.125, 4520678.125, 30))
            project = kind + ".lararium"
            self.new_project(project)
            self.editor("place", project, "--add", "room")
            for name in ("near", "far"):
                self.editor("occluder", project, "--add", name, "--model", name + "." + kind)
            said = self.editor("bake", project)
            self.assertIn("warning: far: its coordinates are those of a survey; (451000, 4521000, 0)", said)
            self.assertNotIn("near", said.split("baked")[0].replace("lies near", ""))
            near, far = ((self.folder / project).glob("**/%s.larmesh" % name) for name in ("near", "far"))
            self.assertEqual(next(near).read_bytes(), next(far).read_bytes())


if __name__ == "__main__":
    unittest.main()
