"""Support for tests of inputs as people have them: each test makes its input, runs the editor on it in
an empty folder and states what a user expects. CMakeLists.txt runs the files with unittest."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["LARARIUM_BIN"])
SCENES = pathlib.Path(os.environ["LARARIUM_SCENES"])
MAQUETTE = SCENES / "maquette" / "maquette.lararium"


class Case(unittest.TestCase):
    """A test in an empty folder, `self.folder`, with an empty home folder."""

    def setUp(self):
        self._scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self._scratch.cleanup)
        self.folder = pathlib.Path(self._scratch.name)
        self.home = self.folder / "home"
        self.home.mkdir()

    def run_program(self, name, *arguments, code=0, timeout=120, errors=subprocess.STDOUT):
        """Runs a program of Lararium and returns all it said. Its exit status must be `code`, unless that is
        None. `errors` says where its errors and its log go."""
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        environment["HOME"] = str(self.home)
        done = subprocess.run(
            [BIN / name, *arguments], cwd=self.folder, env=environment, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=errors, timeout=timeout)
        said = done.stdout.decode("utf-8", "surrogateescape")
        self.assertEqual(done.returncode, done.returncode if code is None else code,
                         f"{name} {arguments} said:\n{said}")
        return said

    def editor(self, *arguments, **options):
        return self.run_program("lararium-editor", *arguments, **options)

    def editor_json(self, *arguments, **options):
        """The result of a subcommand as the JSON object that it prints."""
        return json.loads(self.editor(*arguments, "--json", errors=subprocess.DEVNULL, **options))

    def player(self, *arguments, **options):
        return self.run_program("lararium-player", *arguments, **options)

    def new_project(self, name="p.lararium"):
        self.editor("new", name)
        return self.folder / name

    def copy_of_maquette(self, name="p.lararium"):
        """A copy of the sample project of the rendered room, with its trained place where one lies
        beside the source."""
        shutil.copytree(MAQUETTE, self.folder / name)
        return self.folder / name

    def ffmpeg(self, *arguments):
        subprocess.run(["ffmpeg", "-v", "error", "-y", *map(str, arguments)], check=True, cwd=self.folder,
                       stdin=subprocess.DEVNULL, timeout=120)
