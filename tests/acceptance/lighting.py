#!/usr/bin/python3
"""Measures the light on people against path-traced references made with other people's code.

    lighting.py --bin build/release/bin --data FOLDER/lighting --work FOLDER [--methods path,prt,sh,phong]
                [--samples 256] [--document docs/illumination.md] [--reduce PROGRAM]

The figure is imported and baked, each reference is drawn by every method from the same camera, and the
references' own evaluate_lighting.py compares.  With --reduce, that program (reduce_person) first lights
the figure without reflections and reduces it as for browsers; only references without reflections are
compared then, with a bar of their own.  Fails where the player's light (prt) misses a bar.  Skips
(status 77) where the references are absent.
"""
from __future__ import annotations

import argparse
import json
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np

SKIPPED = 77
# The set's world has the figure face +Z and reads its probes with +X in the middle; the stage has people
# face -Z and probes with -Z in the middle (docs/file-formats.md).
STAGE_FROM_WORLD = np.diag([-1.0, 1.0, -1.0])
PROBE_TURN = 90.0  # degrees about the vertical, stage from probe
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"


@dataclass(frozen=True)
class Case:
    """One reference image."""
    reference: str
    probe: str
    time: int
    bounces: int
    bar: float
    aim: float


CASES = [
    Case("t0_courtyard_front_direct", "courtyard", 0, 0, 0.09, 0.06),
    Case("t1_courtyard_front_direct", "courtyard", 1, 0, 0.12, 0.08),
    Case("t2_courtyard_front_direct", "courtyard", 2, 0, 0.12, 0.08),
    Case("t2_sunset_front_direct", "sunset", 2, 0, 0.12, 0.08),
    Case("t0_courtyard_front_global", "courtyard", 0, 4, 0.13, 0.09),
    Case("t1_courtyard_front_global", "courtyard", 1, 4, 0.13, 0.09),
    Case("t2_courtyard_front_global", "courtyard", 2, 4, 0.13, 0.09),
    Case("t2_sunset_front_global", "sunset", 2, 4, 0.13, 0.09),
]
REDUCED_BAR = 0.13  # Applies to light without reflections between surfaces.
GROUND_ALBEDO = 0.5
GROUND_BAR, GROUND_AIM = 0.08, 0.04


def run(*command: object) -> str:
    """Runs a program; its standard output."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(str(c) for c in command)}\n{done.stdout}{done.stderr}")
    return done.stdout


def read_exr(path: Path) -> np.ndarray:
    """RGBA, linear."""
    image = cv2.imread(str(path), cv2.IMREAD_UNCHANGED).astype(np.float64)
    return image[..., [2, 1, 0, 3]]


def write_camera(data: Path, name: str, path: Path) -> None:
    """The set's camera as a poses.json whose world is the stage."""
    camera = json.loads((data / "cameras.json").read_text())["cameras"][name]
    pose = np.array(camera["world_to_camera"])
    rotation = pose[:, :3] @ STAGE_FROM_WORLD.T
    k = np.array(camera["K"])
    record = {
        "file": "000000.png", "width": camera["width"], "height": camera["height"],
        "K": [k[0, 0], k[1, 1], k[0, 2], k[1, 2]],
        "distortion": {"model": "opencv", "k1_k2_p1_p2": [0, 0, 0, 0]},
        "world_to_camera": {"R": rotation.ravel().tolist(), "t": pose[:, 3].tolist()},
        "tracked": True,
    }
    path.write_text(json.dumps({"images": [record]}, indent=1))


class Bench:
    """Draws and compares."""

    def __init__(self, args: argparse.Namespace) -> None:
        self.editor = args.bin / "lararium-editor"
        self.data, self.work, self.samples, self.reduce = args.data, args.work, args.samples, args.reduce
        self.human = self.work / "light.lararium" / "cast" / "figure.larhuman"
        self.camera = self.work / "front.json"

    def prepare(self) -> None:
        """Imports and bakes the figure."""
        self.work.mkdir(parents=True, exist_ok=True)
        project = self.work / "light.lararium"
        if not project.exists():
            run(self.editor, "new", project)
            run(self.editor, "cast", project, "--import", self.data / "figure.glb", "--name", "figure")
        run(self.editor, "bake", project)
        found = sorted(project.rglob("figure.lit.larhuman"))
        if not found:
            raise SystemExit("the figure was not baked")
        self.human = found[0]
        if self.reduce:
            self.human = self.work / "reduced.larhuman"
            run(self.reduce, found[0], self.human)
        write_camera(self.data, "front", self.camera)

    def draw(self, name: str, method: str, probe: str, time: int, *more: object) -> Path:
        """One image in linear radiance."""
        out = self.work / f"{name}_{method}.exr"
        run(self.editor, "reference", self.human, "--probe", self.data / f"{probe}.exr", "--probe-turn", PROBE_TURN,
            "--camera", self.camera, "--clip", "poses", "--time", time, "--method", method,
            "--samples", self.samples, "--out", out, *more)
        return out

    def compare(self, case: Case, method: str) -> dict:
        """The set's own figures of a case."""
        image = self.draw(case.reference, method, case.probe, case.time, "--bounces", case.bounces)
        return json.loads(run("/usr/bin/python3", self.data / "evaluate_lighting.py", image,
                              self.data / f"{case.reference}.exr"))

    def ground(self, variant: str, method: str) -> float:
        """RMSE of the floor's ratio image, where the floor is seen in both."""
        ours, theirs = [], []
        for person in (True, False):
            name = "ground_t2" if person else "ground_empty"
            reference = f"{name}_courtyard_front_{variant}"
            more = ["--ground", GROUND_ALBEDO, "--bounces", 0 if variant == "direct" else 4]
            image = self.draw(reference, method, "courtyard", 2, *more, *([] if person else ["--without-person"]))
            ours.append(read_exr(image))
            theirs.append(read_exr(self.data / f"{reference}.exr"))
        figure = read_exr(self.data / "t2_courtyard_front_direct.exr")[..., 3]
        floor = (theirs[1][..., 3] > 0.999) & (cv2.dilate(figure, np.ones((5, 5))) < 0.001)
        ratio = [pair[0][floor][:, :3] / pair[1][floor][:, :3] for pair in (ours, theirs)]
        return float(np.sqrt(((ratio[0] - ratio[1]) ** 2).mean()))


def main() -> int:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, required=True)
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--work", type=Path, required=True)
    parser.add_argument("--methods", default="prt,sh,phong,path")
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--document", type=Path)
    parser.add_argument("--reduce", type=Path)
    args = parser.parse_args()
    if not (args.data / "cameras.json").exists():
        print("skipped: the references are not here")
        return SKIPPED
    bench = Bench(args)
    bench.prepare()
    methods = args.methods.split(",")
    lines = [f"| relative RMSE | bar | aim | {' | '.join(methods)} |", "|---|---|---|" + "---|" * len(methods)]
    print("\n".join(lines), flush=True)
    missed = 0
    cases = [replace(case, bar=REDUCED_BAR) for case in CASES if case.bounces == 0] if args.reduce else CASES
    for case in cases:
        errors = {method: bench.compare(case, method)["relative_rmse"] for method in methods}
        missed += errors.get("prt", 0.0) > case.bar
        figures = " | ".join(f"{errors[method]:.3f}" for method in methods)
        lines.append(f"| {case.reference} | {case.bar} | {case.aim} | {figures} |")
        print(lines[-1], flush=True)
    for variant in () if args.reduce else ("direct", "global"):
        errors = {method: bench.ground(variant, method) for method in methods}
        missed += errors.get("prt", 0.0) > GROUND_BAR
        figures = " | ".join(f"{errors[method]:.3f}" for method in methods)
        lines.append(f"| floor's ratio, {variant} | {GROUND_BAR} | {GROUND_AIM} | {figures} |")
        print(lines[-1], flush=True)
    if args.document:
        text = args.document.read_text()
        begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
        args.document.write_text(text[:begin] + "\n" + "\n".join(lines) + "\n" + text[end:])
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
