"""Tests of the Python package: PYTHONPATH=BUILD/python python3 claystack_test.py PROGRAM SAMPLES"""

import json
import math
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np

import claystack

PROGRAM, SAMPLES = sys.argv[1:3]


def sample(name):
    return os.path.join(SAMPLES, name)


class Package(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)

    def file(self, name):
        return os.path.join(self._folder.name, name)

    def run_program(self, *words):
        return subprocess.run([PROGRAM, *words], check=True, capture_output=True)

    def verdict_of(self, *words):
        return subprocess.run([PROGRAM, *words], check=False, capture_output=True)

    def bytes_of(self, name):
        with open(self.file(name), "rb") as file:
            return file.read()

    def test_gives_the_bytes_of_the_command_line(self):
        pot = claystack.throw(sample("vase.scene.json"))
        pot.write(self.file("py.pot.json"))
        self.run_program("throw", sample("vase.scene.json"), "-o", self.file("cli.pot.json"))
        self.assertEqual(self.bytes_of("py.pot.json"), self.bytes_of("cli.pot.json"))
        report = claystack.export(pot, [self.file("py.stl"), self.file("py.ply")])
        self.run_program("export", self.file("cli.pot.json"), self.file("cli.stl"),
                         self.file("cli.ply"))
        self.assertEqual(self.bytes_of("py.stl"), self.bytes_of("cli.stl"))
        self.assertEqual(report.files[0].bytes, len(self.bytes_of("py.stl")))
        self.assertTrue(report.passes)
        claystack.export(pot, [self.file("straight.stl")], smooth_length_mm=0.0)
        self.run_program("export", self.file("cli.pot.json"), self.file("cli_straight.stl"),
                         "--smooth-length", "0")
        self.assertEqual(self.bytes_of("straight.stl"), self.bytes_of("cli_straight.stl"))
        self.assertNotEqual(self.bytes_of("straight.stl"), self.bytes_of("py.stl"))

    def test_names_the_solid_as_the_command_line_does(self):
        claystack.throw(sample("vase.scene.json")).write(self.file("vase.pot.json"))
        os.mkdir(self.file("py"))
        for end in [".stl", ".obj", ".glb", ".step"]:
            claystack.export(claystack.read_pot(self.file("vase.pot.json")),
                             [self.file("py/vase" + end)])
            self.run_program("export", self.file("vase.pot.json"), self.file("vase" + end))
            self.assertEqual(self.bytes_of("py/vase" + end), self.bytes_of("vase" + end), end)

    def test_takes_the_format_options_of_the_command_line(self):
        claystack.throw(sample("vase.scene.json")).write(self.file("vase.pot.json"))
        pot = claystack.read_pot(self.file("vase.pot.json"))
        os.mkdir(self.file("py"))
        usual = {}
        for end in [".glb", ".step", ".stl"]:
            claystack.export(pot, self.file("py/vase" + end))
            usual[end] = self.bytes_of("py/vase" + end)
        for end, keywords, options in [
                (".glb", {"glb": "core"}, ["--glb", "core"]),
                (".glb", {"glb": "meshopt"}, ["--glb", "meshopt"]),
                (".glb", {"material": "celadon"}, ["--material", "celadon"]),
                (".glb", {"wall_map": True}, ["--wall-map"]),
                (".step", {"step": "lines"}, ["--step", "lines"]),
                (".stl", {"segments": 48}, ["--segments", "48"]),
                (".stl", {"max_triangles": 5000}, ["--max-triangles", "5000"])]:
            claystack.export(pot, self.file("py/vase" + end), **keywords)
            self.run_program("export", self.file("vase.pot.json"), self.file("vase" + end), *options)
            self.assertEqual(self.bytes_of("py/vase" + end), self.bytes_of("vase" + end), options)
            self.assertNotEqual(self.bytes_of("py/vase" + end), usual[end], options)

    def test_refuses_format_options_as_the_command_line_does(self):
        pot = claystack.stack(2.0, [40.0] * 10, [0.0] * 3 + [30.0] * 7)
        for name, keywords, message in [
                ("cup.stl", {"glb": "core"}, "glb: expected a .glb among the files to write"),
                ("cup.stl", {"material": "wet"}, "material: expected a .glb among the files"),
                ("cup.stl", {"wall_map": True}, "wall_map: expected a .glb or a .3mf among"),
                ("cup.stl", {"step": "lines"}, "step: expected a .step among the files"),
                ("cup.svg", {"segments": 48}, "segments: expected a mesh among the files"),
                ("cup.svg", {"max_triangles": 500}, "max_triangles: expected a mesh among"),
                ("cup.glb", {"glb": "zip"}, "glb: expected draco, meshopt or core, found zip"),
                ("cup.glb", {"material": "mud"}, "material: expected wet, leather-hard, "),
                ("cup.step", {"step": "x"}, "step: expected spline or lines, found x"),
                ("cup.stl", {"smoothing": "x"}, "smoothing: expected fair, exact or none, found x"),
                ("cup.stl", {"segments": 2}, "segments: expected 3 to "),
                ("cup.stl", {"max_triangles": -5}, "max triangles: expected 8 to ")]:
            with self.assertRaises(claystack.Error) as refused:
                claystack.export(pot, self.file(name), **keywords)
            self.assertTrue(refused.exception.message.startswith(message), refused.exception.message)
            self.assertEqual(refused.exception.code, 2)
            self.assertFalse(os.path.exists(self.file(name)))

    def test_warns_where_the_command_line_does(self):
        with open(sample("vase.session"), "rb") as whole:
            lines = whole.read()
        with open(self.file("torn.session"), "wb") as torn:
            torn.write(lines[:-100])
        for session in (self.file("torn.session"), sample("bowl.session")):
            with self.assertWarns(UserWarning) as warned:
                pot = claystack.throw(sample("vase.scene.json"), session)
            ran = self.run_program("throw", sample("vase.scene.json"), "-s", session, "-o",
                                   self.file("cli.pot.json"))
            self.assertEqual(ran.stderr.decode(), f"claystack: warning: {warned.warning}\n")
            pot.write(self.file("py.pot.json"))
            self.assertEqual(self.bytes_of("py.pot.json"), self.bytes_of("cli.pot.json"))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            claystack.throw(sample("vase.scene.json"))

    def test_refuses_two_tools_in_a_scene_of_one(self):
        with open(sample("vase.scene.json"), encoding="utf-8") as file:
            scene = file.read().split("\n")
        with open(self.file("one.scene.json"), "w", encoding="utf-8") as file:
            text = "\n".join(line for line in scene if "gap_mm" not in line)
            file.write(text.replace('"press",\n', '"press"\n'))
        with self.assertRaises(claystack.Error) as refused:
            claystack.throw(self.file("one.scene.json"), sample("vase.session"))
        self.assertIn("expected one tool throughout", refused.exception.message)
        self.assertEqual(refused.exception.file, sample("vase.session"))

    def test_compares_pots_and_meshes_by_value(self):
        pot, same = (claystack.stack(2.0, [40.0, 41.0], [0.0, 30.0]) for _ in range(2))
        other = claystack.stack(2.0, [40.0, 41.0], [0.0, 30.5])
        self.assertEqual(pot, same)
        self.assertNotEqual(pot, other)
        self.assertEqual(len({pot, same, other}), 2)
        self.assertIn(same, [other, pot])
        self.assertNotEqual(pot, 1)
        self.assertEqual(claystack.mesh(pot), claystack.mesh(same))
        self.assertNotEqual(claystack.mesh(pot), claystack.mesh(other))
        self.assertEqual(len({claystack.mesh(pot), claystack.mesh(same)}), 1)

    def test_refuses_impossible_rings_and_no_file_by_name(self):
        pot = claystack.stack(1.0, [40.0], [0.0])
        for refused, message in [
                (lambda: claystack.stack(1.0, [], []), "outer_mm: expected one ring or more"),
                (lambda: claystack.stack(1.0, [30.0, 30.0], [0.0, 31.0]),
                 "ring 1: expected an inner radius below the outer one of 30 mm, found 31"),
                (lambda: claystack.stack(1.0, [5001.0], [0.0]),
                 "ring 0: expected radii from 0 to 5000 mm, found 5001"),
                (lambda: claystack.export(pot, []), "files: expected one file or more")]:
            with self.assertRaises(claystack.Error) as error:
                refused()
            self.assertIn(message, error.exception.message)
            self.assertEqual(error.exception.code, 2)

    def test_names_an_argument_of_a_wrong_type(self):
        pot, path = claystack.stack(1.0, [40.0], [0.0]), self.file("cup.stl")
        number = {"tolerance_mm": "a number", "smooth_length_mm": "a number",
                  "min_wall_mm": "a number", "shrinkage": "a number"}
        for keyword, expected in {**number, "segments": "a whole number",
                                  "max_triangles": "a whole number", "smoothing": "a string",
                                  "step": "a string", "glb": "a string", "material": "a string",
                                  "process": "a path", "wall_map": "True or False",
                                  "certificates": "True or False"}.items():
            found = "3" if "number" in expected else 3
            with self.assertRaises(TypeError) as wrong:
                claystack.export(pot, path, **{keyword: found})
            self.assertEqual(str(wrong.exception), f"{keyword}: expected {expected}, found {found!r}")
        for call, message in [
                (lambda: claystack.throw(3), "scene: expected a path, found 3"),
                (lambda: claystack.stack("1", [40.0], [0.0]),
                 "ring_height_mm: expected a number, found '1'"),
                (lambda: claystack.stack(1.0, ["40"], [0.0]),
                 "outer_mm: expected numbers, found ['40']"),
                (lambda: claystack.read_pot(None), "path: expected a path, found None"),
                (lambda: claystack.import_pot(3), "path: expected a path, found 3"),
                (lambda: claystack.export(path, path), "pot: expected a Pot, found '"),
                (lambda: claystack.export(pot, [3]), "files: expected a path or several, found [3]"),
                (lambda: claystack.mesh(pot, tolerance_mm=True),
                 "tolerance_mm: expected a number, found True"),
                (lambda: claystack.read_mesh(3), "path: expected a path, found 3"),
                (lambda: claystack.check(path, min_wall_mm="3"),
                 "min_wall_mm: expected a number, found '3'"),
                (lambda: claystack.import_pot(path, wall_mm="3"),
                 "wall_mm: expected a number, found '3'"),
                (lambda: claystack.check(3), "what: expected a Mesh or a path, found 3"),
                (lambda: pot.write(3), "path: expected a path, found 3"),
                (lambda: claystack.throw(), "throw(): missing a required argument: 'scene'")]:
            with self.assertRaises(TypeError) as wrong:
                call()
            self.assertTrue(str(wrong.exception).startswith(message), str(wrong.exception))
        self.assertFalse(os.path.exists(path))

    def test_takes_numbers_of_numpy(self):
        pot = claystack.stack(np.float32(1.0), np.array([40.0, 41.0]), np.zeros(2, dtype=int))
        self.assertEqual(pot, claystack.stack(1.0, [40.0, 41.0], [0.0, 0.0]))
        self.assertEqual(claystack.mesh(pot, tolerance_mm=np.float64(0.5)),
                         claystack.mesh(pot, tolerance_mm=0.5))

    def test_refuses_an_impossible_density(self):
        for density in [float("nan"), -1.0, 0.0, 26.0]:
            with self.assertRaises(claystack.Error):
                claystack.stack(1.0, [40.0], [20.0], density_g_cm3=density)

    def test_a_length_spreads_a_step_of_the_wall(self):
        pot = claystack.stack(0.2, [40.0] * 250 + [40.1] * 250, [20.0] * 500)
        pot.write(self.file("step.pot.json"))
        def steepest(smooth_length_mm):
            points = claystack.mesh(pot, smooth_length_mm=smooth_length_mm).points
            radius, height = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
            outer = radius > 30.0
            heights, first = np.unique(np.round(height[outer], 6), return_index=True)
            return np.abs(np.diff(radius[outer][first]) / np.diff(heights)).max()
        # Without fairing the step rises between the middles of two rings.
        self.assertAlmostEqual(steepest(0.0), 0.1 / 0.2, delta=0.01)
        # The filter of a step d has the slope d 2 pi / (3 l) in its middle (docs/smoothing.md);
        # within the tolerance the mesh has a straight line there, which is less steep.
        middle = 0.1 * 2.0 * math.pi / (3.0 * 9.0)
        self.assertLess(steepest(9.0), 1.01 * middle)
        self.assertGreater(steepest(9.0), 0.5 * middle)
        claystack.export(pot, [self.file("step.stl")], smooth_length_mm=9.0)
        self.run_program("export", self.file("step.pot.json"), "--smooth-length", "9",
                         self.file("cli_step.stl"))
        self.assertEqual(self.bytes_of("step.stl"), self.bytes_of("cli_step.stl"))
        length_mm = 9.0
        with self.assertRaises(claystack.Error) as refused:
            claystack.mesh(pot, smoothing="exact", smooth_length_mm=length_mm)
        self.assertEqual(refused.exception.code, 2)

    def test_shows_rings_and_meshes_without_a_copy(self):
        pot = claystack.stack(2.0, [40.0, 41.0, 42.0], [0.0, 30.0, 30.0])
        self.assertTrue(np.shares_memory(pot.quanta, pot._native.quanta))
        mesh = claystack.mesh(pot, smoothing="none")
        self.assertTrue(np.shares_memory(mesh.points, mesh._native.points))
        self.assertTrue(np.shares_memory(mesh.triangles, mesh._native.triangles))
        for array in (pot.quanta, mesh.points, mesh.triangles):
            with self.assertRaises(ValueError):
                array[0, 0] = 1
        # An array outlives the object that it was taken from.
        points = claystack.mesh(pot, smoothing="none").points
        self.assertEqual(points.dtype, np.float64)
        self.assertEqual(mesh.triangles.dtype, np.uint32)
        self.assertEqual(points.tobytes(), mesh.points.tobytes())

    def test_stacks_rings_of_the_volume_of_geometry(self):
        pot = claystack.stack(2.0, [40.0, 41.0], [0.0, 30.0])
        expected = 2.0 * math.pi * (40.0**2 + 41.0**2 - 30.0**2)
        self.assertAlmostEqual(pot.volume_mm3 / expected, 1.0, places=9)
        np.testing.assert_allclose(pot.outer_mm, [40.0, 41.0], atol=1e-9)
        np.testing.assert_allclose(pot.inner_mm, [0.0, 30.0], atol=1e-9)
        verdict = claystack.check(claystack.mesh(pot, smoothing="none", tolerance_mm=0.001))
        self.assertTrue(verdict.sound)
        self.assertAlmostEqual(verdict.volume_mm3 / expected, 1.0, places=3)

    def test_a_mesh_gives_its_volume_to_numpy(self):
        mesh = claystack.mesh(claystack.stack(50.0, [20.0], [0.0]), tolerance_mm=0.001)
        a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
        volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0
        self.assertAlmostEqual(volume / (math.pi * 20.0**2 * 50.0), 1.0, places=3)

    def test_imports_drawings_and_meshes(self):
        jug = claystack.import_pot(sample("drawings/jug.svg"))
        self.assertGreater(jug.height_mm, 10.0)
        claystack.export(jug, [self.file("jug.stl")])
        back = claystack.import_pot(self.file("jug.stl"))
        self.assertAlmostEqual(back.volume_mm3 / jug.volume_mm3, 1.0, places=2)

    def test_scales_and_hollows_an_import_as_the_command_line_does(self):
        jug = claystack.import_pot(sample("drawings/jug.svg"))
        claystack.export(jug, self.file("jug.stl"))
        for drawing, keywords, options in [
                (sample("drawings/jug.svg"), {"height_mm": 120.0}, ["--height", "120"]),
                (sample("drawings/tumbler.csv"), {"wall_mm": 6.0}, ["--wall", "6"]),
                (sample("drawings/tumbler.csv"), {"height_mm": 90, "wall_mm": 4},
                 ["--height", "90", "--wall", "4"]),
                (self.file("jug.stl"), {"height_mm": 120.0}, ["--height", "120"])]:
            pot = claystack.import_pot(drawing, **keywords)
            pot.write(self.file("py.pot.json"))
            self.run_program("import", drawing, "-o", self.file("cli.pot.json"), *options)
            self.assertEqual(self.bytes_of("py.pot.json"), self.bytes_of("cli.pot.json"), options)
            if "height_mm" in keywords:
                self.assertAlmostEqual(pot.height_mm, keywords["height_mm"], places=1)
            else:
                self.assertGreater(np.count_nonzero(pot.inner_mm), 0)

    def test_refuses_the_size_of_an_import(self):
        claystack.export(claystack.stack(2.0, [40.0] * 10, [0.0] * 10), self.file("lump.stl"))
        for path, keywords, message in [
                (sample("drawings/jug.svg"), {"height_mm": float("nan")},
                 "height_mm: expected from 0.01 to 1e+05 mm, found nan mm"),
                (sample("drawings/tumbler.csv"), {"wall_mm": 0.0},
                 "wall_mm: expected from 0.01 to 1000 mm, found 0 mm"),
                (self.file("lump.stl"), {"wall_mm": 5.0},
                 "wall_mm: expected a drawing, found the mesh " + self.file("lump.stl"))]:
            with self.assertRaises(claystack.Error) as refused:
                claystack.import_pot(path, **keywords)
            self.assertEqual(refused.exception.message, message)

    def test_warns_of_the_size_of_an_import_as_the_command_line_does(self):
        # The wall of the bowl leans by atan(80 / 40) = 63 degrees.
        with open(self.file("bowl.csv"), "w", encoding="utf-8") as file:
            file.write("radius_mm,height_mm\n20,0\n100,40\n")
        claystack.export(claystack.stack(2.0, [40.0] * 10, [0.0] * 10), self.file("lump.stl"))
        for name, keywords, options, words in [
                ("bowl.csv", {"wall_mm": 4.0}, ["--wall", "4"], "leans outward by 63 degrees"),
                ("bowl.csv", {"height_mm": 2.0}, ["--height", "2"], "the pot is 2 mm high"),
                ("lump.stl", {"height_mm": 2.0}, ["--height", "2"], "the pot is only 2 mm high")]:
            with self.assertWarns(UserWarning) as warned:
                claystack.import_pot(self.file(name), **keywords)
            self.assertIn(words, str(warned.warning))
            ran = self.run_program("import", self.file(name), "-o", self.file("cli.pot.json"),
                                   *options)
            text = str(warned.warning).replace("height_mm: ", "--height: ")
            self.assertIn(f"claystack: warning: {text}\n", ran.stderr.decode())

    def test_warns_of_doubts_about_an_import(self):
        with open(self.file("cup.svg"), "w", encoding="utf-8") as file:
            file.write("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 9 9'>"
                       "<rect width='200' height='300'/></svg>")
        with self.assertWarns(UserWarning) as warned:
            claystack.import_pot(self.file("cup.svg"))
        self.assertIn("cup.svg: expected a page with a size in mm", str(warned.warning))
        self.assertEqual(warned.filename, __file__)

    def test_warns_of_an_open_mesh_as_the_command_line_does(self):
        whole = claystack.mesh(claystack.stack(2.0, [40.0] * 20, [0.0] * 3 + [34.0] * 17))
        with open(self.file("open.obj"), "w", encoding="utf-8") as file:
            file.writelines(f"v {x} {y} {z}\n" for x, y, z in whole.points)
            file.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in whole.triangles[1:])
        with self.assertWarns(UserWarning) as warned:
            claystack.import_pot(self.file("open.obj"))
        # A missing triangle leaves three edges with one triangle each.
        self.assertIn("open.obj: expected a closed mesh, found 3 open edges", str(warned.warning))
        command = self.run_program("import", self.file("open.obj"), "-o", self.file("open.pot.json"))
        self.assertIn(f"warning: {warned.warning}\n", command.stderr.decode())

    def test_warns_of_a_unit_as_the_command_line_does(self):
        cup = claystack.mesh(claystack.stack(2.0, [40.0] * 20, [0.0] * 3 + [34.0] * 17))
        path = self.file("metres.obj")
        with open(path, "w", encoding="utf-8") as file:
            file.writelines(f"v {x / 1e3} {y / 1e3} {z / 1e3}\n" for x, y, z in cup.points)
            file.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in cup.triangles)
        printed = self.run_program("check", "-q", path).stderr.decode()
        for call in (claystack.read_mesh, claystack.check):
            with self.assertWarns(UserWarning) as warned:
                call(path)
            self.assertTrue(str(warned.warning).startswith(
                f"{path}: only 0.08 x 0.08 x 0.04 mm: meshes are read in millimetres"))
            self.assertEqual(warned.filename, __file__)
            words = str(warned.warning)[len(path) + 2:]
            self.assertIn(words, printed)
        # Too small for a pot: refused, with the same words.
        with self.assertRaises(claystack.Error) as refused:
            claystack.import_pot(path)
        self.assertIn(words, str(refused.exception))

    def test_finds_faults_of_a_mesh(self):
        with open(self.file("open.off"), "w", encoding="utf-8") as file:
            file.write("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        verdict = claystack.check(self.file("open.off"))
        self.assertFalse(verdict.sound)
        self.assertFalse(verdict.closed)
        self.assertFalse(verdict.passes)
        printed = self.verdict_of("check", self.file("open.off"), "-q").stderr.decode()
        for problem in verdict.problems:
            self.assertIn(problem.text, printed)
        self.assertIn(("open edge", True),
                      [(problem.what, problem.fails) for problem in verdict.problems])

    def test_an_export_with_a_thin_wall_is_written_and_does_not_pass(self):
        pot = claystack.stack(2.0, [40.0] * 20, [0.0] * 3 + [37.0] * 17)
        report = claystack.export(pot, self.file("cup.stl"), min_wall_mm=4.0)
        self.assertFalse(report.passes)
        self.assertFalse(hasattr(report, "sound"), "it would be true for a wall that fails")
        self.assertTrue(claystack.check(self.file("cup.stl")).passes)
        (wall,) = report.problems
        self.assertEqual((wall.what, wall.fails), ("walls", True))
        # The facets take up to the tolerance from the wall of 3 mm.
        self.assertRegex(wall.text, r"^thin wall: (2\.9[89]\d|3\.000) mm, expected at least 4\.000 mm")

    def test_checks_limits_as_the_command_line_does(self):
        pot = claystack.stack(2.0, [40.0] * 20, [0.0] * 3 + [37.0] * 17)
        claystack.export(pot, self.file("cup.stl"))
        for keywords, options, passes in [
                ({}, [], True),
                ({"min_wall_mm": 2.5}, ["--min-wall", "2.5"], True),
                ({"min_wall_mm": 4}, ["--min-wall", "4"], False),
                ({"process": "fdm"}, ["--process", "fdm"], True),
                ({"process": "stoneware"}, ["--process", "stoneware"], True),  # it asks for 3 mm
                ({"process": "fdm", "min_wall_mm": 4.0},
                 ["--process", "fdm", "--min-wall", "4"], False)]:
            ran = self.verdict_of("check", self.file("cup.stl"), "--json", *options)
            expected = json.loads(ran.stdout)
            self.assertEqual(expected["passes"], passes, options)
            wall = expected.get("wall_sampled", {}).get("least_mm")
            texts = [check["text"].replace("--min-wall", "requested minimum wall")
                     for check in expected["checks"] if check["verdict"] != "pass"]
            for what in (self.file("cup.stl"), claystack.read_mesh(self.file("cup.stl"))):
                verdict = claystack.check(what, **keywords)
                self.assertEqual(verdict.passes, passes, options)
                self.assertTrue(verdict.sound)
                self.assertEqual(verdict.sampled_wall_mm, wall)
                self.assertEqual([problem.text for problem in verdict.problems], texts)

    def test_refuses_limits_of_a_check_out_of_range(self):
        mesh = claystack.mesh(claystack.stack(2.0, [40.0] * 10, [30.0] * 10))
        for keywords, message in [
                ({"min_wall_mm": 0.0}, "minimum wall: expected 1e-06 to 10000 mm, found 0 mm"),
                ({"process": "clay"}, "process: expected ")]:
            with self.assertRaises(claystack.Error) as refused:
                claystack.check(mesh, **keywords)
            self.assertTrue(refused.exception.message.startswith(message), refused.exception.message)

    def test_refuses_settings_out_of_range_by_name(self):
        pot = claystack.stack(2.0, [40.0] * 10, [30.0] * 10)
        for setting, message in [
                ({"tolerance_mm": float("nan")}, "tolerance: expected 1e-05 to 10 mm, found nan mm"),
                ({"smooth_length_mm": -1.0}, "smooth length: expected 0 to 10000 mm, found -1 mm"),
                ({"min_wall_mm": float("inf")},
                 "minimum wall: expected 1e-06 to 10000 mm, found inf mm"),
                ({"shrinkage": 0.75}, "shrinkage: expected 0 to 0.5, found 0.75")]:
            with self.assertRaises(claystack.Error) as refused:
                claystack.export(pot, [self.file("refused.stl")], **setting)
            self.assertEqual(refused.exception.message, message)
            self.assertEqual(refused.exception.code, 2)
            self.assertFalse(os.path.exists(self.file("refused.stl")))

    def test_takes_one_file_or_several(self):
        pot = claystack.stack(2.0, [40.0] * 10, [30.0] * 10)
        folder = pathlib.Path(self.file("one"))
        folder.mkdir()
        self.assertEqual(len(claystack.export(pot, str(folder / "cup.stl")).files), 1)
        self.assertEqual(len(claystack.export(pot, folder / "cup.obj").files), 1)
        self.assertEqual(sorted(os.listdir(folder)), ["cup.obj", "cup.stl"])

    def test_takes_names_that_are_not_unicode(self):
        name = os.fsdecode(os.fsencode(self.file("cup")) + b"-\xff")
        pot = claystack.stack(2.0, [40.0] * 10, [30.0] * 10)
        pot.write(name + ".pot.json")
        self.assertEqual(claystack.read_pot(name + ".pot.json"), pot)
        report = claystack.export(pot, [name + ".stl"])
        self.assertEqual(report.files[0].path, name + ".stl")
        self.assertTrue(claystack.check(name + ".stl").sound)
        with self.assertRaises(claystack.Error) as absent:
            claystack.read_pot(name + ".absent.pot.json")
        self.assertEqual(absent.exception.file, name + ".absent.pot.json")

    def test_takes_a_process_as_a_path(self):
        pot = claystack.stack(2.0, [40.0] * 10, [30.0] * 10)
        with self.assertRaises(claystack.Error) as absent:
            claystack.export(pot, self.file("cup.stl"),
                             process=pathlib.Path(self.file("absent.process.json")))
        self.assertEqual(absent.exception.file, self.file("absent.process.json"))

    def test_an_error_goes_from_process_to_process(self):
        with self.assertRaises(claystack.Error) as absent:
            claystack.read_pot(self.file("absent.pot.json"))
        copy = pickle.loads(pickle.dumps(absent.exception))
        self.assertEqual(str(copy), absent.exception.message)
        self.assertEqual((copy.kind, copy.code, copy.file), ("io", 3, self.file("absent.pot.json")))

    def test_a_colon_in_a_name_is_part_of_it(self):
        with open(self.file("a: b.off"), "w", encoding="utf-8") as file:
            file.write("OFF\n3 1 0\n0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n")
        with self.assertRaises(claystack.Error) as bad:
            claystack.check(self.file("a: b.off"))
        self.assertEqual((bad.exception.file, bad.exception.place), (self.file("a: b.off"), "5"))

    def test_errors_have_file_place_and_code(self):
        with self.assertRaises(claystack.Error) as absent:
            claystack.read_pot(self.file("absent.pot.json"))
        self.assertEqual((absent.exception.kind, absent.exception.code), ("io", 3))
        with open(self.file("bad.off"), "w", encoding="utf-8") as file:
            file.write("OFF\n3 1 0\n0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n")
        with self.assertRaises(claystack.Error) as bad:
            claystack.check(self.file("bad.off"))
        self.assertEqual(bad.exception.code, 2)
        self.assertEqual(bad.exception.file, self.file("bad.off"))
        self.assertEqual(bad.exception.place, "5")
        pot = claystack.stack(2.0, [40.0], [30.0])
        for wrong in (lambda: claystack.export(pot, [self.file("a.xyz")]),
                      lambda: claystack.mesh(pot, smoothing="soft"),
                      lambda: claystack.stack(2.0, [30.0], [40.0]),
                      lambda: claystack.stack(2.0, [float("nan")], [0.0]),
                      lambda: pot.write(self.file("pot.stl"))):
            with self.assertRaises(claystack.Error) as refused:
                wrong()
            self.assertEqual(refused.exception.code, 2)
        with self.assertRaises(claystack.Error) as full:
            pot.write("/proc/no/pot.json.pot.json")
        self.assertEqual(full.exception.code, 3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
