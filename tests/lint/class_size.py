"""Fails where a class is too large to be understood by itself.

    class_size.py FOLDER     reads the C++ sources of editor, player, shared and web below FOLDER
    class_size.py --self-test

A class has at most 30 data members, and the functions of a class are defined in at most two source files. A class
that needs more has more than one responsibility. Needs universal-ctags.
"""
import json
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

MAX_MEMBERS = 30
MAX_SOURCES = 2
SKIPPED = 77


def tags(root: Path) -> list[dict]:
    folders = [name for name in ("editor", "player", "shared", "web") if (root / name).is_dir()]
    command = ["ctags", "--recurse", "--output-format=json", "--languages=C++", "--langmap=C++:.h.cc",
               "--kinds-C++=fm", "--fields=+KsZpP", "-f", "-", *folders]
    lines = subprocess.run(command, cwd=root, check=True, capture_output=True, text=True).stdout.splitlines()
    return [json.loads(line) for line in lines]


def problems(root: Path) -> list[str]:
    members = defaultdict(int)
    sources = defaultdict(set)
    for tag in tags(root):
        # An unnamed namespace has a name of its own in each file, so classes within one are told apart.
        owner = tag.get("scope")
        if owner is None or tag.get("scopeKind") not in ("class", "struct"):
            continue
        if tag["kind"] == "member" and "static constexpr" not in tag["pattern"]:
            members[owner, tag["path"]] += 1
        if tag["kind"] == "function" and tag["path"].endswith(".cc"):
            sources[owner].add(tag["path"])
    found = [f"{path}: {owner} has {count} data members; {MAX_MEMBERS} are allowed"
             for (owner, path), count in sorted(members.items()) if count > MAX_MEMBERS]
    found += [f"{owner} is defined in {len(paths)} source files, {', '.join(sorted(paths))}; "
              f"{MAX_SOURCES} are allowed"
              for owner, paths in sorted(sources.items()) if len(paths) > MAX_SOURCES]
    return found


def self_test() -> int:
    def count(members: int, sources: int) -> int:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name) / "shared"
            folder.mkdir()
            fields = "".join(f"  int field{index}_ = 0;\n" for index in range(members))
            (folder / "big.h").write_text(f"namespace n {{\nclass Big {{\n  static constexpr int kMost = 3;\n{fields}}};\n}}\n")
            for index in range(sources):
                (folder / f"big_{index}.cc").write_text(f"namespace n {{\nvoid Big::Do{index}() {{}}\n}}\n")
            return len(problems(Path(name)))
    expected = {(MAX_MEMBERS, MAX_SOURCES): 0, (MAX_MEMBERS + 1, 1): 1, (1, MAX_SOURCES + 1): 1}
    wrong = [case for case, found in expected.items() if count(*case) != found]
    for case in wrong:
        print(f"{case}: expected {expected[case]} problems, found {count(*case)}")
    return 1 if wrong else 0


def main() -> int:
    try:
        subprocess.run(["ctags", "--version"], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        print("skipped: universal-ctags is not installed")
        return SKIPPED
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    found = problems(Path(sys.argv[1]))
    print("\n".join(found) or "no class is too large")
    return 1 if found else 0


sys.exit(main())
