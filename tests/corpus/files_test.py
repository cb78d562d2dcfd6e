"""Names, links, modes and disks as people have them."""
import json
import os
import subprocess
import unittest

from corpus import Case, MAQUETTE


class Links(Case):
    def test_saving_writes_what_a_symbolic_link_names(self):
        project = self.new_project()
        shared = self.folder / "shared"
        shared.mkdir()
        for name in ("project.json", "drama.lua"):
            (project / name).rename(shared / name)
            (project / name).symlink_to(shared / name)
        (shared / "lines.csv").write_text("id,speaker,notes,la\nhail,keeper,,Salvete\n")
        (project / "lines.csv").symlink_to("../shared/lines.csv")
        self.editor("project", project, "--title", "Another")
        self.editor("lines", project, "--set", "hail", "--text", "la=Salvete omnes")
        for name in ("project.json", "drama.lua", "lines.csv"):
            self.assertTrue((project / name).is_symlink(), name)
        self.assertIn("Another", (shared / "project.json").read_text())
        self.assertIn("Salvete omnes", (shared / "lines.csv").read_text())

    def test_a_project_may_be_opened_through_a_link(self):
        project = self.new_project()
        link = self.folder / "link.lararium"
        link.symlink_to(project)
        self.editor("project", link, "--title", "Third")
        self.assertTrue(link.is_symlink())
        self.assertIn("Third", (project / "project.json").read_text())


class Modes(Case):
    def test_saving_keeps_modes_and_new_files_follow_the_umask(self):
        project = self.new_project()
        os.chmod(project / "project.json", 0o660)
        self.editor("project", project, "--title", "Kept")
        self.assertEqual((project / "project.json").stat().st_mode & 0o777, 0o660)
        before = os.umask(0o002)
        try:
            self.editor("new", "group.lararium")
        finally:
            os.umask(before)
        self.assertEqual((self.folder / "group.lararium" / "project.json").stat().st_mode & 0o777, 0o664)


class Names(Case):
    """A name is bytes, whatever they are."""

    def test_json_is_printed_for_names_that_are_no_utf8(self):
        name = b"b\xe0r.lararium"
        self.editor("new", name)
        said = json.loads(self.editor("--json", "project", name))
        self.assertIn("b\uefe0r", json.dumps(said, ensure_ascii=False))
        missing = self.editor("--json", "train", name, "--place", "here", "--video", b"n\xe9ant.mp4", code=2)
        self.assertIn(b"n\xe9ant.mp4", missing.encode("utf-8", "surrogateescape"))

    def test_a_recording_keeps_its_name(self):
        name = b"caf\xe9.mp4"
        film = os.path.join(os.fsencode(self.folder), name)
        with open(film, "wb") as copy:
            copy.write((MAQUETTE / "places/maquette/training.mp4").read_bytes())
        project = self.new_project()
        self.editor("place", project, "--add", "here", "--video", name)
        self.assertIn("no file is missing", self.editor("locate", project))


class Memory(Case):
    def test_little_memory_ends_in_one_sentence(self):
        done = subprocess.run(
            ["bash", "-c", f"ulimit -v 300000; exec {os.environ['LARARIUM_BIN']}/lararium-editor train p.lararium "
             f"--place here --video {MAQUETTE}/places/maquette/training.mp4"],
            cwd=self.new_project().parent, capture_output=True, text=True, timeout=300, check=False)
        self.assertGreater(done.returncode, 0, done.stderr)
        self.assertLess(done.returncode, 128, done.stderr)


if __name__ == "__main__":
    unittest.main()
