"""heightcast verify: right maps pass, wrong ones do not."""

from program import BAD_FILE, INPUT_OUTPUT, USAGE, VERIFY_FAILED, Case, main


class Verify(Case):
    def baked(self, output, *options):
        self.run_program("bake", self.hills(), output, *options)
        return output

    def test_exact_maps_pass(self):
        for output, options in [("a.png", []), ("b.png", ["--bits", 16]), ("c.exr", []),
                                ("d.npy", ["--cones", "l1", "--wrap", "uv"]),
                                ("e.dds", ["--cones", "quad"]), ("f.ktx2", ["--cones", "aniso"]),
                                ("g.tif", ["--registration", "grid", "--max-ratio", "0.3"])]:
            with self.subTest(output=output):
                self.baked(output, *options)
                figures = self.json("verify", output, "--heights", "hills.pgm")
                self.assertEqual((figures["wider"], figures["heights_differ"]), (0, 0))
                self.assertEqual(figures["texels_checked"], 24 * 17)
                self.assertEqual(figures["widest_factor"], 1)
                self.assertGreater(figures["mean_kept"], 0.9)

    def test_narrow_maps_pass(self):
        self.baked("quick.npy", "--method", "quick")
        figures = self.json("verify", "quick.npy", "--heights", "hills.pgm")
        self.assertEqual(figures["wider"], 0)
        self.assertLess(figures["mean_kept"], 1)

    def test_one_wide_ratio_is_found(self):
        self.baked("map.npy")
        _, values = self.read_npy("map.npy")
        texel = min(range(24 * 17), key=lambda i: values[2 * i + 1])
        self.patch_npy("map.npy", 2 * texel + 1, values[2 * texel + 1] * 1.5)
        error = self.refused("verify", "map.npy", "--heights", "hills.pgm", code=VERIFY_FAILED,
                             says=["1 of 408", f"texel {texel % 24}, {texel // 24}"])
        self.assertIn("factor of 1.5", error)
        figures = self.json("verify", "map.npy", "--heights", "hills.pgm", code=VERIFY_FAILED)
        self.assertEqual(figures["wider"], 1)
        self.assertAlmostEqual(figures["widest_factor"], 1.5, places=4)

    def test_unsafe_method_is_found(self):
        self.baked("centre.npy", "--method", "quick-centre")
        self.run_program("verify", "centre.npy", "--heights", "hills.pgm", code=VERIFY_FAILED)

    def test_other_heights_are_found(self):
        self.baked("map.npy")
        self.refused("verify", "map.npy", "--heights", "hills.pgm", "--invert", code=VERIFY_FAILED,
                     says=["heights", "--invert"])

    def test_same_options_pass(self):
        self.baked("map.npy", "--invert", "--range", "20:200")
        self.run_program("verify", "map.npy", "--heights", "hills.pgm", "--invert", "--range",
                         "20:200")

    def test_part_of_the_texels(self):
        self.baked("map.npy")
        figures = self.json("verify", "map.npy", "--heights", "hills.pgm", "--texels", 50)
        self.assertEqual(figures["texels_checked"], 50)
        self.assertAlmostEqual(figures["part_checked"], 50 / 408)

    def test_large_maps_are_sampled(self):
        self.run_program("gen", "fbm", "fbm.npy", "--size", "400x400")
        self.run_program("bake", "fbm.npy", "map.npy", "--method", "quick")
        figures = self.json("verify", "map.npy", "--heights", "fbm.npy")
        self.assertEqual(figures["texels_checked"], 2**30 // 160000)

    def test_other_sizes_and_kinds(self):
        self.baked("map.npy")
        self.hills("small.pgm", 23, 17)
        self.refused("verify", "map.npy", "--heights", "small.pgm", code=BAD_FILE,
                     says=["24 x 17", "23 x 17"])
        self.baked("slopes.npy", "--map", "gradient")
        self.refused("verify", "slopes.npy", "--heights", "hills.pgm", code=BAD_FILE,
                     says="no ratios")
        self.refused("verify", "hills.pgm", "--heights", "hills.pgm", code=BAD_FILE,
                     says="hills.pgm")

    def test_arguments(self):
        self.baked("map.npy")
        self.refused("verify", "map.npy", code=USAGE, says="--heights")
        self.refused("verify", "map.npy", "--heights", "hills.pgm", "--all", "--texels", 3,
                     code=USAGE, says="--all")
        self.refused("verify", "no.npy", "--heights", "hills.pgm", code=INPUT_OUTPUT, says="no.npy")
        self.refused("verify", "map.npy", "--heights", "no.pgm", code=INPUT_OUTPUT, says="no.pgm")


if __name__ == "__main__":
    main()
