#!/usr/bin/python3
"""Makes a show from a video by subcommands alone, as one makes it in the window.

A place is trained, the stage laid by picks, two occluders drawn on training images,
somebody walks behind the counter and speaks, in the light of a probe; the show is
exported and played.  Picks are ground truth to the nearest pixel.  Prints every figure
beside its bar; a figure that misses its bar fails the test.  Skips (status 77) where the
ground truth is absent.
"""
from __future__ import annotations

import argparse
import json
import shutil
import sys
import wave
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

from maquette_test import SKIPPED, Failure, Report, frames, project, rotation, run

# World metres, z up; the stage's axes are x, z, -y.
ANCHORS = {"origin": (0.0, 0.0, 0.0), "forward": (0.0, 0.85, 0.0), "floor": (0.8, 0.0, 0.0),
           "length_from": (-1.25, 0.9, 0.0), "length_to": (2.2, 0.9, 0.0)}
LENGTH = 3.45
COUNTER = [(-1.2, 0.88, 0.0), (2.2, 0.88, 0.0), (2.2, 0.88, 0.95), (-1.2, 0.88, 0.95)]
# The inner side of the counter's short leg: no image shows the whole of its front.
LEG = [(-1.25, -0.5, 0.0), (-1.25, 0.88, 0.0), (-1.25, 0.88, 0.95), (-1.25, -0.5, 0.95)]
# Where somebody ends their walk behind the counter, and when.
BEHIND = (0.75, 1.95)
THERE_FROM = 90  # frame


class Sitting:
    """The project that the subcommands make in a work folder."""

    def __init__(self, args: argparse.Namespace) -> None:
        self.bin: Path = args.bin
        self.data: Path = args.data / "maquette"
        self.work: Path = args.work
        self.project = self.work / "tavern.lararium"
        self.show = self.work / "tavern.larshow"
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(parents=True)
        self.cameras = self.truth("training")

    def truth(self, sequence: str) -> list[dict[str, Any]]:
        """The true cameras of a recording."""
        return json.loads((self.data / sequence / "ground_truth.json").read_text())["images"]

    def editor(self, *command: object) -> Any:
        """One subcommand; its result."""
        return json.loads(run(self.bin / "lararium-editor", *command, "--json").stdout)

    def edit(self, subcommand: str, *options: object) -> Any:
        """One subcommand on the project; its result."""
        return self.editor(subcommand, self.project, *options)

    def seen(self, image: int, points: list[tuple[float, float, float]]) -> np.ndarray:
        """Pixels of points in a training image, as people click them; NaN where it does not show them."""
        return np.round(project(self.cameras[image], np.array(points)))

    def images_of(self, points: list[tuple[float, float, float]], images: list[int], count: int = 3) -> list[int]:
        """Training images that show all of the points, from as far apart as can be."""
        showing = [i for i in images if np.isfinite(self.seen(i, points)).all()]
        if len(showing) < 2:
            raise Failure(f"no two training images show {points}")
        centres = {i: -np.array(self.cameras[i]["world_to_camera"]["R"]).reshape(3, 3).T
                   @ np.array(self.cameras[i]["world_to_camera"]["t"]) for i in showing}
        chosen = [showing[0]]
        while len(chosen) < min(count, len(showing)):
            chosen.append(max((i for i in showing if i not in chosen),
                              key=lambda i: min(np.linalg.norm(centres[i] - centres[c]) for c in chosen)))
        return chosen


def make_place(sitting: Sitting, report: Report) -> list[int]:
    """A trained place; the training images that one can pick in."""
    sitting.editor("new", sitting.project, "--title", "The tavern")
    trained = sitting.edit("train", "--video", sitting.data / "training" / "video.mp4", "--place", "bar",
                           "--intrinsics", "560,560,319.5,239.5")
    report.fact(f"place bar is trained, {trained['points']} points", trained["place"] == "bar")
    listed = sitting.edit("place", "--images")
    return [image["frame_index"] for image in listed[0]["images"]]


def lay_stage(sitting: Sitting, report: Report, images: list[int]) -> None:
    """Origin, scale and floor."""
    picks = []
    for name, point in ANCHORS.items():
        for image in sitting.images_of([point], images):
            x, y = sitting.seen(image, [point])[0]
            picks += ["--pick", f"{name}={image:06d}.png,{x:g},{y:g}"]
    sitting.edit("stage", *picks, "--length", LENGTH)
    laid = sitting.edit("stage", "--floor")
    report.fact("the metres are those of the picks", laid["scale"]["from"] == "picks")
    report.figure("stage: tilt to the floor of the map, degrees", abs(laid["floor"]["stage_tilt_deg"]), 0.01, False)
    report.figure("stage: height above it, mm", abs(laid["floor"]["stage_height_mm"]), 0.1, False)


def hide(sitting: Sitting, report: Report, images: list[int]) -> None:
    """Two occluders drawn on training images, and the floor that catches shadows."""
    for name, corners, depth in (("counter", COUNTER, 0.66), ("leg", LEG, 0.66)):
        seen = []
        for image in sitting.images_of(corners, images):
            pixels = ",".join(f"{x:g},{y:g}" for x, y in sitting.seen(image, corners))
            seen += ["--seen", f"{image:06d}.png,{pixels}"]
        sitting.edit("occluder", "--draw", name, *seen, "--size", f"depth={depth}")
        drawn = sitting.edit("align", "--occluder", name)
        report.figure(f"{name}: corners, mean error of the picks, px", drawn["error_px"], 1.5, False)
    listed = sitting.edit("occluder", "--add", "floor", "--shape", "floor", "--size", "width=8,depth=5.5", "--at",
                          "0,0,0.15")
    report.fact("three occluders are listed", [o["name"] for o in listed["bar"]] == ["counter", "leg", "floor"])


def stage_drama(sitting: Sitting, report: Report) -> None:
    """Somebody who comes along behind the counter and speaks, and the light on them."""
    sitting.edit("cast", "--name", "keeper", "--height", 1.75)
    sitting.edit("cast", "--name", "keeper", "--voice-rate", 130)
    listed = sitting.edit("cast")
    report.fact("a later change of the voice leaves the height", listed[0]["height"] == 1.75)
    sitting.edit("lines", "--add", "hail", "--speaker", "keeper", "--text", "la=Salvete, hospites! Intrate in tabernam.")
    x, y = BEHIND
    walks = ("timeline", "--add", "walks", "--actor", "keeper")
    sitting.edit(*walks, "--at", 0, "--field", f"from={-x},{-y},-90")
    sitting.edit(*walks, "--at", 0.2, "--field", f"to={x},{-y},180", "--field", "speed=1", "--field", "id=along")
    sitting.edit("timeline", "--add", "speech", "--actor", "keeper", "--at", 0.5, "--field", "line=hail")
    items = sitting.edit("timeline", "--item", "keeper/speech/1", "--move", 0.5)
    report.fact("the timeline holds three items", len(items) == 3)
    sitting.editor("probe", "add", sitting.project, "noon", sitting.data / "probe.exr", "--at", "0,1.2,0")


def speech_level(file: Path) -> float:
    """The loudest tenth of a second, of full scale."""
    with wave.open(str(file)) as sound:
        samples = np.frombuffer(sound.readframes(sound.getnframes()), np.int16).astype(float) / 32768.0
        window = sound.getframerate() * sound.getnchannels() // 10
    count = len(samples) // window
    return float(np.sqrt((samples[: count * window].reshape(count, window) ** 2).mean(1)).max())


def play(sitting: Sitting, report: Report) -> None:
    """The show in the player, as a visitor's camera sees it."""
    sitting.edit("bake")
    sitting.edit("check", "--seconds", 10)
    sitting.edit("export", "--out", sitting.show)
    run(sitting.bin / "lararium-player", sitting.show, "--headless", "--pace", "fast", "--video",
        sitting.data / "handheld" / "video.mp4", "--poses-out", sitting.work / "poses.json", "--record",
        sitting.work / "seen.mp4", "--sound", sitting.work / "heard.wav")
    report.figure("what is said, loudest, of full scale", speech_level(sitting.work / "heard.wav"), 0.01, True)


def registration(sitting: Sitting, report: Report) -> None:
    """The floor of the stage lies where the true one does."""
    with zipfile.ZipFile(sitting.show) as archive:
        place = json.loads(archive.read("manifest.json"))["places"][0]["map_from_stage"]
    floor = np.array([[x, y, 0.0] for x in np.arange(-1.0, 1.6, 0.25) for y in (-0.3, 0.3, 0.8)])
    on_stage = np.stack([floor[:, 0], floor[:, 2], -floor[:, 1]], 1)
    in_map = place["scale"] * on_stage @ rotation(place["rotation"]).T + place["translation"]
    found = json.loads((sitting.work / "poses.json").read_text())["images"]
    tracked = [(f, t) for f, t in zip(found, sitting.truth("handheld")) if f["tracked"]]
    report.figure("handheld: tracked fraction", len(tracked) / len(found), 0.97, True)
    offsets = np.array([project(f, in_map) - project(t, floor) for f, t in tracked])
    report.figure("stage: mean offset of points on its floor, px",
                  float(np.nanmean(np.linalg.norm(offsets, axis=2))), 3.0, False)


def patch(image: np.ndarray, pixel: np.ndarray, half: int = 5) -> np.ndarray:
    """A square about a pixel."""
    x, y = np.round(pixel).astype(int)
    return image[max(y - half, 0): y + half + 1, max(x - half, 0): x + half + 1]


def occlusion(sitting: Sitting, report: Report) -> None:
    """Who stands behind the counter is seen above it, and not through it."""
    real = frames(sitting.data / "handheld" / "video.mp4")
    seen = frames(sitting.work / "seen.mp4")
    report.fact("the recording has every frame", len(real) == len(seen))
    x, y = BEHIND
    breast, knee = np.array([[x, y, 1.3]]), np.array([[x, y, 0.4]])
    above, through = [], []
    for camera, before, after in list(zip(sitting.truth("handheld"), real, seen))[THERE_FROM:]:
        changed = np.abs(before.astype(int) - after).max(2) > 30
        for point, into in ((breast, above), (knee, through)):
            pixel = project(camera, point)[0]
            if np.isfinite(pixel).all():
                into.append(patch(changed, pixel).mean())
    report.fact("frames show where they stand", len(above) > 20 and len(through) > 20)
    report.figure("seen above the counter: share of a patch on the breast", float(np.mean(above)), 0.8, True)
    report.figure("hidden by the counter: share of a patch before the knees", float(np.mean(through)), 0.02, False)


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=Path, required=True, help="folder of the two programs")
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--work", type=Path, required=True, help="emptied first")
    args = parser.parse_args()
    if not (args.data / "maquette" / "points.json").exists():
        print(f"skipped: the ground truth of the maquette is not in {args.data}")
        return SKIPPED
    report = Report()
    try:
        sitting = Sitting(args)
        images = make_place(sitting, report)
        lay_stage(sitting, report, images)
        hide(sitting, report, images)
        stage_drama(sitting, report)
        play(sitting, report)
        registration(sitting, report)
        occlusion(sitting, report)
    except Failure as failure:
        print(failure, file=sys.stderr)
        return 1
    return 1 if report.failed else 0


if __name__ == "__main__":
    sys.exit(main())
