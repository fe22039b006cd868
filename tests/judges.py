#!/usr/bin/env python3
"""judges.py CLAYSTACK SCENE [FOLDER]: exports a pot in every format that other programs read, and
compares the volume that they find with the STL's. Programs that are not installed are named and
passed over. Exit status 1 if a program finds another volume or refuses a file."""
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

if len(sys.argv) < 3:
    sys.exit(__doc__)
CLAYSTACK, SCENE = sys.argv[1], sys.argv[2]
FOLDER = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else tempfile.mkdtemp())
FOLDER.mkdir(parents=True, exist_ok=True)
failed = []


def run(*words, timeout=200, environment={}):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, timeout=timeout,
                          env={**os.environ, **environment})
    return done.returncode, done.stdout + done.stderr


def verdict(program, file, volume, expected, bound=1e-4):
    good = volume is not None and abs(volume / expected - 1.0) <= bound
    print(f"{'ok  ' if good else 'FAIL'} {program}: {pathlib.Path(file).name}: {volume} mm3")
    if not good:
        failed.append((program, file))


def volume_in_stl(path):
    """By the divergence theorem, from a binary or text STL."""
    data = pathlib.Path(path).read_bytes()
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        count = struct.unpack_from("<I", data, 80)[0]
        corners = [struct.unpack_from("<9f", data, 84 + 50 * i + 12) for i in range(count)]
    else:
        numbers = [float(n) for line in re.findall(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)", data) for n in line]
        corners = [numbers[i:i + 9] for i in range(0, len(numbers), 9)]
    return sum(a * (e * k - f * h) - b * (d * k - f * g) + c * (d * h - e * g)
               for a, b, c, d, e, f, g, h, k in corners) / 6.0


def by_prusa_slicer(file, expected):
    code, out = run("prusa-slicer", "--info", file)
    found = re.search(r"volume = ([\d.]+)", out)
    verdict("prusa-slicer", file, float(found[1]) if found and "manifold = yes" in out else None, expected)


def by_openscad(file, expected):
    script, stl = FOLDER / "import.scad", FOLDER / "openscad.stl"
    script.write_text(f'import("{file}");')
    code, out = run("openscad", "-o", stl, script)
    verdict("openscad", file, volume_in_stl(stl) if code == 0 else None, expected)


def by_assimp(file, expected, scale=1.0):
    stl = FOLDER / "assimp.stl"
    stl.unlink(missing_ok=True)
    code, out = run("assimp", "export", file, stl, "-fstlb")
    good = code == 0 and stl.exists()
    verdict("assimp", file, volume_in_stl(stl) * scale if good else None, expected)


def by_libsavitar(file, expected):
    program = """
import sys, zipfile, Savitar, struct
scene = Savitar.ThreeMFParser().parse(zipfile.ZipFile(sys.argv[1]).open('3D/3dmodel.model').read())
total = 0.0
for node in scene.getSceneNodes():
    for part in [node] + list(node.getChildren()):
        mesh = part.getMeshData()
        v = list(struct.iter_unpack('<3f', mesh.getVerticesAsBytes()))
        for i, j, k in struct.iter_unpack('<3i', mesh.getFacesAsBytes()):
            (a, b, c), (d, e, f), (g, h, l) = v[i], v[j], v[k]
            total += a * (e * l - f * h) - b * (d * l - f * g) + c * (d * h - e * g)
print(total / 6.0)
"""
    code, out = run("/usr/bin/python3", "-c", program, file)
    verdict("libSavitar (Cura)", file, float(out) if code == 0 else None, expected)


def by_gmsh(file, expected):
    """Open CASCADE's volume of the solid. Its rule has few nodes for a surface with many knots, so
    that it is asked about `--step lines` only."""
    script = FOLDER / "volume.geo"
    script.write_text(f'SetFactory("OpenCASCADE");\nv() = ShapeFromFile("{file}");\n'
                      'm() = Mass Volume{v(0)};\nPrintf("volume %.12g", m(0));\n')
    code, out = run("gmsh", script, "-parse_and_exit")
    found = re.search(r"volume ([\d.]+)", out)
    verdict("gmsh", file, float(found[1]) if found and code == 0 else None, expected, bound=1e-9)


def by_prusa_slicer_step(file, expected):
    """It meshes the solid itself, so the volume agrees less well; the mesh must be closed."""
    code, out = run("prusa-slicer", "--info", file)
    found = re.search(r"volume = ([\d.]+)", out)
    verdict("prusa-slicer", file, float(found[1]) if found and "manifold = yes" in out else None,
            expected, bound=1e-3)


def judged_by_occt(file):
    """Whether Open CASCADE calls the shape valid, and its volume."""
    program = next(iter(sorted(pathlib.Path("/usr/bin").glob("occt-draw-*"))))
    resources = pathlib.Path("/usr/share/opencascade/resources")
    for name in ("TKTopTest", "TKXSDRAW"):  # DRAW asks for the names of the development packages
        link = FOLDER / f"lib{name}.so"
        if not link.exists():
            link.symlink_to(f"/usr/lib/x86_64-linux-gnu/lib{name}.so.7")
    script = FOLDER / "judge.tcl"
    script.write_text(f"pload MODELING XSDRAW\ntestreadstep {file} a\nputs [checkshape a]\n"
                      "puts [vprops a 1e-7 -full]\nexit\n")
    code, out = run(program, "-b", "-f", script, environment={
        "LD_LIBRARY_PATH": str(FOLDER), "CSF_OCCTResourcePath": str(resources),
        "CSF_DrawPluginDefaults": str(resources / "DrawResources"),
        "DRAWHOME": str(resources / "DrawResources")})
    found = re.search(r"Mass\s*:\s*([-\d.e+]+)", out)
    return "This shape seems to be valid" in out, float(found[1]) if found else None


def by_occt(file, expected):
    valid, volume = judged_by_occt(file)
    verdict("occt-draw", file, volume if valid else None, expected, bound=1e-6)


def refuses_broken_step(file):
    """A solid without its foot: Open CASCADE must find another volume, or a fault."""
    broken = FOLDER / "broken.step"
    broken.write_text(re.sub(r"(CLOSED_SHELL\('',\()#\d+,", r"\1", file.read_text()))
    valid, volume = judged_by_occt(file)
    broken_valid, broken_volume = judged_by_occt(broken)
    differs = not broken_valid or broken_volume is None or abs(broken_volume / volume - 1.0) > 1e-3
    good = valid and differs
    print(f"{'ok  ' if good else 'FAIL'} occt-draw: a STEP without one face differs: {broken_volume}")
    if not good:
        failed.append(("occt-draw", broken))


def by_gltf_validator(file):
    """The Khronos validator, from npm, where GLTF_VALIDATOR names its folder."""
    folder = os.environ.get("GLTF_VALIDATOR")
    if not folder:
        return print("     gltf-validator: set GLTF_VALIDATOR to node_modules/gltf-validator")
    script = ("const v = require(process.argv[1]), fs = require('fs');"
              "v.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2])))"
              ".then(r => console.log(JSON.stringify(r.issues)))")
    code, out = run("node", "-e", script, folder, file)
    errors = json.loads(out)["numErrors"] if code == 0 else out
    print(f"{'ok  ' if errors == 0 else 'FAIL'} gltf-validator: {file.name}: {errors} errors")
    if errors != 0:
        failed.append(("gltf-validator", file))


def kept_by_prusa_slicer(file, pot):
    """Opened, saved and sliced; then the pot is still there, to the byte."""
    saved, code_file = FOLDER / "saved.3mf", FOLDER / "sliced.gcode"
    for path in (saved, code_file):
        path.unlink(missing_ok=True)
    run("prusa-slicer", "--export-3mf", file, "-o", saved)
    run("prusa-slicer", "--export-gcode", "--scale", "0.5", "--center", "100,100", saved, "-o", code_file)
    again = FOLDER / "again.pot.json"
    code, out = run(CLAYSTACK, "export", "-q", saved, again)
    same = code == 0 and again.read_bytes() == pathlib.Path(pot).read_bytes()
    sliced = code_file.exists() and b"G1 X" in code_file.read_bytes()
    print(f"{'ok  ' if same and sliced else 'FAIL'} prusa-slicer: opened, saved and sliced; the pot "
          f"{'is unchanged' if same else 'is lost: ' + out}{'' if sliced else '; not sliced'}")
    if not (same and sliced):
        failed.append(("prusa-slicer saved", file))


def judge_step(pot):
    """Both kinds of walls, against the volume that the export states, which is the counted clay."""
    occt = any(pathlib.Path("/usr/bin").glob("occt-draw-*"))
    if not occt:
        print("     occt-draw is not installed")
    for walls in ("spline", "lines"):
        file = FOLDER / f"{walls}.step"
        code, out = run(CLAYSTACK, "export", "--json", "--step", walls, pot, file)
        assert code == 0, out
        stated = json.loads(out)["files"][0]
        print(f"     STEP, {walls}: {stated['faces']} faces, {stated['bytes']} bytes, "
              f"{stated['volume_mm3']} mm3, off by {stated['volume_error_relative']:.1e}")
        if shutil.which("prusa-slicer"):
            by_prusa_slicer_step(file, stated["volume_mm3"])
        if occt:
            by_occt(file, stated["volume_mm3"])
        if walls == "lines" and shutil.which("gmsh"):
            by_gmsh(file, stated["volume_mm3"])
    if occt:
        refuses_broken_step(FOLDER / "lines.step")


def main():
    pot, stl = FOLDER / "pot.pot.json", FOLDER / "pot.stl"
    files = {ending: FOLDER / f"pot{ending}" for ending in (".ply", ".3mf", ".glb")}
    code, out = run(CLAYSTACK, "throw", "-q", SCENE, "-o", pot)
    assert code == 0, out
    code, out = run(CLAYSTACK, "export", "--json", pot, stl, *files.values())
    assert code == 0, out
    expected = volume_in_stl(stl)
    print(f"     STL: {expected} mm3, {json.loads(out)['triangles']} triangles")
    judges = [("prusa-slicer", lambda: (by_prusa_slicer(files[".3mf"], expected),
                                        kept_by_prusa_slicer(files[".3mf"], pot))),
              ("openscad", lambda: by_openscad(files[".3mf"], expected)),
              ("assimp", lambda: [by_assimp(files[".3mf"], expected),
                                  by_assimp(files[".ply"], expected)])]
    for program, judge in judges:
        if shutil.which(program):
            judge()
        else:
            print(f"     {program} is not installed")
    judge_step(pot)
    by_gltf_validator(files[".glb"])
    if run("/usr/bin/python3", "-c", "import Savitar")[0] == 0:
        by_libsavitar(files[".3mf"], expected)
    else:
        print("     python3-savitar is not installed")
    sys.exit(1 if failed else 0)


main()
