"""Folders of photographs as cameras, phones and disks leave them."""
import shutil
import struct
import subprocess
import unittest

from corpus import Case, MAQUETTE

PHOTOGRAPHS = 30  # Of the training film; fewer do not make a map.


def turned(jpeg, orientation):
    """The bytes of a JPEG with an orientation in new EXIF data."""
    exif = b"Exif\0\0MM\0*" + struct.pack(">IHHHIHHI", 8, 1, 0x0112, 3, 1, orientation, 0, 0)
    return jpeg[:2] + b"\xff\xe1" + struct.pack(">H", len(exif) + 2) + exif + jpeg[2:]


def float_tiff(width, height):
    """A grey TIFF whose samples are 32-bit floats."""
    size = 4 * width * height
    entries = [(256, 3, 1, width), (257, 3, 1, height), (258, 3, 1, 32), (259, 3, 1, 1), (262, 3, 1, 1),
               (273, 4, 1, 8), (277, 3, 1, 1), (278, 3, 1, height), (279, 4, 1, size), (339, 3, 1, 3)]
    return (struct.pack("<2sHI", b"II", 42, 8 + size) + struct.pack("<f", 0.5) * (width * height) +
            struct.pack("<H", len(entries)) + b"".join(struct.pack("<HHII", *e) for e in entries) + bytes(4))


class Photographs(Case):
    def photographs(self, folder="img"):
        """Writes photographs of the maquette and returns their paths."""
        images = self.folder / folder
        images.mkdir()
        self.ffmpeg("-i", MAQUETTE / "places/maquette/training.mp4", "-vf", "select=not(mod(n\\,4))",
                    "-vsync", "0", "-frames:v", str(PHOTOGRAPHS), "-q:v", "2", images / "IMG_%d.JPG")
        return [images / f"IMG_{i}.JPG" for i in range(1, PHOTOGRAPHS + 1)]

    def convert(self, *arguments):
        subprocess.run(["convert", *map(str, arguments)], check=True, cwd=self.folder)

    def replace(self, photograph, ending, *options, kind=""):
        """Writes a photograph in another format instead. kind: ImageMagick's name of it, with a colon."""
        other = photograph.with_suffix(ending)
        self.convert(photograph, *options, f"{kind}{other}")
        if other != photograph:
            photograph.unlink()

    def train(self, folder="img"):
        """The report of training from a folder."""
        self.editor("new", "p.lararium")
        return self.editor_json("train", "p.lararium", "--place", "here", "--images", folder, timeout=300)


class Folders(Photographs):
    def test_all_that_people_have_in_one_folder(self):
        images = self.photographs()
        for image in images:  # A disk of macOS.
            image.with_name("._" + image.name).write_bytes(b"\0\5\26\7\0\2\0\0Mac OS X        ")
        (images[0].parent / ".DS_Store").write_bytes(b"\0\0\0\1Bud1")
        (images[0].parent / "Thumbs.db").write_bytes(b"\xd0\xcf\x11\xe0")
        images[0].write_bytes(images[0].read_bytes()[:20000])  # Damaged, and the first.
        self.replace(images[1], ".heic", "-quality", "90")
        self.replace(images[2], ".AVIF", "-quality", "90")
        self.replace(images[3], ".webp", "-quality", "95")
        self.replace(images[4], ".tif", "-compress", "LZW")
        self.replace(images[5], ".tiff", "-depth", "16", "-define", "tiff:tile-geometry=64x64")
        self.replace(images[6], ".png", "-depth", "16")
        self.replace(images[7], ".png", kind="PNG8:")
        self.replace(images[8], ".png", "-alpha", "on")
        self.replace(images[9], ".JPG", "-colorspace", "CMYK")
        self.ffmpeg("-i", images[10], "-c:v", "libjxl", "-distance", "1", images[10].with_suffix(".jxl"))
        images[10].unlink()
        self.convert(images[11], "-rotate", "-90", images[11])  # Held upright: turned, and says so.
        images[11].write_bytes(turned(images[11].read_bytes(), 6))
        images[12].with_suffix(".tif").write_bytes(float_tiff(64, 48))
        images[12].unlink()
        shutil.copy(images[13], images[13].with_suffix(".CR2"))
        shutil.copy(images[14], images[14].with_suffix(".gif"))
        report = self.train()
        self.assertEqual(report["frames"], PHOTOGRAPHS - 2)
        self.assertGreaterEqual(report["located"], PHOTOGRAPHS - 4)
        self.assertEqual(len(report["cameras"]), 1, "the turned one is upright like the others")
        told = "\n".join(report["warnings"])
        self.assertEqual(len(report["warnings"]), 4, told)
        for text in ("IMG_1.JPG", "IMG_13.tif", "(.cr2)", "(.gif)"):
            self.assertIn(text, told)

    def test_names_of_other_programs_and_nested_folders(self):
        """Browsers name a JPEG .jfif; clouds leave placeholders; 360 degree cameras say what they made."""
        images = self.photographs()
        for image, ending in zip(images, (".jfif", ".JFIF", ".jpe")):
            image.rename(image.with_suffix(ending))
        images[3].rename(images[3].with_suffix(""))
        shutil.copy(images[4], images[4].with_suffix(".jpg_original"))
        (images[0].parent / ".IMG_31.HEIC.icloud").write_bytes(b"bplist00")
        (images[0].parent / "notes.txt").write_text("not a picture at all")
        xmp = (b"http://ns.adobe.com/xap/1.0/\0<x:xmpmeta xmlns:x='adobe:ns:meta/'><rdf:Description "
               b"GPano:ProjectionType='equirectangular'/></x:xmpmeta>")
        for image in images[5:7]:
            jpeg = image.read_bytes()
            image.write_bytes(jpeg[:2] + b"\xff\xe1" + struct.pack(">H", len(xmp) + 2) + xmp + jpeg[2:])
        for i, file in enumerate(sorted(images[0].parent.iterdir())):
            camera = self.folder / "img" / f"cam{i % 2}"
            camera.mkdir(exist_ok=True)
            file.rename(camera / file.name)
        report = self.train()
        self.assertEqual(report["frames"], PHOTOGRAPHS - 1)
        told = "\n".join(report["warnings"])
        self.assertEqual(len(report["warnings"]), 3, told)
        self.assertIn("2 files that begin as pictures do (.jpg_original, without an extension) are left out", told)
        self.assertIn("1 pictures are still in the cloud (.icloud)", told)
        self.assertIn("2 pictures of all directions (360 degrees)", told)

    def test_upright_and_lying_photographs_are_of_one_camera(self):
        images = self.photographs()
        for image in images[2::2]:  # Every second one was held upright.
            image.write_bytes(turned(image.read_bytes(), 6))
        # Turned by a program that says nothing, and the first: it does not decide for the others.
        self.convert(images[0], "-rotate", "90", images[0])
        report = self.train()
        self.assertGreaterEqual(report["located"], PHOTOGRAPHS - 2)
        self.assertEqual(len(report["cameras"]), 1, report["cameras"])

    def test_folder_of_raw_files_says_so(self):
        raw = self.folder / "raw"
        raw.mkdir()
        (raw / "IMG_1.CR3").write_bytes(b"\0\0\0\x18ftypcrx ")
        self.editor("new", "p.lararium")
        said = self.editor("train", "p.lararium", "--place", "here", "--images", "raw", code=1)
        self.assertIn("1 camera raw files (.cr3)", said)
        self.assertIn("develop", said)


if __name__ == "__main__":
    unittest.main()
