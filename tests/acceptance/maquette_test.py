#!/usr/bin/python3
"""Takes the sample from its video to tracked, composited frames, as a person would.

Runs lararium-editor (train, bake, check, export) and lararium-player on the
maquette and compares what comes out with the ground truth.  Prints every figure
beside its bar; a figure that misses its bar fails the test.  Skips (status 77)
where the ground truth is absent.
"""
from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import time
import zipfile
from pathlib import Path
from typing import Any

import cv2
import numpy as np

SKIPPED = 77


class Failure(Exception):
    """A program did not do what it should."""


class Report:
    """Figures beside their bars."""

    def __init__(self) -> None:
        self.failed = False

    def figure(self, what: str, value: float, bar: float, larger_is_better: bool) -> None:
        """One line; remembers a miss."""
        good = value >= bar if larger_is_better else value <= bar
        self.failed |= not good
        sign = ">=" if larger_is_better else "<="
        print(f"{'ok  ' if good else 'MISS'} {what:<58} {value:10.4g}  (bar {sign} {bar:g})", flush=True)

    def fact(self, what: str, holds: bool) -> None:
        """One line; remembers a no."""
        self.failed |= not holds
        print(f"{'ok  ' if holds else 'MISS'} {what}", flush=True)


def run(*command: object, expect: int = 0) -> subprocess.CompletedProcess[str]:
    """Run a program; a status other than the expected one is a failure."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    if done.returncode != expect:
        raise Failure(f"{' '.join(map(str, command))}\nended with {done.returncode}, not {expect}:\n"
                      f"{done.stdout[-2000:]}\n{done.stderr[-4000:]}")
    return done


class Sample:
    """The sample project, trained and exported in a work folder."""

    def __init__(self, args: argparse.Namespace) -> None:
        self.bin: Path = args.bin
        self.data: Path = args.data / "maquette"
        self.tools: Path = args.data.parent / "tools"
        self.work: Path = args.work
        self.project = self.work / "maquette.lararium"
        self.show = self.work / "maquette.larshow"
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(parents=True)
        shutil.copytree(args.scenes / "maquette" / "maquette.lararium", self.project)
        points = json.loads((self.data / "points.json").read_text())["points"]
        np.savetxt(self.work / "points.txt", [p["xyz"] for p in points])

    def editor(self, subcommand: str, *options: object) -> subprocess.CompletedProcess[str]:
        """One subcommand on the project."""
        return run(self.bin / "lararium-editor", subcommand, self.project, *options)

    def play(self, *options: object, show: Path | None = None,
             expect: int = 0) -> subprocess.CompletedProcess[str]:
        """The player, off screen, every frame once."""
        return run(self.bin / "lararium-player", show or self.show, "--headless", "--pace", "fast", *options,
                   expect=expect)

    def evaluate(self, sequence: str, poses: Path, *options: object) -> dict[str, Any]:
        """Poses against the ground truth of a sequence."""
        done = run("/usr/bin/python3", self.tools / "evaluate_poses.py", "--json", "--ground-truth",
                   self.data / sequence / "ground_truth.json", "--estimate", poses, "--points",
                   self.work / "points.txt", *options)
        return json.loads(done.stdout)


def make_show(sample: Sample, report: Report) -> None:
    """Train, bake, check, export; figures of the training."""
    poses = sample.work / "training_poses.json"
    start = time.monotonic()
    sample.editor("train", "--place", "maquette", "--poses-out", poses, "--json")
    print(f"     training took {time.monotonic() - start:.0f} s")
    trained = sample.evaluate("training", poses)
    report.figure("training: located frames of 120", trained["registered"], 118, True)
    report.figure("training: mean camera-centre error, m", trained["centre_error"]["mean"], 0.01, False)
    sample.editor("bake")
    sample.editor("check")
    sample.editor("export", "--out", sample.show)


def track(sample: Sample, report: Report) -> None:
    """The player on both held-out sequences."""
    poses, stats = sample.work / "handheld_poses.json", sample.work / "handheld_stats.json"
    sample.play("--video", sample.data / "handheld" / "video.mp4", "--poses-out", poses, "--stats-out", stats,
                "--record", sample.work / "handheld.mp4")
    found = sample.evaluate("handheld", poses, "--align", "sim3", "--align-on", "points")
    report.figure("handheld: tracked fraction", found["registered"] / found["images"], 0.97, True)
    report.figure("handheld: median registration error, px", found["registration_px"]["median"], 0.3, False)
    keys = json.loads(stats.read_text())
    report.fact("stats.json holds what the design names",
                all(k in keys for k in ("capture", "track", "simulate", "render", "total", "tracked_fraction",
                                        "relocalizations", "inliers", "peak_resident_mib", "startup_seconds",
                                        "dropped_frames", "gpu")))

    poses = sample.work / "occlusion_poses.json"
    sample.play("--video", sample.data / "occlusion" / "video.mp4", "--poses-out", poses)
    truth = json.loads((sample.data / "occlusion" / "ground_truth.json").read_text())["images"]
    tracked = [i["tracked"] for i in json.loads(poses.read_text())["images"]]
    covered = [i["visible_fraction"] < 0.05 for i in truth]
    first = next(i for i in range(1, len(truth)) if covered[i - 1] and truth[i]["visible_fraction"] > 0.9)
    report.fact(f"occlusion: a pose on frame {first}, the first uncovered one", tracked[first])
    report.fact("occlusion: no pose while the lens is covered",
                not any(t for t, c, i in zip(tracked, covered, truth) if c and i["visible_fraction"] == 0.0))


def steadied(gains: np.ndarray, step: float) -> np.ndarray:
    """Logarithms of gains as people get them: the filter of shared/show/gain_filter.h."""
    left = np.exp(-step / 0.06)
    at, rate = gains[0].copy(), np.zeros(3)
    followed = [at.copy()]
    for measured in gains[1:]:
        predicted = at + rate * step
        off = measured - predicted
        at = predicted + (1.0 - left * left) * off
        rate = rate + (1.0 - left) ** 2 / step * off
        followed.append(at.copy())
    return np.array(followed)


def gain(sample: Sample, report: Report) -> None:
    """The camera's gain while it hunts for its exposure; after frame 44 the sun itself changes."""
    poses = sample.work / "lighting_poses.json"
    sample.play("--video", sample.data / "lighting" / "video.mp4", "--poses-out", poses)
    truth = json.loads((sample.data / "lighting" / "ground_truth.json").read_text())["images"]
    stops = np.array([i["gain_ev"] for i in truth])[:, None]
    measured = np.log2([i["gain"] for i in json.loads(poses.read_text())["images"]])
    followed = steadied(measured * np.log(2.0), 1.0 / 30.0) / np.log(2.0)
    # Green: the white balance of red and blue drifts besides, which gain_ev leaves out.
    for what, found in (("measured", measured), ("as people get it", followed)):
        error = found - stops
        report.figure(f"lighting: gain {what}, frames 0-44, stops rms", np.sqrt(np.mean(error[:45, 1] ** 2)), 0.15,
                      False)
        print(f"     red and blue {np.sqrt(np.mean(error[:45, [0, 2]] ** 2)):.3f}, green afterwards "
              f"{np.sqrt(np.mean(error[45:, 1] ** 2)):.3f}")


def rotation(q: list[float]) -> np.ndarray:
    """Rotation matrix of a unit quaternion w, x, y, z."""
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def project(camera: dict[str, Any], points: np.ndarray) -> np.ndarray:
    """Pixels of points, NaN where they are not in view."""
    pose = camera["world_to_camera"]
    fx, fy, cx, cy = camera["K"]
    x, y, z = (points @ np.array(pose["R"]).reshape(3, 3).T + np.array(pose["t"])).T
    pixels = np.stack([fx * x / z + cx, fy * y / z + cy], 1)
    seen = (z > 0.5) & (pixels >= 0).all(1) & (pixels < [camera["width"], camera["height"]]).all(1)
    pixels[~seen] = np.nan
    return pixels


def stage_registration(sample: Sample, report: Report) -> None:
    """What stands on the stage lies where it should in the picture, and does not swim."""
    with zipfile.ZipFile(sample.show) as archive:
        place = json.loads(archive.read("manifest.json"))["places"][0]["map_from_stage"]
    # The picks put the stage's axes at the world's: right, up, and towards the viewer.
    floor = np.array([[x, y, 0.0] for x in np.arange(-1.0, 1.6, 0.25) for y in (-0.3, 0.3, 0.8)])
    on_stage = np.stack([floor[:, 0], floor[:, 2], -floor[:, 1]], 1)
    in_map = place["scale"] * on_stage @ rotation(place["rotation"]).T + place["translation"]
    truth = json.loads((sample.data / "handheld" / "ground_truth.json").read_text())["images"]
    found = json.loads((sample.work / "handheld_poses.json").read_text())["images"]
    offsets = np.array([project(f, in_map) - project(t, floor) for f, t in zip(found, truth)])
    size = np.linalg.norm(offsets, axis=2)
    report.figure("stage: mean offset of points on its floor, px", float(np.nanmean(size)), 1.5, False)
    swim = np.linalg.norm(np.diff(offsets, axis=0), axis=2)
    report.figure("stage: swimming from frame to frame, mean, px", float(np.nanmean(swim)), 0.15, False)


def frames(path: Path) -> list[np.ndarray]:
    """All frames of a video."""
    video = cv2.VideoCapture(str(path))
    out = []
    while (read := video.read())[0]:
        out.append(read[1])
    return out


def look(sample: Sample, report: Report) -> None:
    """The recorded composite: people where they should be, the rest untouched."""
    real = frames(sample.data / "handheld" / "video.mp4")
    composite = frames(sample.work / "handheld.mp4")
    report.fact("composite has every frame", len(real) == len(composite))
    # The recording is encoded again, so small differences mean nothing.
    changed = [(np.abs(r.astype(int) - c).max(2) > 60).mean() for r, c in zip(real, composite)]
    # People fade in when the place is found.
    appeared = changed[30:]
    report.figure("composite: least part of a frame that people cover", min(appeared), 0.002, True)
    report.figure("composite: largest part of a frame that people cover", max(changed), 0.5, False)


def determinism(sample: Sample, report: Report) -> None:
    """The same bundle, video and seed give the same poses."""
    first, second = sample.work / "first.json", sample.work / "second.json"
    for out in (first, second):
        sample.play("--video", sample.data / "handheld" / "video.mp4", "--frames", 20, "--poses-out", out)
    report.fact("the same run gives the same poses, byte for byte", first.read_bytes() == second.read_bytes())


def damaged_bundles(sample: Sample, report: Report) -> None:
    """Each is refused with one clear error and status 1."""
    content = sample.show.read_bytes()
    flipped = bytearray(content)
    flipped[len(flipped) // 2] ^= 1
    cases = {"flipped": bytes(flipped), "truncated": content[: len(content) // 2], "empty": b"",
             "foreign": b"This is not a show.\n" * 100}
    for name, damaged in cases.items():
        (sample.work / f"{name}.larshow").write_bytes(damaged)
    with zipfile.ZipFile(sample.work / "escape.larshow", "w") as archive:
        archive.writestr("manifest.json", "{}")
        archive.writestr("../x", "x")
    for name in (*cases, "escape"):
        done = sample.play("--video", sample.data / "handheld" / "video.mp4",
                           show=sample.work / f"{name}.larshow", expect=1)
        lines = done.stderr.strip().splitlines()
        report.fact(f"{name} bundle: {lines[-1] if lines else '(silence)'}",
                    len(lines) == 1 and f"{name}.larshow" in lines[0])


def hostile_scripts(sample: Sample, report: Report) -> None:
    """An endless script is stopped with an error, and the show goes on."""
    drama = sample.project / "drama.lua"
    original = drama.read_text()
    for name, script in (("endless loop", "while true do end"),
                         ("endless allocation", "local block, all = ('x'):rep(60000), {} while true do "
                          "for _ = 1, 12 do all[#all + 1] = block .. #all end wait(0) end")):
        drama.write_text(original.replace("function main()", f"function main()\n  start(function() {script} end)"))
        show, stats = sample.work / "hostile.larshow", sample.work / "hostile_stats.json"
        sample.editor("export", "--out", show)
        done = sample.play("--video", sample.data / "handheld" / "video.mp4", "--frames", 30, "--stats-out", stats,
                           show=show)
        error = next((line for line in done.stderr.splitlines() if "drama.lua:" in line), "(silence)")
        report.fact(f"{name}: {error}",
                    error != "(silence)" and json.loads(stats.read_text())["render"]["count"] == 30)
    drama.write_text(original)


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=Path, required=True, help="folder of the two programs")
    parser.add_argument("--scenes", type=Path, required=True)
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--work", type=Path, required=True, help="emptied first")
    args = parser.parse_args()
    if not (args.data / "maquette" / "points.json").exists():
        print(f"skipped: the ground truth of the maquette is not in {args.data}")
        return SKIPPED
    report = Report()
    try:
        sample = Sample(args)
        for step in (make_show, track, gain, stage_registration, look, determinism, damaged_bundles, hostile_scripts):
            step(sample, report)
    except Failure as failure:
        print(failure, file=sys.stderr)
        return 1
    return 1 if report.failed else 0


if __name__ == "__main__":
    sys.exit(main())
