#!/usr/bin/python3
"""How well the player finds what stands before a place, on the maquette's `occlusion` sequence.

The true foreground of each frame is where it differs from a picture of the empty place, which TOOLS/phone renders with
the true pose (this needs python3-moderngl); the threshold is chosen so that the area agrees with the sequence's true
visible fraction. SHOW is a bundle of the trained maquette, such as tests/acceptance/maquette_test.py leaves in its work
folder.
"""
from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np

# Frames count of which this share is visible: below it the tracker may be lost, above it hardly anything is in front.
COUNTED = (0.3, 0.98)


def without_specks(mask: np.ndarray, least: int = 2500) -> np.ndarray:
    """The mask without patches and holes smaller than some pixels."""
    for value in (1, 0):
        count, labels, stats, _ = cv2.connectedComponentsWithStats((mask == value).astype(np.uint8))
        for label in range(1, count):
            if stats[label, cv2.CC_STAT_AREA] < least:
                mask[labels == label] = 1 - value
    return mask


def true_foreground(image: np.ndarray, empty: np.ndarray, visible: float) -> np.ndarray:
    """Where an image differs from a picture of the empty place."""
    difference = cv2.GaussianBlur(np.abs(image.astype(np.float32) - empty).max(2), (0, 0), 1.2)
    best, best_error = np.zeros(difference.shape, np.uint8), np.inf
    for threshold in range(8, 40):
        mask = cv2.morphologyEx((difference > threshold).astype(np.uint8), cv2.MORPH_OPEN, np.ones((7, 7), np.uint8))
        mask = without_specks(cv2.morphologyEx(mask, cv2.MORPH_CLOSE, np.ones((25, 25), np.uint8)))
        error = abs(mask.mean() - (1.0 - visible))
        if error < best_error:
            best, best_error = mask, error
    return best


class EmptyPlace:
    """Pictures of the maquette with nobody in it."""

    def __init__(self, data: Path, tools: Path) -> None:
        sys.path.insert(0, str(tools / "phone"))
        import camera  # pylint: disable=import-error,import-outside-toplevel
        import render  # pylint: disable=import-error,import-outside-toplevel
        import scene  # pylint: disable=import-error,import-outside-toplevel
        import sensor  # pylint: disable=import-error,import-outside-toplevel

        self.camera, self.table, self.steps = camera, sensor.tone_table(), sensor.STEPS
        self.renderer = render.Renderer(scene.load_glb(data / "scene.glb"), 640, 480)

    def picture(self, truth: dict) -> np.ndarray:
        """The picture with the pose and the gain of a frame, BGR."""
        rotation = np.array(truth["world_to_camera"]["R"]).reshape(3, 3)
        centre = -rotation.T @ np.array(truth["world_to_camera"]["t"])
        still = self.camera.Motion(rotation, centre, np.zeros((3, 3)), np.zeros((3, 3)))
        lens = self.camera.Lens(np.array(truth["K"]), np.zeros(4), np.zeros(3))
        light = self.renderer.picture(still, lens, self.camera.Shutter(640, 480, 0.0, 0.0), 4,
                                      gain=(2.0 ** truth["gain_ev"],) * 3)
        light = cv2.GaussianBlur(light, (0, 0), 0.55)
        return np.interp(light * self.steps, np.arange(len(self.table)), self.table)[..., ::-1]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, required=True, help="folder of lararium-player")
    parser.add_argument("--show", type=Path, required=True)
    parser.add_argument("--data", type=Path, required=True, help="folder that holds `maquette`")
    parser.add_argument("--tools", type=Path, required=True, help="folder that holds `phone`")
    parser.add_argument("--work", type=Path, required=True, help="is emptied; keeps the masks")
    args = parser.parse_args()

    shutil.rmtree(args.work, ignore_errors=True)
    (args.work / "found").mkdir(parents=True)
    sequence = args.data / "maquette" / "occlusion"
    subprocess.run([args.bin / "lararium-player", args.show, "--video", sequence / "video.mp4", "--headless", "--pace", "fast",
                    "--foreground-out", args.work / "found", "--poses-out", args.work / "poses.json",
                    "--stats-out", args.work / "stats.json"], check=True, capture_output=True)
    found = sorted((args.work / "found").iterdir())
    images = json.loads((sequence / "ground_truth.json").read_text())["images"]
    video = cv2.VideoCapture(str(sequence / "video.mp4"))
    place = EmptyPlace(args.data / "maquette", args.tools)
    ratios, common, joined, false = [], 0, 0, []
    for truth, file in zip(images, found, strict=True):
        image = video.read()[1]
        mask = cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) > 127
        visible = truth["visible_fraction"]
        if visible == 1.0:
            false.append(mask.mean())
        if not COUNTED[0] <= visible <= COUNTED[1]:
            continue
        true = true_foreground(image, place.picture(truth), visible) > 0
        cv2.imwrite(str(args.work / f"{truth['frame']:06d}.png"), np.hstack([image, np.where(
            mask[..., None], image // 2 + np.array([0, 0, 127], np.uint8), image)]))
        ratios.append((mask & true).sum() / (mask | true).sum())
        common += (mask & true).sum()
        joined += (mask | true).sum()
        print(f"frame {truth['frame']:3d}: visible {visible:.2f}, intersection over union {ratios[-1]:.3f}")
    print(f"{len(ratios)} frames: intersection over union {common / joined:.3f} of all pixels, {np.mean(ratios):.3f} in the mean")
    print(f"{len(false)} free frames: {100 * np.mean(false):.3f} % taken for foreground in the mean, {100 * max(false):.2f} % at most")


if __name__ == "__main__":
    main()
