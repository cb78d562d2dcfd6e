#!/usr/bin/python3
"""Tracks what phones film in a place that another phone filmed, without being told the lens.

Trains the room of DATA/phone/walk-training with unknown intrinsics, plays the other sequences in it, and prints how far
the drawn points of the surfaces are from where the phone saw them, each at the time of its own row. Fails where a bar is
missed. Exits with 77 where the data or its scripts (tools/ beside it) are missing.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

PYTHON = "/usr/bin/python3"
SKIPPED = 77
PHONE = "881.4,881.4,636.1,362.8,0.05,-0.07,0,0"  # The mean lens of the visitors' phone.
FALSE_PX = 10.0  # A pose whose median error is larger is wrong.


@dataclass
class Sequence:
    """A film, what is told of its lens, and the bars: median and 95 % of the error in pixels."""

    name: str
    intrinsics: str
    median: float
    p95: float


SEQUENCES = [
    Sequence("visit", "", 0.5, 1.5),
    Sequence("visit", PHONE, 0.5, 1.5),
    Sequence("switch", "", 0.5, 1.5),
    Sequence("shake", "", 1.5, 4.0),
    Sequence("shake", PHONE, 1.0, 3.0),
    Sequence("portrait", "", 0.3, 1.0),
]


def run(log: Path, *command: object) -> None:
    """Runs a program; its output goes to the log."""
    with log.open("a", encoding="utf-8") as out:
        out.write("$ " + " ".join(map(str, command)) + "\n")
        out.flush()
        subprocess.run([str(part) for part in command], stdout=out, stderr=out, check=True)


def at_own_row(in_camera: np.ndarray, record: dict, scale: float, project) -> np.ndarray:
    """Where points are drawn while the shutter rolls; in_camera is of the middle of the image."""
    pixels = project(in_camera)
    rolling = record.get("rolling_shutter")
    if rolling is None:
        return pixels
    turn, shift = np.array(rolling["rotation"]), scale * np.array(rolling["translation"])
    size = np.array([record["width"], record["height"]])
    for _ in range(6):
        time = ((pixels - (size - 1) / 2) / size) @ np.array(rolling["readout"])
        across = np.cross(turn, in_camera)
        second = 0.5 * time[:, None] ** 2 * np.cross(turn, across)
        pixels = project(in_camera + time[:, None] * (across + shift) + second)
    return pixels


def measure(tools: Path, truth_file: Path, poses_file: Path, points_file: Path, alignment: Path) -> dict:
    """The errors of a sequence's poses."""
    sys.path[:0] = [str(tools / "phone"), str(tools)]
    import evaluate_poses as evaluate  # pylint: disable=import-error,import-outside-toplevel
    import rows  # pylint: disable=import-error,import-outside-toplevel

    truth, points = rows.Truth(truth_file), evaluate.read_points(points_file)
    poses, move = evaluate.read_poses(poses_file), evaluate.load_alignment(alignment)
    records = {record["file"]: record for record in json.loads(poses_file.read_text())["images"]}
    errors, medians, centres, focal = [], [], [], []
    for name in truth.frames:
        pose, motion = poses[name], truth.motion(name)
        if pose.rotation is None:
            continue
        rotation, translation = move.pose(pose.rotation, pose.translation)
        seen, pixels = truth.pixels(name, points)

        def project(in_camera: np.ndarray, pose=pose) -> np.ndarray:
            return evaluate.project(in_camera, np.eye(3), np.zeros(3), pose.k, pose.distortion)[0]

        drawn = at_own_row(seen @ rotation.T + translation, records[name], move.scale, project)
        errors.append(np.linalg.norm(drawn - pixels, axis=1))
        medians.append(float(np.median(errors[-1])))
        centres.append(float(np.linalg.norm(-rotation.T @ translation - motion.centre)))
        focal.append(abs(pose.k[0] / truth.lens(name)[0][0] - 1))
    together = np.concatenate(errors)
    return {
        "frames": len(truth.frames),
        "tracked": len(medians),
        "wrong": sum(median > FALSE_PX for median in medians),
        "median": float(np.median(together)),
        "p95": float(np.percentile(together, 95)),
        "centre": float(np.median(centres)),
        "focal_first": focal[0],
        "focal_later": float(np.percentile(focal[60:], 95)),
    }


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, required=True)
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--work", type=Path, required=True)
    args = parser.parse_args()
    phone, tools = args.data / "phone", args.data.parent / "tools"
    if not (phone / "visit").exists() or not (tools / "phone" / "rows.py").exists():
        print("the phone sequences or their scripts are missing")
        return SKIPPED
    work = args.work
    subprocess.run(["rm", "-rf", work], check=True)
    work.mkdir(parents=True)
    log, show, alignment = work / "log.txt", work / "room.larshow", work / "alignment.json"
    editor, player = args.bin / "lararium-editor", args.bin / "lararium-player"
    points, training = args.data / "maquette" / "points.json", phone / "walk-training"
    project, trained = work / "room.lararium", work / "training.json"
    run(log, editor, "new", project)
    run(log, editor, "train", project, "--video", training / "video.mp4", "--place", "room", "--poses-out", trained)
    run(log, editor, "bake", project)
    run(log, editor, "export", project, "--out", show)
    run(log, PYTHON, tools / "evaluate_poses.py", "--ground-truth", training / "ground_truth.json", "--estimate", trained,
        "--align-on", "points", "--points", points, "--save-alignment", alignment, "--estimated-intrinsics")
    print("| sequence | lens | tracked | wrong | px median | px 95 % | bars | camera mm | focal length off: first, later % |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    missed = 0
    for sequence in [Sequence("walk-training", "of training", 0.3, 1.0), *SEQUENCES]:
        poses = trained
        if sequence.name != "walk-training":
            poses = work / f"{sequence.name}{'-told' if sequence.intrinsics else ''}.json"
            told = ["--intrinsics", sequence.intrinsics] if sequence.intrinsics else []
            run(log, "xvfb-run", "-a", player, show, "--video", phone / sequence.name / "video.mp4", "--pace", "fast",
                "--headless", "--size", "64x36", "--quality", "5", "--audio", "none", "--smoothing", "off",
                "--poses-out", poses, *told)
        found = measure(tools, phone / sequence.name / "ground_truth.json", poses, points, alignment)
        lens = "of training" if poses == trained else "told" if sequence.intrinsics else "not told"
        print(f"| {sequence.name} | {lens} | {found['tracked']}/{found['frames']} | {found['wrong']} | {found['median']:.2f} |"
              f" {found['p95']:.2f} | {sequence.median}, {sequence.p95} | {1000 * found['centre']:.1f} |"
              f" {100 * found['focal_first']:.2f}, {100 * found['focal_later']:.2f} |", flush=True)
        missed += (found["wrong"] > 0 or found["tracked"] < 0.99 * found["frames"] or found["median"] > sequence.median
                   or found["p95"] > sequence.p95)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
