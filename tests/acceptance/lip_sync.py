#!/usr/bin/python3
"""Measures how well mouths go with voices: lip_sync.py --tool lip_sync --show SHOW.larshow --actor NAME.

Every line of the show is played through the show and the mixer; prints for each, and on average, the
correlation of how far the lips are apart with how loud the exported sound is, and the lag at which it is
best.  Fails where on average the correlation is below 0.3 or the lag beyond what viewers notice (lips
45 ms after the sound, or 125 ms before it: ITU-R BT.1359).
"""
from __future__ import annotations

import argparse
import json
import subprocess
import sys

LEAST_CORRELATION = 0.3
LAG_MS = (-125.0, 45.0)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tool", required=True)
    parser.add_argument("--show", required=True)
    parser.add_argument("--actor", required=True)
    parser.add_argument("--language", default="")
    options = parser.parse_args()
    command = [options.tool, options.show, options.actor]
    command += [options.language] if options.language else []
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    lines = [json.loads(line) for line in output.splitlines()]
    if not lines:
        print("the show has no line with a voice")
        return 1
    print(f"{'line':24s} {'s':>5s} {'mm':>5s} {'corr':>6s} {'best':>6s} {'lag ms':>7s}")
    for line in lines:
        print(f"{line['line']:24s} {line['seconds']:5.2f} {line['opening_mm']:5.1f} "
              f"{line['correlation']:6.2f} {line['best_correlation']:6.2f} {line['lag_ms']:7.0f}")
    correlation = sum(line["correlation"] for line in lines) / len(lines)
    lag = sum(line["lag_ms"] for line in lines) / len(lines)
    print(f"mean of {len(lines)} lines: correlation {correlation:.2f}, lag {lag:.0f} ms")
    good = correlation >= LEAST_CORRELATION and LAG_MS[0] <= lag <= LAG_MS[1]
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
