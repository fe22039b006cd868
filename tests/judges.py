#!/usr/bin/env python3
"""judges.py [--installed] CLAYSTACK SCENE [FOLDER]: exports a pot in every format that other programs
read, and compares the volume that they find with the STL's; and 3MF packages that must be refused
or accepted. Exit status 1 if a program finds another volume or refuses a file, or if a judge is
missing. With --installed, as in the tests, missing judges are named and passed over.

Judges by apt: prusa-slicer openscad assimp-utils python3-savitar lib3mf-dev occt-draw gmsh f3d
chromium; by npm, in the folder that NODE_MODULES names: gltf-validator @gltf-transform/cli gltfpack
three playwright-core."""
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

arguments = [word for word in sys.argv[1:] if word != "--installed"]
if len(arguments) < 2:
    sys.exit(__doc__)
CLAYSTACK, SCENE = arguments[:2]
FOLDER = pathlib.Path(arguments[2] if len(arguments) > 2 else tempfile.mkdtemp())
FOLDER.mkdir(parents=True, exist_ok=True)
JUDGES = pathlib.Path(__file__).resolve().parent / "judges"
NODE_MODULES = pathlib.Path(os.environ.get("NODE_MODULES", "node_modules"))
sys.path.insert(0, str(JUDGES))
import packages_3mf  # noqa: E402
failed = []


def present(judge, there):
    """Whether to ask this judge; one that is missing is a failure without --installed."""
    if not there:
        optional = "--installed" in sys.argv
        print(f"{'    ' if optional else 'FAIL'} {judge} is not installed")
        if not optional:
            failed.append((judge, "not installed"))
    return there


def ruled(good, text, judge, file):
    print(f"{'ok  ' if good else 'FAIL'} {judge}: {text}")
    if not good:
        failed.append((judge, file))


def run(*words, timeout=400, environment={}):
    """Status and output; a program that takes longer than the timeout [s] has failed."""
    try:
        done = subprocess.run([str(w) for w in words], capture_output=True, text=True,
                              timeout=timeout, env={**os.environ, **environment})
    except subprocess.TimeoutExpired:
        return 124, f"no answer within {timeout} s"
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
    """The Khronos validator. It does not decode Draco."""
    script = ("const v = require(process.argv[1]), fs = require('fs');"
              "v.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2])))"
              ".then(r => console.log(JSON.stringify(r.issues)))")
    code, out = run("node", "-e", script, NODE_MODULES / "gltf-validator", file)
    issues = json.loads(out) if code == 0 else {"numErrors": out, "numWarnings": 0}
    ruled(issues["numErrors"] == 0 and issues["numWarnings"] == 0,
          f"{file.name}: {issues['numErrors']} errors, {issues['numWarnings']} warnings",
          "gltf-validator", file)


def by_gltf_transform(file, expected):
    """Decodes the file and writes it again, uncompressed and in one piece; we count its volume."""
    plain, stl = FOLDER / "transformed.glb", FOLDER / "transformed.stl"
    for path in (plain, stl):
        path.unlink(missing_ok=True)
    tool = NODE_MODULES / ".bin" / "gltf-transform"
    code, out = run(tool, "dequantize", file, plain)
    good = code == 0 and run(CLAYSTACK, "check", "-q", plain, "--repair", "-o", stl)[0] == 0
    verdict("gltf-transform", file, volume_in_stl(stl) if good else None, expected, bound=1e-6)


def by_three(files, expected):
    """three.js in a browser without a screen: the volume that it draws, and a picture."""
    script = JUDGES / "three.mjs"
    code, out = run("node", script, NODE_MODULES.resolve(), FOLDER / "three.png", *files,
                    environment={"CHROMIUM": shutil.which("chromium") or ""})
    if code != 0:
        return ruled(False, out.strip()[-400:], "three.js", files[0])
    for file, found in zip(files, json.loads(out)):
        verdict("three.js", file, found["volume"], expected[file], bound=1e-6)
        wall_map = "map" in file.name
        ruled(found["colours"] == wall_map,
              f"{file.name}: {'colours' if found['colours'] else 'no colours'}", "three.js", file)


def by_f3d(file):
    picture = FOLDER / "f3d.png"
    picture.unlink(missing_ok=True)
    run("xvfb-run", "-a", "f3d", file, "--output", picture, "--resolution", "300,300")
    ruled(picture.exists() and picture.stat().st_size > 3000, f"{file.name}: a picture", "f3d", file)


def against_gltfpack(core, ours, tolerance_mm):
    """The size by gltfpack, with the fewest bits for the tolerance: half a step along each axis."""
    bounds = json_in_glb(core)["accessors"][0]
    side_mm = 1000.0 * max(h - l for l, h in zip(bounds["min"], bounds["max"]))
    bits = next(b for b in range(1, 17)
                if 3.0 ** 0.5 / 2.0 * side_mm / (2 ** b - 1) <= tolerance_mm)
    packed = FOLDER / "gltfpack.glb"
    code, out = run(NODE_MODULES / ".bin" / "gltfpack", "-i", core, "-o", packed, "-cc", "-vp", bits)
    if code != 0:
        return ruled(False, out, "gltfpack", core)
    size, peer = ours.stat().st_size, packed.stat().st_size
    ruled(size <= 1.1 * peer, f"{ours.name}: {size} bytes, by gltfpack with {bits} bits {peer}",
          "gltfpack", ours)


def json_in_glb(file):
    data = file.read_bytes()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


def by_lib3mf(file, expected):
    code, out = run("/usr/bin/python3", JUDGES / "lib3mf_volume.py", file)
    verdict("lib3mf, strict", file, float(out) if code == 0 else None, expected)


def rule_packages():
    """Packages that must be refused, and that must be accepted."""
    file = FOLDER / "case.3mf"
    cases = [(what, data, 2) for what, data in packages_3mf.must_fail().items()]
    cases += [(what, data, 0) for what, data in packages_3mf.must_pass().items()]
    wrong = 0
    for what, data, status in cases:
        file.write_bytes(data)
        code, out = run(CLAYSTACK, "check", file, timeout=20)
        if code != status:
            wrong += 1
            ruled(False, f"{what}: expected status {status}, found {code}: {out}", "check", file)
    ruled(wrong == 0, f"{len(cases)} packages of 3MF, {wrong} decided wrongly", "check", file)


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
    occt = present("occt-draw", any(pathlib.Path("/usr/bin").glob("occt-draw-*")))
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
        if walls == "lines" and present("gmsh", shutil.which("gmsh")):
            by_gmsh(file, stated["volume_mm3"])
    if occt:
        refuses_broken_step(FOLDER / "lines.step")


def judge_glb(stl, glb, tolerance_mm, expected, bounds_mm3):
    """`glb`: files by the name of their compression. Rounded points change the volume, by at most the
    bound that the export states. The others must read what check reads."""
    read = {}
    for name, file in glb.items():
        code, out = run(CLAYSTACK, "check", "--json", file)
        read[file] = json.loads(out)["volume_mm3"] if code == 0 else float("nan")
        verdict("claystack check", file, read[file], expected, bound=bounds_mm3[name] / expected)
    if present("gltf-validator", (NODE_MODULES / "gltf-validator").is_dir()):
        for file in glb.values():
            by_gltf_validator(file)
    if present("gltf-transform", (NODE_MODULES / ".bin/gltf-transform").exists()):
        for file in glb.values():
            by_gltf_transform(file, read[file])
    if present("three, playwright-core and chromium", shutil.which("chromium") and all(
            (NODE_MODULES / name).is_dir() for name in ("three", "playwright-core"))):
        by_three(list(glb.values()), read)
    if present("gltfpack", (NODE_MODULES / ".bin/gltfpack").exists()):
        against_gltfpack(glb["core"], glb["meshopt"], tolerance_mm)
    if present("f3d and xvfb-run", shutil.which("f3d") and shutil.which("xvfb-run")):
        by_f3d(glb["core"])  # Debian's build reads neither Draco nor meshopt
    if present("assimp", shutil.which("assimp")):
        by_assimp(glb["core"], expected, scale=1e9)  # metres
    for name, file in glb.items():
        print(f"     GLB, {name}: {file.stat().st_size} bytes, "
              f"{100.0 * file.stat().st_size / stl.stat().st_size:.2f} % of the STL")


def main():
    tolerance_mm = 0.02
    pot, stl = FOLDER / "pot.pot.json", FOLDER / "pot.stl"
    files = {ending: FOLDER / f"pot{ending}" for ending in (".ply", ".3mf")}
    code, out = run(CLAYSTACK, "throw", "-q", SCENE, "-o", pot)
    assert code == 0, out
    code, out = run(CLAYSTACK, "export", "--json", pot, stl, *files.values(), "--tolerance",
                    tolerance_mm)
    assert code == 0, out
    glb, bounds_mm3 = {}, {}
    for mesh in ("core", "draco", "meshopt"):
        for kind, words in ((mesh, []), (mesh + "-map", ["--wall-map"])):
            glb[kind] = FOLDER / f"{kind}.glb"
            code, done = run(CLAYSTACK, "export", "--json", pot, glb[kind], "--glb", mesh,
                             "--tolerance", tolerance_mm, *words)
            assert code == 0, done
            bounds_mm3[kind] = json.loads(done)["files"][0]["volume_bound_mm3"]
    coloured = FOLDER / "map.3mf"
    code, done = run(CLAYSTACK, "export", "-q", pot, coloured, "--wall-map")
    assert code == 0, done
    expected = volume_in_stl(stl)
    print(f"     STL: {expected} mm3, {json.loads(out)['triangles']} triangles")
    if present("prusa-slicer", shutil.which("prusa-slicer")):
        by_prusa_slicer(files[".3mf"], expected)
        by_prusa_slicer(coloured, expected)
        kept_by_prusa_slicer(files[".3mf"], pot)
    if present("openscad", shutil.which("openscad")):
        by_openscad(files[".3mf"], expected)
    if present("assimp", shutil.which("assimp")):
        by_assimp(files[".3mf"], expected)
        by_assimp(files[".ply"], expected)
    if present("lib3mf", run("/usr/bin/python3", "-c", "import ctypes; ctypes.CDLL('lib3MF.so.1')")[0] == 0):
        by_lib3mf(files[".3mf"], expected)
        by_lib3mf(coloured, expected)
    if present("python3-savitar", run("/usr/bin/python3", "-c", "import Savitar")[0] == 0):
        by_libsavitar(files[".3mf"], expected)
    rule_packages()
    judge_step(pot)
    judge_glb(stl, glb, tolerance_mm, expected, bounds_mm3)
    sys.exit(1 if failed else 0)


main()
