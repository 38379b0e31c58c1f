"""heightcast render terrain: pictures of landscapes, frames, paths, what is refused."""

import os
import pathlib
import signal
import struct
import subprocess
import time
import zlib

from picture import read_picture
from program import BAD_FILE, ELEVATIONS, INPUT_OUTPUT, PROGRAM, USAGE, Case, main

SMALL = ["--size", "48x27", "--samples", "1"]
METHODS = ["fast", "safe", "maxmip", "qdm", "parallax", "linear", "relief", "occlusion",
           "cone-fixed", "cone-loop", "cone-exact", "relaxed", "robust", "quick", "pdm"]


class Terrain(Case):
    def render(self, *arguments, field=None, out="a.png", **options):
        return self.json("render", "terrain", field or self.hills(), "--out", out, *SMALL,
                         "--overwrite", *arguments, **options)

    def picture(self, *arguments, **options):
        self.render(*arguments, **options)
        return read_picture(self.path("a.png").read_bytes())

    def refuse(self, *arguments, code=USAGE, says=""):
        self.hills()
        self.refused("render", "terrain", "hills.pgm", "-q", *arguments, code=code, says=says)

    def test_defaults_draw_a_picture(self):
        figures = self.json("render", "terrain", ELEVATIONS, "--out", "a.png", "--size", "96x54")
        width, height, rows = read_picture(self.path("a.png").read_bytes())
        self.assertEqual((width, height), (96, 54))
        self.assertEqual((figures["method"], figures["view"], figures["backend"]),
                         ("fast", "shaded", "cpu"))
        self.assertEqual((figures["low"], figures["high"]), (236, 1076))
        self.assertEqual(figures["rays"], 4 * 96 * 54)
        self.assertGreater(figures["hits"], 0.3 * figures["rays"])
        self.assertLess(figures["hits"], 0.95 * figures["rays"])
        self.assertIn("--spacing", figures["warnings"][0])
        sky, ground = rows[2][3 * 48 : 3 * 48 + 3], rows[50][3 * 48 : 3 * 48 + 3]
        self.assertGreater(sky[2], sky[0])
        self.assertGreater(ground[1], ground[2])

    def test_options_may_stand_anywhere_behind_terrain(self):
        self.hills()
        self.json("render", "terrain", *SMALL, "--out", "b.png", "hills.pgm")
        self.assertIn("b.png", self.files())
        self.refused("render", "--out", "c.png", "terrain", "hills.pgm", code=USAGE,
                     says="right behind render")

    def test_methods(self):
        for method in METHODS:
            with self.subTest(method=method):
                figures = self.render("--method", method, "--view", "missed", "--steps", "256")
                self.assertEqual(figures["method"], method)
                self.assertGreater(figures["hits"], 100)
                if method in ["fast", "safe", "maxmip"]:
                    self.assertEqual((figures["lost"], figures["made_up"]), (0, 0))

    def test_maps_bring_their_ratios(self):
        self.hills()
        self.run_program("bake", "hills.pgm", "quad.exr", "--cones", "quad", "--range", "data")
        figures = self.render("--method", "safe", "--heights", "hills.pgm", field="quad.exr")
        self.assertNotIn("bake", figures["seconds"])
        self.assertGreater(figures["hits"], 100)

    def test_views_differ(self):
        seen = {}
        for view in ["shaded", "height", "normal", "depth", "crossings", "missed"]:
            seen[view] = self.picture("--view", view)
        self.assertEqual(len({str(picture) for picture in seen.values()}), len(seen))

    def test_shares_of_crossings(self):
        figures = self.render("--view", "crossings", "--method", "maxmip", field=ELEVATIONS)
        shares = [figures[f"share_up_to_{few}"] for few in [16, 35, 85]]
        self.assertEqual(shares, sorted(shares))
        self.assertGreater(shares[0], 0.5)
        self.assertLessEqual(shares[2], 1)

    def test_scene_options_change_the_picture(self):
        plain = self.picture("--spacing", "20")
        for option in [["--exaggeration", "2"], ["--elevation", "0:90"], ["--spacing", "20,30"],
                       ["--colours", "elevation"], ["--colours", "slope"], ["--colours", "plain"],
                       ["--blocky"], ["--light", "1,0,0.2"], ["--shadows", "off"],
                       ["--shadow-map", "40"], ["--haze", "50"], ["--tour", "walk"],
                       ["--tour", "up"], ["--tour", "orbit"],
                       ["--moment", "0.3"], ["--above", "400"], ["--fov", "40"],
                       ["--surface", "steps"], ["--at", "0,0,0"], ["--eye", "5,-400,300"],
                       ["--samples", "3"], ["--invert"], ["--range", "0:500"]]:
            with self.subTest(option=option):
                self.assertNotEqual(plain, self.picture("--spacing", "20", *option))
        self.assertNotEqual(self.picture("--tour", "orbit", "--at", "0,0,999", "--open-sides"),
                            self.picture("--tour", "orbit", "--at", "0,0,999"))

    def test_offset_moves_the_world(self):
        here = self.picture("--spacing", "20", "--eye", "5,-600,300", "--at", "200,-100,0")
        there = self.picture("--spacing", "20", "--offset", "1000,512,256", "--eye", "1005,-88,556",
                             "--at", "1200,412,256")
        self.assertEqual(here, there)

    def test_same_bytes_for_every_number_of_threads(self):
        self.assertEqual(self.picture("-j", "1"), self.picture("-j", "3"))

    def test_an_image_on_the_ground(self):
        self.run_program("gen", "cobbles", "grey.png", "--size", "32x32", "--bits", "8")
        self.assertNotEqual(self.picture("--albedo", "grey.png"), self.picture())

    def test_depths(self):
        self.render("--depth-out", "d.npy", "--tour", "walk")
        (shape, values) = self.read_npy("d.npy")
        self.assertEqual(shape, (27, 48))
        self.assertEqual(values[24], float("inf"))
        self.assertLess(min(values), 1e4)
        self.assertGreater(min(values), 0)

    def test_exr(self):
        self.render(out="a.exr")
        self.assertEqual(self.path("a.exr").read_bytes()[:4], struct.pack("<I", 20000630))

    def test_frames_are_numbered(self):
        figures = self.render("--frames", "3", "--depth-out", "d.pfm", out="fly.png")
        self.assertEqual(figures["frames"], 3)
        self.assertEqual(figures["rays"], 3 * 48 * 27)
        names = [f"fly_000{i}.png" for i in range(3)]
        self.assertEqual([n for n in self.files() if n.startswith("fly")], names)
        self.assertIn("d_0002.pfm", self.files())
        self.assertNotEqual(*[self.path(n).read_bytes() for n in names[:2]])
        self.picture("--moment", str(1 / 3))
        self.assertEqual(self.path("a.png").read_bytes(), self.path(names[1]).read_bytes())

    def test_existing_frames_are_refused_before_work_begins(self):
        self.path("fly_0002.png").write_text("mine")
        self.refuse("--frames", "3", "--out", "fly.png", code=INPUT_OUTPUT,
                    says=["fly_0002.png", "--overwrite"])
        self.assertNotIn("fly_0000.png", self.files())

    def test_paths(self):
        self.path("way.txt").write_text("# eye, target, angle\n\n50 -300 400  200 -100 0\n"
                                        "80,-300,420, 200,-100,0, 40 # closer\n")
        self.render("--spacing", "20", "--path", "way.txt", "--frames", "2", out="way.png")
        self.picture("--spacing", "20", "--eye", "50,-300,400", "--at", "200,-100,0")
        self.assertEqual(self.path("a.png").read_bytes(), self.path("way_0000.png").read_bytes())
        self.picture("--spacing", "20", "--eye", "80,-300,420", "--at", "200,-100,0", "--fov", "40")
        self.assertEqual(self.path("a.png").read_bytes(), self.path("way_0001.png").read_bytes())

    def test_bad_paths(self):
        for text, says in [("1 2 3 4 5 6\n1 2 3 nan 5 6\n", "line 2"), ("1 2 3 4 5\n", "line 1"),
                           ("1 2 3 4 5 6 7 8\n", "line 1"), ("1 2 3 1 2 3\n", "must differ"),
                           ("1 2 3 4 5 6 171\n", "170"), ("# nothing\n", "no camera"),
                           ("1 2 3 4 5 inf\n", "line 1"), ("one\n", "line 1"),
                           ("1 2 3 4 5 6" + 5000 * " " + "\n", "line 1")]:
            with self.subTest(text=text[:30]):
                self.path("way.txt").write_text(text)
                self.refuse("--out", "a.png", "--path", "way.txt", code=BAD_FILE,
                            says=["way.txt", says])
        self.refuse("--out", "a.png", "--path", "none.txt", code=INPUT_OUTPUT, says="none.txt")
        self.assertNotIn("a.png", self.files())

    def cut(self, name, columns, rows, shared):
        """Cut the real elevations into tiles; their names, row by row."""
        data = pathlib.Path(ELEVATIONS).read_bytes()
        side, first = 96, len(data) - 2 * 403 * 344
        field = [struct.unpack_from(f">{side + 1}H", data, first + 2 * 403 * y)
                 for y in range(side + 1)]
        names, wide, high = [], side // columns, side // rows
        for row in range(rows):
            for column in range(columns):
                lines = [line[column * wide : (column + 1) * wide + shared]
                         for line in field[row * high : (row + 1) * high + shared]]
                names.append(self.write_pgm(f"{name}{row}{column}.pgm", lines, 65535))
        return names

    def test_tiles_have_no_seams(self):
        for shared in [1, 0]:
            whole, tiles = self.cut("w", 1, 1, shared), self.cut("t", 4, 4, shared)
            for drawn in ["--backend", "gl"], ["--view", "shaded"], ["--view", "depth"]:
                one = self.picture("--range", "0:2000", *drawn, field=whole[0])
                many = self.picture("--range", "0:2000", *drawn, *tiles[1:], field=tiles[0])
                self.assertEqual(one, many)
            self.assertEqual(one, self.picture("--range", "0:2000", "--view", "depth", "--tiles",
                                               "4x4", "--seams", ["apart", "shared"][shared],
                                               *tiles[1:], field=tiles[0]))

    def test_tiles_may_have_ranges_of_their_own(self):
        tiles = self.cut("t", 2, 3, 1)
        figures = self.render("--tiles", "2x3", "--view", "missed", *tiles[1:], field=tiles[0])
        whole = self.render("--view", "missed", field=self.cut("w", 1, 1, 1)[0])
        for key in ["low", "high", "spacing_x", "hits", "lost", "made_up"]:
            self.assertEqual(figures[key], whole[key], key)
        self.assertEqual(figures["tiles"], 6)

    def test_polygons(self):
        self.refuse("--out", "a.png", "--polygons", "full", code=BAD_FILE, says="only gl")
        figures = self.render("--backend", "gl", "--method", "maxmip")
        if figures["backend"] != "gl":
            self.skipTest("no OpenGL here")
        rays = figures["hits"]
        for polygons in ["full", "lod"]:
            figures = self.render("--backend", "gl", "--method", "maxmip", "--polygons", polygons)
            self.assertAlmostEqual(figures["hits"], rays, delta=0.02 * rays)
            self.assertEqual(figures["mean_fetches"], 0)
        self.refuse("--out", "b.png", "--polygons", "lod", "--backend", "gl", "--detail",
                    ELEVATIONS, code=BAD_FILE, says="too coarse")

    def write_texels(self, name, width, height, texels):
        """Of 8 bits; channels by their number."""
        channels = len(texels) // (width * height)
        rows = b"".join(b"\0" + bytes(texels[channels * width * y:channels * width * (y + 1)])
                        for y in range(height))
        kind = {1: 0, 3: 2, 4: 6}[channels]
        chunks = b""
        for tag, body in [(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0)),
                          (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]:
            chunks += (struct.pack(">I", len(body)) + tag + body
                       + struct.pack(">I", zlib.crc32(tag + body)))
        self.path(name).write_bytes(b"\x89PNG\r\n\x1a\n" + chunks)

    def details(self):
        """A map, its colours, and a mask for the hills whose first channel is 0 in the west."""
        self.write_texels("d.png", 4, 4, [60 * (i % 5) for i in range(16)])
        self.write_texels("c.png", 4, 4, [16 * (i % 11) for i in range(48)])
        self.write_texels("m.png", 24, 17,
                          [value for i in range(24 * 17) for value in (0 if i % 24 < 12 else 255,
                                                                       200, 0, 0)])

    def test_details(self):
        self.details()
        base = ["--spacing", "20", "--eye", "60,-300,300", "--at", "240,-60,0"]
        pictures = [self.picture(*base, *more) for more in [
            [],
            ["--detail", "d.png,100,20"],
            ["--detail", "d.png,c.png,100,20"],
            ["--detail", "d.png,100,20", "--detail", "d.png,c.png,33", "--mask", "m.png"],
            ["--detail", "d.png,100,20", "--detail-method", "steps", "--detail-steps", "3"],
            ["--detail", "d.png,c.png"],
            ["--detail", "d.png,100,20", "--surface", "steps"],
        ]]
        for i, one in enumerate(pictures):
            for other in pictures[i + 1:]:
                self.assertNotEqual(one, other)
        faded = self.picture(*base, "--detail", "d.png,100,20", "--detail-fade", "0:0.001")
        self.assertEqual(faded, pictures[0])
        figures = self.render(*base, "--detail", "d.png,100,20", "--view", "missed")
        self.assertEqual((figures["lost"], figures["made_up"]), (0, 0))

    def test_bad_details(self):
        self.details()
        self.write_texels("small.png", 23, 17, [0] * (23 * 17 * 4))
        self.write_texels("rgb.png", 24, 17, [0] * (24 * 17 * 3))
        out = ["--out", "a.png", "--spacing", "20"]
        four = ["--detail", "d.png"] * 4
        for arguments, code, says in [
            (["--mask", "m.png"], USAGE, "--mask needs --detail"),
            (["--detail", "d.png", "--detail-steps", "4"], USAGE, "--detail-method steps"),
            (["--detail", "d.png,-3"], INPUT_OUTPUT, "-3"),
            (["--detail", "d.png,c.png,x"], USAGE, "TILE"),
            (["--detail", "d.png,1,2,3"], USAGE, "TILE"),
            (["--detail", ",d.png"], USAGE, "MAP"),
            (four + ["--detail", "d.png"], USAGE, "up to 4 times"),
            (["--detail", "d.png", "--detail-fade", "9:3"], USAGE, "NEAR:FAR"),
            (["--detail", "d.png,m.png"], BAD_FILE,
             "m.png is 24 x 17 and its heights, d.png, 4 x 4"),
            (["--detail", "d.png", "--mask", "small.png"], BAD_FILE,
             "small.png is 23 x 17; the terrain has 24 x 17 samples"),
            (four + ["--mask", "rgb.png"], BAD_FILE, "rgb.png has 3 channels; 4 details"),
            (["--detail", "none.png"], INPUT_OUTPUT, "none.png"),
        ]:
            with self.subTest(arguments=arguments):
                self.refuse(*out, *arguments, code=code, says=says)

    def test_tiles_that_do_not_fit(self):
        tiles = self.cut("t", 2, 2, 0)
        out = ["--out", "a.png"]
        self.refused("render", "terrain", *tiles[:3], *out, code=USAGE, says="--tiles CxR")
        self.refused("render", "terrain", *tiles, "--tiles", "3x1", *out, code=USAGE,
                     says="3 files")
        self.refused("render", "terrain", *tiles, "--seams", "shared", *out, code=BAD_FILE,
                     says=["should share an edge", "east"])
        self.hills()
        self.refused("render", "terrain", *tiles[:3], "hills.pgm", *out, code=USAGE,
                     says="tile [1, 1] is 24 x 17")

    def test_gl_draws_the_same_or_says_why_not(self):
        cpu = self.picture("--method", "maxmip", field=ELEVATIONS)
        figures = self.render("--backend", "gl", field=ELEVATIONS)
        if figures["backend"] == "gl":
            self.assertEqual(figures["method"], "fast")
            self.assertGreater(figures["mean_fetches"], figures["mean_crossings"])
        else:
            self.assertIn("the CPU draws", figures["warnings"][-1])
        gl = read_picture(self.path("a.png").read_bytes())
        odd = sum(abs(a - b) > 2 for x, y in zip(cpu[2], gl[2]) for a, b in zip(x, y))
        self.assertLess(odd, 12)

    def test_objects(self):
        self.path("things").mkdir()
        self.path("things/roof.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n")
        self.path("things/all.txt").write_text("# what stands here\nball 200 -150 ground+20 60\n"
                                               "roof.obj 240,-150,400,80 45\n"
                                               "house 100 -150 ground 60 10 0.1 0.2 0.9\n")
        plain = self.picture("--spacing", "20", "--tour", "orbit")
        with_all = self.picture("--spacing", "20", "--tour", "orbit", "--objects", "things/all.txt")
        self.assertNotEqual(plain, with_all)
        blue = [row[i : i + 3] for row in with_all[2] for i in range(0, len(row), 3)
                if row[i + 2] > row[i] + 60 and row[i + 2] > row[i + 1] + 40]
        self.assertGreater(len(blue), 0)

    def test_bad_objects(self):
        for text, says in [("ball 1 2 3\n", "line 1"), ("\nball 1 2 3 0\n", "line 2"),
                           ("ball 1 2 grund 4\n", "line 1"), ("ball 1 2 ground+x 4\n", "line 1"),
                           ("ball 1 2 3 4 5 6\n", "line 1"), ("ball 1 2 3 4 5 0 0 2\n", "line 1"),
                           ("ball nan 2 3 4\n", "line 1"), ("ball 1 2 3 4 5 0 0 1 1\n", "line 1")]:
            with self.subTest(text=text):
                self.path("all.txt").write_text(text)
                self.refuse("--out", "a.png", "--objects", "all.txt", code=BAD_FILE,
                            says=["all.txt", says])
        for text in [b"ball 1 2 3 4\n\0\0", b"ball 1 2 3 4\0\n",
                     "ball 1 2 3 4".encode("utf-16-be")]:
            self.path("all.txt").write_bytes(text)
            self.refuse("--out", "a.png", "--objects", "all.txt", code=BAD_FILE,
                        says=["all.txt, line", "save it as text"])
        self.path("all.txt").write_text("ball 1 2 3 4" + 5000 * " " + "\n")
        self.refuse("--out", "a.png", "--objects", "all.txt", code=BAD_FILE,
                    says=["all.txt, line 1", "4095"])
        self.path("all.txt").write_text("ball 1 2 3 1e10\n")
        self.refuse("--out", "a.png", "--objects", "all.txt", code=USAGE, says="1e+09")
        self.path("bad.obj").write_text("v 0 0 0\nf 1 2 3\n")
        self.path("all.txt").write_text("bad.obj 1 2 3 4\n")
        self.refuse("--out", "a.png", "--objects", "all.txt", code=BAD_FILE,
                    says=["bad.obj", "line 2"])
        self.path("all.txt").write_text("none.obj 1 2 3 4\n")
        self.refuse("--out", "a.png", "--objects", "all.txt", code=INPUT_OUTPUT,
                    says=["all.txt, line 1: none.obj", "bodies are ball, box, cone, house"])
        self.refuse("--out", "a.png", "--objects", "none.txt", code=INPUT_OUTPUT, says="none.txt")

    def test_an_eye_under_the_ground_is_told(self):
        figures = self.render("--spacing", "20", "--eye", "200,-200,-50", "--at", "300,-200,-50")
        self.assertIn("under the ground", figures["warnings"][0])

    def test_holes_are_as_in_other_commands(self):
        self.run_program("gen", "fbm", "a.npy", "--size", "16x16")
        self.patch_npy("a.npy", 40, float("nan"))
        self.refused("render", "terrain", "a.npy", "--out", "a.png", code=BAD_FILE,
                     says="no height")
        self.render("--holes", "fill", field="a.npy")

    def test_what_makes_no_sense(self):
        for arguments, says in [
            ([], "needs --out"),
            (["--out", "a.jpg"], ".png, .exr"),
            (["--out", "a.png", "--depth-out", "d.png"], ".exr, .pfm, .npy"),
            (["--out", "a.png", "--eye", "1,2,3", "--tour", "walk"], ["--eye", "--tour"]),
            (["--out", "a.png", "--eye", "1,2,3", "--path", "x"], ["--eye", "--path"]),
            (["--out", "a.png", "--frames", "2", "--moment", "0.5"], ["--frames", "--moment"]),
            (["--out", "a.png", "--moment", "1.5"], "from 0 to 1"),
            (["--out", "a.png", "--frames", "0"], "1 to 9999"),
            (["--out", "a.png", "--view", "steps"], "crossings"),
            (["--out", "a.png", "--tour", "flay"], "did you mean 'fly'?"),
            (["--out", "a.png", "--method", "maxmap"], "did you mean 'maxmip'?"),
            (["--out", "a.png", "--cones", "l2"], "l1 or quad"),
            (["--out", "a.png", "--colours", "plain", "--albedo", "x.png"], "--albedo"),
            (["--out", "a.png", "--size", "70000x1"], "65536"),
            (["--out", "a.png", "--wrap", "u"], "--wrap"),
            (["--out", "a.png", "--eye", "1,2,nan"], "three numbers"),
            (["--out", "a.png", "--light", "0,0,0"], "no direction"),
            (["--out", "a.png", "--spacing", "20", "--eye", "1,2,1e31"], "within 1e+30"),
        ]:
            with self.subTest(arguments=arguments):
                self.refuse(*arguments, says=says)
        self.refuse("--out", "a.png", "--spacing", "20", "--eye", "1,2,3", "--at", "1,2,3",
                    code=USAGE, says="looks nowhere")

    def test_existing_output(self):
        self.path("a.png").write_text("mine")
        self.refuse("--out", "a.png", code=INPUT_OUTPUT, says="--overwrite")
        self.assertEqual(self.path("a.png").read_text(), "mine")

    def test_stopping_leaves_whole_frames(self):
        running = subprocess.Popen([PROGRAM, "render", "terrain", ELEVATIONS, "--out", "fly.png",
                                    "--size", "300x200", "--frames", "2000"], cwd=self.folder,
                                   stderr=subprocess.PIPE)
        self.wait_until_it_catches(running, signal.SIGINT)
        while not self.path("fly_0001.png").exists():
            self.assertIsNone(running.poll())
            time.sleep(0.01)
        os.kill(running.pid, signal.SIGINT)
        running.communicate(timeout=60)
        self.assertEqual(running.returncode, 128 + signal.SIGINT)
        for name in self.files():
            self.assertEqual(read_picture(self.path(name).read_bytes())[:2], (300, 200))


if __name__ == "__main__":
    main()
