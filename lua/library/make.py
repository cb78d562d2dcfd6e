#!/usr/bin/python3
"""Writes lararium.lua: what the Lua language server (LuaLS) knows of a drama's words.

Made of lua/std, whose comments and signatures are the truth:
  lua/library/make.py           writes it
  lua/library/make.py --check   fails where it is not what would be written
"""

import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
STD = HERE.parent / "std"
OUT = HERE / "lararium.lua"

# What arguments of a name are, everywhere in lua/std.
TYPES = {
    "act": "table", "action": "string", "always": "boolean", "clip": "string",
    "degrees": "number", "ease": "string", "expression": "string", "f": "function", "fade": "number",
    "handle": "Handle", "hours": "number", "intensity": "number", "kind": "string",
    "address": "string", "line": "string", "metres": "number", "name": "string", "on": "boolean",
    "options": "table", "part": "string", "point": "string", "seconds": "number",
    "speech": "string", "settings": "table", "spec": "table", "state": "string", "style": "table|string",
    "surface": "string", "target": "Actor|Object|string|table|boolean",
    "thing": "Object|string", "time": "string", "to": "Actor|string", "trigger": "Trigger",
    "value": "number|string|boolean", "what": "Handle|Trigger", "where": "Object|string|table",
}
# What words give that make things.
RETURNS = {
    "actor": "Actor", "object": "Object", "light": "Light", "sound": "Sound", "start": "Handle",
    "on": "Handle", "at": "Handle", "after": "Handle", "timeout": "Trigger",
    "tracking": "Trigger", "osc": "Trigger", "heard": "any ...", "key": "Trigger", "clock": "Trigger", "marker": "Trigger",
    "now": "number", "first": "integer", "race": "integer", "together": "boolean, string?",
    "attempt": "boolean, string?", "wait_for": "boolean, string?", "meet": "boolean, string?",
    "Visitor:near": "Trigger", "Visitor:leaves": "Trigger", "Visitor:looks_at": "Trigger",
    "Visitor:looks_away": "Trigger", "Visitor:stays": "Trigger", "Visitor:is_here": "boolean",
    "Visitor:where": "table", "Visitor:distance": "number?", "Actor:where": "table",
    "Actor:length": "number", "Actor:walk_to": "boolean", "Actor:address": "boolean",
    "Actor:keep_distance": "Handle", "Object:where": "table", "Object:state": "string",
    "Object:holder": "Actor?", "Handle:is_over": "boolean", "Light:level": "number",
    "Daylight:time": "number?",
}
OPTIONAL = {"options", "seconds", "fade", "intensity", "point", "metres", "surface", "part", "ease",
            "expression", "style", "on", "always", "value"}
INSTANCES = {"Visitor": "visitor", "Daylight": "daylight"}


def words():
    """(file, comment lines, class or None, name, arguments) of each word of lua/std."""
    for path in sorted(STD.glob("*.lua")):
        comment = []
        for line in path.read_text().splitlines():
            match = re.match(r"function (?:([A-Z]\w*):)?(\w+)\(([^)]*)\)", line)
            if match:
                owner, name, arguments = match.groups()
                names = [a.strip() for a in arguments.split(",") if a.strip()]
                yield path.name, comment, owner, name, names
            comment = comment + [line[2:].strip()] if line.startswith("--") else []


def library():
    lines = ["---@meta", "",
             "-- Made by lua/library/make.py of lua/std; not run. For the Lua language server:",
             '-- "workspace.library": ["lua/library"].', ""]
    classes = []
    for _, comment, owner, name, arguments in words():
        if owner and owner not in classes:
            classes.append(owner)
            lines.append(f"---@class {owner}")
            declared = INSTANCES.get(owner)
            lines.append(f"{declared} = {{}}" if declared else f"local {owner} = {{}}")
            lines.append("")
        lines += [f"---{text}" for text in comment]
        for argument in arguments:
            if argument == "...":
                lines.append("---@param ... any")
                continue
            optional = "?" if argument in OPTIONAL else ""
            lines.append(f"---@param {argument}{optional} {TYPES[argument]}")
        full = f"{owner}:{name}" if owner else name
        if full in RETURNS:
            lines.append(f"---@return {RETURNS[full]}")
        called = f"{INSTANCES.get(owner, owner)}:{name}" if owner else name
        lines.append(f"function {called}({', '.join(arguments)}) end")
        lines.append("")
    return "\n".join(lines)


def main():
    text = library()
    if "--check" in sys.argv[1:]:
        if not OUT.exists() or OUT.read_text() != text:
            sys.exit("lua/library/lararium.lua is not what lua/std says: run lua/library/make.py")
        return
    OUT.write_text(text)


if __name__ == "__main__":
    main()
