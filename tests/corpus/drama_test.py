"""Scripts and behaviours as editors and other programs save them."""
import unittest

from speaking import DRAMA, SpeakingCase

BML = ("<speech id='s1' start='1'><text>Valete et redite cras.</text></speech><gaze id='g1' target='AUDIENCE' start='2' "
       "end='4'/><locomotion id='l1' target='0.5 -2' start='5'/>")


class Drama(SpeakingCase):
    def checked(self, script):
        """What check says of a script: the lines that name it."""
        (self.project / "drama.lua").write_bytes(script if isinstance(script, bytes) else script.encode("utf-8"))
        said = self.editor("check", "p.lararium", "--seconds", "3", code=1)  # The project has no place.
        return [line for line in said.splitlines() if "drama.lua" in line and "paradata" not in line]

    def test_marks_and_line_ends(self):
        for script in (DRAMA, b"\xef\xbb\xbf" + DRAMA.encode(), DRAMA.replace("\n", "\r\n"), DRAMA.replace("\n", "\r")):
            self.assertEqual(self.checked(script), [])

    def test_what_is_wrong_is_one_line_with_its_place(self):
        for script, told in ((DRAMA.encode("utf-16"), "drama.lua:1: is not UTF-8; save the script as UTF-8"),
                             (DRAMA.encode("utf-16-le"), "drama.lua:1: holds a zero byte"),
                             ("--\nlocal k = actor('caf\u00e9')\n".encode("latin-1"), "drama.lua:2: is not UTF-8"),
                             ("local k = actor(\u201ckeeper\u201d)\n", "drama.lua:1: unexpected symbol"),
                             ("local k = actor(\u201ckeeper\u201d)\n", "the line holds a quotation mark (U+201C)"),
                             ("--\n\u00a0local k = 1\n", "the line holds a no-break space (U+00A0)"),
                             ("--\n--\nlocal k = \u22121\n", "the line holds a minus sign (U+2212)"),
                             ("local k = actor('keeper')\nfunction main()\n  k:place{x = 0, z = -2,5}\nend\n",
                              "drama.lua:3: place: 5 has no name; decimals have a point"),
                             ("", "drama.lua:1: has no function main()"),
                             ("local k = actor('keeper')\n", "drama.lua:1: has no function main()"),
                             (b"\x1bLua", "drama.lua:1: is compiled Lua"),
                             ("function main()\n  table.sort({2, 1}, function(a, b) wait(1) return a < b end)\nend\n",
                              "drama.lua:2: wait: cannot wait within a function")):
            found = self.checked(script)
            self.assertEqual(len(found), 1, (script, found))
            self.assertIn(told, found[0])

    def imported(self, data):
        (self.project / "drama.lua").write_text(DRAMA, encoding="utf-8")
        (self.folder / "in.xml").write_bytes(data if isinstance(data, bytes) else data.encode("utf-8"))
        return self.editor("import-bml", "p.lararium", "in.xml", "--actor", "C=keeper")

    def test_behaviours(self):
        prefixed = BML.replace("<", "<b:").replace("<b:/", "</b:")
        for text in (f"<?xml version='1.0'?><bml xmlns='http://www.bml-initiative.org/bml/bml-1.0' characterId='C'>{BML}</bml>",
                     f"<b:bml xmlns:b='http://www.bml-initiative.org/bml/bml-1.0' characterId='C'>{prefixed}</b:bml>",
                     f"\ufeff<?xml version='1.0' encoding='UTF-8'?><bml characterId='C'>{BML}</bml>",
                     f"<!DOCTYPE bml [<!ENTITY a 'aa'>]><bml characterId='C'>{BML}</bml>",
                     f"<act><scene><bml characterId='C'><required>{BML}</required></bml></scene></act>",
                     f"<?xml version='1.0' encoding='ISO-8859-1'?><bml characterId='C'><!-- caf\u00e9 -->{BML}</bml>".encode("latin-1"),
                     f"<?xml version='1.0' encoding='UTF-16'?><bml characterId='C'>{BML}</bml>".encode("utf-16")):
            said = self.imported(text)
            self.assertNotIn("warning", said)
            self.assertIn("3 items", said)

    def test_behaviours_without_a_time_are_left_out(self):
        for text in ("<gaze id='a' target='AUDIENCE' start='b:end'/><gaze id='b' target='AUDIENCE' start='a:end'/>",
                     "<gaze id='a' target='AUDIENCE' start='1,5'/>"):
            said = self.imported(f"<bml characterId='C'>{text}</bml>")
            self.assertIn("left out", said)
            self.assertIn("0 items", said)
            self.assertEqual((self.project / "drama.lua").read_text(), DRAMA)


if __name__ == "__main__":
    unittest.main()
