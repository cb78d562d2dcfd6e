#!/usr/bin/env python3
"""links.py ROOT: links between the Markdown pages lead to files, and to headings that exist."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path

LINK = re.compile(r"\]\(([^)\s]+)\)")
SKIPPED = {"build", ".git", "node_modules"}


def anchor(heading: str) -> str:
    """The anchor that GitHub makes of a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.lstrip("#").strip().lower())
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def main() -> int:
    """Prints broken links."""
    root = Path(sys.argv[1]).resolve()
    pages = []
    for folder, inner, files in os.walk(root):
        inner[:] = [name for name in inner if name not in SKIPPED]
        pages += [Path(folder, name) for name in files if name.endswith(".md")]
    anchors = {page: {anchor(line) for line in page.read_text().splitlines() if line.startswith("#")} for page in pages}
    broken = 0
    for page in pages:
        for target in LINK.findall(page.read_text()):
            if re.match(r"[a-z]+:", target):
                continue
            path, _, heading = target.partition("#")
            file = (page.parent / path).resolve() if path else page
            if not file.exists():
                problem = "there is no such file"
            elif heading and heading not in anchors.get(file, {heading}):
                problem = "there is no such heading"
            else:
                continue
            print(f"{page.relative_to(root)}: {target}: {problem}")
            broken += 1
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
