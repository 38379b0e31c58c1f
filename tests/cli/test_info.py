"""heightcast info: what files are."""

import math
import struct

from program import BAD_FILE, ELEVATIONS, INPUT_OUTPUT, USAGE, Case, main


class Info(Case):
    def test_field(self):
        figures = self.json("info", ELEVATIONS)
        self.assertEqual((figures["format"], figures["width"], figures["height"]),
                         ("PNM", 403, 344))
        self.assertEqual((figures["bits"], figures["type"]), (16, "u16"))
        height = figures["statistics"][0]
        self.assertEqual(height["channel"], "height")
        # 236 to 1076 metres in 16-bit codes
        self.assertAlmostEqual(height["least"] * 65535, 236, places=2)
        self.assertAlmostEqual(height["largest"] * 65535, 1076, places=2)

    def test_original_range(self):
        figures = self.json("info", ELEVATIONS, "--range", "data")
        self.assertEqual((figures["low"], figures["high"]), (236, 1076))
        self.assertEqual(figures["statistics"][0]["least"], 0)
        self.assertEqual(figures["statistics"][0]["largest"], 1)

    def test_map(self):
        self.run_program("bake", self.hills(), "out.npy", "--cones", "quad", "--wrap", "u",
                         "--registration", "grid")
        figures = self.json("info", "out.npy")
        for key, value in [("map", "cone"), ("layout", "quad"), ("cones", "quad"), ("bits", 32),
                           ("method", "exact"), ("wrap", "u"), ("registration", "grid"),
                           ("width", 24), ("height", 17)]:
            self.assertEqual(figures[key], value)
        self.assertEqual([s["channel"] for s in figures["statistics"]],
                         ["ratio_1", "ratio_2", "ratio_3", "ratio_4"])

    def test_statistics_are_right(self):
        self.run_program("bake", self.hills(), "out.npy")
        ratios = self.read_npy("out.npy")[1][1::2]
        finite = [r for r in ratios if math.isfinite(r)]
        figures = self.json("info", "out.npy")["statistics"][1]
        self.assertEqual(figures["channel"], "ratio")
        self.assertEqual(figures["unlimited"], len(ratios) - len(finite))
        self.assertGreater(figures["unlimited"], 0)
        self.assertAlmostEqual(figures["least"], min(finite))
        self.assertAlmostEqual(figures["largest"], max(finite))
        self.assertAlmostEqual(figures["mean"], sum(finite) / len(finite))

    def test_all_levels_count(self):
        self.run_program("bake", self.hills(), "out.ktx2", "--map", "pyramid")
        text = self.text("info", "out.ktx2")
        self.assertRegex(text, r"(?m)^levels +5$")
        self.assertRegex(text, r"(?m)^highest ")

    def test_text_goes_to_standard_output(self):
        done = self.run_program("info", self.hills())
        self.assertIn(b"24 x 17", done.stdout)
        self.assertEqual(done.stderr, b"")

    def test_standard_input_and_raw(self):
        data = self.path(self.hills()).read_bytes()
        self.assertIn("24 x 17", self.text("info", "-", input=data))
        self.path("raw").write_bytes(bytes(12))
        self.assertIn("4 x 3", self.text("info", "raw", "--raw", "4x3:u8"))

    def test_holes_are_a_warning(self):
        self.path("raw").write_bytes(struct.pack("<3f", 1.0, math.inf, 2.0))
        figures = self.json("info", "raw", "--raw", "3x1:f32")
        self.assertEqual(len(figures["warnings"]), 1)
        self.assertEqual(figures["statistics"][0]["zero"], 2)

    def test_foreign_text(self):
        """Names and metadata start no line and steer no terminal; JSON is UTF-8."""
        steers = "a\nb\033[31m.pgm"
        self.write_pgm(steers, [[0, 1]])
        self.assertRegex(self.text("info", steers), r"(?m)^input +a\?b\?\[31m\.pgm$")
        self.assertEqual(self.json("info", steers)["input"], steers)
        self.run_program("bake", steers, "map.npy")
        raw = self.path("map.npy").read_bytes()
        self.path("map.npy").write_bytes(raw.replace(b"method=exact", b"method=%1B2m"))
        self.assertRegex(self.text("info", "map.npy"), r"(?m)^method +\?2m$")
        for arguments in [["bake", "x", steers[:-4]], ["gen", "f\nbm", "x.png", "--size", "4"],
                          ["ba\nke"], ["bake", "x", "y.png", "--method", "\033c"]]:
            self.assertNotIn("\033", self.refused(*arguments, code=USAGE, says=""))
        for name, shown in [("\udcff.pgm", "?.pgm"), ("\udced\udca0\udc80.pgm", "???.pgm"),
                            ("\udcc3.pgm", "?.pgm"), ("\u00e9\u20ac\U0001f3d4.pgm", None)]:
            self.write_pgm(name, [[0, 1]])
            self.assertEqual(self.json("info", name)["input"], shown or name)

    def test_bad_files(self):
        self.refused("info", "nothing", code=INPUT_OUTPUT, says="nothing")
        self.path("text").write_text("no picture\n")
        self.refused("info", "text", code=BAD_FILE, says="text")
        self.refused("info", "text", "--raw", "4x4:u16", code=BAD_FILE, says="text")


if __name__ == "__main__":
    main()
