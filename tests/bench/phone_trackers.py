#!/usr/bin/python3
"""Judges the poses of any tracker on the phone sequences, and runs OpenCV's pipeline on them.

    phone_trackers.py --data DATA --opencv FOLDER                    # runs SIFT, FLANN and solvePnPRansac, and judges them
    phone_trackers.py --data DATA --tracker NAME=FOLDER[,ALIGNMENT]  # judges poses that are there; may be repeated

A tracker's FOLDER holds SEQUENCE.json for some of the sequences of DATA/phone: {"images": [...]}, for each tracked frame "file",
"K", "distortion", "width", "height" and "world_to_camera" as in their ground_truth.json. ALIGNMENT moves the tracker's map into the
world; evaluate_poses.py --save-alignment makes it from the tracker's poses of walk-training. Without it, poses count as in the
world's frame. OpenCV's map is made from every tenth frame of walk-training at its true pose, and it is told the mean of the main
lens. acceptance/phone.py leaves ours: --tracker Lararium=WORK,WORK/room-alignment.json.

Errors are those of points drawn where the phone saw them, each at the time of its own row; a pose is wrong if their median is
above 10 pixels. Processor time is that of a frame with one thread, where the tracker's FOLDER/SEQUENCE-report.json states it.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Sequence

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "acceptance"))
import phone  # pylint: disable=wrong-import-position

SEQUENCES = ("visit", "switch", "shake", "portrait")


def write_mean_lens(truth_file: Path, copy: Path) -> None:
    """Copies a ground truth in which each image was taken by the mean of the main lens."""
    truth = json.loads(truth_file.read_text())
    main = [image for image in truth["images"] if image["lens"] == "main"]
    mean = {"K": np.mean([image["K"] for image in main], axis=0).tolist(), "distortion": main[0]["distortion"]}
    for image in truth["images"]:
        image.update(mean)
    copy.write_text(json.dumps(truth))


def run_opencv(data: Path, folder: Path, sequences: Sequence[str]) -> None:
    """OpenCV's pipeline."""
    training = data / "phone" / "walk-training"
    for name in sequences:
        sequence, out = data / "phone" / name, folder / name
        if (folder / f"{name}.json").exists():
            continue
        out.mkdir(parents=True, exist_ok=True)
        write_mean_lens(sequence / "ground_truth.json", out / "ground_truth.json")
        phone.run(folder / "log.txt", phone.PYTHON, data.parent / "tools" / "opencv_tracker.py", "--train", training,
                  "--train-video", training / "video.mp4", "--train-step", 10, "--test", out, "--test-video",
                  sequence / "video.mp4", "--threads", 1, "--out", out)
        shutil.copy(out / "report.json", folder / f"{name}-report.json")
        shutil.copy(out / "poses.json", folder / f"{name}.json")


def print_row(data: Path, tracker: str, folder: Path, alignment: Path | None, name: str) -> None:
    """One line of the table."""
    found = phone.measure(data.parent / "tools", data / "phone" / name / "ground_truth.json", folder / f"{name}.json",
                          data / "maquette" / "points.json", alignment)
    report = folder / f"{name}-report.json"
    cost = "–"
    if report.exists():
        times = json.loads(report.read_text())["total_cpu_ms"]
        cost = f"{times['median']:.0f}, {times['p95']:.0f}"
    print(f"| {name} | {tracker} | {found['tracked']}/{found['frames']} | {found['wrong']} | {found['median']:.2f} |"
          f" {found['p95']:.2f} | {1000 * found['centre']:.1f} | {cost} |", flush=True)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--opencv", type=Path, help="where OpenCV's poses are written; those that are there are taken")
    parser.add_argument("--tracker", action="append", default=[], metavar="NAME=FOLDER[,ALIGNMENT]")
    parser.add_argument("--sequences", nargs="+", choices=SEQUENCES, default=SEQUENCES)
    args = parser.parse_args()
    trackers: list[tuple[str, Path, Path | None]] = []
    if args.opencv:
        args.opencv.mkdir(parents=True, exist_ok=True)
        run_opencv(args.data, args.opencv, args.sequences)
        trackers.append(("OpenCV, mean lens told", args.opencv, None))
    for given in args.tracker:
        name, _, rest = given.partition("=")
        folder, _, alignment = rest.partition(",")
        trackers.append((name, Path(folder), Path(alignment) if alignment else None))
    if not trackers:
        parser.error("give --opencv or --tracker")
    print("| sequence | tracker | tracked | wrong | px, median | px, 95 % | camera mm | processor ms, median, 95 % |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for sequence in args.sequences:
        for name, folder, alignment in trackers:
            if (folder / f"{sequence}.json").exists():
                print_row(args.data, name, folder, alignment, sequence)


if __name__ == "__main__":
    main()
