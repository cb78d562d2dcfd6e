"""A small project in which somebody speaks, made once for all tests of a class."""
import shutil
import tempfile
import pathlib

from corpus import Case

LINES = """id,speaker,notes,la,it
hail,keeper,,"Salvete, hospites. Quid vultis?","Perché così? È là, più giù."
part,keeper,,Valete et redite cras.,Città – addio.
third,keeper,,Di vos ament.,Però è tardi.
"""
DRAMA = """local keeper = actor("keeper")
function main()
  keeper:place{x = 0, z = -2}
  for _, line in ipairs{"hail", "part", "third"} do keeper:say(line) end
end
"""


class SpeakingCase(Case):
    """`self.project` is a copy of a project whose lines were baked."""

    @classmethod
    def setUpClass(cls):
        cls._made = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls._made.cleanup)
        cls.made = pathlib.Path(cls._made.name) / "p.lararium"

    def setUp(self):
        super().setUp()
        self.project = self.folder / "p.lararium"
        if not self.made.exists():
            self.new_project()
            self.editor("cast", "p.lararium", "--name", "keeper", "--plain")
            (self.project / "lines.csv").write_text(LINES, encoding="utf-8")
            (self.project / "drama.lua").write_text(DRAMA, encoding="utf-8")
            self.editor("bake", "p.lararium", timeout=400)
            shutil.move(self.project, self.made)
        shutil.copytree(self.made, self.project)
