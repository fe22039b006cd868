#!/usr/bin/env python3
"""Performance guard: python3 tests/compare_speed.py BASE [CHANGE] [--only tick] [--rounds 6]

Builds two commits, runs `claystack bench --quick` on both in turn, and compares every time that
states its spread. Fails (exit status 1) where a time grew by more than 10 % and every round agrees
that it grew: with six rounds, chance does that in 1 of 64. Run it on a quiet machine. A path of a
program instead of a commit is used as it is.
"""

import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile

LIMIT = 1.1
UNITS = ("_ns", "_us", "_ms", "_s")


def built(commit: str, scratch: str) -> str:
    """The program of a commit."""
    if os.access(commit, os.X_OK) and os.path.isfile(commit):
        return os.path.abspath(commit)
    source = os.path.join(scratch, commit.replace("/", "_"))
    subprocess.run(["git", "worktree", "add", "-q", "--detach", source, commit], check=True)
    build = os.path.join(source, "build", "release")
    # What both commits share is compiled once, where ccache is installed.
    environment = dict(os.environ, CCACHE_BASEDIR=source, CCACHE_NOHASHDIR="1")
    for words in (["cmake", "--preset", "release", "-DCLAYSTACK_TESTS=OFF", "-DCLAYSTACK_BENCH=ON"],
                  ["cmake", "--build", build, "--target", "claystack"]):
        subprocess.run(words, cwd=source, env=environment, check=True, stdout=subprocess.DEVNULL)
    return os.path.join(build, "app", "claystack")


def times(program: str, sections: str) -> dict:
    """Every number NAME_ns (us, ms, s) beside a NAME_ns_iqr or NAME_iqr_ns, by its place."""
    run = subprocess.run([program, "bench", "--quick", "--only", sections, "--json"],
                         capture_output=True, text=True)
    if run.returncode not in (0, 1):  # 1: a requirement is missed, which is not the question here
        sys.exit(f"compare_speed: {program}: {run.stderr}")
    found = {}

    def walk(value, place):
        if isinstance(value, dict):
            for name, one in value.items():
                unit = next((u for u in UNITS if name.endswith(u)), None)
                spread = unit and any(k in value for k in (name + "_iqr",
                                                           name[: -len(unit)] + "_iqr" + unit))
                if spread and isinstance(one, (int, float)) and one > 0:
                    found[f"{place}.{name}"] = float(one)
                else:
                    walk(one, f"{place}.{name}" if place else name)
        elif isinstance(value, list):
            for index, one in enumerate(value):
                walk(one, f"{place}[{index}]")

    walk(json.loads(run.stdout), "")
    if not found:
        sys.exit(f"compare_speed: {program}: no times in section {sections}")
    return found


def slower(rounds: list) -> list:
    """(place, median ratio, least, largest) of every time that is in all rounds."""
    places = set.intersection(*(set(base) & set(change) for base, change in rounds))
    rows = []
    for place in sorted(places):
        ratios = [change[place] / base[place] for base, change in rounds]
        rows.append((place, statistics.median(ratios), min(ratios), max(ratios)))
    return rows


def too_slow(rows: list) -> list:
    """The rows of `slower` that fail: above the limit, and slower in every round."""
    return [row for row in rows if row[1] > LIMIT and row[2] > 1.0]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("base")
    parser.add_argument("change", nargs="?", default="HEAD")
    parser.add_argument("--only", default="tick", help="sections of bench (default tick)")
    parser.add_argument("--rounds", type=int, default=6)
    options = parser.parse_args()
    scratch = tempfile.mkdtemp(prefix="compare-speed-")
    try:
        base, change = built(options.base, scratch), built(options.change, scratch)
        rounds = []
        for number in range(options.rounds):
            pair = {}
            order = (base, change) if number % 2 == 0 else (change, base)
            for program in order:
                pair[program] = times(program, options.only)
            rounds.append((pair[base], pair[change]))
        rows = slower(rounds)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
        subprocess.run(["git", "worktree", "prune"], check=False)
    failed = too_slow(rows)
    for place, median, least, largest in rows:
        mark = "SLOWER" if (place, median, least, largest) in failed else ""
        print(f"{place:40} {median:6.3f}  ({least:.3f} to {largest:.3f}) {mark}")
    print(f"{len(rows)} times, {len(failed)} slower by more than {100 * (LIMIT - 1):.0f} %")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
