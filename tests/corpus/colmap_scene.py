"""A scene of three textured boards, its images and its COLMAP model, with everything known exactly."""
import pathlib

import cv2
import numpy

WIDTH, HEIGHT, FOCAL = 640, 480, 560.0
BOARDS = ((0.0, 0.0, 4.0, 3.0), (-0.7, 0.2, 2.6, 0.5), (0.6, -0.2, 2.1, 0.4))  # Centre x, y, distance, half size.
TEXTURE = 900


def texture(seed):
    """Discs of all sizes and greys, in which features are found."""
    random = numpy.random.default_rng(seed)
    image = numpy.full((TEXTURE, TEXTURE, 3), 128, numpy.uint8)
    for _ in range(900):
        x, y = random.integers(0, TEXTURE, 2)
        cv2.circle(image, (int(x), int(y)), int(random.integers(4, 26)), tuple(int(c) for c in random.integers(0, 255, 3)), -1,
                   cv2.LINE_AA)
    return image


class Scene:
    """`cameras`, `images` (id, record, features) and `points` are lines of a text model."""

    def __init__(self, count=6):
        self.poses = [numpy.array([0.16 * (i - (count - 1) / 2), 0.05 * (i % 2), 0.0]) for i in range(count)]
        self.pictures = [self.render(position) for position in self.poses]
        self.names = [f"frame{i:02d}.jpg" for i in range(count)]
        self.cameras = [f"1 PINHOLE {WIDTH} {HEIGHT} {FOCAL} {FOCAL} {WIDTH / 2} {HEIGHT / 2}"]
        self.find_points()

    @staticmethod
    def project(position, point):
        x, y, z = point - position
        return numpy.array([FOCAL * x / z + WIDTH / 2 - 0.5, FOCAL * y / z + HEIGHT / 2 - 0.5])

    def render(self, position):
        picture = numpy.zeros((HEIGHT, WIDTH, 3), numpy.uint8)
        for seed, (cx, cy, z, half) in enumerate(BOARDS):
            corners = [(cx - half, cy - half), (cx + half, cy - half), (cx + half, cy + half), (cx - half, cy + half)]
            image = numpy.float32([self.project(position, numpy.array([x, y, z])) for x, y in corners])
            end = TEXTURE - 1
            warp = cv2.getPerspectiveTransform(numpy.float32([(0, 0), (end, 0), (end, end), (0, end)]), image)
            size = (WIDTH, HEIGHT)
            mask = cv2.warpPerspective(numpy.full((TEXTURE, TEXTURE), 255, numpy.uint8), warp, size)
            board = cv2.warpPerspective(texture(seed), warp, size, flags=cv2.INTER_AREA)
            picture[mask > 127] = board[mask > 127]
        return picture

    def surface(self, position, pixel):
        """The point that a pixel shows: that on the nearest board."""
        ray = numpy.array([(pixel[0] - WIDTH / 2 + 0.5) / FOCAL, (pixel[1] - HEIGHT / 2 + 0.5) / FOCAL, 1.0])
        for cx, cy, z, half in sorted(BOARDS, key=lambda board: board[2]):
            point = position + ray * (z - position[2])
            if abs(point[0] - cx) < half and abs(point[1] - cy) < half:
                return point
        return None

    def find_points(self):
        """Tracks of features that show the same point within a pixel."""
        found = []
        for picture in self.pictures:
            keypoints = cv2.SIFT_create(2000).detect(cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY), None)
            found.append(numpy.array([k.pt for k in keypoints]))
        features = [[] for _ in self.pictures]
        self.points = []
        for first in found[0]:
            point = self.surface(self.poses[0], first)
            seen = []
            for i, position in enumerate(self.poses):
                expected = self.project(position, point) if point is not None else None
                if expected is None or (i > 0 and self.surface(position, expected) is None):
                    continue
                distances = numpy.linalg.norm(found[i] - expected, axis=1)
                if distances.min() < 0.7:
                    seen.append((i, found[i][distances.argmin()]))
            if len(seen) < 3:
                continue
            number = len(self.points) + 1
            track = []
            for i, pixel in seen:
                track += [i + 1, len(features[i])]
                features[i].append(f"{pixel[0] + 0.5:.4f} {pixel[1] + 0.5:.4f} {number}")
            self.points.append(" ".join(map(str, [number, *(f"{x:.9f}" for x in point), 128, 128, 128, 0.5, *track])))
        self.images = []
        for i, position in enumerate(self.poses):
            move = " ".join(f"{-x:.9f}" for x in position)
            self.images.append((f"{i + 1} 1 0 0 0 {move} 1 {self.names[i]}", " ".join(features[i])))

    def write_images(self, folder, names=None):
        for name, picture in zip(names or self.names, self.pictures):
            file = pathlib.Path(folder) / name
            file.parent.mkdir(parents=True, exist_ok=True)
            cv2.imwrite(str(file), picture, [cv2.IMWRITE_JPEG_QUALITY, 97])


def write_model(folder, cameras, images, points, mark=b"", end="\n", blank=True):
    """images: pairs of lines. points None: no file. blank False: an image without features has no second line."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    texts = {"cameras": "# Cameras\n" + "".join(c + "\n" for c in cameras),
             "images": "# Images\n" + "".join(a + "\n" + (b + "\n" if b or blank else "") for a, b in images)}
    if points is not None:
        texts["points3D"] = "# Points\n" + "".join(p + "\n" for p in points)
    for name, text in texts.items():
        (folder / (name + ".txt")).write_bytes(mark + text.replace("\n", end).encode("utf-8"))
