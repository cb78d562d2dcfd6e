"""Names, links, modes and disks as people have them."""
import ctypes
import json
import os
import platform
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


# System calls that change modes and owners: those of x86, and those that every machine has.
CHANGES = {"x86_64": (90, 91, 92, 93, 94, 260, 268), "aarch64": (52, 53, 54, 55)}


class Instruction(ctypes.Structure):
    _fields_ = [("code", ctypes.c_ushort), ("if_true", ctypes.c_ubyte), ("if_false", ctypes.c_ubyte),
                ("value", ctypes.c_uint)]


class Program(ctypes.Structure):
    _fields_ = [("size", ctypes.c_ushort), ("instructions", ctypes.POINTER(Instruction))]


def refuse_changes():
    """From now on this process is refused to change modes and owners, as disks without them refuse it (seccomp)."""
    calls = CHANGES[platform.machine()]
    code = [Instruction(0x20, 0, 0, 0)]  # The number of the system call.
    code += [Instruction(0x15, len(calls) - i, 0, call) for i, call in enumerate(calls)]
    code += [Instruction(0x06, 0, 0, 0x7FFF0000), Instruction(0x06, 0, 0, 0x00050001)]  # Allowed; EPERM.
    program = Program(len(code), (Instruction * len(code))(*code))
    libc = ctypes.CDLL(None)
    if libc.prctl(38, 1, 0, 0, 0) != 0 or libc.prctl(22, 2, ctypes.byref(program), 0, 0) != 0:
        os._exit(99)


@unittest.skipIf(platform.machine() not in CHANGES, "the numbers of the system calls are not known")
class Disks(Case):
    def test_a_disk_that_keeps_no_modes_can_be_written_to(self):
        """exFAT, shares of Windows, cameras."""
        def run(*arguments):
            done = subprocess.run([f"{os.environ['LARARIUM_BIN']}/lararium-editor", *arguments], cwd=self.folder,
                                  capture_output=True, text=True, timeout=100, check=False, preexec_fn=refuse_changes,
                                  env=os.environ | {"HOME": str(self.home)})
            self.assertEqual(done.returncode, 0, done.stderr)
        run("new", "p.lararium")
        run("project", "p.lararium", "--title", "On a stick")
        self.assertIn("On a stick", (self.folder / "p.lararium/project.json").read_text())
        os.chmod(self.folder / "p.lararium/project.json", 0o600)
        refused = subprocess.run([f"{os.environ['LARARIUM_BIN']}/lararium-editor", "project", "p.lararium", "--title", "Open"],
                                 cwd=self.folder, capture_output=True, text=True, check=False, preexec_fn=refuse_changes)
        self.assertEqual(refused.returncode, 1, "the file would be open to others")


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
