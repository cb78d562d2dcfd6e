#!/usr/bin/python3
"""Images of places that a map does not show, many and cheap: made from images of other places.

Each is a part of one image, seen askew and in other light, or a mixture of two: side by side, one on top of the other, or
patches of one in the other. Some are mirrored. The folder is for `lararium-player SHOW --benchmark DIR --foreign FOLDER`, which
counts how many of them get a pose.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np

WIDTH, HEIGHT = 640, 480
VIDEOS = (".mp4", ".mkv", ".webm", ".mov")


def read(sources: list[Path], every: int) -> list[np.ndarray]:
    """The images of folders and every n-th frame of films, at most 1280 pixels long."""
    images = []

    def keep(image: np.ndarray | None) -> None:
        if image is not None:
            scale = min(1.0, 1280 / max(image.shape[:2]))
            images.append(cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA))

    for source in sources:
        if source.suffix.lower() in VIDEOS:
            film = cv2.VideoCapture(str(source))
            index = 0
            while film.grab():
                if index % every == 0:
                    keep(film.retrieve()[1])
                index += 1
        else:
            for file in sorted(source.iterdir()):
                keep(cv2.imread(str(file)))
    return images


def askew(image: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """A random part of an image, as a camera that looks from another side may show it."""
    height, width = image.shape[:2]
    share = rng.uniform(0.45, 1.0)
    part = np.array([WIDTH, HEIGHT]) * share * min(width / WIDTH, height / HEIGHT)
    corner = rng.uniform(0, np.maximum([width, height] - part, 1e-3))
    corners = corner + part * (np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) + rng.uniform(-0.12, 0.12, (4, 2)))
    turn = np.radians(rng.uniform(-25, 25))
    middle = corners.mean(0)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    corners = (corners - middle) @ rotation.T + middle
    target = np.array([[0, 0], [WIDTH, 0], [WIDTH, HEIGHT], [0, HEIGHT]], np.float32)
    warp = cv2.getPerspectiveTransform(corners.astype(np.float32), target)
    seen = cv2.warpPerspective(image, warp, (WIDTH, HEIGHT), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REFLECT)
    return seen[:, ::-1] if rng.random() < 0.3 else seen


def mixed(a: np.ndarray, b: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """One of several mixtures of two images."""
    kind = rng.integers(4)
    if kind == 0:
        return a
    if kind == 1:  # Side by side.
        cut = int(rng.uniform(0.3, 0.7) * WIDTH)
        return np.concatenate([a[:, :cut], b[:, cut:]], axis=1)
    if kind == 2:  # One shines through the other.
        share = rng.uniform(0.3, 0.7)
        return cv2.addWeighted(a, share, b, 1.0 - share, 0.0)
    patched = a.copy()
    for _ in range(rng.integers(2, 9)):
        size = rng.integers([60, 60], [260, 220])
        x, y = rng.integers([0, 0], [WIDTH - size[0], HEIGHT - size[1]])
        u, v = rng.integers([0, 0], [WIDTH - size[0], HEIGHT - size[1]])
        patched[y:y + size[1], x:x + size[0]] = b[v:v + size[1], u:u + size[0]]
    return patched


def in_other_light(image: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Exposure, contrast, colour, focus and noise."""
    light = (image / 255.0) ** rng.uniform(0.7, 1.5) * 2.0 ** rng.uniform(-0.8, 0.5)
    light = light * rng.uniform(0.9, 1.1, 3)
    if rng.random() < 0.5:
        light = cv2.GaussianBlur(light, (0, 0), rng.uniform(0.4, 1.6))
    light = light + rng.normal(0.0, rng.uniform(0.002, 0.02), light.shape)
    return np.clip(255.0 * light, 0, 255).astype(np.uint8)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sources", type=Path, nargs="+", help="folders of images, and films, of other places")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--every", type=int, default=10, help="takes every n-th frame of a film")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    cv2.setNumThreads(1)
    images = read(args.sources, args.every)
    if len(images) < 2:
        parser.error("the sources hold fewer than two images")
    args.out.mkdir(parents=True)
    print(f"{args.count} images from {len(images)}, seed {args.seed}", flush=True)
    for i in range(args.count):
        rng = np.random.default_rng([args.seed, i])
        a, b = (askew(images[k], rng) for k in rng.choice(len(images), 2, replace=False))
        made = in_other_light(mixed(a, b, rng), rng)
        cv2.imwrite(str(args.out / f"{i:05d}.jpg"), made, [cv2.IMWRITE_JPEG_QUALITY, 85])


if __name__ == "__main__":
    main()
