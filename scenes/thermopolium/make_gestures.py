#!/usr/bin/env python3
"""Writes the gestures of the thermopolium as BVH files: python3 make_gestures.py

A gesture is a few key poses of arms, head and trunk of a plain figure that stands with
its feet still. It begins and ends standing with hanging arms, so that it can be laid
over whatever somebody does.
"""

import math
import pathlib

OUT = pathlib.Path(__file__).parent / "thermopolium.lararium" / "motion"
FRAMES_PER_SECOND = 30

# Centimetres. The figure faces +Z, its left is +X; arms are spread in its rest pose.
BONES = [  # name, parent, offset
    ("Hips", None, (0, 92, 0)),
    ("Spine", "Hips", (0, 11, 0)),
    ("Chest", "Spine", (0, 18, 0)),
    ("Neck", "Chest", (0, 22, 0)),
    ("Head", "Neck", (0, 9, 1)),
]
for side, sign in (("Left", 1), ("Right", -1)):
    BONES += [
        (side + "Shoulder", "Chest", (3 * sign, 18, 0)),
        (side + "Arm", side + "Shoulder", (14 * sign, 0, 0)),
        (side + "ForeArm", side + "Arm", (27 * sign, 0, 0)),
        (side + "Hand", side + "ForeArm", (25 * sign, 0, 0)),
        (side + "UpLeg", "Hips", (9 * sign, -4, 0)),
        (side + "Leg", side + "UpLeg", (0, -41, 0)),
        (side + "Foot", side + "Leg", (0, -40, 0)),
    ]
ENDS = {
    "Head": (0, 16, 0),
    "LeftHand": (17, 0, 0),
    "RightHand": (-17, 0, 0),
    "LeftFoot": (0, -7, 14),
    "RightFoot": (0, -7, 14),
}


# ---- quaternions (w, x, y, z) --------------------------------------------------


def product(a, b):
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


def inverse(q):
    return (q[0], -q[1], -q[2], -q[3])


def turn(axis, degrees):
    half = math.radians(degrees) / 2
    return (math.cos(half),) + tuple(math.sin(half) * c for c in axis)


def slerp(a, b, t):
    dot = sum(x * y for x, y in zip(a, b))
    if dot < 0:
        b, dot = tuple(-x for x in b), -dot
    angle = math.acos(min(1.0, dot))
    if angle < 1e-6:
        return a
    u, v = math.sin((1 - t) * angle) / math.sin(angle), math.sin(t * angle) / math.sin(angle)
    return tuple(u * x + v * y for x, y in zip(a, b))


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def cross(a, b):
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def from_columns(x, y, z):
    m = [[x[i], y[i], z[i]] for i in range(3)]
    w = math.sqrt(max(0.0, 1 + m[0][0] + m[1][1] + m[2][2])) / 2
    if w > 0.1:
        return (
            w,
            (m[2][1] - m[1][2]) / (4 * w),
            (m[0][2] - m[2][0]) / (4 * w),
            (m[1][0] - m[0][1]) / (4 * w),
        )
    i = max(range(3), key=lambda k: m[k][k])
    j, k = (i + 1) % 3, (i + 2) % 3
    s = 2 * math.sqrt(max(1e-12, 1 + m[i][i] - m[j][j] - m[k][k]))
    q = [(m[k][j] - m[j][k]) / s, 0, 0, 0]
    q[1 + i] = s / 4
    q[1 + j] = (m[j][i] + m[i][j]) / s
    q[1 + k] = (m[k][i] + m[i][k]) / s
    return tuple(q)


def limb(side, along, palm):
    """Of an arm's bone: the way it points and the way the palm below it would face, as
    the right arm has them; the left one mirrors them."""
    if side == "Left":
        along, palm = (-along[0],) + along[1:], (-palm[0],) + palm[1:]
    sign = 1 if side == "Left" else -1
    x = tuple(sign * c for c in unit(along))  # at rest the bone points along sign * X,
    z = unit(cross(x, tuple(-c for c in palm)))
    return from_columns(x, cross(z, x), z)  # the palm faces -Y


# ---- key poses -----------------------------------------------------------------

# Of the right arm: the way of upper arm, forearm and hand, and the palm's.
HANGS = ((-0.16, -1, -0.02), (-0.10, -1, 0.20), (-0.06, -1, 0.25), (1, 0, 0.1))
RAISED = ((-0.55, -0.72, 0.45), (-0.25, 0.93, 0.40), (-0.15, 1, 0.25), (0, 0.1, 1))
OFFERS = ((-0.30, -1, 0.18), (-0.30, -0.10, 1), (-0.35, -0.05, 1), (0.1, 1, 0))
POINTS = ((-0.30, -0.45, 0.85), (-0.10, -0.05, 1), (-0.08, -0.05, 1), (0.3, -1, 0))
WIDE = ((-0.35, -1, 0.05), (-0.80, -0.10, 0.65), (-0.85, 0.05, 0.60), (0.1, 1, 0.1))
STOPS = ((-0.25, -0.85, 0.50), (0.05, 0.42, 0.95), (0.0, 0.95, 0.35), (0, -0.1, 1))
BEATS = ((-0.22, -1, 0.25), (-0.02, 0.25, 1), (0.0, 0.20, 1), (0.9, 0.3, 0))
BEATEN = ((-0.22, -1, 0.22), (-0.08, -0.20, 1), (-0.06, -0.28, 1), (0.9, 0.3, 0))
# Towards the mouth or the brow: of who prays, the palm turned up.
PRAYS = ((-0.35, -0.70, 0.60), (-0.15, 0.70, 0.75), (-0.12, 0.62, 0.80), (0, 0.8, 0.65))

STANDS = {"Right": HANGS, "Left": HANGS, "head": (0, 0, 0), "trunk": (0, 0, 0), "lift": 0}


def pose(**changes):
    return {**STANDS, **changes}


# name: (seconds, pose); head and trunk in degrees: down, to the left, to the side.
GESTURES = {
    # The open right hand raised: hail and farewell.
    "salute": [
        (0, pose()),
        (0.7, pose(Right=RAISED, head=(-3, -4, 0), trunk=(-2, 0, 0))),
        (1.5, pose(Right=RAISED, head=(4, -4, 0), trunk=(2, 0, 0))),
        (2.3, pose()),
    ],
    # Both hands held out: here it is.
    "offer": [
        (0, pose()),
        (0.7, pose(Right=OFFERS, Left=OFFERS, head=(5, 0, 0), trunk=(5, 0, 0))),
        (1.6, pose(Right=OFFERS, Left=OFFERS, head=(3, 0, 0), trunk=(4, 0, 0))),
        (2.4, pose()),
    ],
    "point": [
        (0, pose()),
        (0.6, pose(Right=POINTS, head=(-2, 0, 0), trunk=(3, 8, 0))),
        (1.4, pose(Right=POINTS, head=(-2, 0, 0), trunk=(3, 8, 0))),
        (2.1, pose()),
    ],
    "nod": [
        (0, pose()),
        (0.3, pose(head=(16, 0, 0), trunk=(3, 0, 0))),
        (0.6, pose(head=(2, 0, 0))),
        (0.9, pose(head=(12, 0, 0), trunk=(2, 0, 0))),
        (1.3, pose()),
    ],
    # The palm against it, the head turned away and back.
    "refuse": [
        (0, pose()),
        (0.6, pose(Right=STOPS, head=(0, 16, 0), trunk=(-4, 4, 0))),
        (0.95, pose(Right=STOPS, head=(0, -12, 0), trunk=(-4, 0, 0))),
        (1.3, pose(Right=STOPS, head=(0, 10, 0), trunk=(-4, 2, 0))),
        (2.1, pose()),
    ],
    "shrug": [
        (0, pose()),
        (0.6, pose(Right=WIDE, Left=WIDE, head=(2, 0, 8), lift=14)),
        (1.2, pose(Right=WIDE, Left=WIDE, head=(2, 0, 8), lift=12)),
        (2.0, pose()),
    ],
    # The forearm beats what is said.
    "explain": [
        (0, pose()),
        (0.5, pose(Right=BEATS, head=(-2, 0, 0))),
        (0.8, pose(Right=BEATEN, head=(5, 0, 0), trunk=(2, 0, 0))),
        (1.1, pose(Right=BEATS, head=(-1, 3, 0))),
        (1.4, pose(Right=BEATEN, head=(6, 3, 0), trunk=(2, 0, 0))),
        (2.2, pose()),
    ],
    # Both hands raised with the palms up, as Romans prayed.
    "pray": [
        (0, pose()),
        (1.1, pose(Right=PRAYS, Left=PRAYS, head=(-10, 0, 0), trunk=(-3, 0, 0))),
        (3.4, pose(Right=PRAYS, Left=PRAYS, head=(-6, 0, 0), trunk=(-2, 0, 0))),
        (4.4, pose(head=(12, 0, 0), trunk=(4, 0, 0))),
        (5.0, pose()),
    ],
}


def angles(down, left, side):
    return product(
        turn((0, 1, 0), left), product(turn((1, 0, 0), down), turn((0, 0, 1), side))
    )


def globals_of(key):
    """The turn of each bone from its rest pose, in the frame of the floor."""
    still = (1, 0, 0, 0)
    trunk = angles(*key["trunk"])
    bones = {name: still for name, _, _ in BONES}
    bones["Spine"] = slerp(still, trunk, 0.5)
    bones["Chest"] = trunk
    head = product(trunk, angles(*key["head"]))
    bones["Neck"], bones["Head"] = slerp(trunk, head, 0.4), head
    for side, sign in (("Left", 1), ("Right", -1)):
        upper, fore, hand, palm = key[side]
        bones[side + "Shoulder"] = product(trunk, turn((0, 0, 1), sign * key["lift"]))
        bones[side + "Arm"] = product(trunk, limb(side, upper, palm))
        bones[side + "ForeArm"] = product(trunk, limb(side, fore, palm))
        bones[side + "Hand"] = product(trunk, limb(side, hand, palm))
    return bones


def sample(keys, time):
    for (t0, before), (t1, after) in zip(keys, keys[1:]):
        if time <= t1:
            share = max(0.0, (time - t0) / (t1 - t0))
            share = share * share * (3 - 2 * share)
            a, b = globals_of(before), globals_of(after)
            return {name: slerp(a[name], b[name], share) for name in a}
    return globals_of(keys[-1][1])


# ---- BVH -----------------------------------------------------------------------


def euler(q):
    """Degrees about Z, then X, then Y of the turned frame."""
    w, x, y, z = q
    m01, m11 = 2 * (x * y - w * z), 1 - 2 * (x * x + z * z)
    m20, m22 = 2 * (x * z - w * y), 1 - 2 * (x * x + y * y)
    m21 = 2 * (y * z + w * x)
    return (
        math.degrees(math.atan2(-m01, m11)),
        math.degrees(math.asin(max(-1.0, min(1.0, m21)))),
        math.degrees(math.atan2(-m20, m22)),
    )


def hierarchy(name, depth, order, lines):
    offset = next(o for n, _, o in BONES if n == name)
    pad = "  " * depth
    root = depth == 0
    lines += [
        f"{pad}{'ROOT' if root else 'JOINT'} {name}",
        f"{pad}{{",
        f"{pad}  OFFSET {offset[0]} {0 if root else offset[1]} {offset[2]}",
        f"{pad}  CHANNELS "
        + ("6 Xposition Yposition Zposition" if root else "3")
        + " Zrotation Xrotation Yrotation",
    ]
    order.append(name)
    for child, parent, _ in BONES:
        if parent == name:
            hierarchy(child, depth + 1, order, lines)
    if name in ENDS:
        x, y, z = ENDS[name]
        lines += [f"{pad}  End Site", f"{pad}  {{", f"{pad}    OFFSET {x} {y} {z}", f"{pad}  }}"]
    lines.append(f"{pad}}}")


def write(name, keys):
    lines, order = ["HIERARCHY"], []
    hierarchy("Hips", 0, order, lines)
    parents = {n: p for n, p, _ in BONES}
    count = round(keys[-1][0] * FRAMES_PER_SECOND) + 1
    lines += ["MOTION", f"Frames: {count}", f"Frame Time: {1 / FRAMES_PER_SECOND:.6f}"]
    for frame in range(count):
        bones = sample(keys, frame / FRAMES_PER_SECOND)
        numbers = [0, 92, 0]
        for bone in order:
            parent = parents[bone]
            local = bones[bone] if parent is None else product(inverse(bones[parent]), bones[bone])
            numbers += euler(local)
        lines.append(" ".join(f"{n:.2f}".rstrip("0").rstrip(".") for n in numbers))
    (OUT / f"{name}.bvh").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    OUT.mkdir(exist_ok=True)
    for name, keys in GESTURES.items():
        write(name, keys)
