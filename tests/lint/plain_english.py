"""Fails where a comment cannot be read by itself, or uses words that the field does not use.

    plain_english.py FOLDER     reads the C++, Lua and shader sources below FOLDER
    plain_english.py --self-test

CONTRIBUTING.md has the rules. A comment behind code is a sentence of its own: it does not open with a
word that continues the line before it ("// of them", "// likewise"). Comments use the field's words.
"""
import re
import sys
from pathlib import Path

CONTINUES = ("of likewise and or that which whose with without where what who whom whether until from at in to by "
             "for as on so then else otherwise there these those them it its their")
FOREIGN = {
    "sight": "observation",
    "sights": "observations",
    "somebody": "a person",
    "nobody": "no one, or name who",
    "whoever": "name who",
    "whatever": "name what",
    "anew": "again",
    "likewise": "say it again",
    "foretell": "predict",
    "foretold": "predicted",
    "so many": "the number",
    "so much": "the amount",
    "nevertheless": "still",
    "lest": "so that ... not",
    "hence": "therefore",
    "thereof": "name what",
    "hereby": "leave it out",
}
SUFFIXES = {".h": "//", ".cc": "//", ".glsl": "//", ".vert": "//", ".frag": "//", ".lua": "--"}
FOLDERS = ("editor", "lua", "player", "scenes", "shaders", "shared", "tests", "web")
FRAGMENT = re.compile(r"\S\s+(?://|--)\s*(?:" + "|".join(CONTINUES.split()) + r")\b", re.IGNORECASE)
DIALECT = re.compile(r"\b(" + "|".join(sorted(FOREIGN, key=len, reverse=True)) + r")\b", re.IGNORECASE)


def problems(line: str, mark: str) -> list[str]:
    """What is wrong with the comment of one line."""
    code, found, comment = line.partition(mark)
    if not found:
        return []
    result = []
    if code.strip() and FRAGMENT.match(code.rstrip()[-1] + "  " + mark + comment):
        result.append("a comment behind code must be a sentence of its own")
    word = DIALECT.search(comment)
    if word:
        result.append(f'"{word[0]}": {FOREIGN[word[0].lower()]}')
    return result


def self_test() -> int:
    """What must be found, and what must not."""
    wrong = ["int a = 0;  // of them", "float b;  // Likewise", "// Reads it anew.", "f();  // so many metres"]
    right = ["int a = 0;  // metres", "// Of the cast, the first.", 'const char* url = "a";  // The address.',
             "// Observations of a point."]
    missed = [line for line in wrong if not problems(line, "//")] + [line for line in right if problems(line, "//")]
    print("\n".join(missed))
    return int(bool(missed))


def main() -> int:
    """Command line."""
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    root = Path(sys.argv[1])
    count = 0
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            mark = SUFFIXES.get(path.suffix)
            if mark is None or not path.is_file():
                continue
            for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
                for problem in problems(line, mark):
                    print(f"{path.relative_to(root)}:{number}: {problem}")
                    count += 1
    return int(count > 0)


if __name__ == "__main__":
    sys.exit(main())
