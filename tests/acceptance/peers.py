#!/usr/bin/python3
"""Measures Lararium beside what people use today, and writes docs/benchmarks.md from it.

The peers run on the same machine, on the same images, in the same run: COLMAP for training; SIFT,
FLANN and solvePnPRansac of OpenCV for tracking.  Every figure stands beside its bar.

Each step leaves its result in the work folder as soon as it is done, and is not repeated while that
file is there, so an interrupted run goes on where it stopped.  --again repeats chosen steps, for
instance after a change:

    peers.py ... --parts train,track          two parts only
    peers.py ... --again 'ours/*'             everything of ours anew, the peers as they were
    peers.py ... --parts none                 only print the table and write the document

Skips (status 77) where the ground truth or the peers' scripts are absent.
"""
from __future__ import annotations

import argparse
import datetime
import fnmatch
import json
import os
import re
import resource
import shutil
import sqlite3
import subprocess
import sys
import time
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable

import cv2

SKIPPED = 77
PYTHON = "/usr/bin/python3"
SEQUENCES = ("handheld", "blur", "lighting", "occlusion")
PARTS = ("train", "track", "first-pose", "foreign", "growth", "calibration", "jitter")
VISIBLE = 0.3
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"


class Failure(Exception):
    """A program did not do what it should."""


def say(text: str) -> None:
    """One line, at once."""
    print(text, flush=True)


def run(log: Path, *command: object, environment: dict[str, str] | None = None) -> dict[str, float]:
    """Run a program with its output in a log; wall and processor seconds of it and its children."""
    words = [str(c) for c in command]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    with log.open("a") as out:
        out.write(f"\n$ {' '.join(words)}\n")
        out.flush()
        done = subprocess.run(words, stdout=out, stderr=subprocess.STDOUT, check=False,
                              env={**os.environ, **(environment or {})})
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise Failure(f"{' '.join(words)}\nended with {done.returncode}; the end of {log}:\n"
                      f"{log.read_text(errors='replace')[-1500:]}")
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {"wall_s": wall, "cpu_s": cpu}


@dataclass
class TrainingSet:
    """Images to train from, with their true poses."""

    name: str
    folder: Path  # images/ and ground_truth.json
    points: Path
    matcher: str  # of COLMAP
    known: bool  # intrinsics


class Bench:
    """Steps whose results stay in the work folder."""

    def __init__(self, args: argparse.Namespace) -> None:
        self.args = args
        self.bin: Path = args.bin.resolve()
        self.data: Path = args.data.resolve()
        self.maquette = self.data / "maquette"
        self.tools = self.data.parent / "tools"
        self.work: Path = args.work.resolve()
        (self.work / "results").mkdir(parents=True, exist_ok=True)
        self.failures: list[str] = []

    # ------------------------------------------------------------ steps

    def path(self, name: str) -> Path:
        """Where the result of a step lies."""
        return self.work / "results" / (name.replace("/", "--") + ".json")

    def result(self, name: str) -> Any:
        """What a step left, or None."""
        path = self.path(name)
        return json.loads(path.read_text()) if path.exists() else None

    def step(self, name: str, action: Callable[[Path], Any]) -> None:
        """Do a step unless its result is there. A failure is reported and does not stop the rest."""
        chosen = any(fnmatch.fnmatch(name, pattern) for pattern in self.args.again)
        if self.path(name).exists() and not chosen:
            say(f"have {name}")
            return
        self.path(name).unlink(missing_ok=True)
        folder = self.work / name.replace("/", "--")
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        say(f"run  {name}   (load {os.getloadavg()[0]:.1f})")
        start = time.monotonic()
        try:
            result = action(folder)
        except (Failure, OSError, ValueError, KeyError, subprocess.SubprocessError) as failure:
            self.failures.append(name)
            say(f"FAIL {name}: {failure}")
            return
        document = {"date": datetime.date.today().isoformat(), "load": os.getloadavg()[0], "result": result}
        new = self.path(name).with_suffix(".new")
        new.write_text(json.dumps(document, indent=1) + "\n")
        new.replace(self.path(name))
        say(f"done {name}   {time.monotonic() - start:.0f} s")

    def value(self, name: str, *keys: str | int) -> Any:
        """A figure of a step's result, or None."""
        document = self.result(name)
        value = document["result"] if document else None
        for key in keys:
            if value is None:
                return None
            value = value[key] if isinstance(key, int) or key in value else None
        return value

    # ------------------------------------------------------------ training

    def sets(self) -> list[TrainingSet]:
        """What is trained, ours and theirs."""
        every = [TrainingSet("maquette", self.work / "maquette", self.maquette / "points.json", "sequential", True)]
        for name, known in (("fountain-P11", True), ("fountain-P11-unknown", False), ("fox-pinhole", True)):
            folder = self.data / name.removesuffix("-unknown")
            every.append(TrainingSet(name, folder, folder / "points.txt", "exhaustive", known))
        return [s for s in every if s.name in self.args.sets]

    def extract_frames(self) -> None:
        """The maquette's training video as images: the same for both programs."""
        folder = self.work / "maquette"
        truth = json.loads((self.maquette / "training" / "ground_truth.json").read_text())
        count = min(self.args.frames or len(truth["images"]), len(truth["images"]))
        if (folder / "ground_truth.json").exists():
            if len(json.loads((folder / "ground_truth.json").read_text())["images"]) == count:
                return
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "images").mkdir(parents=True)
        video = cv2.VideoCapture(str(self.maquette / "training" / "video.mp4"))
        for image in truth["images"][:count]:
            good, frame = video.read()
            if not good:
                raise Failure("the training video is too short")
            cv2.imwrite(str(folder / "images" / image["file"]), frame)
        truth["images"] = truth["images"][:count]
        (folder / "ground_truth.json").write_text(json.dumps(truth))

    def evaluate(self, truth: Path, poses: Path, points: Path, *options: str) -> dict[str, Any]:
        """Errors of poses by the reference evaluator: centres after a fit on centres, pixels after one on points."""
        def report(*more: str) -> dict[str, Any]:
            done = subprocess.run([PYTHON, str(self.tools / "evaluate_poses.py"), "--json", "--ground-truth", str(truth),
                                   "--estimate", str(poses), "--points", str(points), *options, *more],
                                  capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise Failure(f"evaluate_poses.py: {done.stderr}")
            return json.loads(done.stdout)
        centres, pixels = report("--align", "sim3"), report("--align", "sim3", "--align-on", "points")
        return {"images": centres["images"], "registered": centres["registered"], "units": centres["units"],
                "centre_error": centres["centre_error"], "rotation_error_deg": centres["rotation_error_deg"],
                "registration_px": pixels["registration_px"],
                "tracked": sorted({r["file"] for r in pixels["per_image"]})}

    def quality(self, item: TrainingSet, poses: Path) -> dict[str, Any]:
        """Errors of a trained set."""
        own = [] if item.known else ["--estimated-intrinsics"]
        return self.evaluate(item.folder / "ground_truth.json", poses, item.points, *own)

    def colmap(self, item: TrainingSet, folder: Path) -> dict[str, Any]:
        """COLMAP, CPU only, defaults but for the intrinsics and the matcher."""
        log, database, sparse = folder / "log.txt", folder / "colmap.db", folder / "sparse"
        sparse.mkdir()
        images = item.folder / "images"
        first = json.loads((item.folder / "ground_truth.json").read_text())["images"][0]
        offscreen = {"QT_QPA_PLATFORM": "offscreen"}
        camera = ["--ImageReader.single_camera", 1, "--ImageReader.camera_model", "SIMPLE_RADIAL"]
        fixed: list[object] = []
        if item.known:
            fx, fy, cx, cy = first["K"]  # COLMAP's pixel centres are at halves
            camera = ["--ImageReader.single_camera", 1, "--ImageReader.camera_model", "PINHOLE",
                      "--ImageReader.camera_params", f"{fx},{fy},{cx + 0.5},{cy + 0.5}"]
            for what in ("focal_length", "principal_point", "extra_params"):
                fixed += [f"--Mapper.ba_refine_{what}", 0]
        match: list[object] = ["exhaustive_matcher"]
        if item.matcher == "sequential":
            match = ["sequential_matcher", "--SequentialMatching.overlap", 10]
        times = {
            "extract": run(log, "colmap", "feature_extractor", "--database_path", database, "--image_path", images,
                           "--SiftExtraction.use_gpu", 0, *camera, environment=offscreen),
            "match": run(log, "colmap", *match, "--database_path", database, "--SiftMatching.use_gpu", 0,
                         environment=offscreen),
            "map": run(log, "colmap", "mapper", "--database_path", database, "--image_path", images, "--output_path",
                       sparse, *fixed, environment=offscreen)}
        models = [p for p in sorted(sparse.iterdir()) if (p / "images.bin").exists()]
        if not models:
            raise Failure("COLMAP made no model")
        # The images are counted at the start of images.bin.
        best = max(models, key=lambda p: int.from_bytes((p / "images.bin").read_bytes()[:8], "little"))
        run(log, PYTHON, self.tools / "colmap_to_poses.py", best, folder / "poses.json")
        with sqlite3.connect(database) as connection:
            features = connection.execute("SELECT AVG(rows) FROM keypoints").fetchone()[0]
        return {"stages": times, "features_per_image": features,
                "wall_s": sum(t["wall_s"] for t in times.values()), "cpu_s": sum(t["cpu_s"] for t in times.values()),
                **self.quality(item, folder / "poses.json")}

    def train(self, item: TrainingSet, folder: Path) -> dict[str, Any]:
        """Our training of the same images."""
        log, project, poses = folder / "log.txt", folder / "set.lararium", folder / "poses.json"
        if item.name == "maquette":  # the sample, so that it can be exported as a show
            shutil.copytree(self.args.scenes / "maquette" / "maquette.lararium", project)
        else:
            run(log, self.bin / "lararium-editor", "new", project)
        first = json.loads((item.folder / "ground_truth.json").read_text())["images"][0]
        known = ["--intrinsics", ",".join(str(v) for v in first["K"])] if item.known else []
        times = run(log, self.bin / "lararium-editor", "train", project, "--images", item.folder / "images", "--place",
                    item.name, "--poses-out", poses, *known)
        return {**times, **self.quality(item, poses)}

    def part_train(self) -> None:
        """COLMAP's training and ours."""
        self.extract_frames()
        for item in self.sets():
            self.step(f"ours/train/{item.name}", lambda folder, item=item: self.train(item, folder))
            if not self.args.no_colmap:
                self.step(f"colmap/{item.name}", lambda folder, item=item: self.colmap(item, folder))

    # ------------------------------------------------------------ tracking

    def make_show(self, folder: Path) -> dict[str, str]:
        """The sample, trained from the same frames as the peers, as visitors get it."""
        project = self.work / "ours--train--maquette" / "set.lararium"
        log, show = folder / "log.txt", folder / "maquette.larshow"
        run(log, self.bin / "lararium-editor", "bake", project)
        run(log, self.bin / "lararium-editor", "export", project, "--out", show)
        return {"show": str(show)}

    def show(self) -> Path:
        """The show to measure with."""
        if self.args.show:
            return self.args.show.resolve()
        if self.result("ours/train/maquette") is None:
            self.extract_frames()
            item = next(s for s in self.sets() if s.name == "maquette")
            self.step("ours/train/maquette", lambda folder: self.train(item, folder))
        self.step("ours/show", self.make_show)
        show = self.value("ours/show", "show")
        if show is None:
            raise Failure("there is no show to measure with")
        return Path(show)

    def sequences(self, *names: str) -> Path:
        """A folder of the sequences of these names, and of their points."""
        folder = self.work / ("sequences-" + "-".join(names))
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        for name in names:
            (folder / name).symlink_to(self.maquette / name)
        (folder / "points.json").symlink_to(self.maquette / "points.json")
        return folder

    def benchmark(self, folder: Path, sequences: Path, *options: object) -> dict[str, Any]:
        """The player's own benchmark; its table goes to the log."""
        report = folder / "benchmark.json"
        limit = ["--frames", self.args.frames] if self.args.frames else []
        run(folder / "log.txt", self.bin / "lararium-player", self.show(), "--benchmark", sequences, "--stats-out",
            report, *limit, *options)
        document = json.loads(report.read_text())
        for sequence in document["sequences"]:
            del sequence["per_frame"]
        return document

    def opencv(self, folder: Path, sequence: str, threads: int) -> dict[str, Any]:
        """The pipeline of OpenCV over a map made with the true training poses."""
        training, test = self.maquette / "training", self.maquette / sequence
        step = max(1, 150 // self.args.frames) if self.args.frames else 1
        run(folder / "log.txt", PYTHON, self.tools / "opencv_tracker.py", "--train", training, "--train-video",
            training / "video.mp4", "--train-step", 5, "--test", test, "--test-video", test / "video.mp4",
            "--test-step", step, "--threads", threads, "--out", folder)
        report = json.loads((folder / "report.json").read_text())
        found = self.evaluate(folder / "truth.json", folder / "poses.json", self.maquette / "points.json")
        tracked = set(found["tracked"])
        visible = [i["file"] for i in json.loads((folder / "truth.json").read_text())["images"]
                   if i["visible_fraction"] >= VISIBLE]
        return {"frames": report["test_frames"], "tracked": len(tracked), "visible": len(visible),
                "visible_tracked": len(tracked & set(visible)), "registration_px": found["registration_px"],
                "wall_ms": report["total_ms"], "cpu_ms": report["total_cpu_ms"]}

    def part_track(self) -> None:
        """Following on one core, beside OpenCV on one thread."""
        for sequence in SEQUENCES:
            self.step(f"ours/track/{sequence}", lambda folder, s=sequence: self.benchmark(
                folder, self.sequences(s), "--threads", 1))
            self.step(f"opencv/1/{sequence}", lambda folder, s=sequence: self.opencv(folder, s, 1))

    def part_first_pose(self) -> None:
        """Finding every frame anew on two cores."""
        self.step("ours/first-pose", lambda folder: self.benchmark(
            folder, self.sequences("handheld"), "--threads", 2, "--first-pose"))
        self.step("opencv/2/handheld", lambda folder: self.opencv(folder, "handheld", 2))

    def part_foreign(self) -> None:
        """Images of other places: shown while searching, and cut into a followed video."""
        foreign: list[object] = []
        for name in ("fox", "fountain-P11", "box/box.mp4"):
            foreign += ["--foreign", self.data / name]
        self.step("ours/foreign", lambda folder: self.benchmark(folder, self.sequences("handheld"), *foreign))

    def part_growth(self) -> None:
        """First poses as the map grows."""
        def measure(folder: Path) -> Any:
            scene, log = folder / "map.larscene", folder / "log.txt"
            with zipfile.ZipFile(self.show()) as show:
                name = next(n for n in show.namelist() if n.endswith(".larscene"))
                scene.write_bytes(show.read(name))
            step = 30 if self.args.frames else 3
            run(log, self.bin / "lararium_map_growth", scene, self.maquette / "handheld" / "video.mp4", step)
            scene.unlink()
            # points, descriptors, tracked %, ms of matching and pose, ms of the first pose, ...
            rows = re.findall(r"^\s*(\d+)\s+(\d+)\s+([\d.]+)%\s+([\d.]+)\s+([\d.]+) ms", log.read_text(), re.M)
            if len(rows) < 2:
                raise Failure(f"cannot read {log}")
            return [{"points": int(r[0]), "descriptors": int(r[1]), "tracked": float(r[2]) / 100,
                     "locate_ms": float(r[3]), "first_ms": float(r[4])} for r in rows]
        self.step("ours/growth", measure)

    def part_calibration(self) -> None:
        """Confidence and covariance over all sequences together, images of other places beside them."""
        self.step("ours/calibration", lambda folder: self.benchmark(folder, self.sequences(*SEQUENCES)))

    def part_jitter(self) -> None:
        """A still camera, with each kind of smoothing; what smoothing costs a moving one."""
        def still(folder: Path) -> dict[str, Any]:
            sequence = folder / "sequence"
            run(folder / "log.txt", PYTHON, Path(__file__).parent.parent / "bench" / "render_still.py", "--model",
                self.maquette / "scene.glb", "--truth", self.maquette / "handheld" / "ground_truth.json", "--image", 40,
                "--out", sequence)
            return {"sequence": str(sequence)}
        self.step("still", still)
        sequence = self.value("still", "sequence")
        for smoothing in ("off", "soft", "strong"):
            if sequence is not None:
                self.step(f"ours/jitter/{smoothing}", lambda folder, s=smoothing: self.benchmark(
                    folder, Path(sequence), "--smoothing", s))
            self.step(f"ours/moving/{smoothing}", lambda folder, s=smoothing: self.benchmark(
                folder, self.sequences("handheld"), "--smoothing", s))

    def measure(self) -> None:
        """All chosen parts."""
        for part in self.args.parts:
            say(f"== {part}")
            try:
                getattr(self, "part_" + part.replace("-", "_"))()
            except (Failure, OSError) as failure:
                self.failures.append(part)
                say(f"FAIL {part}: {failure}")


# ---------------------------------------------------------------- bars

@dataclass
class Line:
    """One figure beside its bars; good says whether a value reaches a bar."""

    what: str
    ours: float | None
    peer: float | None
    bar: float | None
    aim: float | None
    rising: bool  # larger is better

    def reaches(self, bar: float | None) -> bool:
        if self.ours is None or bar is None:
            return False
        return self.ours >= bar if self.rising else self.ours <= bar

    def verdict(self) -> str:
        if self.ours is None or self.bar is None:
            return "not measured"
        if not self.reaches(self.bar):
            return "**missed**"
        return "aim" if self.reaches(self.aim) else "reached"


def ratio(a: float | None, b: float | None) -> float | None:
    """a over b, where both are known."""
    return a / b if a is not None and b else None


def growth_lines(bench: Bench) -> list[Line]:
    """The largest map against the smallest: time and share of frames that get a pose."""
    rows = bench.value("ours/growth") or []
    slower = fall = None
    if rows:
        slower = rows[-1]["first_ms"] / rows[0]["first_ms"]
        fall = max(0.0, 100 * (rows[0]["tracked"] - rows[-1]["tracked"]))
    return [Line("one-frame initialisation, 1 000 000 points over 10 000: time", slower, None, 2, 1.3, False),
            Line("the same: tracked fraction lost, points of a hundred", fall, None, 2, 0, False)]


def lines(bench: Bench) -> list[Line]:
    """The table of bars."""
    v = bench.value
    out = [Line("training the maquette: COLMAP's wall time over ours",
                ratio(v("colmap/maquette", "wall_s"), v("ours/train/maquette", "wall_s")), None, 5, 15, True)]
    for name in ("maquette", "fountain-P11", "fox-pinhole"):
        for key, unit in (("centre_error", "centre error, thousandths of a unit"), ("registration_px", "registration px")):
            ours, peer = v(f"ours/train/{name}", key, "mean"), v(f"colmap/{name}", key, "mean")
            scale = 1000 if key == "centre_error" else 1
            scaled = [None if x is None else scale * x for x in (ours, peer)]
            aim = None if scaled[1] is None else scaled[1] * 0.999
            out.append(Line(f"{name}, known intrinsics: {unit}", scaled[0], scaled[1], scaled[1], aim, False))
    out.append(Line("fountain-P11, unknown intrinsics: registration px with own intrinsics",
                    v("ours/train/fountain-P11-unknown", "registration_px", "mean"),
                    v("colmap/fountain-P11-unknown", "registration_px", "mean"), 0.6, 0.3, False))

    def ours(sequence: str, *keys: str) -> Any:
        return v(f"ours/track/{sequence}", "sequences", 0, *keys)
    for sequence in SEQUENCES:
        out.append(Line(f"{sequence}: processor time of OpenCV's frame over a followed one, one core",
                        ratio(v(f"opencv/1/{sequence}", "cpu_ms", "median"), ours(sequence, "followed_cpu_ms", "median")),
                        None, 10, 20, True))
    out.append(Line("first pose from one frame, two cores: OpenCV's wall time over ours",
                    ratio(v("opencv/2/handheld", "wall_ms", "median"),
                          v("ours/first-pose", "sequences", 0, "found_wall_ms", "median")), None, 2, 4, True))
    for sequence in SEQUENCES:
        peer = v(f"opencv/1/{sequence}", "registration_px", "mean")
        aim = None if peer is None else min(peer / 2, 0.1) if sequence == "handheld" else peer / 2
        out.append(Line(f"{sequence}: registration px, mean", ours(sequence, "registration_px", "mean"), peer, peer, aim,
                        False))
    for sequence, bar in zip(SEQUENCES, (100, 97, 95, 99)):
        share = ratio(ours(sequence, "visible_tracked"), ours(sequence, "visible"))
        peer = ratio(v(f"opencv/1/{sequence}", "visible_tracked"), v(f"opencv/1/{sequence}", "visible"))
        out.append(Line(f"{sequence}: tracked, of frames with 0.3 or more in view, %",
                        None if share is None else 100 * share, None if peer is None else 100 * peer, bar, 100, True))
    recoveries = ours("occlusion", "recoveries")
    slowest = max((r["frames"] if r["found"] else 1000 for r in recoveries), default=None) if recoveries else None
    out.append(Line("occlusion: frames until the pose is back after full cover", slowest, None, 1, 1, False))
    foreign = v("ours/foreign", "foreign") or []
    count = sum(f["frames"] for f in foreign)
    out.append(Line(f"false accepts on {count} images of other places",
                    sum(len(f["accepted"]) for f in foreign) if foreign else None, None, 0, 0, False))
    cuts = sum(f["cuts"] for f in foreign)
    out.append(Line(f"false accepts on {cuts} of them, each cut in after a frame of the place",
                    sum(len(f["accepted_after_cut"]) for f in foreign) if foreign else None, None, 0, 0, False))
    out += growth_lines(bench)
    out.append(Line("calibration error of the confidence, all sequences",
                    v("ours/calibration", "all", "calibration_error"), None, 0.05, 0.02, False))
    error = v("ours/calibration", "all", "normalised_pose_error", "mean")
    out.append(Line("pose error over covariance, per degree of freedom: at most", error, None, 2, 1.2, False))
    out.append(Line("the same: at least", error, None, 0.5, 0.8, True))
    out.append(Line("still camera: jitter px", v("ours/jitter/soft", "sequences", 0, "jitter_px"), None, 0.3, 0.1, False))
    return out


def number(value: float | None) -> str:
    """Three digits that count."""
    if value is None:
        return "–"
    if value == 0 or abs(value) >= 100:
        return f"{value:.0f}"
    text = f"{value:.3g}"
    return text if "e" not in text else f"{value:.5f}"


def table(heads: list[str], rows: list[list[str]]) -> str:
    """Markdown."""
    body = ["| " + " | ".join(row) + " |" for row in (heads, ["---"] * len(heads), *rows)]
    return "\n".join(body)


# ---------------------------------------------------------------- document

def machine() -> str:
    """Processor, cores, system, compiler."""
    info = Path("/proc/cpuinfo").read_text()
    name = re.search(r"model name\s*:\s*(.+)", info)
    system = re.search(r'PRETTY_NAME="(.+)"', Path("/etc/os-release").read_text())
    compiler = subprocess.run(["c++", "-dumpfullversion"], capture_output=True, text=True, check=False).stdout.strip()
    return (f"{os.cpu_count()} cores of {name[1] if name else 'an unknown processor'}, "
            f"{system[1] if system else 'Linux'}, GCC {compiler}, `-O2 -march=x86-64-v3`")


def dates(bench: Bench) -> str:
    """When the steps ran."""
    days = sorted({json.loads(p.read_text())["date"] for p in (bench.work / "results").glob("*.json")})
    return days[0] if len(days) == 1 else f"{days[0]} to {days[-1]}" if days else "no day"


def training_table(bench: Bench) -> str:
    """Both programs on every set."""
    rows = []
    for name in ("maquette", "fountain-P11", "fountain-P11-unknown", "fox-pinhole"):
        for who, key in (("Lararium", f"ours/train/{name}"), ("COLMAP", f"colmap/{name}")):
            r = bench.value(key)
            if r is None:
                continue
            rows.append([name.replace("-unknown", ", unknown intrinsics"), who, f"{r['registered']}/{r['images']}",
                         f"{r['wall_s']:.0f}", f"{r['cpu_s']:.0f}", number(1000 * r["centre_error"]["mean"]),
                         number(r["rotation_error_deg"]["mean"]), number(r["registration_px"]["mean"])])
    return table(["set", "", "located", "wall s", "processor s", "centre error, thousandths", "rotation deg",
                  "registration px"], rows)


def tracking_table(bench: Bench) -> str:
    """Both trackers on every sequence."""
    rows = []
    for sequence in SEQUENCES:
        s, peer = bench.value(f"ours/track/{sequence}", "sequences", 0), bench.value(f"opencv/1/{sequence}")
        if s is not None:
            px, cpu = s["registration_px"], s["followed_cpu_ms"] or {}
            rows.append([sequence, "Lararium", f"{s['visible_tracked']}/{s['visible']}",
                         f"{100 * s['followed'] / max(s['tracked'], 1):.0f} %",
                         " / ".join(number(px[k]) for k in ("mean", "median", "p95", "max")) if px else "–",
                         " / ".join(number(cpu.get(k)) for k in ("median", "p95")), str(s["false_accepts"])])
        if peer is not None:
            px, cpu = peer["registration_px"], peer["cpu_ms"]
            rows.append([sequence, "OpenCV", f"{peer['visible_tracked']}/{peer['visible']}", "0 %",
                         " / ".join(number(px[k]) for k in ("mean", "median", "p95", "max")),
                         " / ".join(number(cpu[k]) for k in ("median", "p95")), "–"])
    return table(["sequence", "", "tracked, of those in view", "followed", "registration px, mean / median / p95 / max",
                  "processor ms, median / p95", "false poses"], rows)


def growth_table(bench: Bench) -> str:
    """First poses in maps of several sizes."""
    rows = [[str(r["points"]), str(r["descriptors"]), f"{100 * r['tracked']:.1f} %", number(r["locate_ms"]),
             number(r["first_ms"])] for r in bench.value("ours/growth") or []]
    return table(["points", "descriptors", "tracked", "matching and pose, ms", "first pose, ms"], rows)


def smoothing_table(bench: Bench) -> str:
    """What smoothing gives and takes."""
    rows = []
    for kind in ("off", "soft", "strong"):
        still = bench.value(f"ours/jitter/{kind}", "sequences", 0)
        moving = bench.value(f"ours/moving/{kind}", "sequences", 0)
        if still is None or moving is None:
            continue
        rows.append([kind, number(still["jitter_px"]), number(moving["lag_ms"]), number(moving["swimming_px"]),
                     number(moving["registration_px"]["mean"])])
    return table(["smoothing", "still camera: jitter px", "handheld: lag ms", "swimming px", "registration px"], rows)


def document(bench: Bench) -> str:
    """What stands between the marks of docs/benchmarks.md."""
    bars = [[line.what, number(line.ours), number(line.peer), number(line.bar), number(line.aim), line.verdict()]
            for line in lines(bench)]
    gain = bench.value("ours/track/lighting", "sequences", 0, "gain_error_stops", "mean")
    first = bench.value("ours/first-pose", "sequences", 0, "found_wall_ms") or {}
    peer_first = bench.value("opencv/2/handheld", "wall_ms") or {}
    return f"""{BEGIN}
Measured on {dates(bench)} with {machine()}. This part is written by `tests/acceptance/peers.py`,
which ran Lararium and its peers (COLMAP, CPU; OpenCV {cv2.__version__}) on the same images in turn.

### Against the bars

{table(["", "ours", "peer", "at least", "aim", ""], bars)}

### Training

{training_table(bench)}

The maquette is 120 frames of 640x480; COLMAP takes the sequential matcher (overlap 10) there and the exhaustive one
on the photographs. Intrinsics are known unless said. Centre errors after a similarity alignment on centres,
registration after one on the points.

### Tracking

{tracking_table(bench)}

One thread. OpenCV's pipeline is SIFT with 1000 features, FLANN, `solvePnPRansac` and refinement on every frame, over a
map made with the true training poses; ours tracks with the map that it trained itself. The first pose from one
frame takes {number(first.get("median"))} ms of wall time (95 %: {number(first.get("p95"))}) on two cores, OpenCV's
{number(peer_first.get("median"))} ({number(peer_first.get("p95"))}). In `lighting` the gain is off by
{number(gain)} stops on average, after the map's own constant.

### As the map grows

{growth_table(bench)}

One thread, processor time; perturbed mixtures of real descriptors are added (`lararium_map_growth`).

### Steadiness

{smoothing_table(bench)}

A still camera is 100 pictures from one pose of the maquette's model, each with its own noise
(`tests/bench/render_still.py`). `soft`, what visitors get, takes corrections after re-localisation back gently;
`strong` adds a low-pass, whose lag the third column states.
{END}"""


def write_document(bench: Bench, path: Path) -> None:
    """Replace the measured part, keep the rest."""
    text = path.read_text() if path.exists() else f"# Benchmarks\n\n{BEGIN}\n{END}\n"
    if BEGIN not in text or END not in text:
        raise Failure(f"{path} lacks the marks {BEGIN} and {END}")
    before, rest = text.split(BEGIN, 1)
    after = rest.split(END, 1)[1]
    path.write_text(before + document(bench) + after)
    say(f"wrote {path}")


def print_bars(bench: Bench) -> bool:
    """Every bar; False where one is missed."""
    good = True
    say(f"\n{'':<84} {'ours':>9} {'peer':>9} {'bar':>9} {'aim':>9}")
    for line in lines(bench):
        good &= line.verdict() != "**missed**"
        say(f"{line.what:<84} {number(line.ours):>9} {number(line.peer):>9} {number(line.bar):>9} {number(line.aim):>9}"
            f"  {line.verdict().strip('*')}")
    return good


def listed(choices: tuple[str, ...]) -> Callable[[str], list[str]]:
    """An option's comma-separated list."""
    def parse(text: str) -> list[str]:
        words = [] if text == "none" else text.split(",")
        if unknown := [w for w in words if w not in choices]:
            raise argparse.ArgumentTypeError(f"{unknown[0]}: choose from {', '.join(choices)}, or none")
        return words
    return parse


def main() -> int:
    """Command line."""
    sets = ("maquette", "fountain-P11", "fountain-P11-unknown", "fox-pinhole")
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, required=True, help="folder of the programs")
    parser.add_argument("--scenes", type=Path, required=True)
    parser.add_argument("--data", type=Path, required=True, help="the peers' scripts are in tools/ beside it")
    parser.add_argument("--work", type=Path, required=True, help="kept between runs")
    parser.add_argument("--parts", type=listed(PARTS), default=list(PARTS), help="of " + ",".join(PARTS))
    parser.add_argument("--sets", type=listed(sets), default=list(sets), help="to train: of " + ",".join(sets))
    parser.add_argument("--again", action="append", default=[], metavar="STEPS",
                        help="repeat the steps that match, as ours/* or colmap/maquette")
    parser.add_argument("--no-colmap", action="store_true", help="leave COLMAP's training out")
    parser.add_argument("--show", type=Path, help="measure tracking with this show instead of training one")
    parser.add_argument("--frames", type=int, default=0, help="only so many of each video: to try the script")
    parser.add_argument("--document", type=Path, help="write the tables there, as docs/benchmarks.md")
    args = parser.parse_args()
    tools = args.data.resolve().parent / "tools"
    if not (args.data / "maquette" / "points.json").exists() or not (tools / "opencv_tracker.py").exists():
        say(f"skipped: no ground truth in {args.data} or no peers' scripts in {tools}")
        return SKIPPED
    bench = Bench(args)
    bench.measure()
    good = print_bars(bench)
    if args.document:
        write_document(bench, args.document)
    if bench.failures:
        say("failed: " + ", ".join(bench.failures))
    return 0 if good and not bench.failures else 1


if __name__ == "__main__":
    sys.exit(main())
