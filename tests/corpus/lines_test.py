"""Tables of lines and catalogues as spreadsheets and translators' programs write them."""
import json
import unittest

from speaking import LINES, SpeakingCase


class Lines(SpeakingCase):
    def listed(self):
        return json.loads(self.editor("lines", "p.lararium", "--json"))

    def assert_same(self, data):
        """The table is imported as LINES is, without a warning."""
        (self.folder / "in.csv").write_bytes(data if isinstance(data, bytes) else data.encode("utf-8"))
        before = self.listed()
        said = self.editor("lines", "p.lararium", "--import", "in.csv")
        self.assertNotIn("warning", said)
        self.assertEqual(self.listed(), before)

    def test_separators_marks_and_headers(self):
        plain = LINES.replace('"Salvete, hospites. Quid vultis?"', "Salvete hospites").replace(
            '"Perché così? È là, più giù."', "Perché così")
        (self.project / "lines.csv").write_text(plain, encoding="utf-8")
        semicolons = plain.replace(",", ";")
        for table in ("\ufeff" + semicolons, "\ufeff\ufeff" + plain, "sep=;\n" + semicolons, plain.replace(",", "\t"), plain.replace("\n", "\r\n"),
                      plain.replace("\n", "\r"), plain.replace("\n", ",,,\n"), plain.replace("id,", "id ,").replace("la", " la"),
                      plain.replace("id,speaker,notes", "ID,Speaker,Notes"), plain.replace("\n", "\n\n,,,,\n"),
                      '"' + plain.replace(",", '","').replace("\n", '"\n"')[:-1]):
            self.assert_same(table)
        self.assert_same(plain.encode("utf-16"))
        self.assert_same(plain.encode("utf-16-le"))

    def test_names_of_locales_are_languages(self):
        (self.folder / "in.csv").write_text("id,speaker,pt_BR\nhail,keeper,\"um\ndois\"\n")
        self.editor("lines", "p.lararium", "--import", "in.csv")
        self.assertEqual(self.listed()["lines"][0]["text"], {"pt-BR": "um\ndois"})

    def test_a_guessed_encoding_is_told(self):
        (self.folder / "in.csv").write_bytes(LINES.encode("cp1252"))
        before = self.listed()
        said = self.editor("lines", "p.lararium", "--import", "in.csv")
        self.assertIn("warning: in.csv: is not UTF-8 and was read as windows-1252", said)
        self.assertEqual(self.listed(), before)

    def test_a_bad_row_costs_that_row(self):
        (self.folder / "in.csv").write_text(
            LINES + "hail,keeper,,Iterum,\n!,keeper,,x,\nlate,keeper,,a,b,c\nopen,keeper,,\"x,\nlast,keeper,,Vale,\n")
        said = self.editor("lines", "p.lararium", "--import", "in.csv")
        for told in ("row 5: the id 'hail' occurs twice", "row 6: '!' cannot be a line's id", "row 7: has more cells",
                     "row 8: a quote is not closed"):
            self.assertIn("warning: in.csv: " + told, said)
        self.assertEqual([line["id"] for line in self.listed()["lines"]], ["hail", "part", "third", "last"])

    def test_a_project_with_a_bad_row_plays_and_its_file_is_kept(self):
        table = LINES + "hail,keeper,,Iterum,\n"
        (self.project / "lines.csv").write_text(table, encoding="utf-8")
        said = self.editor("check", "p.lararium", "--seconds", "1", code=1)
        self.assertIn("row 5: the id 'hail' occurs twice; rename one; it was left out", said)
        self.assertIn("occurs twice", self.editor("bake", "p.lararium"))
        self.editor("lines", "p.lararium", "--set", "part", "--text", "la=Vale", code=1)
        self.assertEqual((self.project / "lines.csv").read_text(encoding="utf-8"), table)

    def test_catalogues(self):
        head = 'msgid ""\nmsgstr ""\n"Language: it_IT.UTF-8\\n"\n"Content-Type: text/plain; charset=%s\\n"\n\n'
        body = ('#, fuzzy\n#~ msgid "old"\n#~ msgstr "vecchio"\n\nmsgctxt "hail"\nmsgid "x"\nmsgstr ""\n"Perché "\n"no?"\n\n'
                'msgid "Valete et redite cras."\nmsgid_plural "y"\nmsgstr[0] "Così"\nmsgstr[1] "z"\n\n'
                'msgid "bad\nmsgstr "z"\n\n#, fuzzy\nmsgctxt "third"\nmsgid "x"\nmsgstr "Forse"\n')
        for charset, data in (("UTF-8", b"\xef\xbb\xbf"), ("ISO-8859-1", b"")):
            (self.folder / "it.po").write_bytes(data + (head % charset + body).replace("\n", "\r\n").encode(charset))
            said = self.editor("lines", "p.lararium", "--import", "it.po")
            self.assertIn("2 texts in it", said)
            for told in ("line 21: a quoted text was expected", "of several plural forms the first is taken",
                         "1 fuzzy entries were left out"):
                self.assertIn(told, said)
            texts = {line["id"]: line["text"]["it"] for line in self.listed()["lines"]}
            self.assertEqual(texts, {"hail": "Perché no?", "part": "Così", "third": "Però è tardi."})

    def test_json_with_a_mark(self):
        path = self.project / "project.json"
        for _ in range(2):  # One program put a second mark before that of another.
            path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
            self.assertEqual(len(self.listed()["lines"]), 3)


if __name__ == "__main__":
    unittest.main()
