#!/usr/bin/env python3
"""Prints, for each room (a folder of sources), its files, lines, long functions and public headers.
Then prints the cycles between rooms, and the rooms that an export of a pot reaches.

usage: tests/rooms.py [--long]      --long names every function of more than 40 lines
The rooms are those of tests/layering.cmake, which checks who may include whom.
"""
import collections
import pathlib
import re
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent
LONGEST = 40  # lines of a function
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
# clang-format puts the first line of a definition at the depth of its scope and the last brace too.
OPENS = re.compile(r"^( *)(?!namespace|struct|class|enum|union|extern|using|#|//|\}).*\).*\{$")


def room_names():
    text = (TOP / "tests/layering.cmake").read_text()
    names = re.search(r"set\(rooms(.*?)\)", text, re.S).group(1).split()
    return sorted(names, key=len, reverse=True)


ROOMS = room_names()


def sources():
    return [file for component in ("core", "engine", "export", "falcon", "app")
            for file in sorted((TOP / component).rglob("*.[ch]pp"))]


def room_of(path):
    """The longest room that the path lies in; None for a path of no room. A public header belongs
    to the room that it has its name from, else to COMPONENT/include, which is no room."""
    public = re.match(r"(?:\w+/include/)?claystack/(\w+)/(\w+)\.hpp", path)
    if public:
        room = "/".join(public.groups())
        return room if room in ROOMS else public.group(1) + "/include"
    return next((room for room in ROOMS if path.startswith(room + "/")), None)


def first_line(lines, at):
    """Where the definition begins whose brace opens at the end of line `at`."""
    while at > 0:
        above = lines[at - 1].strip()
        if not above or above.endswith((";", "}", "{", ":")) or above.startswith(("//", "#", "template")):
            break
        at -= 1
    return at


def long_functions(lines):
    found = []
    at = 0
    while at < len(lines):
        if not OPENS.match(lines[at]):
            at += 1
            continue
        begin = first_line(lines, at)
        indent = lines[begin][:len(lines[begin]) - len(lines[begin].lstrip())]
        if len(indent) > 4:  # a statement within a function
            at += 1
            continue
        end = next((i for i in range(at + 1, len(lines)) if lines[i].startswith(indent + "}")),
                   len(lines) - 1)
        if end - begin + 1 > LONGEST:
            found.append((begin + 1, end - begin + 1, lines[begin].strip()))
        at = end + 1
    return found


def cycles(edges):
    """Sets of rooms that include each other, by Tarjan's algorithm."""
    index, low, stack, found = {}, {}, [], []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        for target in edges.get(node, ()):
            if target not in index:
                visit(target)
                low[node] = min(low[node], low[target])
            elif target in stack:
                low[node] = min(low[node], index[target])
        if low[node] == index[node]:
            component = [stack.pop()]
            while component[-1] != node:
                component.append(stack.pop())
            if len(component) > 1:
                found.append(component)

    for node in list(edges):
        if node not in index:
            visit(node)
    return found


def rooms_of_an_export(edges):
    """The rooms of export that its job reaches by includes: all that a pot may pass through."""
    reached, todo = set(), ["export/job"]
    while todo:
        room = todo.pop()
        if room in reached or not room.startswith("export/"):
            continue
        reached.add(room)
        todo.extend(edges.get(room, ()))
    return sorted(room for room in reached if not room.endswith("/include"))


def main():
    rows = collections.defaultdict(lambda: [0, 0, 0, 0])
    edges = collections.defaultdict(set)
    named = []
    for file in sources():
        path = str(file.relative_to(TOP))
        room = room_of(path)
        if room is None:
            sys.exit(f"{path} lies in no room of tests/layering.cmake")
        lines = file.read_text().splitlines()
        functions = long_functions(lines)
        named += [(path, *function) for function in functions]
        row = rows[room]
        row[0] += 1
        row[1] += len(lines)
        row[2] += len(functions)
        row[3] += "/include/claystack/" in path
        for line in lines:
            include = INCLUDE.match(line)
            target = room_of(include.group(1)) if include else None
            if target and target != room and not (room + target).count("/include"):
                edges[room].add(target)
    print(f"{'room':24} {'files':>6} {'lines':>7} {'functions > ' + str(LONGEST):>15} "
          f"{'public headers':>15}")
    for room in sorted(rows):
        print(f"{room:24} {rows[room][0]:6} {rows[room][1]:7} {rows[room][2]:15} {rows[room][3]:15}")
    total = [sum(column) for column in zip(*rows.values())]
    print(f"{'all':24} {total[0]:6} {total[1]:7} {total[2]:15} {total[3]:15}")
    found = cycles(edges)
    print(f"cycles between rooms: {len(found)}")
    for component in found:
        print("  " + " <-> ".join(sorted(component)))
    passed = rooms_of_an_export(edges)
    print(f"rooms that an export of a pot reaches: {len(passed)} ({', '.join(passed)})")
    if "--long" in sys.argv[1:]:
        for path, line, length, text in sorted(named, key=lambda row: -row[2]):
            print(f"{path}:{line}: {length} lines: {text[:70]}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
