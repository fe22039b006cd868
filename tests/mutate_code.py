#!/usr/bin/env python3
"""Mutation testing of the safety rules and of the certificate.

    python3 tests/mutate_code.py [--subject NAME] [--mutants N] [--only TEXT] [--list]

Copies the last commit to FOLDER/source (default build/mutants), builds the tests of a subject, and
checks that they pass. Then it changes one place of the code at a time: flips a comparison, moves a
constant, swaps min and max, removes a clamp, negates a condition. It rebuilds only that test program
and runs the tests of the subject. A mutant that no test detects survives: it is printed with file,
line and change. Exit status 1 if any survives that is not in tests/mutants.txt, which states for
each known survivor why no test can or need detect it.
"""

import argparse
import io
import os
import random
import re
import subprocess
import sys
import tarfile
from pathlib import Path

TESTS = {
    "guard": ("falcon", "falcon_tests", ["falcon/safety/force_guard.cpp", "falcon/safety/basic_guard.hpp",
                                         "falcon/safety/guard_rules.cpp"], "*"),
    "passivity": ("falcon", "falcon_tests", ["falcon/safety/passivity_law.cpp", "falcon/safety/energy_observer.cpp",
                                             "falcon/safety/reading_period.cpp", "falcon/safety/swing_counter.cpp"], "*"),
    "bound": ("falcon", "falcon_tests", ["falcon/safety/sampled_bound.cpp"], "*"),
    "watchdog": ("app", "servo_tests", ["app/servo/servo.cpp", "app/servo/servo_loop.cpp"], "*"),
    "certificate": ("export", "export_tests",
                    ["export/proof/certificate.cpp", "export/proof/solid_certificate.cpp"],
                    "*Certificate*:*Certify*:Margins*"),
    "wall": ("export", "export_tests", ["export/walls/wall_thickness.cpp", "export/walls/wall_search.cpp"],
             "*Wall*"),
}
SWAPS = {" < ": " <= ", " <= ": " < ", " > ": " >= ", " >= ": " > ", " == ": " != ", " != ": " == ",
         " && ": " || ", " || ": " && ", " + ": " - ", " - ": " + ", "std::min(": "std::max(",
         "std::max(": "std::min(", " += ": " -= ", " = true;": " = false;", " = false;": " = true;"}


def code_of(line):
    """The line without its comment and its strings."""
    line = re.sub(r'"(\\.|[^"\\])*"', lambda m: "_" * len(m.group()), line)
    return line.split("//")[0]


def without_clamp(line, at):
    """std::clamp(a, b, c) at this place, replaced by (a)."""
    begin, depth = at + len("std::clamp("), 1
    end = comma = None
    for i in range(begin, len(line)):
        depth += {"(": 1, ")": -1, "{": 1, "}": -1}.get(line[i], 0)
        if depth == 1 and line[i] == "," and comma is None:
            comma = i
        if depth == 0:
            end = i
            break
    return line[:at] + "(" + line[begin:comma] + ")" + line[end + 1:] if comma and end else None


def moved(number):
    """Another constant: a count by one, a quantity by half."""
    digits = number.replace("'", "")
    if digits.isdigit():
        return str(int(digits) + 1)
    return f"({number} * 1.5)" if float(digits) else "1.0"


def mutants_of(path):
    """Pairs of a line number and its new text."""
    found = []
    for number, line in enumerate(path.read_text().split("\n")):
        code = code_of(line)
        if re.match(r"\s*(#|template|static_assert|using|namespace)", code):
            continue
        for old, new in SWAPS.items():
            for match in re.finditer(re.escape(old), code):
                found.append((number, line[:match.start()] + new + line[match.end():]))
        for match in re.finditer(r"(?<![\w.])(\d[\d']*\.?\d*(?:e-?\d+)?)(?![\w.])", code):
            text = match.group(1)
            found.append((number, line[:match.start()] + moved(text) + line[match.end():]))
        for match in re.finditer(r"std::clamp\(", code):
            if (changed := without_clamp(line, match.start())) is not None:
                found.append((number, changed))
        for match in re.finditer(r"\bif \((?!constexpr)", code):
            found.append((number, line[:match.end()] + "false && " + line[match.end():]))
    return found


def run(command, seconds, **options):
    try:
        return subprocess.run(command, timeout=seconds, capture_output=True, text=True, **options)
    except subprocess.TimeoutExpired:
        return None


def label_of(name, path, number, text):
    return f"{name}:{number + 1}: {path.read_text().split(chr(10))[number].strip()}  ->  {text.strip()}"


def unpack_commit(source):
    """Writes the files of the last commit that differ, so that only these are built again."""
    archive = subprocess.run(["git", "archive", "HEAD"], check=True, capture_output=True).stdout
    with tarfile.open(fileobj=io.BytesIO(archive)) as files:
        for member in files:
            place, content = source / member.name, member.isfile() and files.extractfile(member).read()
            if not member.isfile() or place.exists() and place.read_bytes() == content:
                continue
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(content)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--subject", choices=TESTS, action="append")
    parser.add_argument("--mutants", type=int, default=40, help="for each subject, drawn at random")
    parser.add_argument("--build", type=Path, default=Path("build/mutants"))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="mutants whose line of output contains this text")
    parser.add_argument("--list", action="store_true", help="print the mutants and stop")
    options = parser.parse_args()
    os.chdir(Path(__file__).resolve().parent.parent)
    source, build = options.build.resolve() / "source", options.build.resolve() / "build"
    source.mkdir(parents=True, exist_ok=True)
    unpack_commit(source)
    known = Path("tests/mutants.txt").read_text() if Path("tests/mutants.txt").exists() else ""
    subprocess.run(["cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DCLAYSTACK_BENCH=OFF", "-DCLAYSTACK_FAST_BUILD=OFF", "-DCLAYSTACK_WERROR=OFF", "-DCMAKE_CXX_FLAGS_RELEASE=-O1"],
                   check=True, stdout=subprocess.DEVNULL)
    unknown = tried = 0
    for subject in options.subject or TESTS:
        folder, target, files, tests = TESTS[subject]
        places = [(name, *mutant) for name in files for mutant in mutants_of(source / name)
                  if options.only in label_of(name, source / name, *mutant)]
        random.Random(options.seed).shuffle(places)
        build_target = ["cmake", "--build", str(build), "--target", target]
        test = [str(build / "tests" / folder / target), f"--gtest_filter={tests}", "--gtest_brief=1",
                "--gtest_fail_fast"]
        if not options.list:
            subprocess.run(build_target, check=True, stdout=subprocess.DEVNULL)
            if run(test, 600).returncode != 0:
                sys.exit(f"{subject}: the tests fail without a mutant")
        for name, number, text in places[:options.mutants]:
            path = source / name
            before = path.read_text()
            lines = before.split("\n")
            label = label_of(name, path, number, text)
            if options.list:
                print(label)
                continue
            lines[number] = text
            path.write_text("\n".join(lines))
            try:
                if (built := run(build_target, 900)) is None or built.returncode != 0:
                    print(f"no build  {label}", flush=True)
                    continue
                tried += 1
                ran = run(test, 300)
            finally:
                path.write_text(before)
            if ran is None or ran.returncode != 0:
                print(f"detected  {label}", flush=True)
            else:
                reason = label.split(": ", 1)[1] in known
                unknown += not reason
                print(f"{'known    ' if reason else 'SURVIVES '} {label}", flush=True)
    if not options.list:
        print(f"{tried} mutants, {unknown} survive without a reason in tests/mutants.txt")
    sys.exit(1 if unknown else 0)


main()
