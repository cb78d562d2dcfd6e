#!/usr/bin/env python3
"""Runs the fuzz harnesses for minutes of processor time each and prints a table of what they reached.

  tests/fuzz/campaign.py build/fuzz [--minutes 10] [--jobs 2] [HARNESS...]

Inputs that reach something new are kept in BUILD/corpus and go on from there the next time; an input
that a harness fails on lies there too, as libFuzzer names it. Exit status: 0 none failed, 1 one did.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys

CHUNK_SECONDS = 120  # of the clock; processor time is counted after each


def commands_of(build):
    """name -> command of each fuzz test."""
    listed = subprocess.run(
        ["ctest", "--test-dir", build, "--show-only=json-v1", "-R", "^fuzz/"],
        check=True, capture_output=True, text=True).stdout
    tests = json.loads(listed)["tests"]
    return {test["name"].removeprefix("fuzz/"): test["command"] for test in tests if "command" in test}


def run_chunk(command, seconds, corpus):
    """Exit status, processor seconds and output of one run."""
    options = [argument for argument in command[1:] if not argument.startswith(("-runs=", "-seed="))]
    # An input's own limit is wall time, of which a campaign beside other work has little.
    full = [command[0], *options, f"-max_total_time={seconds}", "-timeout=60",
            "-print_final_stats=1", f"-artifact_prefix={corpus}/", str(corpus)]
    environment = dict(os.environ, ASAN_OPTIONS="detect_leaks=0")
    log = corpus.parent / (corpus.name + ".log")
    with open(log, "w", encoding="utf-8", errors="replace") as out:
        process = subprocess.Popen(full, stdout=out, stderr=subprocess.STDOUT, env=environment)
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime + usage.ru_stime, log.read_text(errors="replace")


def last_number(pattern, text):
    found = re.findall(pattern, text)
    return int(found[-1]) if found else 0


def explore(name, command, minutes, build):
    """One row: name, edges, inputs, processor minutes, whether it failed."""
    corpus = pathlib.Path(build, "corpus", name)
    corpus.mkdir(parents=True, exist_ok=True)
    spent = 0.0
    inputs = 0
    edges = 0
    while spent < 60.0 * minutes:
        left = max(int(60.0 * minutes - spent) + 1, 5)
        status, seconds, output = run_chunk(command, min(CHUNK_SECONDS, left), corpus)
        spent += seconds
        inputs += last_number(r"stat::number_of_executed_units:\s+(\d+)", output)
        edges = max(edges, last_number(r"\bcov: (\d+)", output))
        if status != 0:
            print(output[-4000:], file=sys.stderr)
            return name, edges, inputs, spent / 60.0, True
    return name, edges, inputs, spent / 60.0, False


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", help="the build folder of the fuzz preset")
    parser.add_argument("harness", nargs="*", help="all unless named")
    parser.add_argument("--minutes", type=float, default=10.0, help="of processor time, for each")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="harnesses at a time")
    options = parser.parse_intermixed_args()
    commands = commands_of(options.build)
    unknown = [name for name in options.harness if name not in commands]
    if unknown:
        parser.error(f"no harness {unknown[0]}; there are: {', '.join(sorted(commands))}")
    names = options.harness or sorted(commands)
    print("| harness | edges | inputs | processor minutes |\n|---|---|---|---|", flush=True)
    failed = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        rows = [pool.submit(explore, name, commands[name], options.minutes, options.build)
                for name in names]
        for row in concurrent.futures.as_completed(rows):
            name, edges, inputs, minutes, bad = row.result()
            print(f"| {name} | {edges} | {inputs} | {minutes:.1f}{' FAILED' if bad else ''} |",
                  flush=True)
            failed += [name] if bad else []
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
