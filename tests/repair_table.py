#!/usr/bin/env python3
"""Repairs the real meshes that Debian packages contain, and prints a table for docs/repair.md.

    python3 tests/repair_table.py build/release/app/claystack SCRATCH_FOLDER [SECONDS_PER_FILE]

Downloads the packages with apt-get and unpacks them into SCRATCH_FOLDER; installs nothing. The limit
and the times are seconds of a processor, of all threads together, so that a busy machine does not
change the table. Each repaired file is checked again from its bytes, by admesh and PrusaSlicer where
they are installed, and by manifold-3d (npm) where MANIFOLD_3D names its folder.
"""
import json
import os
import re
import resource
import shutil
import subprocess
import sys
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
    """The result and its processor time; None if that exceeds the limit."""
    child = subprocess.Popen(
        arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace",
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds)))
    out, err = child.communicate()
    return None if child.returncode < 0 else subprocess.CompletedProcess(arguments, child.returncode, out, err)


def timed(arguments, seconds):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = run(arguments, seconds)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, sum(after[i] - before[i] for i in range(2))


def admesh_accepts(path):
    done = run(["admesh", "--exact", str(path)], 60)
    if done is None or done.returncode != 0:
        return False
    open_facets = re.search(r"Total disconnected facets\s*:\s*(\d+)", done.stdout)
    return open_facets is not None and int(open_facets.group(1)) == 0


def prusa_slicer_accepts(path):
    done = run(["prusa-slicer", "--info", str(path)], 60)
    return (done is not None and "manifold = yes" in done.stdout
            and not re.search(r"edges_fixed|facets_removed|facets_reversed|backwards_edges", done.stdout))


def manifold_accepts(path):
    script = Path(__file__).parent / "manifold_status.mjs"
    done = run(["node", str(script), os.environ["MANIFOLD_3D"], str(path)], 60)
    return done is not None and done.stdout.strip() == "NoError"


JUDGES = {"admesh": (admesh_accepts, shutil.which("admesh")),
          "PrusaSlicer": (prusa_slicer_accepts, shutil.which("prusa-slicer")),
          "manifold": (manifold_accepts, os.environ.get("MANIFOLD_3D"))}


def examine(claystack, scratch, seconds, path):
    row = {"package": path.relative_to(scratch).parts[0], "file": path.name}
    found = run([claystack, "check", "--json", "--quiet", str(path)], seconds)
    report = json.loads(found.stdout) if found and found.stdout.strip() else {}
    row["read"] = bool(found) and found.returncode in (0, 1)
    row["sound"] = bool(found) and found.returncode == 0
    row["prints"] = report.get("verdict") == "prints"
    row["closed"] = report.get("closed", False)
    if not row["read"] or row["sound"]:
        return row
    out = scratch / "out" / (path.name + ".stl")
    out.unlink(missing_ok=True)
    done, row["seconds"] = timed([claystack, "check", "--repair", "--quiet", "-o", str(out), str(path)], seconds)
    row["repaired"] = bool(done) and done.returncode == 0
    if row["repaired"]:
        again = run([claystack, "check", "--quiet", str(out)], seconds)
        row["proved"] = bool(again) and again.returncode == 0
        for judge, (accepts, installed) in JUDGES.items():
            row[judge] = bool(installed) and accepts(out)
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
    rows = [examine(claystack, scratch, seconds, p) for p in files]  # one by one: their times are told apart
    heads = ["package", "files", "read", "sound", "prints", "closed, unsound", "repaired", "open", "repaired",
             *JUDGES, "slowest [s]"]
    print("|", " | ".join(heads), "|")
    print("|", " | ".join("---" for _ in heads), "|")
    for package in PACKAGES + ["all"]:
        of = [r for r in rows if package in (r["package"], "all")]
        bad = [r for r in of if r["read"] and not r["sound"]]
        closed = [r for r in bad if r["closed"]]
        opened = [r for r in bad if not r["closed"]]
        fixed = [r for r in bad if r["repaired"] and r["proved"]]
        print("|", " | ".join(str(cell) for cell in [
            package, len(of), sum(r["read"] for r in of), sum(r["sound"] for r in of),
            sum(r["prints"] for r in bad), len(closed),
            sum(r in fixed for r in closed), len(opened), sum(r in fixed for r in opened),
            *(f"{sum(r[judge] for r in fixed)} of {len(fixed)}" if installed else "not installed"
              for judge, (_, installed) in JUDGES.items()),
            f"{max([r['seconds'] for r in bad], default=0):.0f}"]), "|")
    print()
    for r in rows:
        if r["read"] and not r["sound"] and not r["repaired"]:
            print(f"* {r['package']}, {r['file']}{' (closed)' if r['closed'] else ''}: {r['reason']}")


main()
