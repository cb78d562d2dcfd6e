"""Makes small people and motions: a person of boxes as glTF, the same skeleton walking as BVH or FBX."""
import base64
import json
import math
import struct
import zlib

# Name, parent, place of the joint (left, up, front; metres), half sizes of its box, centre of the box.
BONES = [
    ("Hips", None, (0, 1.00, 0), (.15, .09, .10), (0, .03, 0)),
    ("Spine", "Hips", (0, 1.14, 0), (.15, .08, .09), (0, .07, 0)),
    ("Chest", "Spine", (0, 1.30, 0), (.17, .09, .10), (0, .09, 0)),
    ("Neck", "Chest", (0, 1.50, 0), (.05, .05, .05), (0, .04, 0)),
    ("Head", "Neck", (0, 1.58, 0), (.08, .12, .10), (0, .11, 0)),
]
for _side, _x in (("Left", 1), ("Right", -1)):
    BONES += [
        (_side + "Shoulder", "Chest", (.05 * _x, 1.44, 0), (.05, .04, .04), (.05 * _x, 0, 0)),
        (_side + "Arm", _side + "Shoulder", (.18 * _x, 1.44, 0), (.13, .05, .05), (.13 * _x, 0, 0)),
        (_side + "ForeArm", _side + "Arm", (.46 * _x, 1.44, 0), (.12, .04, .04), (.12 * _x, 0, 0)),
        (_side + "Hand", _side + "ForeArm", (.72 * _x, 1.44, 0), (.08, .02, .04), (.08 * _x, 0, 0)),
        (_side + "UpLeg", "Hips", (.10 * _x, .95, 0), (.07, .21, .07), (0, -.22, 0)),
        (_side + "Leg", _side + "UpLeg", (.10 * _x, .50, 0), (.06, .20, .06), (0, -.20, 0)),
        (_side + "Foot", _side + "Leg", (.10 * _x, .08, 0), (.05, .04, .12), (0, -.04, .05)),
        (_side + "ToeBase", _side + "Foot", (.10 * _x, .02, .14), (.05, .02, .05), (0, 0, .05)),
    ]
INDEX = {bone[0]: i for i, bone in enumerate(BONES)}
PARENT = {bone[0]: bone[1] for bone in BONES}
PLACE = {bone[0]: bone[2] for bone in BONES}
FLOAT, BYTE, INT = 5126, 5121, 5125


def offset(name):
    base = PLACE[PARENT[name]] if PARENT[name] else (0, 0, 0)
    return tuple(a - b for a, b in zip(PLACE[name], base))


def png(width, height, colour):
    """colour(x, y): red, green and blue, 0 to 255."""
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in colour(x, y)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Figure:
    """The person of boxes; `json` can be changed before it is written."""

    def __init__(self, texture=None):
        self.binary = bytearray()
        self.json = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": []}
        positions, normals, uvs, joints, indices = self._boxes()
        attributes = {
            "POSITION": self.accessor(positions, FLOAT, "VEC3"), "NORMAL": self.accessor(normals, FLOAT, "VEC3"),
            "TEXCOORD_0": self.accessor(uvs, FLOAT, "VEC2"), "JOINTS_0": self.accessor(joints, BYTE, "VEC4"),
            "WEIGHTS_0": self.accessor([(1, 0, 0, 0)] * len(joints), FLOAT, "VEC4")}
        primitive = {"attributes": attributes, "indices": self.accessor(indices, INT, "SCALAR")}
        nodes = [{"name": bone[0], "translation": offset(bone[0])} for bone in BONES]
        for name, parent in PARENT.items():
            if parent:
                nodes[INDEX[parent]].setdefault("children", []).append(INDEX[name])
        bind = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -b[2][0], -b[2][1], -b[2][2], 1) for b in BONES]
        self.json.update(
            nodes=nodes + [{"name": "person", "mesh": 0, "skin": 0}],
            meshes=[{"primitives": [primitive]}],
            skins=[{"joints": list(range(len(BONES))), "inverseBindMatrices": self.accessor(bind, FLOAT, "MAT4")}],
            scenes=[{"nodes": [0, len(BONES)]}], scene=0)
        if texture is not None:
            primitive["material"] = 0
            self.json.update(
                images=[{"bufferView": self.view(texture), "mimeType": "image/png"}], textures=[{"source": 0}],
                materials=[{"name": "m", "pbrMetallicRoughness": {
                    "baseColorTexture": {"index": 0}, "metallicFactor": 0}}])

    @staticmethod
    def _boxes():
        positions, normals, uvs, joints, indices = [], [], [], [], []
        for bone, (_, _, place, half, middle) in enumerate(BONES):
            for axis in range(3):
                for sign in (1, -1):
                    u, v = (axis + 1) % 3, (axis + 2) % 3
                    first = len(positions)
                    for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                        corner = [place[k] + middle[k] for k in range(3)]
                        corner[axis] += sign * half[axis]
                        corner[u] += sign * a * half[u]
                        corner[v] += b * half[v]
                        positions.append(corner)
                        normals.append([sign if k == axis else 0 for k in range(3)])
                        uvs.append(((a + 1) / 2, (1 - b) / 2))
                        joints.append((bone, 0, 0, 0))
                    indices += [(first + i,) for i in (0, 1, 2, 0, 2, 3)]
        return positions, normals, uvs, joints, indices

    def view(self, data):
        self.binary += b"\0" * (-len(self.binary) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, rows, component, kind):
        letter = {FLOAT: "f", BYTE: "B", INT: "I"}[component]
        data = b"".join(struct.pack("<%d%s" % (len(row), letter), *row) for row in rows)
        self.json["accessors"].append(
            {"bufferView": self.view(data), "componentType": component, "count": len(rows), "type": kind})
        return len(self.json["accessors"]) - 1

    def lift_arm(self, interpolation):
        """A clip "wave": the right arm goes up within the second second and down within the third."""
        turns = [(0, 0, math.sin(math.radians(d) / 2), math.cos(math.radians(d) / 2)) for d in (0, 0, -80, 0)]
        if interpolation == "CUBICSPLINE":
            turns = [row for q in turns for row in ((0, 0, 0, 0), q, (0, 0, 0, 0))]
        self.json["animations"] = [{
            "name": "wave",
            "samplers": [{"input": self.accessor([(0,), (1,), (2,), (3,)], FLOAT, "SCALAR"),
                          "output": self.accessor(turns, FLOAT, "VEC4"), "interpolation": interpolation}],
            "channels": [{"sampler": 0, "target": {"node": INDEX["RightArm"], "path": "rotation"}}]}]

    def write_glb(self, path):
        self.json["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        data = bytes(self.binary) + b"\0" * (-len(self.binary) % 4)
        path.write_bytes(struct.pack("<III", 0x46546c67, 2, 28 + len(text) + len(data)) +
                         struct.pack("<II", len(text), 0x4e4f534a) + text +
                         struct.pack("<II", len(data), 0x004e4942) + data)

    def write_gltf(self, path, uri, file=None):
        if uri == "data:":
            uri = "data:application/octet-stream;base64," + base64.b64encode(bytes(self.binary)).decode()
        else:
            (path.parent / (file or uri)).write_bytes(bytes(self.binary))
        self.json["buffers"] = [{"byteLength": len(self.binary), "uri": uri}]
        path.write_text(json.dumps(self.json, ensure_ascii=False), encoding="utf-8")


def walk(name, seconds):
    """Rotations about X, Y and Z in degrees of a joint in a walk of one step a second, arms hanging."""
    swing = math.sin(2 * math.pi * seconds)
    bent = math.cos(2 * math.pi * seconds)
    return {"LeftUpLeg": (-30 * swing, 0, 0), "RightUpLeg": (30 * swing, 0, 0),
            "LeftLeg": (max(0, 40 * bent), 0, 0), "RightLeg": (max(0, -40 * bent), 0, 0),
            "LeftArm": (0, 0, -75), "RightArm": (0, 0, 75)}.get(name, (0, 0, 0))


def rotation(axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return {"X": ((1, 0, 0), (0, c, -s), (0, s, c)), "Y": ((c, 0, s), (0, 1, 0), (-s, 0, c)),
            "Z": ((c, -s, 0), (s, c, 0), (0, 0, 1))}[axis]


def product(*matrices):
    result = matrices[0]
    for m in matrices[1:]:
        result = tuple(tuple(sum(row[k] * m[k][j] for k in range(3)) for j in range(len(m[0]))) for row in result)
    return result


def transposed(m):
    return tuple(zip(*m))


def zxy_angles(m):
    """The angles of Z, X and Y whose rotations, in this order, give the matrix."""
    x = math.asin(max(-1.0, min(1.0, m[2][1])))
    return [math.degrees(a) for a in (math.atan2(-m[0][1], m[1][1]), x, math.atan2(-m[2][0], m[2][2]))]


def write_bvh(path, frame_of=None, up=None, scale=100, frames=60, order="ZXY", **text):
    """Writes the walk, 1.2 m a second. frame_of(name): the orientation of a joint, a rotation matrix, in
    the pose with spread arms; the zero pose then shows no person unless all are the identity. up: a
    rotation of the whole motion. text: name, number and channel convert these to text; prefix, eol, bom,
    stated_frames, frame_time, end_site and encoding change the rest of the file."""
    identity = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    turn = {n: frame_of(n) if frame_of else identity for n in PARENT}
    turn[None] = identity
    number = text.get("number", lambda x: "%.5f" % x)
    name_of = text.get("name", lambda n: n)
    channel = text.get("channel", lambda c: c)
    lines, joints = ["HIERARCHY"], []

    def emit(name, depth):
        tab = "\t" * depth
        local = product(transposed(turn[PARENT[name]]), tuple((scale * c,) for c in offset(name)))
        channels = ["%srotation" % a for a in order]
        if depth == 0:
            channels = ["Xposition", "Yposition", "Zposition"] + channels
        joints.append(name)
        lines.extend([tab + ("ROOT " if depth == 0 else "JOINT ") + name_of(name), tab + "{",
                      tab + "\tOFFSET " + " ".join(number(c[0]) for c in local),
                      tab + "\tCHANNELS %d " % len(channels) + " ".join(map(channel, channels))])
        children = [n for n, parent in PARENT.items() if parent == name]
        for child in children:
            emit(child, depth + 1)
        if not children:
            lines.extend([tab + "\tEnd Site", tab + "\t{", *text.get("end_site", ["OFFSET 0 5 0"]), tab + "\t}"])
        lines.append(tab + "}")

    emit("Hips", 0)
    lines += ["MOTION", "Frames: %d" % text.get("stated_frames", frames),
              "Frame Time: %s" % text.get("frame_time", number(1 / 30))]
    for frame in range(frames):
        seconds, row = frame / 30, []
        for name in joints:
            angles = dict(zip("XYZ", walk(name, seconds)))
            matrix = product(transposed(turn[PARENT[name]]),
                             product(*(rotation(a, angles[a]) for a in "ZXY")), turn[name])
            if name == "Hips":
                place = (0, 1 + .02 * abs(math.sin(2 * math.pi * seconds)), 1.2 * seconds)
                if up:
                    matrix = product(up, matrix)
                    place = tuple(r[0] for r in product(up, tuple((c,) for c in place)))
                row += [scale * c for c in place]
            row += zxy_angles(matrix) if order == "ZXY" else [angles[a] for a in order]
        lines.append(" ".join(number(value) for value in row))
    content = (text.get("prefix", "") + "\n".join(lines) + "\n").replace("\n", text.get("eol", "\n"))
    path.write_bytes((b"\xef\xbb\xbf" if text.get("bom") else b"") + content.encode(text.get("encoding", "utf-8")))


def along_bone(name):
    """An orientation whose X axis lies along the bone, as several programs have their joints."""
    children = [n for n, parent in PARENT.items() if parent == name]
    x = (0, 1, 0) if name in ("Hips", "Chest") else offset(children[0] if children else name)
    length = math.sqrt(sum(c * c for c in x))
    x = tuple(c / length for c in x)
    help_axis = (0, 0, 1) if abs(x[2]) < .9 else (0, 1, 0)

    def cross(a, b):
        return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])

    y = cross(help_axis, x)
    length = math.sqrt(sum(c * c for c in y))
    y = tuple(c / length for c in y)
    return transposed((x, y, cross(x, y)))


TICKS = 46186158000  # Of FBX, a second.
PRE_ROTATION = {"LeftUpLeg": (0, 0, 180), "RightUpLeg": (0, 0, 180), "LeftArm": (0, 0, 90), "RightArm": (0, 0, -90)}


def write_fbx(path, unit_cm=1.0):
    """The walk as text FBX without meshes; legs and arms have pre-rotations. unit_cm: centimetres of a unit."""
    objects, connections, frames = [], [], 61
    turn = {None: ((1, 0, 0), (0, 1, 0), (0, 0, 1))}
    for name, parent in PARENT.items():
        pre = rotation("Z", PRE_ROTATION.get(name, (0, 0, 0))[2])
        turn[name] = product(turn[parent], pre)
        place = product(transposed(turn[parent]), tuple((100 / unit_cm * c,) for c in offset(name)))
        objects.append(
            'Model: %d, "Model::%s", "LimbNode" {\nVersion: 232\nProperties70: {\n'
            'P: "RotationActive", "bool", "", "",1\nP: "InheritType", "enum", "", "",1\n'
            'P: "PreRotation", "Vector3D", "Vector", "",%g,%g,%g\n'
            'P: "Lcl Translation", "Lcl Translation", "", "A",%g,%g,%g\n}\n}'
            % (1000 + INDEX[name], name, *PRE_ROTATION.get(name, (0, 0, 0)), *(c[0] for c in place)))
        connections.append('C: "OO",%d,%d' % (1000 + INDEX[name], 1000 + INDEX[parent] if parent else 0))
    objects += ['AnimationStack: 1, "AnimStack::walk", "" {\n}', 'AnimationLayer: 2, "AnimLayer::base", "" {\n}']
    connections.append('C: "OO",2,1')
    next_id = [5000]

    def curves(name, what, rows):
        node = next_id[0]
        objects.append('AnimationCurveNode: %d, "AnimCurveNode::%s", "" {\n}' % (node, what[4]))
        connections.extend(['C: "OO",%d,2' % node, 'C: "OP",%d,%d, "%s"' % (node, 1000 + INDEX[name], what)])
        for axis, values in zip("XYZ", zip(*rows)):
            next_id[0] += 1
            objects.append(
                'AnimationCurve: %d, "AnimCurve::", "" {\nDefault: 0\nKeyVer: 4008\nKeyTime: *%d {\na: %s\n}\n'
                'KeyValueFloat: *%d {\na: %s\n}\nKeyAttrFlags: *1 {\na: 260\n}\nKeyAttrDataFloat: *4 {\n'
                'a: 0,0,0,0\n}\nKeyAttrRefCount: *1 {\na: %d\n}\n}'
                % (next_id[0], frames, ",".join(str(TICKS * f // 30) for f in range(frames)), frames,
                   ",".join("%g" % v for v in values), frames))
            connections.append('C: "OP",%d,%d, "d|%s"' % (next_id[0], node, axis))
        next_id[0] += 1

    for name in PARENT:
        rows = []
        for f in range(frames):
            angles = dict(zip("XYZ", walk(name, f / 30)))
            matrix = product(*(rotation(a, angles[a]) for a in "ZXY"))
            # In the axes of the joint, which its pre-rotations have turned.
            rows.append(xyz_angles(product(transposed(turn[name]), matrix, turn[name])))
        curves(name, "Lcl Rotation", rows)
    curves("Hips", "Lcl Translation",
           [(0, 100 / unit_cm * (1 + .02 * abs(math.sin(2 * math.pi * f / 30))), 100 / unit_cm * 1.2 * f / 30)
            for f in range(frames)])
    path.write_text(
        '; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXHeaderVersion: 1003\nFBXVersion: 7400\n}\n'
        'GlobalSettings: {\nVersion: 1000\nProperties70: {\nP: "UpAxis", "int", "Integer", "",1\n'
        'P: "UpAxisSign", "int", "Integer", "",1\nP: "FrontAxis", "int", "Integer", "",2\n'
        'P: "FrontAxisSign", "int", "Integer", "",1\nP: "CoordAxis", "int", "Integer", "",0\n'
        'P: "CoordAxisSign", "int", "Integer", "",1\nP: "UnitScaleFactor", "double", "Number", "",%g\n'
        'P: "TimeMode", "enum", "", "",6\n}\n}\nObjects: {\n%s\n}\nConnections: {\n%s\n}\n'
        % (unit_cm, "\n".join(objects), "\n".join(connections)))


def xyz_angles(m):
    """The angles about X, Y and Z of the order in which FBX applies them: X first."""
    y = math.asin(max(-1.0, min(1.0, -m[2][0])))
    return [math.degrees(a) for a in (math.atan2(m[2][1], m[2][2]), y, math.atan2(m[1][0], m[0][0]))]
