#!/usr/bin/env python3
"""Repairs the real meshes that Debian packages contain, and prints a table for docs/repair.md.

    python3 tests/repair_table.py build/release/app/claystack SCRATCH_FOLDER [SECONDS_PER_FILE]

Downloads the packages with apt-get and unpacks them into SCRATCH_FOLDER; installs nothing. Each
repaired file is checked again from its bytes, and by admesh where that is installed.
"""
import json
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PACKAGES = ["cura", "prusa-slicer", "assimp-testmodels", "openscad", "admesh"]


def fetch(scratch):
    for package in PACKAGES:
        to = scratch / package
        if to.exists():
            continue
        subprocess.run(["apt-get", "download", package], cwd=scratch, check=True, capture_output=True)
        subprocess.run(["dpkg", "-x", next(scratch.glob(package + "_*.deb")), to], check=True)


def run(arguments, seconds):
    try:
        return subprocess.run(arguments, capture_output=True, text=True, timeout=seconds, errors="replace")
    except subprocess.TimeoutExpired:
        return None


def admesh_accepts(path):
    done = run(["admesh", "--exact", str(path)], 60)
    if done is None or done.returncode != 0:
        return False
    open_facets = re.search(r"Total disconnected facets\s*:\s*(\d+)", done.stdout)
    return open_facets is not None and int(open_facets.group(1)) == 0


def examine(claystack, scratch, seconds, path):
    row = {"package": path.relative_to(scratch).parts[0], "file": path.name}
    found = run([claystack, "check", "--json", "--quiet", str(path)], seconds)
    report = json.loads(found.stdout) if found and found.stdout.strip() else {}
    row["read"] = bool(found) and found.returncode in (0, 1)
    row["sound"] = bool(found) and found.returncode == 0
    row["closed"] = report.get("closed", False)
    if not row["read"] or row["sound"]:
        return row
    out = scratch / "out" / (path.name + ".stl")
    out.unlink(missing_ok=True)
    start = time.monotonic()
    done = run([claystack, "check", "--repair", "--quiet", "-o", str(out), str(path)], seconds)
    row["seconds"] = time.monotonic() - start
    row["repaired"] = bool(done) and done.returncode == 0
    if row["repaired"]:
        again = run([claystack, "check", "--quiet", str(out)], seconds)
        row["proved"] = bool(again) and again.returncode == 0
        row["admesh"] = admesh_accepts(out)
    elif done:
        row["reason"] = done.stderr.strip().split(": ", 2)[-1][:160]
    else:
        row["reason"] = f"more than {seconds} s"
    return row


def main():
    claystack, scratch = sys.argv[1], Path(sys.argv[2]).resolve()
    seconds = int(sys.argv[3]) if len(sys.argv) > 3 else 60
    (scratch / "out").mkdir(parents=True, exist_ok=True)
    fetch(scratch)
    files = sorted(p for package in PACKAGES for p in (scratch / package).rglob("*")
                   if p.suffix.lower() in (".stl", ".obj") and p.is_file())
    with ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(lambda p: examine(claystack, scratch, seconds, p), files))
    print("| package | files | read | sound | closed, unsound | repaired | open | repaired | admesh | slowest [s] |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for package in PACKAGES + ["all"]:
        of = [r for r in rows if package in (r["package"], "all")]
        bad = [r for r in of if r["read"] and not r["sound"]]
        closed = [r for r in bad if r["closed"]]
        opened = [r for r in bad if not r["closed"]]
        fixed = [r for r in bad if r["repaired"] and r["proved"]]
        print("|", " | ".join(str(cell) for cell in [
            package, len(of), sum(r["read"] for r in of), sum(r["sound"] for r in of), len(closed),
            sum(r in fixed for r in closed), len(opened), sum(r in fixed for r in opened),
            f"{sum(r['admesh'] for r in fixed)} of {len(fixed)}",
            f"{max([r['seconds'] for r in bad], default=0):.0f}"]), "|")
    print()
    for r in rows:
        if r["read"] and not r["sound"] and not r["repaired"]:
            print(f"* {r['package']}, {r['file']}{' (closed)' if r['closed'] else ''}: {r['reason']}")


main()
