#!/usr/bin/env python3
"""Repairs the real meshes that Debian packages contain, and prints a table for docs/repair.md.

    python3 tests/repair_table.py build/release/app/claystack SCRATCH_FOLDER [SECONDS_PER_FILE [JOBS]]

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
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PACKAGES = ["cura", "prusa-slicer", "assimp-testmodels", "libcgal-demo", "openscad", "admesh"]
SUFFIXES = (".stl", ".obj", ".off", ".ply")


def fetch(scratch):
    for package in PACKAGES:
        to = scratch / package
        if to.exists():
            continue
        subprocess.run(["apt-get", "download", package], cwd=scratch, check=True, capture_output=True)
        subprocess.run(["dpkg", "-x", next(scratch.glob(package + "_*.deb")), to], check=True)
        for archive in to.rglob("data.tar.gz"):  # the meshes of CGAL
            subprocess.run(["tar", "xzf", archive, "-C", archive.parent], check=True)


def timed(arguments, seconds):
    """The result, None if its processor time exceeds the limit; and that time, of all its threads."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        child = subprocess.Popen(
            arguments, stdout=out, stderr=err,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds)))
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for file in (out, err):
            file.seek(0)
            texts.append(file.read().decode(errors="replace"))
    done = subprocess.CompletedProcess(arguments, child.returncode, *texts)
    return (None if child.returncode < 0 else done), usage.ru_utime + usage.ru_stime


def run(arguments, seconds):
    return timed(arguments, seconds)[0]


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
    out = scratch / "out" / f"{row['package']}_{path.name}.stl"
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
    jobs = int(sys.argv[4]) if len(sys.argv) > 4 else os.cpu_count()
    (scratch / "out").mkdir(parents=True, exist_ok=True)
    fetch(scratch)
    files = sorted(p for package in PACKAGES for p in (scratch / package).rglob("*")
                   if p.suffix.lower() in SUFFIXES and p.is_file())
    with ThreadPoolExecutor(jobs) as pool:
        rows = list(pool.map(lambda path: examine(claystack, scratch, seconds, path), files))
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
