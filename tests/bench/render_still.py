#!/usr/bin/python3
"""Renders what a camera that stands still would film of a textured model.

Reads a glTF binary of unlit textured meshes (the maquette's scene.glb), draws it once from the
pose of one image of a ground_truth.json, and writes a sequence for `lararium-player --benchmark`:
the same picture many times, each with its own noise, and a ground_truth.json.  What the
tracker's poses differ by from frame to frame is then jitter and nothing else.

The picture: triangles with perspective-correct texture coordinates at several samples a pixel,
averaged in linear light; point spread, vignetting, shot and read noise, sRGB curve, 8 bit.
"""
from __future__ import annotations

import argparse
import json
import shutil
import struct
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np

NEAR = 0.02  # metres; what is nearer is cut away
TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}


@dataclass
class Mesh:
    """Triangles of one texture, in the world (Z up)."""

    positions: np.ndarray  # [n][3]
    uv: np.ndarray  # [n][2]
    triangles: np.ndarray  # [m][3]
    texture: np.ndarray  # linear light, BGR


def linear(srgb: np.ndarray) -> np.ndarray:
    """sRGB decoded; both of 0..1."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def encoded(light: np.ndarray) -> np.ndarray:
    """sRGB encoded; both of 0..1."""
    light = np.clip(light, 0.0, 1.0)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def read_glb(path: Path) -> list[Mesh]:
    """The meshes of a glTF binary whose nodes do not move them."""
    content = path.read_bytes()
    magic, _, _, json_size, _ = struct.unpack("<5I", content[:20])
    if magic != 0x46546C67:
        raise SystemExit(f"{path} is not a glTF binary")
    document = json.loads(content[20:20 + json_size])
    binary = content[28 + json_size:]

    def view(index: int) -> tuple[int, int]:
        v = document["bufferViews"][index]
        return v.get("byteOffset", 0), v["byteLength"]

    def array(index: int) -> np.ndarray:
        accessor = document["accessors"][index]
        start = view(accessor["bufferView"])[0] + accessor.get("byteOffset", 0)
        width = WIDTHS[accessor["type"]]
        flat = np.frombuffer(binary, TYPES[accessor["componentType"]], accessor["count"] * width, start)
        return flat.reshape(-1, width)

    def texture(material: dict[str, Any]) -> np.ndarray:
        slot = material["pbrMetallicRoughness"]["baseColorTexture"]["index"]
        image = document["images"][document["textures"][slot]["source"]]
        start, size = view(image["bufferView"])
        picture = cv2.imdecode(np.frombuffer(binary, np.uint8, size, start), cv2.IMREAD_COLOR)
        return linear(picture.astype(np.float32) / 255).astype(np.float32)

    meshes = []
    for node in document["nodes"]:
        if "mesh" not in node:
            continue
        if {"matrix", "translation", "rotation", "scale"} & node.keys():
            raise SystemExit(f"{path}: the node {node.get('name')} is moved, which this reader does not do")
        for part in document["meshes"][node["mesh"]]["primitives"]:
            p = array(part["attributes"]["POSITION"]).astype(float)
            meshes.append(Mesh(np.stack([p[:, 0], -p[:, 2], p[:, 1]], 1),
                               array(part["attributes"]["TEXCOORD_0"]).astype(float),
                               array(part["indices"]).reshape(-1, 3).astype(int),
                               texture(document["materials"][part["material"]])))
    return meshes


def clipped(points: np.ndarray, uv: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """The parts of a triangle beyond the near plane, as triangles (Sutherland and Hodgman)."""
    out = []
    for i in range(3):
        j = (i + 1) % 3
        inside, next_inside = points[i, 2] >= NEAR, points[j, 2] >= NEAR
        if inside:
            out.append((points[i], uv[i]))
        if inside != next_inside:
            s = (NEAR - points[i, 2]) / (points[j, 2] - points[i, 2])
            out.append((points[i] + s * (points[j] - points[i]), uv[i] + s * (uv[j] - uv[i])))
    return [(np.array([out[0][0], out[k][0], out[k + 1][0]]), np.array([out[0][1], out[k][1], out[k + 1][1]]))
            for k in range(1, len(out) - 1)]


class Canvas:
    """Depth, texture coordinates and mesh of every sample."""

    def __init__(self, width: int, height: int, k: np.ndarray, samples: int) -> None:
        self.size = (height * samples, width * samples)
        # c' = s (c + 0.5) - 0.5
        fx, fy, cx, cy = k
        self.k = np.array([fx * samples, fy * samples, (cx + 0.5) * samples - 0.5, (cy + 0.5) * samples - 0.5])
        self.inverse_depth = np.zeros(self.size, np.float32)
        self.uv = np.zeros((*self.size, 2), np.float32)
        self.mesh = np.full(self.size, -1, np.int16)

    def draw(self, points: np.ndarray, uv: np.ndarray, mesh: int) -> None:
        """One triangle in camera coordinates, all of it beyond the near plane."""
        w = 1.0 / points[:, 2]
        x = points[:, 0] * w * self.k[0] + self.k[2]
        y = points[:, 1] * w * self.k[1] + self.k[3]
        left, right = max(int(np.ceil(x.min())), 0), min(int(np.floor(x.max())), self.size[1] - 1)
        top, bottom = max(int(np.ceil(y.min())), 0), min(int(np.floor(y.max())), self.size[0] - 1)
        area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
        if left > right or top > bottom or area == 0:
            return
        px = np.arange(left, right + 1)[None, :]
        py = np.arange(top, bottom + 1)[:, None]
        b0 = ((x[1] - px) * (y[2] - py) - (x[2] - px) * (y[1] - py)) / area
        b1 = ((x[2] - px) * (y[0] - py) - (x[0] - px) * (y[2] - py)) / area
        b2 = 1.0 - b0 - b1
        depth = b0 * w[0] + b1 * w[1] + b2 * w[2]  # linear on the screen, as are u and v times it
        region = (slice(top, bottom + 1), slice(left, right + 1))
        seen = (b0 >= 0) & (b1 >= 0) & (b2 >= 0) & (depth > self.inverse_depth[region])
        if not seen.any():
            return
        for c in range(2):
            value = (b0 * w[0] * uv[0, c] + b1 * w[1] * uv[1, c] + b2 * w[2] * uv[2, c]) / np.where(seen, depth, 1)
            self.uv[region][..., c][seen] = value[seen]
        self.inverse_depth[region][seen] = depth[seen]
        self.mesh[region][seen] = mesh


def render(meshes: list[Mesh], camera: dict[str, Any], samples: int) -> np.ndarray:
    """The picture in linear light, BGR, one value a pixel and channel."""
    width, height = camera["width"], camera["height"]
    rotation = np.array(camera["world_to_camera"]["R"]).reshape(3, 3)
    translation = np.array(camera["world_to_camera"]["t"])
    canvas = Canvas(width, height, np.array(camera["K"]), samples)
    for index, mesh in enumerate(meshes):
        points = mesh.positions @ rotation.T + translation
        corners = points[mesh.triangles]
        depth = corners[:, :, 2]
        for triangle in np.nonzero((depth >= NEAR).any(1))[0]:
            uv = mesh.uv[mesh.triangles[triangle]]
            if (depth[triangle] >= NEAR).all():
                canvas.draw(corners[triangle], uv, index)
            else:
                for part, part_uv in clipped(corners[triangle], uv):
                    canvas.draw(part, part_uv, index)
    picture = np.zeros((*canvas.size, 3), np.float32)
    for index, mesh in enumerate(meshes):
        where = canvas.mesh == index
        if where.any():
            rows, columns = mesh.texture.shape[:2]
            at = canvas.uv[where][None] * np.array([columns, rows], np.float32) - 0.5
            for start in range(0, at.shape[1], 30000):  # cv2.remap takes short rows only
                part = at[:, start:start + 30000].copy()
                colours = cv2.remap(mesh.texture, part, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_WRAP)
                flat = np.flatnonzero(where)[start:start + 30000]
                picture.reshape(-1, 3)[flat] = colours[0]
    return cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA)


def exposed(light: np.ndarray, spread: float, vignetting: float) -> np.ndarray:
    """What reaches the sensor: point spread, darker corners."""
    height, width = light.shape[:2]
    blurred = cv2.GaussianBlur(light, (0, 0), spread)
    y, x = np.mgrid[:height, :width]
    radius = ((x - (width - 1) / 2) ** 2 + (y - (height - 1) / 2) ** 2) / ((width / 2) ** 2 + (height / 2) ** 2)
    return blurred * (1 - vignetting * radius)[..., None]


def noisy(light: np.ndarray, electrons: float, read_noise: float, rng: np.random.Generator) -> np.ndarray:
    """An 8-bit image: shot noise of a sensor that holds so many electrons at white, and read noise."""
    sigma = np.sqrt(np.maximum(light, 0) / electrons + (read_noise / electrons) ** 2)
    return np.rint(255 * encoded(light + sigma * rng.standard_normal(light.shape))).astype(np.uint8)


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--model", type=Path, required=True, help="scene.glb; points.json lies beside it")
    parser.add_argument("--truth", type=Path, required=True, help="ground_truth.json that holds the pose")
    parser.add_argument("--image", type=int, default=0, help="which of its images gives the pose")
    parser.add_argument("--frames", type=int, default=100)
    parser.add_argument("--samples", type=int, default=4, help="along each side of a pixel")
    parser.add_argument("--spread", type=float, default=0.55, help="sigma of the point spread, px")
    parser.add_argument("--vignetting", type=float, default=0.16, help="light lost in the corners")
    parser.add_argument("--electrons", type=float, default=10000, help="of a white pixel")
    parser.add_argument("--read-noise", type=float, default=20, help="electrons")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, required=True, help="folder of the sequence, replaced")
    args = parser.parse_args()

    camera = json.loads(args.truth.read_text())["images"][args.image]
    light = exposed(render(read_glb(args.model), camera, args.samples), args.spread, args.vignetting)
    shutil.rmtree(args.out, ignore_errors=True)
    (args.out / "images").mkdir(parents=True)
    shutil.copy(args.model.parent / "points.json", args.out / "points.json")
    rng = np.random.default_rng(args.seed)
    images = []
    for frame in range(args.frames):
        name = f"images/{frame:06d}.png"
        if not cv2.imwrite(str(args.out / name), noisy(light, args.electrons, args.read_noise, rng)):
            raise SystemExit(f"cannot write {args.out / name}")
        images.append({"frame": frame, "file": name, "visible_fraction": 1.0, "gain_ev": 0.0,
                       **{key: camera[key] for key in ("width", "height", "K", "world_to_camera")}})
    truth = {"units": "m", "fps": 30, "images": images}
    (args.out / "ground_truth.json").write_text(json.dumps(truth, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
