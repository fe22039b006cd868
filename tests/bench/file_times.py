#!/usr/bin/env python3
"""file_times.py CLAYSTACK POT [ROUNDS]: exports each kind of file in turn, and compares it with the
binary STL: wall time (the program starts, writes and syncs) and processor time, the least of all
rounds [ms]. Run it on a quiet machine."""
import os
import resource
import subprocess
import sys
import tempfile
import time

KINDS = {"stl": ["p.stl"], "3mf": ["p.3mf"], "3mf, wall map": ["p.3mf", "--wall-map"],
         "glb, draco": ["p.glb"], "glb, meshopt": ["p.glb", "--glb", "meshopt"],
         "glb, core": ["p.glb", "--glb", "core"], "ply": ["p.ply"], "drc": ["p.drc"],
         "stl, report": ["p.stl", "--report", "p.html"]}
# Without an EGL vendor there is no picture in the report.
NO_PICTURE = {"__EGL_VENDOR_LIBRARY_DIRS": "/nowhere", "__EGL_VENDOR_LIBRARY_FILENAMES": ""}


def spent():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def timed(words, folder, environment):
    before, start = spent(), time.perf_counter()
    subprocess.run(words, cwd=folder, env={**os.environ, **environment}, check=True)
    return 1000.0 * (time.perf_counter() - start), 1000.0 * (spent() - before)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program, pot = (os.path.abspath(word) for word in sys.argv[1:3])
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 10
    jobs = [(name, words, {}) for name, words in KINDS.items()]
    jobs.append(("stl, report without picture", KINDS["stl, report"], NO_PICTURE))
    least = {}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(rounds):
            for name, words, environment in jobs:
                found = timed([program, "export", "-q", pot, *words], folder, environment)
                least[name] = tuple(map(min, zip(found, least.get(name, found))))
    wall, used = least["stl"]
    print(f"{'file':28} {'wall':>8} {'/ STL':>6} {'processor':>10} {'/ STL':>6}")
    for name, (ms, cpu) in least.items():
        print(f"{name:28} {ms:8.1f} {ms / wall:6.2f} {cpu:10.1f} {cpu / used:6.2f}")


main()
