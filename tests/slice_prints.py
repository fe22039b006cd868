#!/usr/bin/env python3
"""Slices the real meshes that `check` calls "prints", and compares volumes.

    python3 tests/slice_prints.py build/release/app/claystack FOLDER_OF_REPAIR_TABLE [PERCENT]

Each STL or OBJ file in the folder with the verdict "prints" is scaled to 60 mm, repaired, and both
are sliced by PrusaSlicer without infill gaps (100 % infill, one material, no skirt). The extruded
volumes of the file as it is and of the repaired file must be within PERCENT (default 5) of each
other: then the slicer made of the file what the repair made of it. Exit status 1 if fewer than 95 %
of the files are.
"""
import json
import re
import subprocess
import sys
from pathlib import Path

SLICER = ["prusa-slicer", "--export-gcode", "--fill-density", "100%", "--fill-pattern", "rectilinear",
          "--skirts", "0", "--brim-width", "0",
          "--nozzle-diameter", "0.4", "--layer-height", "0.2", "--first-layer-height", "0.2",
          "--filament-diameter", "1.75", "--scale-to-fit", "60,60,60", "--center", "100,100"]


def extruded_cm3(path, gcode):
    gcode.unlink(missing_ok=True)
    done = subprocess.run([*SLICER, "-o", str(gcode), str(path)], capture_output=True, text=True, errors="replace",
                          timeout=600)
    if done.returncode != 0 or not gcode.exists():
        return None, (done.stderr or done.stdout).strip().splitlines()[-1:]
    found = re.search(r"; filament used \[cm3\] = ([\d.]+)", gcode.read_text(errors="replace"))
    return (float(found.group(1)), []) if found else (None, ["no volume in the G-code"])


def main():
    claystack, folder = sys.argv[1], Path(sys.argv[2]).resolve()
    percent = float(sys.argv[3]) if len(sys.argv) > 3 else 5.0
    out = folder / "out"
    out.mkdir(exist_ok=True)
    files = sorted(p for p in folder.rglob("*")
                   if p.suffix.lower() in (".stl", ".obj") and p.is_file() and out not in p.parents)
    agreed = total = 0
    for path in files:
        found = subprocess.run([claystack, "check", "--json", "--quiet", str(path)], capture_output=True, text=True)
        if not found.stdout.strip() or json.loads(found.stdout).get("verdict") != "prints":
            continue
        total += 1
        repaired = out / (path.name + ".prints.stl")
        done = subprocess.run([claystack, "check", "--repair", "--quiet", "-o", str(repaired), str(path)],
                              capture_output=True, text=True)
        if done.returncode != 0:
            print(f"* {path.name}: not repaired: {done.stderr.strip()[:120]}")
            continue
        volume, why = extruded_cm3(path, out / "prints.gcode")
        ours, ours_why = extruded_cm3(repaired, out / "repaired.gcode")
        if volume is None or ours is None:
            print(f"* {path.name}: not sliced: {why or ours_why}")
            continue
        difference = 100.0 * abs(volume - ours) / ours if ours > 0.0 else float("inf")
        agreed += difference <= percent
        print(f"* {path.name}: {volume:.3f} cm3 extruded, {ours:.3f} cm3 repaired, {difference:.2f} % apart")
    print(f"{agreed} of {total} within {percent:g} %")
    sys.exit(0 if 100 * agreed >= 95 * total else 1)


main()
