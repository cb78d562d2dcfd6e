"""Recordings of lines as recorders and phones name and store them."""
import array
import json
import math
import shutil
import subprocess
import unittest

from speaking import SpeakingCase


class Recordings(SpeakingCase):
    RATE = 44_100  # Synthesised voices have another rate.

    def setUp(self):
        super().setUp()
        # A voice of which the alignment can find the sounds: that of the baked line.
        self.ffmpeg("-i", self.project / "speech/la/hail.flac", "-ar", self.RATE, "s.wav")

    def baked(self, *files):
        """Puts files (source, name) beside the lines and bakes; returns what was said and the baked rate."""
        folder = self.project / "audio" / "la"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for source, name in files:
            shutil.copy(self.folder / source, folder / name)
        said = self.editor("bake", "p.lararium")
        probe = subprocess.run(["ffprobe", "-v", "error", "-show_streams", "-of", "json", self.project / "speech/la/hail.flac"],
                               check=True, stdout=subprocess.PIPE)
        return said, int(json.loads(probe.stdout)["streams"][0]["sample_rate"])

    def test_are_used_whatever_their_case_and_container(self):
        for container in ("flac", "mp3", "m4a", "ogg", "aiff", "wma", "mka"):
            self.ffmpeg("-i", "s.wav", "s." + container)
        self.assertNotEqual(self.baked()[1], self.RATE)
        for source, name in (("s.wav", "hail.wav"), ("s.wav", "hail.WAV"), ("s.wav", "Hail.wav"), ("s.flac", "HAIL.FLAC"),
                             ("s.mp3", "hail.mp3"), ("s.m4a", "hail.m4a"), ("s.m4a", "hail.MP4"), ("s.ogg", "hail.oga"),
                             ("s.aiff", "hail.aif"), ("s.wma", "hail.wma"), ("s.mka", "hail.mka"), ("s.mp3", "hail.wav")):
            said, rate = self.baked((source, name))
            self.assertEqual(rate, self.RATE, (name, said))
            self.assertNotIn("warning", said)

    def level(self, file):
        """Root mean square and peak of a sound, and how many of its samples lie at full scale."""
        samples = array.array("f")
        samples.frombytes(subprocess.run(["ffmpeg", "-v", "error", "-i", file, "-ac", "1", "-f", "f32le", "-"], check=True,
                                         cwd=self.folder, stdout=subprocess.PIPE).stdout)
        peak = max(abs(x) for x in samples)
        return math.sqrt(sum(x * x for x in samples) / len(samples)), peak, sum(1 for x in samples if abs(x) > 0.9995)

    def test_a_voice_on_one_of_several_channels_keeps_its_level(self):
        plain, _, _ = self.level("s.wav")
        for name, layout, told in (("left", "stereo|c0=c0|c1=0*c0", False), ("centre", "5.1|FC=c0", False),
                                   ("lapel", "stereo|c0=0.1*c0|c1=c0", True), ("swapped", "stereo|c0=c0|c1=-1*c0", True)):
            self.ffmpeg("-i", "s.wav", "-af", "pan=" + layout, name + ".wav")
            said, rate = self.baked((name + ".wav", "hail.wav"))
            self.assertEqual(rate, self.RATE, said)
            self.assertAlmostEqual(self.level(self.project / "speech/la/hail.flac")[0], plain, delta=0.02 * plain, msg=name)
            self.assertEqual("channels weaken each other" in said, told, said)

    def test_a_recording_in_floats_above_full_scale_is_not_clipped(self):
        _, peak, _ = self.level("s.wav")
        self.ffmpeg("-i", "s.wav", "-af", f"volume={4 / peak}", "-c:a", "pcm_f32le", "loud.wav")
        said, _ = self.baked(("loud.wav", "hail.wav"))
        self.assertIn("hail.wav: is 12 dB louder than full scale; it was turned down by that", said)
        _, peak, full = self.level(self.project / "speech/la/hail.flac")
        self.assertGreater(peak, 0.99)
        self.assertLess(full, 4)

    def test_opus_is_used(self):
        self.ffmpeg("-i", "s.wav", "s.opus")
        self.assertEqual(self.baked(("s.opus", "hail.Opus"))[1], 48_000)

    def test_a_film_with_sound_is_a_recording(self):
        self.ffmpeg("-f", "lavfi", "-i", "color=s=64x48:d=1", "-i", "s.wav", "-shortest", "-ar", self.RATE, "film.mov")
        self.assertEqual(self.baked(("film.mov", "hail.mov"))[1], self.RATE)

    def test_headers_without_a_size_are_read_to_the_end(self):
        data = bytearray((self.folder / "s.wav").read_bytes())
        at = data.index(b"data")
        for size in (b"\0\0\0\0", b"\xff\xff\xff\xff"):
            data[at + 4:at + 8] = data[4:8] = size
            (self.folder / "crashed.wav").write_bytes(data)
            self.assertEqual(self.baked(("crashed.wav", "hail.wav"))[1], self.RATE)

    def test_names_that_nearly_fit_are_told(self):
        audio = self.project / "audio"
        (audio / "la").mkdir(parents=True)
        (audio / "Latin").mkdir()
        for name in ("la/hail (1).wav", "la/01 part.wav", "la/thirt.wav", "la/noise.wav", "Latin/hail.wav", "la/._hail.wav"):
            shutil.copy(self.folder / "s.wav", audio / name)
        said = self.editor("check", "p.lararium", "--seconds", "1", code=1)
        for file, line in (("hail (1)", "hail"), ("01 part", "part"), ("thirt", "third")):
            self.assertIn(f"{file}.wav: is not used; if it is the recording of the line '{line}', name it {line}.wav", said)
        self.assertIn("warning: p.lararium/audio/la/noise.wav: belongs to no line", said)
        self.assertIn("audio/Latin: holds recordings or captions, but 'Latin' is no language of the lines", said)
        self.assertNotIn("._hail", said)

    def test_sounds_that_are_not_played_are_told(self):
        audio = self.project / "audio"
        audio.mkdir()
        for name in ("bell.m4a", "DRUM.WAV", "gong.wav", "gong.flac", "gong.m4a", "._horn.wav"):
            shutil.copy(self.folder / "s.wav", audio / name)
        said = self.editor("check", "p.lararium", "--seconds", "1", code=1)
        self.assertIn("audio/bell.m4a: is not played as a sound; save it as WAV", said)
        self.assertIn("audio/gong.wav: gong.flac is the sound of that name", said)
        for name in ("DRUM.WAV", "gong.m4a", "horn"):
            self.assertNotIn(name + ":", said)

    def test_two_recordings_or_one_that_is_no_sound_are_one_line(self):
        (self.folder / "no.wav").write_bytes(b"this is no sound at all, whatever its name says")
        for files, told in (((("s.wav", "hail.wav"), ("s.wav", "hail.WAV")), "keep one of them"),
                            ((("no.wav", "hail.wav"),), "cannot be read as a sound")):
            folder = self.project / "audio" / "la"
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            for source, name in files:
                shutil.copy(self.folder / source, folder / name)
            said = self.editor("bake", "p.lararium", code=1)
            self.assertIn(told, said.strip().splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
