"""heightcast render relief: pictures of relief, what is refused, files that are not left behind."""

import math
import os
import signal
import struct
import subprocess
import time

from picture import read_picture
from program import BAD_FILE, ELEVATIONS, INPUT_OUTPUT, MEMORY, PROGRAM, USAGE, Case, main

BODIES = ["plane", "cylinder", "sphere", "torus"]
METHODS = ["fast", "safe", "maxmip", "qdm", "parallax", "linear", "relief", "occlusion",
           "cone-fixed", "cone-loop", "cone-exact", "relaxed", "robust", "quick", "pdm"]
SMALL = ["--size", "32x24", "--samples", "1", "--overwrite"]


class Render(Case):
    def render(self, *arguments, field=None, out="a.png", **options):
        return self.json("render", "relief", field or self.hills(), "--out", out, *SMALL,
                         *arguments, **options)

    def picture(self, *arguments, **options):
        self.render(*arguments, **options)
        return read_picture(self.path("a.png").read_bytes())

    def test_defaults_draw_a_picture(self):
        figures = self.json("render", "relief", ELEVATIONS, "--out", "a.png", "--size", "96x64")
        width, height, rows = read_picture(self.path("a.png").read_bytes())
        self.assertEqual((width, height), (96, 64))
        self.assertEqual((figures["method"], figures["object"], figures["view"]),
                         ("safe", "plane", "shaded"))
        self.assertEqual(figures["rays"], 4 * 96 * 64)
        self.assertGreater(figures["hits"], 0.3 * figures["rays"])
        self.assertLess(figures["hits"], 0.9 * figures["rays"])
        bright = [max(row[i : i + 3]) for row in rows for i in range(0, len(row), 3)]
        self.assertGreater(max(bright), 180)
        self.assertLess(min(bright), 70)

    def test_bodies_and_methods(self):
        self.hills()
        for body in BODIES:
            for method in METHODS:
                with self.subTest(body=body, method=method):
                    figures = self.render("--object", body, "--method", method)
                    self.assertGreater(figures["hits"], 50)
                    self.assertEqual((figures["object"], figures["method"]), (body, method))

    def test_views_differ(self):
        views = ["shaded", "height", "normal", "depth", "steps", "unconverged", "missed", "error"]
        seen = {}
        for view in views:
            seen[view] = self.picture("--view", view, "--method", "cone-fixed", "--steps", "3")
        for view in views:
            for other in views:
                if view < other:
                    self.assertNotEqual(seen[view], seen[other], f"{view} {other}")

    def test_safe_loses_nothing_and_few_steps_do(self):
        for body in BODIES:
            truth = self.render("--view", "missed", "--object", body)
            self.assertEqual((truth["lost"], truth["made_up"]), (0, 0))
        few = self.render("--view", "missed", "--method", "linear", "--steps", "2")
        self.assertGreater(few["lost"], 0)

    def test_same_bytes_for_every_number_of_threads(self):
        self.assertEqual(self.picture("-j", "1"), self.picture("-j", "3"))

    def test_refinements(self):
        pictures = [self.picture("--method", "relief", "--steps", "6", "--refine", how,
                                 "--view", "height") for how in ["none", "secant", "binary"]]
        self.assertNotEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[1], pictures[2])
        one = self.picture("--method", "relief", "--steps", "6", "--refinements", "1", "--view",
                           "height")
        self.assertNotEqual(one, pictures[2])

    def test_scene_options_change_the_picture(self):
        plain = self.picture()
        for option in [["--depth", "0.4"], ["--repeat", "3"], ["--repeat", "2,1"],
                       ["--aspect", "0.5"],
                       ["--fade", "1:5"],
                       ["--camera", "0,-3,3"], ["--ortho", "3"], ["--fov", "60"],
                       ["--light", "1,0,0.2"], ["--lamp", "0,0,1"], ["--shadows", "off"],
                       ["--colour", "0.1,0.5,0.1"], ["--at", "0.5,0,0", "--camera", "0,-3,3"]]:
            with self.subTest(option=option):
                if option == ["--shadows", "off"]:
                    low = ["--light", "1,0,0.3"]
                    self.assertNotEqual(self.picture(*low), self.picture(*low, *option))
                else:
                    self.assertNotEqual(plain, self.picture(*option))

    def test_edges(self):
        flat = ["--camera", "0,-4,0.05"]
        polygon = self.render(*flat, "--edge", "discard")
        self.assertGreater(self.render(*flat)["hits"], polygon["hits"])
        low = ["--camera", "0,-2.4,1", "--depth", "0.5"]
        dropped = self.render(*low, "--edge", "discard")
        self.assertGreater(self.render(*low, "--edge", "clamp")["hits"], dropped["hits"])

    def test_fewer_steps_far_away(self):
        linear = ["--method", "linear", "--steps", "24"]
        plain = self.render(*linear)
        fewer = self.render(*linear, "--lod", "1:2")
        fewest = self.render(*linear, "--lod", "1:2", "--lod-steps", "1")
        self.assertGreater(plain["mean_steps"], 3 * fewer["mean_steps"])
        self.assertGreater(fewer["mean_steps"], 1.2)
        self.assertEqual(fewest["mean_steps"], 1)

    def test_albedo(self):
        self.path("red.ppm").write_bytes(b"P6\n1 1\n255\n" + bytes([200, 0, 0]))
        self.write_pgm("grey.pgm", [[128]])
        _, _, rows = self.picture("--albedo", "red.ppm")
        middle = rows[12][3 * 16 : 3 * 16 + 3]
        self.assertGreater(middle[0], middle[1] + 40)
        _, _, rows = self.picture("--albedo", "grey.pgm")
        middle = rows[12][3 * 16 : 3 * 16 + 3]
        self.assertLess(max(middle) - min(middle), 3)
        self.refused("render", "relief", self.hills(), "--out", "b.png", "--albedo", "no.png",
                     code=INPUT_OUTPUT, says="no.png")

    def test_maps_are_drawn_with_their_own_cones(self):
        self.hills()
        self.run_program("bake", "hills.pgm", "map.exr", "--cones", "l1", "--range", "data")
        figures = self.render(field="map.exr")
        self.assertNotIn("bake", figures["seconds"])
        self.assertGreater(figures["hits"], 100)
        self.refused("render", "relief", "map.exr", "--out", "b.png", "--object", "torus",
                     code=USAGE, says=["field.wrap is none", "torus"])

    def test_float_outputs(self):
        self.render("--depth-out", "depth.npy", "--camera", "0,0,3", "--ortho", "4", out="a.exr")
        self.assertEqual(self.path("a.exr").read_bytes()[:4], struct.pack("<I", 20000630))
        shape, depths = self.read_npy("depth.npy")
        self.assertEqual(shape, (24, 32))
        self.assertTrue(math.isinf(depths[0]))
        self.assertTrue(3 <= depths[12 * 32 + 16] <= 3.16 + 1e-5)

    def test_without_opengl_the_cpu_draws(self):
        self.hills()
        on_cpu = self.picture()
        for variable, value in [("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere.json"),
                                ("MESA_GL_VERSION_OVERRIDE", "3.3")]:
            with self.subTest(variable=variable):
                figures = self.render("--backend", "gl", env={**os.environ, variable: value})
                if figures["backend"] == "gl":
                    self.skipTest("this driver does not listen")
                self.assertIn("OpenGL", figures["warnings"][0])
                self.assertIn("the CPU draws", figures["warnings"][0])
                self.assertEqual(read_picture(self.path("a.png").read_bytes()), on_cpu)

    def test_opengl_draws_the_same(self):
        on_cpu = self.picture("--view", "height")
        figures = self.render("--view", "height", "--backend", "gl")
        if figures["backend"] == "cpu":
            self.skipTest(figures["warnings"][0])
        self.assertGreater(figures["mean_fetches"], figures["mean_steps"])
        on_gl = read_picture(self.path("a.png").read_bytes())
        odd = sum(abs(a - b) > 2 for p, q in zip(on_cpu[2], on_gl[2]) for a, b in zip(p, q))
        self.assertLessEqual(odd, 3)

    def test_what_makes_no_sense(self):
        field = self.hills()
        for arguments, says in [
            (["relief", field], "needs --out"),
            (["relied", field, "--out", "b.png"], "'relied'; relief"),
            (["relief", field, "--out", "b.jpg"], ".png, .exr"),
            (["relief", field, "--out", "b.png", "--depth-out", "d.png"], ".exr, .pfm, .npy"),
            (["relief", field, "--out", "b.png", "--lamp", "0,0,1", "--light", "0,0,1"], "exclude"),
            (["relief", field, "--out", "b.png", "--light", "0,0,0"], "no direction"),
            (["relief", field, "--out", "b.png", "--ortho", "1e30"], "up to 1e6"),
            (["relief", field, "--out", "b.png", "--colour", "0,2,0"], "2 is not from 0 to 1"),
            (["relief", field, "--out", "b.png", "--colour", "0,1,0", "--albedo", field],
             "exclude"),
            (["relief", field, "--out", "b.png", "--refine", "none", "--refinements", "3"],
             "--refine none"),
            (["relief", field, "--out", "b.png", "--cones", "l2"], "l1 or quad"),
            (["relief", field, "--out", "b.png", "--lod", "1:2"], "nothing with --method safe"),
            (["relief", field, "--out", "b.png", "--lod-steps", "2"], "--lod-steps needs --lod"),
            (["relief", field, "--out", "b.png", "--method", "linear", "--lod", "1:2",
              "--lod-steps", "40"], "relief.lod_steps is 40"),
            (["relief", field, "--out", "b.png", "--object", "torus", "--depth", "0.5"],
             "relief.depth is 0.5"),
            (["relief", field, "--out", "b.png", "--repeat", "2", "--wrap", "none"],
             "wraps along u"),
            (["relief", field, "--out", "b.png", "--method", "reference"], "allowed are fast"),
            (["relief", field, "--out", "b.png", "--samples", "0"], "1 to 256"),
            (["relief", field, "--out", "b.png", "--size", "65537"], "65536"),
        ]:
            with self.subTest(says=says):
                self.refused("render", *arguments, code=USAGE, says=says)
        self.refused("render", "relief", "none.pgm", "--out", "b.png", code=INPUT_OUTPUT,
                     says="none")
        self.path("bad.pgm").write_bytes(b"P5 3")
        self.refused("render", "relief", "bad.pgm", "--out", "b.png", code=BAD_FILE, says="bad.pgm")
        self.path("a.png").write_bytes(b"precious")
        self.refused("render", "relief", field, "--out", "a.png", code=INPUT_OUTPUT,
                     says="--overwrite")
        self.assertEqual(self.path("a.png").read_bytes(), b"precious")
        self.assertEqual(self.files(), ["a.png", "bad.pgm", "hills.pgm"])

    def test_fields_that_are_too_large_for_opengl(self):
        figures = self.render("--backend", "gl")
        if figures["backend"] == "cpu":
            self.skipTest(figures["warnings"][0])
        self.write_pgm("wide.pgm", [[i % 256 for i in range(65536)]])
        self.refused("render", "relief", "wide.pgm", "--out", "b.png", "--backend", "gl",
                     "--size", "32x24", code=MEMORY,
                     says=["field of 65536 x 1: textures of this driver have at most", "use cpu"])
        self.assertFalse(self.path("b.png").exists())
        figures = self.render("--backend", "auto", field="wide.pgm")
        self.assertEqual(figures["backend"], "cpu")
        self.assertIn("; the CPU draws", figures["warnings"][0])

    def test_ctrl_c(self):
        """A picture that takes far longer than anyone waits here."""
        self.hills()
        self.path("a.png").write_bytes(b"precious")
        for backend in ["cpu", "gl"]:
            running = subprocess.Popen(
                [PROGRAM, "render", "relief", "hills.pgm", "--out", "a.png", "--overwrite",
                 "--backend", backend, "--size", "4000x3000", "--samples", "64",
                 "--depth-out", "d.npy"],
                cwd=self.folder, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
            self.wait_until_it_catches(running, signal.SIGINT)
            time.sleep(0.3)  # until it draws
            running.send_signal(signal.SIGINT)
            _, error = running.communicate(timeout=60)
            self.assertEqual(running.returncode, 130, error)
            self.assertIn(b"signal", error)
            self.assertEqual(self.path("a.png").read_bytes(), b"precious")
            self.assertEqual(self.files(), ["a.png", "hills.pgm"])

    def test_odd_sizes(self):
        for size in ["1x1", "1x300", "301x1"]:
            for backend in ["cpu", "gl"]:
                figures = self.render("--size", size, "--backend", backend)
                width, height, _ = read_picture(self.path("a.png").read_bytes())
                self.assertEqual(f"{width}x{height}", size)
                self.assertEqual(figures["rays"], width * height)
        for columns, rows in [(1, 1), (1, 7), (9, 1)]:
            self.write_pgm("odd.pgm", [[(x * 5 + y * 3) % 8 * 30 for x in range(columns)]
                                       for y in range(rows)])
            for body in ["plane", "torus"]:
                truths = [self.render("--object", body, "--view", "missed", "--aspect", "1",
                                      "--backend", backend, field="odd.pgm")
                          for backend in ["cpu", "gl"]]
                for truth in truths:
                    self.assertEqual((truth["lost"], truth["made_up"]), (0, 0))
                self.assertGreater(truths[0]["hits"], 200)
                self.assertLessEqual(abs(truths[0]["hits"] - truths[1]["hits"]), 1)

    def test_too_large(self):
        self.refused("render", "relief", self.hills(), "--out", "b.png", "--size", "32768x16384",
                     code=MEMORY, says="pixels")


if __name__ == "__main__":
    main()
