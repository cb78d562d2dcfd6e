#!/usr/bin/python3
"""Photographs of one place by different cameras, and how well training places them.

Renders folders of photographs of the maquette with the scripts of TOOLS/phone (which need python3-moderngl), trains each
with unknown intrinsics, and prints how far camera centres and focal lengths are from the truth:

  mixed  31 photographs by five cameras, two of which take images of one size; one is held upright
  ten    10 photographs, each by another camera and of another size
  same   18 photographs of one size by three cameras
  one    14 photographs by one camera
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np


@dataclass
class Camera:
    """Size in pixels, focal length in pixels and two radial terms."""

    width: int
    height: int
    focal: float
    k1: float
    k2: float


CAMERAS = {
    "a": Camera(1280, 720, 986.0, 0.08, -0.10),
    "b": Camera(720, 1280, 880.0, 0.05, -0.07),
    "c": Camera(1024, 768, 640.0, -0.05, 0.02),
    "d": Camera(1280, 720, 760.0, 0.03, -0.02),
    "e": Camera(1200, 900, 1350.0, 0.02, 0.0),
}


def shrunk(name: str, share: float, rng: np.random.Generator) -> Camera:
    """A camera like a known one, of another size and with another lens."""
    base = CAMERAS[name]
    even = [int(side * share) // 2 * 2 for side in (base.width, base.height)]
    return Camera(*even, base.focal * share * rng.uniform(0.9, 1.1), base.k1 + rng.uniform(-0.03, 0.03), base.k2)


def plans(rng: np.random.Generator) -> dict[str, list[Camera]]:
    """The cameras of each folder's photographs."""
    a, b, c = CAMERAS["a"], Camera(1280, 720, 880.0, 0.05, -0.07), Camera(1280, 720, 640.0, -0.05, 0.02)
    return {
        "mixed": [CAMERAS[name] for name in "abcdeabcdabcdeabcdabcdeabcdabca"],
        "ten": [shrunk(name, 1.0 - 0.04 * i, rng) for i, name in enumerate("abcdeabcda")],
        "same": [a, c, a, b, a, b] * 3,
        "one": [a] * 14,
    }


class Photographer:
    """Takes photographs from random places before the counter."""

    def __init__(self, tools: Path, rng: np.random.Generator) -> None:
        sys.path.insert(0, str(tools / "phone"))
        import camera  # pylint: disable=import-error,import-outside-toplevel
        import make  # pylint: disable=import-error,import-outside-toplevel
        import render  # pylint: disable=import-error,import-outside-toplevel
        import sensor  # pylint: disable=import-error,import-outside-toplevel

        self.camera, self.render, self.sensor = camera, render, sensor
        self.meshes, self.rng = make.meshes("maquette"), rng
        self.renderers: dict[tuple[int, int], object] = {}

    def take(self, by: Camera, seed: int) -> tuple[np.ndarray, dict]:
        """An image and the truth about it."""
        size, rng = (by.width, by.height), self.rng
        if size not in self.renderers:
            self.renderers[size] = self.render.Renderer(self.meshes, *size, False, sky=(0.7, 0.76, 0.84))
        renderer = self.renderers[size]
        renderer.gl.__enter__()
        eye = np.array([rng.uniform(-1.4, 1.4), rng.uniform(-2.8, -1.5) - (by.focal > 1200.0), rng.uniform(1.4, 1.8)])
        target = np.array([rng.uniform(-0.6, 0.6) + 0.3 * eye[0], 1.8, rng.uniform(0.85, 1.2)])
        rotation = self.camera.look(eye, target, rng.uniform(-0.06, 0.06))
        still = self.camera.Motion(rotation, eye, np.zeros((3, 3)), np.zeros((3, 3)))
        centre = [0.503 * by.width - 0.5, 0.496 * by.height - 0.5]
        lens = self.camera.Lens(np.array([by.focal, by.focal, *centre]), np.array([by.k1, by.k2, 0, 0]), np.zeros(3))
        stops = rng.uniform(-0.3, 0.3)
        gain = np.array([rng.uniform(0.95, 1.05), 1.0, rng.uniform(0.95, 1.05)]) * 2.0**stops
        light = renderer.picture(still, lens, self.camera.Shutter(*size, 0.0, 0.004, "y"), 4, gain, seed)
        image = self.sensor.Sensor(*size, seed).expose(light, 0.5, stops)
        return image[..., ::-1], {"centre": eye.tolist(), "focal": by.focal}


def centre_errors(truth: dict, poses: list[dict]) -> list[float]:
    """Distances of the camera centres from the true ones in metres, after the best similarity."""
    found, true = [], []
    for record in poses:
        rotation, shift = record["world_to_camera"]["R"], record["world_to_camera"]["t"]
        found.append(-np.reshape(rotation, (3, 3)).T @ np.array(shift))
        true.append(truth[record["file"]]["centre"])
    x, y = np.array(found), np.array(true)
    x, y = x - x.mean(0), y - y.mean(0)
    u, s, vt = np.linalg.svd(y.T @ x)
    d = np.array([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    moved = (s * d).sum() / (x**2).sum() * x @ (u @ np.diag(d) @ vt).T
    return np.linalg.norm(moved - y, axis=1).tolist()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, required=True, help="folder of lararium-editor")
    parser.add_argument("--tools", type=Path, required=True, help="folder with phone/make.py")
    parser.add_argument("--work", type=Path, required=True, help="where images and projects are written")
    args = parser.parse_args()
    rng = np.random.default_rng(5)
    photographer = Photographer(args.tools, rng)
    editor = args.bin / "lararium-editor"
    for name, cameras in plans(rng).items():
        images, project, out = args.work / name, args.work / f"{name}.lararium", args.work / f"{name}.json"
        images.mkdir(parents=True)
        truth = {}
        for i, camera in enumerate(cameras):
            image, truth[f"{i:02d}.jpg"] = photographer.take(camera, 100 + i)
            cv2.imwrite(str(images / f"{i:02d}.jpg"), image, [cv2.IMWRITE_JPEG_QUALITY, 92])
        for command in (["new", project], ["train", project, "--images", images, "--place", "p", "--poses-out", out]):
            subprocess.run([str(part) for part in [editor, *command]], check=True, capture_output=True)
        poses = [record for record in json.loads(out.read_text())["images"] if record["world_to_camera"]]
        errors = centre_errors(truth, poses)
        focals = [abs(record["K"][0] / truth[record["file"]]["focal"] - 1.0) for record in poses]
        print(f"{name}: {len(poses)} of {len(cameras)} located; centres {1000 * np.mean(errors):.1f} mm off in the mean,"
              f" {1000 * max(errors):.1f} at most; focal lengths {100 * np.mean(focals):.2f} %, {100 * max(focals):.2f} %",
              flush=True)


if __name__ == "__main__":
    main()
