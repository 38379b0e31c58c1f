"""Help, version, and what is said about a command line that makes no sense."""

import re
import subprocess

from program import DONE, INPUT_OUTPUT, SOURCE, USAGE, Case, main

COMMANDS = ["bake", "gen", "info", "show", "compare", "verify", "trace", "render",
            "render terrain", "bench"]


class Options(Case):
    def test_help_lists_the_commands(self):
        for way in ["--help", "-h", "help"]:
            text = self.text(way)
            for command in COMMANDS:
                self.assertIn(f"  {command} ", text)

    def test_each_command_has_help(self):
        for command in COMMANDS:
            text = self.text("help", *command.split())
            self.assertEqual(text, self.text(*command.split(), "--help"))
            self.assertIn(f"Usage: heightcast {command}", text)
            self.assertIn("Exit codes", text)
            # One word, the list of the methods, is longer than a line.
            wide = [line for line in text.splitlines() if len(line) > 80 and "--method" not in line]
            self.assertEqual(wide, [])

    def test_help_needs_a_known_command(self):
        self.refused("help", "bkae", code=USAGE, says="did you mean 'bake'?")

    def test_version(self):
        for way in [["--version"], ["bake", "--version"]]:
            self.assertRegex(self.text(*way), r"^heightcast \d+\.\d+\.\d+\n$")

    def test_the_manual_has_every_option(self):
        manual = (SOURCE / "docs" / "heightcast.1").read_text().replace("\\-", "-")
        for command in COMMANDS:
            self.assertIn(f"heightcast {command}", manual)
            shown = self.text("help", *command.split())
            for option in re.findall(r"^  (?:-., )?--([a-z-]+)", shown, re.M):
                self.assertRegex(manual, rf"--{option}\b", command)

    def test_the_manual_has_no_other_options(self):
        known = {"help", "version"}
        for command in COMMANDS:
            known |= set(re.findall(r"--([a-z-]+)", self.text("help", *command.split())))
        manual = (SOURCE / "docs" / "heightcast.1").read_text().replace("\\-", "-")
        self.assertEqual(set(re.findall(r"--([a-z][a-z-]*)", manual)) - known, set())

    def test_no_command(self):
        self.refused(code=USAGE, says="--help")

    def test_unknown_command(self):
        self.refused("verfy", code=USAGE, says=["'verfy'", "did you mean 'verify'?"])
        self.refused("frobnicate", code=USAGE, says=["'frobnicate'", "--help"])
        self.refused("--vresion", code=USAGE, says="unknown option '--vresion'")

    def test_unknown_option(self):
        self.refused("bake", "a", "b.png", "--mehtod", "exact", code=USAGE,
                     says=["--mehtod", "did you mean --method?"])
        self.refused("bake", "a", "b.png", "--qqqqqq", code=USAGE, says=["--qqqqqq", "--help"])
        self.refused("bake", "a", "b.png", "-Z", code=USAGE, says="-Z")

    def test_option_of_another_command(self):
        self.refused("gen", "fbm", "a.png", "--cones", "l1", code=USAGE,
                     says=["--cones", "heightcast bake"])

    def test_ambiguous_option(self):
        self.refused("bake", "a", "b.png", "--max", "1", code=USAGE,
                     says=["--max-samples", "--max-ratio"])

    def test_values(self):
        for option, value, says in [
            ("method", "exat", "did you mean 'exact'?"),
            ("method", "zebra", "exact, brute, ring"),
            ("cones", "l3", "l2, l1, quad, aniso"),
            ("layout", "rgb", "dummer"),
            ("map", "cones", "did you mean 'cone'?"),
            ("bits", "12", "8, 16, 32"),
            ("wrap", "x", "none, u, v, uv"),
            ("channel", "green", "auto, r, g, b, a, luma"),
            ("registration", "post", "texel, grid"),
            ("holes", "ignore", "error, fill, lowest"),
            ("backend", "cuda", "cpu, gl"),
            ("isa", "sse", "scalar"),
            ("compat", "2007", "2006"),
            ("range", "3", "LOW:HIGH"),
            ("range", "2:2", "two different"),
            ("range", "nan:1", "LOW:HIGH"),
            ("range", "0:1:2", "LOW:HIGH"),
            ("raw", "3x4", "WIDTHxHEIGHT:TYPE"),
            ("raw", "0x4:u8", "WIDTHxHEIGHT:TYPE"),
            ("raw", "3x4:u9", "u8, u16"),
            ("raw", "3x4:u16middle", "u8, u16"),
            ("max-samples", "0", "from 1"),
            ("max-samples", "99999999999999999999", "from 1"),
            ("max-ratio", "-1", "above 0"),
            ("max-ratio", "inf", "above 0"),
            ("max-ratio", "1e-60", "above 0"),
            ("max-ratio", "1 ", "above 0"),
            ("level", "0", "from 1"),
            ("gems-steps", "5000", "1 to 4096"),
            ("threads", "1025", "1024"),
            ("threads", "+3", "1024"),
            ("threads", "", "1024"),
        ]:
            with self.subTest(option=option, value=value):
                self.refused("bake", "a.pgm", "b.png", f"--{option}", value, code=USAGE,
                             says=[f"--{option} {value}", says])

    def test_missing_and_surplus_values(self):
        self.refused("bake", "a", "b.png", "--method", code=USAGE,
                     says=["--method needs a value", "exact"])
        self.refused("bake", "a", "b.png", "-j", code=USAGE, says="--threads needs a value")
        self.refused("bake", "a", "b.png", "--json=yes", code=USAGE, says="--json takes no value")

    def test_missing_and_surplus_arguments(self):
        self.refused("bake", "a", code=USAGE, says="IN OUT")
        self.refused("bake", "a", "b", "c", code=USAGE, says="'c'")
        self.refused("info", code=USAGE, says="FILE")
        self.refused("info", "a", "b", code=USAGE, says="'b'")
        self.refused("compare", "a", code=USAGE, says="A B")
        self.refused("verify", code=USAGE, says="MAP")
        self.refused("gen", "fbm", code=USAGE, says="NAME OUT")

    def test_empty_arguments(self):
        self.refused("info", "", code=USAGE, says=["argument 1 is empty", "FILE"])
        self.refused("bake", "a", "", code=USAGE, says=["argument 2 is empty", "IN OUT"])

    def test_outputs_that_are_the_same_file(self):
        field = self.hills()
        for arguments in [["trace", field, "--size", "4", "--out", "a.npy", "--save-rays"],
                          ["render", "relief", field, "--size", "4", "--out", "a.exr",
                           "--depth-out"],
                          ["bench", "bake", "--sizes", "8", "--json", "a.json", "--csv"]]:
            name = next(word for word in arguments if word.startswith("a."))
            for same in [name, f"./{name}", str(self.path(name))]:
                self.refused(*arguments, same, "--overwrite", code=USAGE, says="are the same file")
        self.assertEqual(self.files(), [field])

    def test_usage_errors_reach_json_too(self):
        figures = self.json("info", "missing.png", code=INPUT_OUTPUT)
        self.assertIn("missing.png", figures["error"])

    def test_options_after_two_dashes_are_names(self):
        self.hills("--json")
        self.assertIn("24 x 17", self.text("info", "--", "--json"))

    def test_full_standard_output_is_an_error(self):
        self.hills()
        for arguments in [["--help"], ["--version"], ["help", "bake"], ["gen", "--list"],
                          ["info", "hills.pgm"], ["info", "hills.pgm", "--json"]]:
            with self.subTest(arguments=arguments), open("/dev/full", "wb") as full:
                done = self.run_program(*arguments, code=INPUT_OUTPUT, stdout=full,
                                        stderr=subprocess.PIPE)
                self.assertIn(b"standard output", done.stderr)

    def test_closed_standard_output_does_no_harm_to_a_bake(self):
        self.hills()
        self.run_program("bake", "hills.pgm", "out.npy", code=DONE)
        self.assertIn("out.npy", self.files())


if __name__ == "__main__":
    main()
