"""SubRip and WebVTT as people and programs write them."""
import re
import unittest

from speaking import SpeakingCase

TIMING = re.compile(r"(?m)^\d\d:\d\d:\d\d[,.]\d\d\d --> .*$")


class Captions(SpeakingCase):
    def setUp(self):
        super().setUp()
        self.srt = self.exported("a.srt")
        self.vtt = self.exported("a.vtt")
        self.cues = len(TIMING.findall(self.srt))
        self.assertGreaterEqual(self.cues, 3)

    def exported(self, name):
        self.editor("captions", "p.lararium", "--language", "it", "--seconds", "30", "--out", name)
        return (self.folder / name).read_text(encoding="utf-8")

    def imported(self, data, extension="srt", code=0):
        """Imports captions into a fresh folder; returns what was said and the captions of the lines."""
        name = "in." + extension
        (self.folder / name).write_bytes(data if isinstance(data, bytes) else data.encode("utf-8"))
        audio = self.project / "audio" / "la"
        for old in audio.glob("*.srt") if audio.exists() else ():
            old.unlink()
        said = self.editor("captions", "p.lararium", "--seconds", "30", "--import", name, "--language", "it",
                           code=code)
        texts = "".join(f.read_text(encoding="utf-8") for f in sorted(audio.glob("*.it.srt")))
        return said, texts

    def assert_taken(self, data, extension="srt", told=None):
        """All captions arrive with their letters. Nothing is told, or what `told` says."""
        plain = self.imported(self.srt)[1]
        said, texts = self.imported(data, extension)
        words = lambda text: re.sub(r"\s+", " ", re.sub(r"(?m)^(\d+|.*-->.*)$", "", text)).strip()
        self.assertEqual(words(texts), words(plain), said)
        if told is None:
            self.assertNotIn("warning", said)
        else:
            self.assertRegex(said, told)

    def test_line_ends_marks_and_encodings(self):
        self.assert_taken(b"\xef\xbb\xbf" + self.srt.encode())
        self.assert_taken(b"\xef\xbb\xbf" * 2 + self.srt.encode())
        self.assert_taken(self.srt.replace("\n", "\r\n"))
        self.assert_taken(self.srt.replace("\n", "\r"))
        self.assert_taken(self.srt.encode("utf-16"))
        self.assert_taken(self.srt.encode("utf-16-be"))
        self.assert_taken(self.srt.encode("cp1252"), told="warning: in.srt: is not UTF-8 and was read as windows-1252")

    def test_times_of_all_kinds(self):
        srt = self.srt
        self.assert_taken(srt.replace(",", ".", 1))
        self.assert_taken(re.sub(r"(\d\d:\d\d),(\d\d\d)", r"\1.\2", srt))
        self.assert_taken(re.sub(r"(,\d\d)\d\b", r"\1", srt))
        self.assert_taken(re.sub(r"(,\d)\d\d\b", r"\1", srt))
        self.assert_taken(re.sub(r"\b00:00:", "0:0:", srt))
        self.assert_taken(re.sub(r"\b00:(\d\d:\d\d,)", r"\1", srt))
        self.assert_taken(re.sub(r",\d\d\d", "", srt))
        self.assert_taken(srt.replace(" --> ", "-->"))
        self.assert_taken(srt.replace(" --> ", " -> "))
        self.assert_taken(re.sub(r"(?m)(-->.*)$", r"\1  X1:100 X2:540 Y1:400 Y2:460", srt))

    def test_blank_rows_and_numbers_anywhere(self):
        srt = self.srt
        self.assert_taken("\n\n" + srt)
        self.assert_taken(re.sub(r"(?m)^\d+\n(?=\d\d:)", "", srt))
        self.assert_taken(srt.replace("\n\n", "\n"))
        self.assert_taken(re.sub(r"(?m)^(\d+)\n(?=\d\d:)", r"\1\n\n", srt))
        self.assert_taken(re.sub(r"(?m)(-->.*)$", r"\1\n", srt))
        self.assert_taken(re.sub(r"(?m)^(\d+)$", r"\1  ", srt))
        self.assert_taken(re.sub(r"(?m)(, |\? )", r"\1\n\n", srt, count=1))

    def test_a_bad_caption_costs_that_caption(self):
        srt = self.srt
        for bad, told in (("1\n00:00:01,000 --> 00:00:02,000\n\n", "line 2: the caption has no text; it was left out"),
                          ("1\n00:00:01,000 --> 00:00:01,000\nx\n\n", "line 2: the caption ends before it begins"),
                          ("1\n-00:00:01,000 --> 00:00:02,000\nx\n\n", "line 2: .* is not a time such as"),
                          ("1\nzero --> one\nx\n\n", "line 1: .* has no time")):
            self.assert_taken(bad + srt, told="warning: in.srt: " + told)
        self.assert_taken(srt + "\n\n9999\n", told='"9999" has no time')
        self.assertRegex(self.imported("hello\n", code=1)[0], "in.srt: no caption can be read: line 1")

    def test_tags_and_entities(self):
        self.assert_taken(re.sub(r"(?m)(-->.*\n)(.*)$", r'\1<font color="#f00"><i>{\\an8}\2</i></font>', self.srt))
        self.assert_taken(self.srt.replace("è", "&#232;").replace("ù", "&#xF9;"))
        self.assert_taken(self.srt.replace("è", "&egrave;").replace("ù", "&ugrave;"))

    def test_web_captions(self):
        body = self.vtt.split("\n\n", 1)[1]
        ids = re.compile(r"(?m)^[\w/-]+\n(?=\d\d:\d\d)")
        for head in ("WEBVTT\nKind: captions\nLanguage: it\n\n", "WEBVTT - Titoli\n\n", "WEBVTT\n",
                     "WEBVTT\nX-TIMESTAMP-MAP=LOCAL:00:00:00.000,MPEGTS:0\n\n",
                     "WEBVTT\n\nSTYLE\n::cue { color: red; }\n\nNOTE\nun commento\n\nNOTE un altro\n\nREGION\nid:a\n\n"):
            self.assert_taken(head + body, "vtt")
        for name in ("NOTEBOOK-1", "STYLED", "REGIONAL", "NOTE", "1"):
            self.assert_taken("WEBVTT\n\n" + ids.sub(name + "\n", body), "vtt")
        self.assert_taken(re.sub(r"\b00:(\d\d:\d\d\.)", r"\1", self.vtt), "vtt")
        self.assert_taken(re.sub(r"(?m)(-->.*)$", r"\1 line:0 position:20% align:start", self.vtt), "vtt")
        self.assert_taken(re.sub(r"(?m)(-->.*\n)", r"\1<v Placidus>", self.vtt), "vtt")
        self.assert_taken(self.vtt.replace(" --> ", "\t-->\t"), "vtt")
        self.assert_taken(b"\xef\xbb\xbf" + self.vtt.replace("\n", "\r\n").encode(), "vtt")
        said, _ = self.imported(self.vtt.replace("WEBVTT", "webvtt", 1), "vtt", code=1)
        self.assertIn("begins with WEBVTT in capital letters", said.strip().splitlines()[-1])

    def test_breaks_of_other_formats_are_breaks(self):
        first = TIMING.search(self.srt)[0]
        _, texts = self.imported(f"1\n{first}\nPrima riga\\NSeconda\\hriga\n\n")
        self.assertIn("Prima riga\nSeconda riga\n", texts)
        times = first.replace(",", ".")
        _, texts = self.imported(f"WEBVTT\n\n{times}\n<31:05.500>Ciao <31:06.000>bella <3\n\n", "vtt")
        self.assertIn("\nCiao bella <3\n", texts)

    def test_captions_at_the_same_time_keep_their_times(self):
        first, second = "00:00:00,100 --> 00:00:03,000", "00:00:01,000 --> 00:00:02,000"
        for one, other in ((first, first), (first, second)):
            _, texts = self.imported(f"1\n{one}\n- Salve!\n\n2\n{other}\n{{\\an8}}- Vale!\n\n")
            self.assertIn(f"{one}\n- Salve!\n", texts)
            self.assertIn(f"{other}\n- Vale!\n", texts)

    def test_letters_that_only_a_caption_file_has_are_drawn_or_told(self):
        audio = self.project / "audio" / "la"
        audio.mkdir(parents=True)
        (audio / "hail.it.srt").write_text("1\n00:00:00,0 --> 00:00:02,0\n\u202b\u05e9\u05dc Ж\u200b\u202c\n",
                                           encoding="utf-8")
        said = self.editor("check", "p.lararium", "--seconds", "1", code=1)
        for letter in ("05E9", "05DC"):
            self.assertIn(f"captions: the font has no character U+{letter}", said)
        for known in ("0416", "202B", "202C", "200B"):
            self.assertNotIn("U+" + known, said)

    def test_captions_beside_a_recording_are_checked(self):
        audio = self.project / "audio" / "la"
        audio.mkdir(parents=True)
        (audio / "Hail.it.SRT").write_bytes("1\n00:00:00,0 --> 00:00:01,0\nPerché?\n\n2\nx --> y\nz\n".encode("cp1252"))
        (audio / "hale.it.srt").write_text("1\n00:00:00,0 --> 00:00:01,0\nx\n")
        said = self.editor("check", "p.lararium", "--seconds", "1", code=1)
        self.assertIn("Hail.it.SRT: is not UTF-8 and was read as windows-1252", said)
        self.assertIn("hale.it.srt: belongs to no line", said)


if __name__ == "__main__":
    unittest.main()
