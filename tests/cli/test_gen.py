"""heightcast gen: named fields."""

import json
import unittest

from program import INPUT_OUTPUT, MEMORY, SANITIZED, USAGE, Case, main


class Gen(Case):
    def names(self):
        return list(json.loads(self.text("gen", "--list", "--json"))["fields"])

    def test_list(self):
        text = self.text("gen", "--list")
        for name in ["fbm", "spikes", "flat"]:
            self.assertRegex(text, rf"(?m)^  {name} +\w")

    def test_every_name_at_odd_sizes(self):
        names = self.names()
        self.assertGreater(len(names), 10)
        for name in names:
            with self.subTest(name=name):
                figures = self.json("gen", name, f"{name}.npy", "--size", "31x17")
                self.assertEqual((figures["width"], figures["height"]), (31, 17))
                shape, heights = self.read_npy(f"{name}.npy")
                self.assertEqual(shape, (17, 31))
                self.assertTrue(all(0.0 <= h <= 1.0 for h in heights))

    def test_one_texel(self):
        self.run_program("gen", "fbm", "one.png", "--size", 1)
        self.assertIn("1 x 1", self.text("info", "one.png"))

    def test_seed(self):
        for output, seed in [("a", 7), ("b", 7), ("c", 2**64 - 1)]:
            figures = self.json("gen", "noise", f"{output}.npy", "--size", 16, "--seed", seed)
            self.assertEqual(figures["seed"], seed)
        self.assertEqual(self.path("a.npy").read_bytes(), self.path("b.npy").read_bytes())
        self.assertNotEqual(self.path("a.npy").read_bytes(), self.path("c.npy").read_bytes())

    def test_bits(self):
        for bits in [8, 16]:
            self.run_program("gen", "fbm", f"{bits}.png", "--size", 16, "--bits", bits)
            self.assertEqual(self.json("info", f"{bits}.png")["bits"], bits)

    def test_usage(self):
        self.refused("gen", "fbn", "a.png", "--size", 9, code=USAGE, says="did you mean 'fbm'?")
        self.refused("gen", "xxxxx", "a.png", "--size", 9, code=USAGE, says="known are fbm")
        self.refused("gen", "fbm", "a.png", code=USAGE, says="--size")
        for size in ["0", "0x5", "5x", "x5", "5x5x5", "5.5", "-3", "2000000x1"]:
            self.refused("gen", "fbm", "a.png", "--size", size, code=USAGE,
                         says=["--size", size, "WIDTHxHEIGHT"])
        self.refused("gen", "fbm", "a.jpg", "--size", 9, code=USAGE, says=".png")
        self.refused("gen", "fbm", "a.png", "--size", 9, "--bits", 32, code=USAGE,
                     says=".tif, .exr")
        self.assertEqual(self.files(), [])

    def test_existing_output(self):
        self.path("a.png").write_bytes(b"precious")
        self.refused("gen", "fbm", "a.png", "--size", 9, code=INPUT_OUTPUT, says="--overwrite")
        self.run_program("gen", "fbm", "a.png", "--size", 9, "--overwrite")
        self.assertNotEqual(self.path("a.png").read_bytes(), b"precious")

    @unittest.skipIf(SANITIZED, "says more than the program does")
    def test_too_large(self):
        self.refused("gen", "flat", "huge.pgm", "--size", 1048576, code=MEMORY,
                     says=["1048576 x 1048576", "--size"])


if __name__ == "__main__":
    main()
