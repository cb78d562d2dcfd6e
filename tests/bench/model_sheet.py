#!/usr/bin/python3
"""What the editor makes of a folder of models of other programs: a table and contact sheets.

Each model is pictured by `lararium-editor portrait`, as a person where its glTF has a skin or its name ends in .vrm,
otherwise as a thing. OUT/table.tsv has a line for each: what came of it (loaded; told, with the warnings; refused, with
the error; crashed), seconds, the largest resident memory of a process (MB), and the sheet and the number in it. Whether
what is loaded also looks right is for the eye: OUT/sheet-NN.png.
"""
from __future__ import annotations

import argparse
import json
import os
import struct
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

KINDS = {".gltf", ".glb", ".vrm", ".fbx", ".dae", ".obj", ".ply", ".stl"}
SIDE, COLUMNS, ROWS, LONGEST = 200, 8, 6, 300


def description(file: Path) -> dict:
    """The JSON of a glTF; empty for other files and for what cannot be parsed."""
    data = file.read_bytes()
    try:
        if data[:4] == b"glTF":
            data = data[20:20 + struct.unpack_from("<I", data, 12)[0]]
        found = json.loads(data)
        return found if isinstance(found, dict) else {}
    except (ValueError, struct.error, RecursionError):
        return {}


def try_model(editor: Path, file: Path, picture: Path, more: list[str]) -> dict:
    """Pictures one model in a process of its own."""
    glTF = description(file)
    person = bool(glTF.get("skins")) or file.suffix.lower() == ".vrm"
    command = [editor, "portrait", file, "--out", picture, "--size", f"{SIDE}x{SIDE}", "--json", *more]
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
        begun = time.monotonic()
        process = subprocess.Popen(["timeout", "-k", "5", str(LONGEST), *command, *([] if person else ["--thing"])],
                                   stdin=subprocess.DEVNULL, stdout=out, stderr=errors)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.monotonic() - begun
        out.seek(0)
        errors.seek(0)
        said, complaint = out.read().decode(errors="replace"), errors.read().decode(errors="replace").strip()
    result = {"file": file, "picture": picture, "kind": "person" if person else "thing", "seconds": seconds,
              "megabytes": used.ru_maxrss / 1024, "notes": [], "has_mesh": bool(glTF.get("meshes"))}
    if process.returncode == 0:
        result["notes"] = json.loads(said).get("warnings", [])
        result["end"] = "told" if result["notes"] else "loaded"
    else:
        result["end"] = "refused" if process.returncode == 1 else "crashed"
        result["notes"] = [f"{complaint or said.strip()}" + ("" if process.returncode == 1 else
                                                             f" (status {process.returncode})")]
    return result


def write_sheet(cells: list[dict], sheet: Path, scratch: Path) -> None:
    """Tiles the pictures of some models; each is labelled with its number and the end of its path."""
    captions = []
    for i, cell in enumerate(cells):
        image, text = scratch / f"{i:03}.png", scratch / f"{i:03}.txt"
        if cell["picture"].exists():
            image.write_bytes(cell["picture"].read_bytes())
        else:
            subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "lavfi", "-i", f"color=gray:s={SIDE}x{SIDE}",
                            "-frames:v", "1", image], check=True)
        label = f"{i} {cell['end'][0]} {cell['file'].name[:24]}\n{cell['file'].parent.name[:28]}"
        text.write_text(label)
        captions.append(f"drawtext=textfile={text}:expansion=none:enable='eq(n,{i})':x=2:y=2:fontsize=11:"
                        "fontcolor=yellow:box=1:boxcolor=black@0.4")
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", scratch / "%03d.png", "-frames:v", "1", "-vf",
                    f"format=rgb24,{','.join(captions)},tile={COLUMNS}x{ROWS}", sheet], check=True)
    for left in scratch.iterdir():
        left.unlink()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="searched with all folders below it")
    parser.add_argument("out", type=Path)
    parser.add_argument("--editor", type=Path, default=Path("build/release/bin/lararium-editor"))
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", default="", help="only files whose path contains this")
    parser.add_argument("rest", nargs="*", help="after --: more options of portrait")
    options = parser.parse_args()
    files = sorted(f for f in options.folder.rglob("*")
                   if f.suffix.lower() in KINDS and f.is_file() and options.only in str(f))
    options.out.mkdir(parents=True, exist_ok=True)
    pictures = options.out / "pictures"
    pictures.mkdir(exist_ok=True)
    with ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(lambda numbered: try_model(options.editor, numbered[1],
                                                           pictures / f"{numbered[0]:04}.png", options.rest),
                                enumerate(files)))
    per_sheet = COLUMNS * ROWS
    with tempfile.TemporaryDirectory() as scratch:
        for first in range(0, len(results), per_sheet):
            write_sheet(results[first:first + per_sheet], options.out / f"sheet-{first // per_sheet:02}.png",
                        Path(scratch))
    with open(options.out / "table.tsv", "w", encoding="utf-8", errors="surrogateescape") as table:
        for i, result in enumerate(results):
            print(result["file"].relative_to(options.folder), result["kind"], result["end"],
                  f"{result['seconds']:.2f}", f"{result['megabytes']:.0f}", f"{i // per_sheet:02}:{i % per_sheet}",
                  "mesh" if result["has_mesh"] else "", " | ".join(result["notes"]).replace("\n", " "),
                  sep="\t", file=table)
    ends = [result["end"] for result in results]
    print(f"{len(ends)} models: " + ", ".join(f"{ends.count(end)} {end}" for end in sorted(set(ends))))
    if results:
        slowest = max(results, key=lambda result: result["seconds"])
        largest = max(results, key=lambda result: result["megabytes"])
        print(f"slowest: {slowest['seconds']:.1f} s, {slowest['file']}")
        print(f"largest: {largest['megabytes']:.0f} MB, {largest['file']}")
    return 1 if "crashed" in ends else 0


if __name__ == "__main__":
    sys.exit(main())
