#!/usr/bin/env python3
"""docs.py PROGRAM: compares README, CONTRIBUTING and docs with the tree and with the program.

Lines have at most 100 columns. Links lead to a file and a heading. The files, rooms, presets, build
options and options of commands that the pages name exist. The programs of the pages are those of
samples/consumer. The commands of the maker's guide work as pasted, and print the numbers that the
page states.

docs.py --links FOLDER: only the links, of the pages in a folder, such as those of an installed
copy."""

import functools
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md")])
PARTS = ["core", "engine", "export", "falcon", "app", "samples", "tests", "docs", "cmake"]
BLOCK = re.compile(r"^```[a-z]*\n(.*?)^```", re.S | re.M)

# Of the maker's guide, in its order: the beginning of a command, its exit status, and words that both
# the page and the output contain. All other commands end with 0.
STATED = [
    ("claystack throw samples/cylinder", 0, ["weight", "volume error", "0 quanta"]),
    ("claystack check out/beaker.pot.json", 1, ["39.6 degrees at a height of 1.5 mm"]),
    ("claystack throw samples/cylinder", 0, ["5.84 mm"]),
    ("claystack check out/beaker.pot.json", 0, ["of 40.9 degrees"]),
    ("claystack export out/jug.pot.json", 0, ["38.8 degrees", "0.04 mm instead of"]),
    ("claystack check out/tumbler.pot.json", 0, ["overhang of 26.6 degrees"]),
]


def prose(text):
    return BLOCK.sub("", text)


def command_lines(text):
    return [line for block in BLOCK.findall(text) for line in block.replace("\\\n", "").splitlines()]


def code_in(text):
    return [" ".join(code.split()) for code in re.findall(r"`([^`]+)`", prose(text))] + command_lines(text)


@functools.cache
def anchors(page):
    """Those of the headings, as GitHub makes them."""
    found = []
    for title in re.findall(r"^#+ (.*)", prose(page.read_text()), re.M):
        slug = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", title).strip().lower()
        slug = re.sub(r"[^\w\- ]", "", slug).replace(" ", "-")
        found.append(f"{slug}-{found.count(slug)}" if slug in found else slug)
    return found


def long_lines(text):
    for line in prose(text).splitlines():
        if len(line) > 100 and not line.startswith(("|", "<")) and "](" not in line:
            yield f"a line has more than 100 columns: {line}"


def broken_links(page, text):
    for pair in re.findall(r"\]\(([^)\s]+)\)|(?:src|href)=\"([^\"]+)\"", prose(text)):
        link = "".join(pair)
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if re.match(r"[a-z]+:", link):
            continue
        if not target.exists() or (anchor and target.suffix == ".md" and anchor not in anchors(target)):
            yield f"the link {link} leads nowhere"


def missing_files(text):
    """The end of a name may be left out: `docs/fairing` for docs/fairing-after.png."""
    for word in " ".join(code_in(text)).split():
        if re.fullmatch(rf"({'|'.join(PARTS)})/[\w./-]*\w", word):
            path = ROOT / word
            if not path.exists() and not [*path.parent.glob(path.name + "[.-]*")]:
                yield f"there is no file {word}"


@functools.cache
def options_of(program, command):
    ran = subprocess.run([program, command, "--help"], capture_output=True, text=True)
    return set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", ran.stdout))


def unknown_options(text, program):
    for line in code_in(text):
        for command, rest in re.findall(r"\bclaystack ([a-z]+)\b([^|#]*)", line):
            for option in re.findall(r"(?<=\s)--?[a-z][\w-]*", rest):
                if option not in options_of(program, command):
                    yield f"there is no option {option} in: {line.strip()}"


def untested_programs(text):
    """A program of a page is one of samples/consumer, which the test `consumer` builds."""
    tested = [file.read_text() for file in (ROOT / "samples/consumer").glob("*.cpp")]
    for program in re.findall(r"^```cpp\n(.*?)^```", text, re.S | re.M):
        if program not in tested:
            yield f"samples/consumer has no program like this one: {program.splitlines()[0]}"


@functools.cache
def build_names():
    """Build options and other names that sources read, and presets."""
    names = {preset["name"] for preset in
             json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]}
    for folder in [*PARTS, "CMakeLists.txt"]:
        for file in [ROOT / folder, *(ROOT / folder).rglob("*")]:
            if file.is_file() and file.suffix in (".txt", ".cmake", ".cpp", ".hpp", ".sh", ".py", ".in"):
                names.update(re.findall(r"CLAYSTACK_\w+", file.read_text()))
    return names


def unknown_build_names(text):
    used = re.findall(r"CLAYSTACK_\w+|(?<=--preset )[a-z][\w-]*", text)
    return (f"the build has no {name}" for name in set(used) - build_names())


def missing_rooms():
    listed = (ROOT / "docs/architecture.md").read_text()
    rooms = re.search(r"set\(rooms\n(.*?)\)", (ROOT / "tests/layering.cmake").read_text(), re.S)[1]
    for part, room in re.findall(r"\b(engine|export|falcon|app)/(\w+)(?= |$)", rooms, re.M):
        if not re.search(rf"^(\w+/)? +{room}/ ", listed, re.M):
            yield f"docs/architecture.md does not list {part}/{room}"


def differences_of_the_guide(program):
    text = (ROOT / "docs/makers-guide.md").read_text()
    page, stated = " ".join(text.split()), list(STATED)
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "samples").symlink_to(ROOT / "samples")
        for line in command_lines(text):
            if not re.match(r"claystack|mkdir|cp|sed", line):
                continue  # builds and installs
            status, words = 0, []
            if stated and line.startswith(stated[0][0]):
                _, status, words = stated.pop(0)
            ran = subprocess.run(re.sub("^claystack", program, line), shell=True, cwd=folder,
                                 capture_output=True, text=True)
            output = ran.stdout + ran.stderr
            if ran.returncode != status:
                yield f"{line} ended with {ran.returncode}, expected {status}:\n{output}"
            yield from (f"{line} does not print: {word}" for word in words if word not in output)
            yield from (f"the guide does not state: {word}" for word in words if word not in page)
    yield from (f"the guide has no command: {start}" for start, _, _ in stated)


def faults_of_links(folder):
    pages = sorted(folder.rglob("*.md"))
    if not pages:
        yield f"there are no pages in {folder}"
    for page in pages:
        yield from (f"{page.relative_to(folder)}: {fault}" for fault in broken_links(page, page.read_text()))


def faults_of_the_tree(program):
    yield from missing_rooms()
    for page in PAGES:
        text = page.read_text()
        for fault in [*long_lines(text), *broken_links(page, text), *missing_files(text), *unknown_options(text, program),
                      *unknown_build_names(text), *untested_programs(text)]:
            yield f"{page.relative_to(ROOT)}: {fault}"
    yield from (f"docs/makers-guide.md: {fault}" for fault in differences_of_the_guide(program))


def main():
    if sys.argv[1] == "--links":
        faults, agreement = [*faults_of_links(pathlib.Path(sys.argv[2]))], "all links lead to files"
    else:
        faults = [*faults_of_the_tree(str(pathlib.Path(sys.argv[1]).resolve()))]
        agreement = f"{len(PAGES)} pages agree with the tree and the program"
    print("\n".join(faults) or agreement)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
