"""heightcast trace: rays from files, streams and a camera; verify --rays."""

import resource
import signal
import struct
import subprocess
import time

from picture import read_picture
from program import (BAD_FILE, ELEVATIONS, INPUT_OUTPUT, MEMORY, PROGRAM, USAGE, VERIFY_FAILED,
                     Case, main)

INF = float("inf")
DOWN = [0.5, 0.5, 1, 0, 0, 0, -1, INF]
METHODS = ["fast", "safe", "maxmip", "qdm", "parallax", "linear", "relief", "occlusion",
           "cone-fixed", "cone-loop", "cone-exact", "relaxed", "robust", "quick", "pdm",
           "reference"]


class Rays(Case):
    def write_rays(self, rays, name="rays.npy"):
        head = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({len(rays)}, 8), }}\n".encode()
        self.path(name).write_bytes(
            b"\x93NUMPY\1\0" + struct.pack("<H", len(head)) + head
            + b"".join(struct.pack("<8f", *ray) for ray in rays))
        return name

    def plain(self, name="plain.pgm", width=4, height=4):
        """A level field at 1/2, which is exact."""
        return self.write_pgm(name, [[1] * width] * height, maxval=2)

    def many_rays(self, count=3000):
        """Rays of all directions above a field, the same each time."""
        state, numbers = 7, []
        for _ in range(8 * count):
            state = (state * 1664525 + 1013904223) % 2**32
            numbers.append(state / 2**32)
        return self.write_rays([
            [n[0], n[1], 1 + n[2], 0, n[3] - 0.5, n[4] - 0.5, -n[5] - 0.01, INF]
            for n in (numbers[8 * i : 8 * i + 8] for i in range(count))])

    def rows(self, name, width=8):
        shape, values = self.read_npy(name)
        self.assertEqual(shape[1], width)
        return [values[width * i : width * i + width] for i in range(shape[0])]

    def any_hits(self, name):
        data = self.path(name).read_bytes()
        self.assertIn(b"'descr': '|u1'", data)
        return list(data[10 + struct.unpack_from("<H", data, 8)[0] :])


class Trace(Rays):
    def test_known_hits(self):
        self.plain()
        self.write_rays([DOWN, [0.25, 0.75, 0.75, 0, 0, 0, -0.5, INF],
                         [0.5, 0.5, 1, 0, 0, 0, 1, INF], [0.5, 0.5, 1, 0, 0, 0, -1, 0.25],
                         [0.5, 0.5, 0.25, 0, 1, 0, 0, INF], [-1, 0.5, 0.25, 0, 1, 0, 0, INF]])
        for method in ["fast", "safe", "maxmip", "reference"]:
            with self.subTest(method=method):
                figures = self.json("trace", "plain.pgm", "--rays", "rays.npy", "--out", "hits.npy",
                                    "--method", method, "--overwrite")
                down, slow, up, short, inside, side = self.rows("hits.npy")
                self.assertEqual(down[:7], [0.5, 0.5, 0.5, 0.5, 0, 0, 1])
                self.assertEqual(slow[:7], [0.5, 0.25, 0.75, 0.5, 0, 0, 1])
                for miss in [up, short]:
                    self.assertEqual(miss[:7], [INF, 0, 0, 0, 0, 0, 0])
                self.assertEqual(inside[:4], [0, 0.5, 0.5, 0.25])
                self.assertEqual(side[:7], [1, 0, 0.5, 0.25, -1, 0, 0])
                self.assertEqual((figures["rays"], figures["hits"], figures["inside"],
                                  figures["side"]), (6, 4, 1, 1))
                self.assertEqual(figures["method"], method)
                self.assertGreater(figures["rays_per_second"], 0)
                self.assertIn("cast", figures["seconds"])

    def test_open_sides(self):
        self.plain()
        self.write_rays([[-1, 0.5, 0.25, 0, 1, 0, 0, INF]])
        figures = self.json("trace", "plain.pgm", "--rays", "rays.npy", "--open-sides")
        self.assertEqual(figures["hits"], 0)

    def test_steps_surface(self):
        """Between two samples a patch is half-way up, a step is up or down."""
        self.write_pgm("two.pgm", [[0, 2]], maxval=2)
        self.write_rays([[0.375, 0.5, 1, 0, 0, 0, -1, INF], [0.625, 0.5, 1, 0, 0, 0, -1, INF]])
        wanted = {"bilinear": [0.75, 0.25], "steps": [1, 0]}
        for surface, expected in wanted.items():
            for method in ["fast", "safe", "maxmip", "reference"]:
                with self.subTest(surface=surface, method=method):
                    self.run_program("trace", "two.pgm", "--rays", "rays.npy", "--out", "hits.npy",
                                     "--surface", surface, "--method", method, "--overwrite")
                    self.assertEqual([row[0] for row in self.rows("hits.npy")], expected)
        self.refused("trace", "two.pgm", "--rays", "rays.npy", "--surface", "steps", "--method",
                     "relief", code=USAGE, says="relief")

    def test_any(self):
        self.plain()
        self.write_rays([DOWN, [0.5, 0.5, 1, 0, 0, 0, 1, INF], DOWN])
        for method in ["fast", "linear", "reference"]:
            with self.subTest(method=method):
                figures = self.json("trace", "plain.pgm", "--rays", "rays.npy", "--out", "any.npy",
                                    "--any", "--method", method, "--overwrite")
                self.assertEqual(self.any_hits("any.npy"), [1, 0, 1])
                self.assertEqual(figures["hits"], 2)

    def test_every_method(self):
        self.hills()
        self.many_rays(300)
        for method in METHODS:
            with self.subTest(method=method):
                figures = self.json("trace", "hills.pgm", "--rays", "rays.npy", "--method", method)
                self.assertEqual(figures["rays"], 300)
                self.assertGreater(figures["hits"], 50)

    def test_any_agrees_with_the_hits(self):
        self.hills()
        self.many_rays()
        for method in ["fast", "safe", "reference"]:
            self.run_program("trace", "hills.pgm", "--rays", "rays.npy", "--out", "hits.npy",
                             "--method", method, "--overwrite")
            self.run_program("trace", "hills.pgm", "--rays", "rays.npy", "--out", "any.npy",
                             "--any", "--method", method, "--overwrite")
            self.assertEqual(self.any_hits("any.npy"),
                             [int(row[0] != INF) for row in self.rows("hits.npy")])

    def test_same_bytes_for_every_number_of_threads(self):
        self.hills()
        self.many_rays()
        for method in ["fast", "safe", "cone-exact"]:
            for threads in [1, 2, 5]:
                self.run_program("trace", "hills.pgm", "--rays", "rays.npy", "--out",
                                 f"{threads}.npy", "-j", threads, "--method", method, "--overwrite")
            one = self.path("1.npy").read_bytes()
            self.assertEqual(one, self.path("2.npy").read_bytes(), method)
            self.assertEqual(one, self.path("5.npy").read_bytes(), method)

    def test_streams(self):
        self.hills()
        rays = self.path(self.many_rays()).read_bytes()
        self.run_program("trace", "hills.pgm", "--rays", "rays.npy", "--out", "hits.npy")
        hits = self.path("hits.npy").read_bytes()
        done = self.run_program("trace", "hills.pgm", "--rays", "-", "--out", "-", input=rays)
        self.assertEqual(done.stdout, hits)
        field = self.path("hills.pgm").read_bytes()
        done = self.run_program("trace", "-", "--rays", "rays.npy", "--out", "-", input=field)
        self.assertEqual(done.stdout, hits)
        self.run_program("trace", "hills.pgm", "--rays", "-", "--out", "cut.npy",
                         input=rays[:-1], code=BAD_FILE)
        self.assertNotIn("cut.npy", self.files())

    def test_spaces(self):
        """Row 0 is in the north; samples are 10 apart to the east and 20 to the south."""
        self.write_pgm("two.pgm", [[0, 2], [2, 2], [2, 2]], maxval=2)
        place = ["--spacing", "10,20", "--elevation", "100:300"]
        self.write_rays([[5, 0, 500, 0, 0, 0, -2, INF], [10, -40, 500, 0, 0, 0, -2, INF],
                         [500, 0, 150, 0, -1, 0, 0, INF]])
        self.run_program("trace", "two.pgm", "--rays", "rays.npy", "--out", "hits.npy", "--space",
                         "local", "--method", "reference", *place)
        slope, corner, wall = self.rows("hits.npy")
        self.assertEqual(slope[:4], [150, 0.5, struct.unpack("f", struct.pack("f", 1 / 6))[0], 0.5])
        self.assertAlmostEqual(slope[4], -20 * slope[6], places=5)  # 200 up in 10 to the east
        self.assertEqual(corner[0], 100)
        self.assertAlmostEqual(corner[1], 0.75)
        self.assertAlmostEqual(corner[2], 5 / 6, places=6)
        self.assertEqual((wall[0], wall[4:7]), (485, [1, 0, 0]))
        # the file has no origin: both spaces are one
        self.run_program("trace", "two.pgm", "--rays", "rays.npy", "--out", "world.npy", "--space",
                         "world", "--method", "reference", *place)
        self.assertEqual(self.path("world.npy").read_bytes(), self.path("hits.npy").read_bytes())

    def placed_tiff(self, x, y):
        """Two by two float samples, 10 apart to the east and 20 to the south, the first at x, y."""
        values = struct.pack("<4f", 0, 10, 10, 10)
        scale, tie = struct.pack("<3d", 10, 20, 0), struct.pack("<6d", 0, 0, 0, x, y, 0)
        keys = struct.pack("<8H", 1, 1, 0, 1, 1025, 0, 1, 2)  # samples are points
        extra = 8 + len(values)
        entries = [(256, 4, 1, 2), (257, 4, 1, 2), (258, 3, 1, 32), (259, 3, 1, 1), (262, 3, 1, 1),
                   (273, 4, 1, 8), (277, 3, 1, 1), (278, 4, 1, 2), (279, 4, 1, len(values)),
                   (339, 3, 1, 3), (33550, 12, 3, extra), (33922, 12, 6, extra + 24),
                   (34735, 3, 8, extra + 72)]
        directory = struct.pack("<H", len(entries)) + b"".join(
            struct.pack("<HHII", *entry) for entry in entries) + struct.pack("<I", 0)
        self.path("geo.tif").write_bytes(b"II*\0" + struct.pack("<I", extra + 88) + values + scale
                                         + tie + keys + directory)
        return "geo.tif"

    def test_world_space_starts_at_the_origin_of_the_file(self):
        self.placed_tiff(1000, 5000)
        self.write_rays([[1005, 5000, 20, 0, 0, 0, -1, INF]])
        for method in ["fast", "reference"]:
            figures = self.json("trace", "geo.tif", "--rays", "rays.npy", "--out", "hits.npy",
                                "--space", "world", "--method", method, "--overwrite")
            self.assertEqual(self.rows("hits.npy")[0][:4], [15, 0.5, 0.25, 0.5])
            self.assertNotIn("warnings", figures)
        self.write_rays([[5, 0, 20, 0, 0, 0, -1, INF]])
        self.run_program("trace", "geo.tif", "--rays", "rays.npy", "--out", "hits.npy", "--space",
                         "local", "--overwrite")
        self.assertEqual(self.rows("hits.npy")[0][:4], [15, 0.5, 0.25, 0.5])

    def test_coarse_coordinates_are_warned_of(self):
        self.placed_tiff(500000, 5400000)
        self.write_rays([DOWN])
        for space, warned in [("world", True), ("local", False)]:
            figures = self.json("trace", "geo.tif", "--rays", "rays.npy", "--space", space)
            self.assertEqual("--space local" in "".join(figures.get("warnings", [])), warned)

    def test_maps_as_fields(self):
        self.hills()
        self.many_rays(500)
        self.run_program("trace", "hills.pgm", "--rays", "rays.npy", "--out", "field.npy",
                         "--method", "safe")
        wanted = self.path("field.npy").read_bytes()
        self.run_program("bake", "hills.pgm", "quad.npy", "--cones", "quad")
        self.run_program("trace", "quad.npy", "--heights", "hills.pgm", "--rays", "rays.npy",
                         "--out", "quad_hits.npy", "--method", "safe")
        self.assertEqual(self.path("quad_hits.npy").read_bytes(), wanted)
        self.refused("trace", "quad.npy", "--rays", "rays.npy", code=BAD_FILE,
                     says=["quad", "--heights"])
        for output, options in [("rg.npy", []), ("d.png", ["--layout", "dummer"]),
                                ("l1.exr", ["--cones", "l1"]), ("h.tif", ["--layout", "height"]),
                                ("p.ktx2", ["--map", "pyramid"]), ("r.npy", ["--map", "relaxed"])]:
            with self.subTest(output=output):
                self.run_program("bake", "hills.pgm", output, *options)
                self.run_program("trace", output, "--rays", "rays.npy", "--out", "hits.npy",
                                 "--method", "reference", "--overwrite")
                self.run_program("trace", "hills.pgm", "--rays", "rays.npy", "--out", "wanted.npy",
                                 "--method", "reference", "--overwrite")
                self.assertEqual(self.path("hits.npy").read_bytes(),
                                 self.path("wanted.npy").read_bytes())
        self.hills("small.pgm", 23, 17)
        self.refused("trace", "quad.npy", "--heights", "small.pgm", "--rays", "rays.npy",
                     code=BAD_FILE, says=["24 x 17", "23 x 17"])
        self.run_program("bake", "hills.pgm", "slopes.npy", "--map", "gradient")
        self.refused("trace", "slopes.npy", "--rays", "rays.npy", code=BAD_FILE, says="gradient")

    def test_maps_bring_their_ratios(self):
        """Narrower cones in the map mean more steps, so they are what was used."""
        self.hills()
        self.many_rays(500)
        self.run_program("bake", "hills.pgm", "narrow.npy", "--max-ratio", "0.0001")
        wide, narrow = (
            self.json("trace", name, "--rays", "rays.npy", "--method", "cone-loop")["mean_steps"]
            for name in ["hills.pgm", "narrow.npy"])
        self.assertGreater(narrow, 2 * wide)

    def test_odd_sizes(self):
        for i, (width, height) in enumerate([(1, 1), (1, 7), (5, 1), (2, 2), (3, 5)]):
            for j, wrap in enumerate(["none", "u", "v", "uv"]):
                registration = ["texel", "grid"][(i + j) % 2]
                with self.subTest(size=(width, height), wrap=wrap, registration=registration):
                    self.plain("odd.pgm", width, height)
                    self.write_rays([DOWN, [0, 0, 1, 0, 0, 0, -1, INF]])
                    for method in ["fast", "safe", "maxmip", "reference"]:
                        self.run_program(
                            "trace", "odd.pgm", "--rays", "rays.npy", "--out", "hits.npy",
                            "--wrap", wrap, "--registration", registration, "--method", method,
                            "--overwrite")
                        self.assertEqual([row[0] for row in self.rows("hits.npy")], [0.5, 0.5])

    def test_no_rays(self):
        self.plain()
        self.write_rays([])
        for options in [[], ["--any"], ["--method", "reference"]]:
            figures = self.json("trace", "plain.pgm", "--rays", "rays.npy", "--out", "hits.npy",
                                "--overwrite", *options)
            self.assertEqual((figures["rays"], figures["hits"]), (0, 0))
        self.assertEqual(self.read_npy("hits.npy"), ((0, 8), []))

    def test_rays_that_mean_nothing_miss(self):
        self.plain()
        nan = float("nan")
        self.write_rays([[nan] + DOWN[1:], DOWN[:6] + [nan, INF], [0.5, 0.5, 1, 0, 0, 0, 0, INF],
                         DOWN[:3] + [nan] + DOWN[4:], DOWN[:3] + [2, 0, 0, -1, 1],
                         [INF] + DOWN[1:], DOWN[:7] + [nan]])
        for method in ["fast", "safe", "maxmip", "reference", "cone-exact", "linear"]:
            with self.subTest(method=method):
                figures = self.json("trace", "plain.pgm", "--rays", "rays.npy", "--method", method)
                self.assertEqual((figures["rays"], figures["hits"]), (7, 0))


class Camera(Rays):
    def test_picture_and_its_rays(self):
        self.hills()
        size = ["--size", "64x48"]
        figures = self.json("trace", "hills.pgm", "--picture", "a.png", "--save-rays", "rays.npy",
                            "--out", "hits.npy", *size)
        self.assertEqual(figures["rays"], 64 * 48)
        width, height, rows = read_picture(self.path("a.png").read_bytes())
        self.assertEqual((width, height), (64, 48))
        hits = self.rows("hits.npy")
        # sky is blue, ground is not
        for index, hit in enumerate(hits):
            red, _, blue = rows[index // 64][3 * (index % 64) :][:3]
            self.assertEqual(hit[0] == INF, blue > red + 30, index)
        self.assertTrue(64 * 4 < figures["hits"] < 64 * 44)
        self.run_program("trace", "hills.pgm", "--rays", "rays.npy", "--out", "again.npy")
        self.assertEqual(self.path("again.npy").read_bytes(), self.path("hits.npy").read_bytes())

    def test_pictures_do_not_depend_on_threads(self):
        for threads in [1, 2]:
            self.run_program("trace", ELEVATIONS, "--range", "data", "--picture", f"{threads}.png",
                             "--size", "100x75", "-j", threads, "--space", "local", "--spacing",
                             "74.5,92.5")
        self.assertEqual(self.path("1.png").read_bytes(), self.path("2.png").read_bytes())

    def test_eye_and_at(self):
        """Straight down from above the middle: right is +u, the top of the picture is the top."""
        self.plain()
        for space, eye, at, right, up in [
            (["--space", "texture"], "0.5,0.5,1.5", "0.5,0.5,0", (1, 0), (0, -1)),
            (["--space", "local", "--spacing", "1", "--elevation", "0:1"], "1.5,-1.5,4",
             "1.5,-1.5,0", (1, 0), (0, 1)),
        ]:
            with self.subTest(space=space):
                self.run_program("trace", "plain.pgm", "--save-rays", "rays.npy", "--eye", eye,
                                 "--at", at, "--fov", "90", "--size", "3", "--overwrite", *space)
                rays = self.rows("rays.npy")
                self.assertEqual(rays[4][:8], [*map(float, eye.split(",")), 0, 0, 0, -1, INF])
                self.assertAlmostEqual(rays[5][4], right[0] * 2 / 3, places=6)
                self.assertAlmostEqual(rays[5][5], right[1], places=6)
                self.assertAlmostEqual(rays[1][4], up[0], places=6)
                self.assertAlmostEqual(rays[1][5], up[1] * 2 / 3, places=6)

    def test_row_order_when_looking_north(self):
        self.plain()
        self.run_program("trace", "plain.pgm", "--save-rays", "rays.npy", "--eye", "0.5,2,0.8",
                         "--at", "0.5,0,0.8", "--size", "3", "--out", "hits.npy")
        rays = self.rows("rays.npy")
        self.assertLess(rays[3][4], 0)  # left is -u
        self.assertGreater(rays[1][6], 0)  # the top looks up
        self.assertEqual(self.rows("hits.npy")[1][0], INF)


class Refused(Rays):
    def test_arguments(self):
        self.hills()
        self.write_rays([DOWN])
        rays = ["--rays", "rays.npy"]
        for options, says in [
            ([], "--picture"),
            ([*rays, "--picture", "a.png"], "exclude"),
            ([*rays, "--save-rays", "a.npy"], "exclude"),
            ([*rays, "--eye", "0,0,1"], "--eye does nothing"),
            ([*rays, "--size", "64"], "--size does nothing"),
            (["--picture", "a.jpg"], ".png"),
            (["--picture", "a.png", "--any"], "--any"),
            ([*rays, "--out", "a.csv"], ".npy"),
            (["--picture", "a.png", "--save-rays", "a.txt"], ".npy"),
            ([*rays, "--spacing", "3"], "--space"),
            ([*rays, "--elevation", "1:3"], "--space"),
            ([*rays, "--space", "local"], "--spacing"),
            ([*rays, "--space", "world", "--spacing", "1", "--invert", "--range", "2:9"],
             "--elevation"),
            ([*rays, "--secant", "--refinements", "3"], "exclude"),
            ([*rays, "--method", "fats"], "did you mean 'fast'?"),
            ([*rays, "--space", "wrld"], "did you mean 'world'?"),
            ([*rays, "--surface", "smooth"], "bilinear, steps"),
            ([*rays, "--steps", "0"], "1 to 65536"),
            ([*rays, "--refinements", "65"], "1 to 64"),
            ([*rays, "--space", "local", "--spacing", "-1"], "positive"),
            ([*rays, "--space", "local", "--spacing", "1,2,3"], "positive"),
            ([*rays, "--space", "local", "--elevation", "3:2"], "LOW:HIGH"),
            (["--picture", "a.png", "--eye", "1,2"], "three numbers"),
            (["--picture", "a.png", "--fov", "171"], "up to 170"),
            (["--picture", "a.png", "--texels", "5"], "heightcast verify"),
            ([*rays, "--out", "-", "--json"], "standard output"),
            (["--save-rays", "-", "--out", "-"], "standard output"),
        ]:
            with self.subTest(options=options):
                self.refused("trace", "hills.pgm", *options, code=USAGE, says=says)
        self.refused("trace", "-", "--rays", "-", code=USAGE, says="standard input")
        self.refused("trace", *rays, code=USAGE, says="FIELD")
        self.refused("trace", "hills.pgm", "--picture", "a.png", "--size", "20000", code=MEMORY,
                     says="pixels")
        self.assertEqual(self.files(), ["hills.pgm", "rays.npy"])

    def test_files(self):
        self.hills()
        self.write_rays([DOWN])
        out = ["--out", "hits.npy"]
        self.refused("trace", "no.pgm", "--rays", "rays.npy", *out, code=INPUT_OUTPUT,
                     says="no.pgm")
        self.refused("trace", "hills.pgm", "--rays", "no.npy", *out, code=INPUT_OUTPUT,
                     says="no.npy")
        self.refused("trace", "hills.pgm", "--rays", "hills.pgm", *out, code=BAD_FILE,
                     says=["hills.pgm", "NPY"])
        self.run_program("gen", "fbm", "field.npy", "--size", "9x5")
        self.run_program("trace", "hills.pgm", "--rays", "field.npy", code=BAD_FILE)
        self.write_rays([DOWN] * 60, "sixty.npy")
        self.refused("trace", "hills.pgm", "--rays", "sixty.npy", *out, "--max-samples", "479",
                     code=MEMORY, says="limit is 59")
        self.refused("trace", "hills.pgm", "--rays", "rays.npy", "--out", "no/hits.npy",
                     code=INPUT_OUTPUT, says="no/hits.npy")
        cut = self.path("rays.npy").read_bytes()[:-1]
        self.path("cut.npy").write_bytes(cut)
        self.refused("trace", "hills.pgm", "--rays", "cut.npy", *out, code=BAD_FILE,
                     says=["cut.npy", "cut off"])
        self.assertNotIn("hits.npy", self.files())

    def test_existing_outputs(self):
        self.hills()
        self.write_rays([DOWN])
        for name, options in [("a.npy", ["--rays", "rays.npy", "--out", "a.npy"]),
                              ("a.npy", ["--save-rays", "a.npy", "--size", "4"]),
                              ("a.png", ["--picture", "a.png", "--size", "4"])]:
            self.path(name).write_bytes(b"precious")
            self.refused("trace", "hills.pgm", *options, code=INPUT_OUTPUT, says="--overwrite")
            self.assertEqual(self.path(name).read_bytes(), b"precious")
            self.run_program("trace", "hills.pgm", *options, "--overwrite")
            self.assertNotEqual(self.path(name).read_bytes(), b"precious")

    def test_full_disk(self):
        self.hills()
        self.many_rays(500)
        with open("/dev/full", "wb") as full:
            done = self.run_program("trace", "hills.pgm", "--rays", "rays.npy", "--out", "-",
                                    code=INPUT_OUTPUT, stdout=full, stderr=subprocess.PIPE)
        self.assertIn(b"standard output", done.stderr)

        def small_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

        done = self.run_program("trace", "hills.pgm", "--rays", "rays.npy", "--out", "hits.npy",
                                code=INPUT_OUTPUT, preexec_fn=small_files)
        self.assertIn(b"hits.npy", done.stderr)
        self.assertEqual(self.files(), ["hills.pgm", "rays.npy"])

    def start_waiting(self, *options):
        """A run that waits for the rest of its rays, with its output begun."""
        rays = self.path("rays.npy").read_bytes()
        running = subprocess.Popen(
            [PROGRAM, "trace", "hills.pgm", "--rays", "-", "--out", "hits.npy", *options],
            cwd=self.folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        running.stdin.write(rays[:-1])
        running.stdin.flush()
        deadline = time.monotonic() + 60
        while len(self.files()) < 3 and time.monotonic() < deadline:
            time.sleep(0.01)
        self.assertEqual(len(self.files()), 3)
        return running

    def test_stopped_runs_leave_nothing(self):
        self.hills()
        self.many_rays(50)
        for number in [signal.SIGINT, signal.SIGTERM]:
            running = self.start_waiting()
            time.sleep(0.1)  # until it waits
            running.send_signal(number)
            _, error = running.communicate(timeout=60)
            self.assertEqual(running.returncode, 128 + number, error)
            self.assertIn(b"signal", error)
            self.assertEqual(self.files(), ["hills.pgm", "rays.npy"])

    def test_killed_runs_leave_no_half_file_under_the_name(self):
        self.hills()
        self.many_rays(50)
        running = self.start_waiting()
        running.kill()
        running.communicate(timeout=60)
        self.assertNotIn("hits.npy", self.files())

    def test_full_standard_output_of_figures(self):
        self.hills()
        self.write_rays([DOWN])
        with open("/dev/full", "wb") as full:
            self.run_program("trace", "hills.pgm", "--rays", "rays.npy", "--json", stdout=full,
                             stderr=subprocess.PIPE, code=INPUT_OUTPUT)


class VerifyRays(Rays):
    def methods(self, figures):
        return {m["method"]: m for m in figures["methods"]}

    def test_all_methods_of_a_field(self):
        self.hills()
        figures = self.json("verify", "hills.pgm", "--rays", 2000)
        methods = self.methods(figures)
        self.assertEqual(list(methods), METHODS[:-1])
        for name, m in methods.items():
            with self.subTest(method=name):
                self.assertEqual(m["lost"], m["missed"] + m["late"])
                self.assertEqual(m["too_early"], m["early"] + m["false_hits"])
                self.assertEqual(sum(m["wrong_in_set"].values()), m["lost"] + m["too_early"])
                if name in ["fast", "safe", "maxmip"]:
                    self.assertEqual(m["lost"] + m["too_early"], 0)
                    self.assertGreater(m["hits"], 500)
                    self.assertLess(m["reach"], 0.01)
        self.assertGreater(methods["parallax"]["lost"] + methods["parallax"]["too_early"], 0)

    def test_surfaces_and_sides(self):
        self.hills()
        for options in [["--surface", "steps"], ["--open-sides"], ["--surface", "steps",
                        "--open-sides"], ["--wrap", "uv"], ["--registration", "grid"]]:
            with self.subTest(options=options):
                methods = self.methods(self.json("verify", "hills.pgm", "--rays", 1000, *options))
                self.assertEqual("relief" in methods, "steps" not in options)
                for name in ["fast", "safe", "maxmip"]:
                    self.assertGreater(methods[name]["hits"], 200)

    def test_seed_and_threads(self):
        self.hills()
        def measured(*options):
            figures = self.json("verify", "hills.pgm", "--rays", 500, *options)
            return figures["methods"]
        first = measured("--seed", 1, "-j", 1)
        self.assertEqual(first, measured("--seed", 1, "-j", 2))
        self.assertNotEqual(first, measured("--seed", 2))

    def test_maps_allow_the_methods_they_have_ratios_for(self):
        self.hills()
        free = {"fast", "maxmip", "qdm", "pdm", "parallax", "linear", "relief", "occlusion"}
        for output, options, more in [
            ("l2.npy", [], {"cone-fixed", "cone-loop", "cone-exact", "robust", "quick"}),
            ("d.png", ["--layout", "dummer"],
             {"cone-fixed", "cone-loop", "cone-exact", "robust", "quick"}),
            ("l1.png", ["--cones", "l1", "--bits", "16"], {"safe"}),
            ("r.exr", ["--map", "relaxed"], {"relaxed"}),
            ("h.tif", ["--layout", "height"], set()),
        ]:
            with self.subTest(output=output):
                self.run_program("bake", "hills.pgm", output, *options)
                figures = self.json("verify", output, "--rays", 300)
                self.assertEqual(set(self.methods(figures)), free | more)

    def test_heights_and_rays_together(self):
        self.hills()
        self.run_program("bake", "hills.pgm", "quad.npy", "--cones", "quad")
        figures = self.json("verify", "quad.npy", "--heights", "hills.pgm", "--rays", 300,
                            "--method", "safe")
        self.assertEqual(figures["wider"], 0)
        self.assertEqual(list(self.methods(figures)), ["safe"])

    def test_wide_cones_are_found(self):
        """The check must be able to fail: cones ten times too wide lose hits."""
        self.hills()
        self.run_program("bake", "hills.pgm", "map.npy", "--cones", "l1")
        _, values = self.read_npy("map.npy")
        for i in range(1, len(values), 2):
            self.patch_npy("map.npy", i, values[i] * 10)
        self.refused("verify", "map.npy", "--rays", 2000, "--method", "safe", code=VERIFY_FAILED,
                     says=["must neither be lost", "safe lost"])
        figures = self.json("verify", "map.npy", "--rays", 2000, "--method", "safe",
                            code=VERIFY_FAILED)
        self.assertGreater(figures["methods"][0]["lost"], 0)

    def test_arguments(self):
        self.hills()
        self.run_program("bake", "hills.pgm", "map.npy")
        self.refused("verify", "map.npy", "--rays", "0", code=USAGE, says="1 to 10000000")
        self.refused("verify", "map.npy", code=USAGE, says=["--heights", "--rays"])
        self.refused("verify", "map.npy", "--heights", "hills.pgm", "--seed", 3, code=USAGE,
                     says="--rays")
        self.refused("verify", "map.npy", "--rays", 5, "--method", "safe", code=BAD_FILE,
                     says=["map.npy", "safe"])
        self.refused("verify", "map.npy", "--rays", 5, "--method", "reference", code=USAGE,
                     says="judged")


if __name__ == "__main__":
    main()
