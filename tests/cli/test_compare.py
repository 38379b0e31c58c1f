"""heightcast compare: differences, and their picture."""

import math

from picture import read_picture
from program import BAD_FILE, INPUT_OUTPUT, USAGE, Case, main


class Compare(Case):
    def test_equal(self):
        self.hills("a.pgm")
        self.hills("b.pgm")
        figures = self.json("compare", "a.pgm", "b.pgm")
        self.assertTrue(figures["equal"])
        height = figures["channels"][0]
        self.assertEqual((height["largest"], height["mean"], height["differing"]), (0, 0, 0))
        self.assertIsNone(height["psnr"])
        self.assertRegex(self.text("compare", "a.pgm", "b.pgm"), r"(?m)^equal +yes$")

    def test_figures(self):
        self.write_pgm("a.pgm", [[0, 255, 0, 0]])
        self.write_pgm("b.pgm", [[0, 204, 0, 51]])
        figures = self.json("compare", "a.pgm", "b.pgm")
        height = figures["channels"][0]
        self.assertFalse(figures["equal"])
        self.assertAlmostEqual(height["largest"], 0.2, places=6)
        self.assertAlmostEqual(height["mean"], 0.1, places=6)
        self.assertAlmostEqual(height["psnr"], 10 * math.log10(1 / 0.02), places=4)
        self.assertEqual(height["differing"], 2)
        self.assertEqual(height["largest_y"], 0)

    def test_maps(self):
        self.run_program("bake", self.hills(), "a.npy")
        self.run_program("bake", "hills.pgm", "b.npy", "--method", "quick")
        height, ratio = self.json("compare", "a.npy", "b.npy")["channels"]
        self.assertEqual(height["differing"], 0)
        self.assertEqual(ratio["channel"], "ratio")
        self.assertGreater(ratio["largest"], 0)
        self.assertGreater(ratio["psnr"], 0)

    def test_unlimited_in_one(self):
        self.run_program("bake", self.hills(), "a.npy")
        self.run_program("bake", "hills.pgm", "b.npy", "--max-ratio", 5)
        ratios = self.read_npy("a.npy")[1][1::2]
        finite = [ratio for ratio in ratios if math.isfinite(ratio)]
        figures = self.json("compare", "a.npy", "b.npy")["channels"][1]
        self.assertEqual(figures["unlimited_in_one"], len(ratios) - len(finite))
        self.assertEqual(figures["differing"], sum(ratio > 5 for ratio in ratios))
        self.assertAlmostEqual(figures["largest"], max(finite) - 5, places=5)

    def test_all_levels_count(self):
        for name, heights in [("a", [0, 100, 50, 200]), ("b", [0, 100, 60, 200])]:
            self.write_pgm(f"{name}.pgm", [heights])
            self.run_program("bake", f"{name}.pgm", f"{name}.dds", "--map", "pyramid")
        highest, lowest = self.json("compare", "a.dds", "b.dds")["channels"]
        self.assertEqual((highest["differing"], lowest["differing"]), (1, 2))

    def test_different_things(self):
        self.hills("a.pgm")
        self.hills("b.pgm", width=23)
        self.refused("compare", "a.pgm", "b.pgm", code=BAD_FILE, says=["24 x 17", "23 x 17"])
        self.run_program("bake", "a.pgm", "rg.npy")
        self.run_program("bake", "a.pgm", "quad.npy", "--cones", "quad")
        self.refused("compare", "rg.npy", "quad.npy", code=BAD_FILE, says=["rg", "quad"])
        self.refused("compare", "rg.npy", "a.pgm", code=BAD_FILE, says="height map")

    def test_bad_arguments(self):
        self.hills("a.pgm")
        self.refused("compare", "a.pgm", "b.pgm", code=INPUT_OUTPUT, says="b.pgm")
        self.refused("compare", "-", "-", code=USAGE, says="standard input")
        self.refused("compare", "a.pgm", "a.pgm", "--diff", "d.jpg", code=USAGE, says=".png")
        self.path("d.png").write_bytes(b"precious")
        self.refused("compare", "a.pgm", "a.pgm", "--diff", "d.png", code=INPUT_OUTPUT,
                     says="--overwrite")
        self.assertEqual(self.path("d.png").read_bytes(), b"precious")


class Picture(Case):
    def picture(self, a, b):
        self.run_program("compare", a, b, "--diff", "d.png", "--overwrite")
        return read_picture(self.path("d.png").read_bytes())

    def test_values_and_scale(self):
        """A field of 4 x 2 is drawn 256 x 128, 8 from the left and 26 from the top."""
        self.write_pgm("a.pgm", [[0, 0, 0, 0], [0, 0, 0, 0]])
        self.write_pgm("b.pgm", [[0, 0, 0, 0], [0, 51, 0, 255]])
        width, height, rows = self.picture("a.pgm", "b.pgm")
        self.assertEqual((width, height), (256 + 16, 26 + 128 + 8 + 12 + 4 + 10 + 8))

        def at(x, y):
            return tuple(rows[y][3 * x : 3 * x + 3])

        lowest, highest = at(8 + 5, 26 + 5), at(8 + 3 * 64 + 5, 26 + 64 + 5)
        self.assertEqual(lowest, (20, 20, 48))
        self.assertEqual(highest, (255, 245, 190))
        bar = 26 + 128 + 8 + 6
        self.assertEqual((at(8, bar), at(8 + 255, bar)), (lowest, highest))
        between = at(8 + 64 + 5, 26 + 64 + 5)
        self.assertEqual(between, at(8 + 51, bar))
        ink = (230, 230, 230)
        labels = range(bar + 10, bar + 20)
        self.assertTrue(any(at(x, y) == ink for y in labels for x in range(8, 16)))
        self.assertTrue(any(at(x, y) == ink for y in labels for x in range(240, 264)))

    def test_large_fields_are_reduced_without_losing_texels(self):
        rows = [[0] * 2100 for _ in range(40)]
        self.write_pgm("a.pgm", rows)
        rows[21][1301] = 255
        self.write_pgm("b.pgm", rows)
        width, height, pixels = self.picture("a.pgm", "b.pgm")
        self.assertLess(width, 1100)
        self.assertLess(height, 120)
        bright = bytes((255, 245, 190))
        self.assertEqual(pixels[26 + 21 // 3][3 * (8 + 1301 // 3) :][:3], bright)

    def test_one_panel_for_each_channel(self):
        self.run_program("bake", self.hills(), "a.png")
        self.run_program("bake", "hills.pgm", "b.png", "--method", "quick")
        width, height, _ = self.picture("a.png", "b.png")
        self.assertEqual(width, 8 + 2 * (240 + 8))
        self.assertEqual(height, 8 + 2 * (170 + 18 + 34 + 8))


if __name__ == "__main__":
    main()
