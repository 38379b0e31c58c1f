"""heightcast bake: defaults, refusals, and outputs that are complete or not there."""

import fcntl
import json
import math
import os
import pty
import resource
import select
import signal
import struct
import subprocess
import termios
import time
import unittest

from program import (BAD_FILE, DONE, ELEVATIONS, INPUT_OUTPUT, MEMORY, PROGRAM, USAGE, Case,
                     main)


class Defaults(Case):
    def test_png_is_dummer(self):
        figures = self.json("bake", self.hills(), "out.png")
        self.assertEqual((figures["layout"], figures["bits"], figures["channels"]),
                         ("dummer", 8, 4))
        self.assertEqual((figures["map"], figures["cones"], figures["method"]),
                         ("cone", "l2", "exact"))
        self.assertEqual(figures["max_ratio"], 1)

    def test_png_with_16_bits_is_rg(self):
        figures = self.json("bake", self.hills(), "out.png", "--bits", 16)
        self.assertEqual((figures["layout"], figures["bits"]), ("rg", 16))

    def test_png_of_four_quadrants_has_16_bits(self):
        figures = self.json("bake", self.hills(), "out.png", "--cones", "quad")
        self.assertEqual((figures["layout"], figures["bits"]), ("quad", 16))

    def test_other_formats_are_float(self):
        self.hills()
        for ending in ["tif", "exr", "npy", "ktx2", "dds"]:
            figures = self.json("bake", "hills.pgm", f"out.{ending}")
            self.assertEqual((figures["layout"], figures["bits"]), ("rg", 32), ending)
            self.assertIsNone(figures["max_ratio"])

    def test_relaxed_is_falling_edge(self):
        figures = self.json("bake", self.hills(), "out.npy", "--map", "relaxed")
        self.assertEqual(figures["method"], "falling-edge")

    def test_lost_bits_are_a_warning(self):
        figures = self.json("bake", ELEVATIONS, "out.png")
        self.assertIn("16-bit heights are rounded to the 8 bits", figures["warnings"][-1])
        figures = self.json("bake", ELEVATIONS, "rg.png", "--layout", "rg")
        self.assertNotIn("rounded", " ".join(figures["warnings"]))
        self.assertNotIn("warnings", self.json("bake", self.hills(), "small.png"))

    def test_little_used_range_is_a_warning(self):
        figures = self.json("bake", ELEVATIONS, "out.npy")
        self.assertIn("236 to 1076", figures["warnings"][0])
        figures = self.json("bake", ELEVATIONS, "data.npy", "--range", "data")
        self.assertNotIn("warnings", figures)

    def test_every_kind_and_shape(self):
        self.hills()
        for options in [["--map", "pyramid"], ["--map", "bounds"], ["--map", "gradient"],
                        ["--cones", "l1"], ["--cones", "quad"], ["--cones", "aniso"],
                        ["--layout", "height"], ["--compat", "2006"], ["--wrap", "uv"],
                        ["--map", "relaxed", "--method", "gems", "--gems-steps", 9]]:
            with self.subTest(options=options):
                figures = self.json("bake", "hills.pgm", "out.tif", "--overwrite", *options)
                self.assertGreater(figures["output_bytes"], 0)
                self.assertEqual(self.json("info", "out.tif")["map"], figures["map"])

    def test_odd_sizes(self):
        for width, height in [(1, 1), (1, 7), (9, 1), (3, 5), (33, 2)]:
            with self.subTest(width=width, height=height):
                name = self.hills("odd.pgm", width, height)
                figures = self.json("bake", name, "out.npy", "--overwrite")
                self.assertEqual((figures["width"], figures["height"]), (width, height))
                self.assertEqual(self.read_npy("out.npy")[0], (height, width, 2))


class Figures(Case):
    def test_json_has_the_phases(self):
        figures = self.json("bake", self.hills(), "out.png")
        for phase in ["load", "bake", "save", "total"]:
            self.assertGreaterEqual(figures["seconds"][phase], 0.0)
        self.assertEqual((figures["width"], figures["height"]), (24, 17))
        self.assertEqual(figures["output_bytes"], self.path("out.png").stat().st_size)

    def test_figures_for_people_go_to_standard_error(self):
        done = self.run_program("bake", self.hills(), "out.png")
        self.assertEqual(done.stdout, b"")
        self.assertIn(b"24 x 17", done.stderr)
        self.assertNotIn(b"threads", done.stderr)
        done = self.run_program("bake", "hills.pgm", "v.png", "-v")
        self.assertIn(b"threads", done.stderr)

    def test_quiet(self):
        done = self.run_program("bake", ELEVATIONS, "out.png", "-q")
        self.assertEqual((done.stdout, done.stderr), (b"", b""))

    def test_threads_give_the_same_bytes(self):
        self.hills(width=130, height=67)
        for threads in [1, 2, 5]:
            self.run_program("bake", "hills.pgm", f"{threads}.npy", "-j", threads)
        one = self.path("1.npy").read_bytes()
        self.assertEqual(self.path("2.npy").read_bytes(), one)
        self.assertEqual(self.path("5.npy").read_bytes(), one)


class Inputs(Case):
    def test_standard_input(self):
        data = self.path(self.hills()).read_bytes()
        self.run_program("bake", "-", "piped.npy", input=data)
        self.run_program("bake", "hills.pgm", "named.npy")
        self.assertEqual(self.read_npy("piped.npy"), self.read_npy("named.npy"))

    def test_raw(self):
        self.path("raw.bin").write_bytes(struct.pack(">6H", 0, 65535, 3, 4, 5, 6))
        self.run_program("bake", "raw.bin", "out.npy", "--raw", "3x2:u16be", "--layout", "height")
        shape, heights = self.read_npy("out.npy")
        self.assertEqual(shape, (2, 3))
        self.assertEqual(heights[:2], [0.0, 1.0])
        self.assertAlmostEqual(heights[5], 6 / 65535, places=9)

    def test_invert_and_range(self):
        self.write_pgm("two.pgm", [[10, 20, 30]])
        self.run_program("bake", "two.pgm", "out.npy", "--layout", "height", "--range", "10:30",
                         "--invert")
        self.assertEqual(self.read_npy("out.npy")[1], [1.0, 0.5, 0.0])

    def test_missing_input(self):
        self.refused("bake", "nothing.png", "out.png", code=INPUT_OUTPUT, says="nothing.png")

    def test_folder_as_input(self):
        self.refused("bake", ".", "out.png", code=INPUT_OUTPUT, says=".")

    def test_damaged_input(self):
        data = self.path(self.hills()).read_bytes()
        self.path("cut.pgm").write_bytes(data[:-20])
        self.refused("bake", "cut.pgm", "out.png", code=BAD_FILE, says="cut.pgm")
        self.path("noise.png").write_bytes(bytes(range(200)))
        self.refused("bake", "noise.png", "out.png", code=BAD_FILE, says="noise.png")
        self.path("empty.png").write_bytes(b"")
        self.refused("bake", "empty.png", "out.png", code=BAD_FILE, says="empty.png")
        self.assertEqual(self.files(), ["cut.pgm", "empty.png", "hills.pgm", "noise.png"])

    def test_holes(self):
        self.path("holes.raw").write_bytes(struct.pack("<4f", 0.0, math.nan, 0.5, 1.0))
        raw = ["holes.raw", "out.npy", "--raw", "2x2:f32", "--layout", "height"]
        self.refused("bake", *raw, code=BAD_FILE, says=["holes.raw", "1"])
        self.run_program("bake", *raw, "--holes", "lowest")
        self.assertEqual(self.read_npy("out.npy")[1], [0.0, 0.0, 0.5, 1.0])

    def test_limit(self):
        self.refused("bake", self.hills(), "out.png", "--max-samples", 100, code=MEMORY,
                     says="hills.pgm")
        self.run_program("bake", "hills.pgm", "out.png", "--max-samples", 24 * 17)


class Contradictions(Case):
    def test_all(self):
        self.hills()
        for options, says in [
            ("out.png --method ring --cones quad", "use exact, brute"),
            ("out.png --method gems", "--map relaxed"),
            ("out.png --map relaxed --method quick", "gems, falling-edge"),
            ("out.png --map relaxed --cones l1", "--cones l2"),
            ("out.tif --map pyramid --method exact", "--method does nothing"),
            ("out.tif --map gradient --cones l1", "--cones does nothing"),
            ("out.tif --map bounds --max-ratio 2", "--max-ratio does nothing"),
            ("out.tif --gems-steps 4", "--method gems"),
            ("out.tif --level 1", "--map pyramid"),
            ("out.png --map pyramid", "--level 1"),
            ("out.dds --map pyramid --level 2", "leave --level out"),
            ("out.npy --map pyramid --level 9", "level"),
            ("out.png --layout quad", "--layout auto"),
            ("out.npy --layout dummer --bits 16", "8 bits"),
            ("out.exr --layout dummer", ".png"),
            ("out.exr --bits 16", "--bits"),
            ("out.png --bits 32", ".tif"),
            ("out.png --compat 2006 --layout rg", "dummer"),
            ("out.png --compat 2006 --method ring", "2006"),
            ("out.jpg", ".png, .tif"),
            ("out", ".png, .tif"),
            (".png", ".png, .tif"),
            ("-", ".png, .tif"),
            ("out.pgm", ".png, .tif"),
        ]:
            with self.subTest(options=options):
                self.refused("bake", "hills.pgm", *options.split(), code=USAGE, says=says)
        self.assertEqual(self.files(), ["hills.pgm"])

    def test_opengl_bakes_the_same(self):
        self.hills()
        for name, options in [("map.exr", ["--cones", "quad", "--wrap", "u"]),
                              ("map.png", ["--method", "quick-improved"]),
                              ("map.npy", ["--map", "relaxed"]),
                              ("map.ktx2", ["--map", "pyramid", "--bits", "8"]),
                              ("map.dds", ["--map", "bounds", "--wrap", "v"]),
                              ("map.tif", ["--map", "gradient"])]:
            with self.subTest(name=name):
                figures = self.json("bake", "hills.pgm", "gl." + name, "--backend", "gl", *options)
                if figures["backend"] == "cpu":
                    self.skipTest(figures["warnings"][0])
                self.run_program("bake", "hills.pgm", name, *options)
                if figures["gpu_rounds"] == "yes":
                    self.assertEqual(self.path("gl." + name).read_bytes(),
                                     self.path(name).read_bytes())

    def test_the_cpu_bakes_where_opengl_does_not(self):
        self.hills()
        self.run_program("bake", "hills.pgm", "cpu.npy")
        for options, environment, says in [
            (["--method", "ring"], {}, "CPU"),
            ([], {"__EGL_VENDOR_LIBRARY_FILENAMES": "/nowhere.json"}, "OpenGL cannot be used"),
            ([], {"MESA_GL_VERSION_OVERRIDE": "3.3"}, "OpenGL cannot be used"),
        ]:
            with self.subTest(says=says):
                figures = self.json("bake", "hills.pgm", "gl.npy", "--overwrite", "--backend", "gl",
                                    *options, env={**os.environ, **environment})
                if figures["backend"] == "gl":
                    self.skipTest("this driver does not listen")
                self.assertIn("; the CPU bakes", figures["warnings"][0])
                self.assertEqual(self.read_npy("gl.npy"), self.read_npy("cpu.npy"))

    def test_opengl_that_fails_on_the_way(self):
        faults = os.environ.get("HEIGHTCAST_GL_FAULTS")
        if faults is None:
            self.skipTest("this build has no way to make OpenGL fail")
        figures = self.json("bake", self.hills(), "cpu.npy", "--backend", "gl")
        if figures["backend"] == "cpu":
            self.skipTest(figures["warnings"][0])
        for fault, says, code in [("lost", "the driver has lost its context, for what others drew",
                                   INPUT_OUTPUT),
                                  ("memory", "out of memory for graphics", MEMORY),
                                  ("compile", "does not compile", DONE)]:
            with self.subTest(fault=fault):
                environment = {**os.environ, "LD_PRELOAD": faults, "HC_GL_FAULT": fault}
                done = self.run_program("bake", "hills.pgm", "gl.npy", "--backend", "gl", code=code,
                                        env=environment)
                self.assertIn(says, done.stderr.decode())
                self.assertEqual(self.path("gl.npy").exists(), code == DONE)
                figures = self.json("bake", "hills.pgm", "auto.npy", "--overwrite", "--backend",
                                    "auto", env=environment)
                self.assertEqual(figures["backend"], "cpu")
                self.assertIn(says, figures["warnings"][0])
                self.assertIn("; the CPU bakes", figures["warnings"][0])
                self.assertEqual(self.read_npy("auto.npy"), self.read_npy("cpu.npy"))

    def test_opengl_has_nothing_to_do(self):
        for options, says in [(["--map", "gradient"], "--map gradient in codes"),
                              (["--compat", "2006"], "--compat")]:
            self.refused("bake", self.hills(), "out.png", "--backend", "gl", *options, code=USAGE,
                         says=["--backend gl does nothing", says])
        self.write_pgm("wide.pgm", [[i % 256 for i in range(65536)]])
        figures = self.json("bake", "hills.pgm", "a.exr", "--backend", "gl")
        if figures["backend"] == "gl":
            self.refused("bake", "wide.pgm", "out.exr", "--backend", "gl", code=MEMORY,
                         says=["field of 65536 x 1", "use cpu"])
            self.assertNotIn("out.exr", self.files())
            figures = self.json("bake", "wide.pgm", "out.exr", "--backend", "auto")
            self.assertEqual(figures["backend"], "cpu")
            self.assertIn("; the CPU bakes", figures["warnings"][0])


class Outputs(Case):
    def test_existing_output_is_refused(self):
        self.path("out.png").write_bytes(b"precious")
        self.refused("bake", self.hills(), "out.png", code=INPUT_OUTPUT, says="--overwrite")
        self.assertEqual(self.path("out.png").read_bytes(), b"precious")
        self.run_program("bake", "hills.pgm", "out.png", "--overwrite")
        self.assertTrue(self.path("out.png").read_bytes().startswith(b"\x89PNG"))

    def test_failed_bake_keeps_the_old_output(self):
        self.path("out.png").write_bytes(b"precious")
        self.refused("bake", "nothing.pgm", "out.png", "--overwrite", code=INPUT_OUTPUT,
                     says="nothing.pgm")
        self.assertEqual(self.path("out.png").read_bytes(), b"precious")

    def test_output_folder(self):
        self.refused("bake", self.hills(), "no/such/out.png", code=INPUT_OUTPUT, says="no/such")
        self.refused("bake", "hills.pgm", "/proc/out.png", code=INPUT_OUTPUT, says="/proc/out.png")

    @unittest.skipIf(os.geteuid() == 0, "nothing is read-only to root")
    def test_read_only_folder(self):
        self.hills()
        self.path("closed").mkdir(mode=0o555)
        self.refused("bake", "hills.pgm", "closed/out.png", code=INPUT_OUTPUT,
                     says="closed/out.png")

    def test_output_that_is_no_file(self):
        self.path("folder.png").mkdir()
        self.refused("bake", self.hills(), "folder.png", "--overwrite", code=INPUT_OUTPUT,
                     says="not a regular file")
        os.mkfifo(self.path("pipe.png"))
        self.refused("bake", "hills.pgm", "pipe.png", "--overwrite", code=INPUT_OUTPUT,
                     says="not a regular file")

    def test_names_that_cannot_be_are_refused_before_the_bake(self):
        self.hills()
        for name, says in [("n" * 300 + ".png", "too long"), ("hills.pgm/out.png", "directory")]:
            figures = self.json("bake", "hills.pgm", name, code=INPUT_OUTPUT)
            self.assertIn(says, figures["error"])
            self.assertEqual(figures["seconds"], {})

    def test_links(self):
        """One that leads nowhere is as much in the way as a file."""
        self.hills()
        for name, target in [("nowhere.png", "missing"), ("round.png", "round.png"),
                             ("file.png", "hills.pgm")]:
            self.path(name).symlink_to(target)
            figures = self.json("bake", "hills.pgm", name, code=INPUT_OUTPUT)
            self.assertIn("--overwrite", figures["error"])
            self.assertEqual(figures["seconds"], {})
            self.assertTrue(self.path(name).is_symlink())
            self.run_program("bake", "hills.pgm", name, "--overwrite")
            self.assertFalse(self.path(name).is_symlink())
        self.assertTrue(self.path("hills.pgm").read_bytes().startswith(b"P5"))

    def test_full_disk_leaves_nothing(self):
        self.hills()
        for ending in ["png", "tif", "exr", "npy", "ktx2", "dds"]:
            with self.subTest(ending=ending):
                done = self.run_program(
                    "bake", "hills.pgm", f"out.{ending}", code=INPUT_OUTPUT,
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100)))
                self.assertIn(f"out.{ending}".encode(), done.stderr)
                self.assertEqual(self.files(), ["hills.pgm"])


class LongBake(Case):
    """The ring search can stop early nowhere on this field, and takes many seconds."""

    def start(self, *options, **more):
        self.write_pgm("low.pgm", [[int((x * 7 + y * 13) % 11 == 0) for x in range(300)]
                                   for y in range(200)])
        return subprocess.Popen(
            [PROGRAM, "bake", "low.pgm", "out.png", "--method", "ring", "-j", "1", *options],
            cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, **more)


class Interrupts(LongBake):
    def check_stopped(self, number, *options):
        running = self.start(*options, stderr=subprocess.PIPE)
        self.wait_until_it_catches(running, number)
        time.sleep(0.2)  # until it bakes
        running.send_signal(number)
        stdout, stderr = running.communicate(timeout=60)
        self.assertEqual(running.returncode, 128 + number, stderr)
        self.assertIn(b"signal", stderr)
        return stdout

    def test_ctrl_c(self):
        self.check_stopped(signal.SIGINT)
        self.assertEqual(self.files(), ["low.pgm"])

    def test_ctrl_c_keeps_the_old_output(self):
        self.path("out.png").write_bytes(b"precious")
        stdout = self.check_stopped(signal.SIGINT, "--overwrite", "--json")
        self.assertEqual(self.path("out.png").read_bytes(), b"precious")
        self.assertEqual(json.loads(stdout)["exit_code"], 130)
        self.assertEqual(self.files(), ["low.pgm", "out.png"])

    def test_termination(self):
        self.check_stopped(signal.SIGTERM)
        self.assertEqual(self.files(), ["low.pgm"])

    def test_ctrl_c_while_reading_a_pipe(self):
        running = subprocess.Popen([PROGRAM, "bake", "-", "out.png"], cwd=self.folder,
                                   stdin=subprocess.PIPE, stderr=subprocess.PIPE)
        self.wait_until_it_catches(running, signal.SIGINT)
        time.sleep(0.1)  # until it reads
        running.send_signal(signal.SIGINT)
        running.wait(timeout=60)
        running.communicate()
        self.assertEqual(running.returncode, 130)
        self.assertEqual(self.files(), [])


class Progress(LongBake):
    def bar(self, *options, columns=80, terminal="xterm", patience=60):
        """The first pictures that a terminal of this width sees."""
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("4H", 24, columns, 0, 0))
        running = self.start(*options, stderr=slave, env={**os.environ, "TERM": terminal})
        os.close(slave)
        seen = b""
        end = time.monotonic() + patience
        while time.monotonic() < end and seen.count(b"\r") < 4 and running.poll() is None:
            if select.select([master], [], [], 0.1)[0]:
                seen += os.read(master, 4096)
        running.kill()
        running.communicate()
        return seen.decode().split("\r\x1b[K")[1:-1]

    def test_bar_on_a_terminal(self):
        lines = self.bar()
        self.assertGreaterEqual(len(lines), 2)
        for line in lines:
            self.assertRegex(line, r"^bake +\d+ % \[[#.]{5,}\] \d+:\d\d(, \d+:\d\d left)?$")
            self.assertLess(len(line), 80)

    def test_bar_in_narrow_windows(self):
        for columns in [30, 24, 12]:
            with self.subTest(columns=columns):
                lines = self.bar(columns=columns)
                self.assertGreaterEqual(len(lines), 2)
                for line in lines:
                    self.assertRegex(line, r"^bake +\d+ %")
                    self.assertLess(len(line), columns)

    def test_no_bar_on_a_terminal_that_cannot_move_its_cursor(self):
        self.assertEqual(self.bar(terminal="dumb", patience=1.5), [])

    def test_no_bar_when_quiet(self):
        self.assertEqual(self.bar("-q", patience=1.5), [])

    def test_no_bar_in_a_pipe(self):
        done = self.run_program("bake", self.hills(), "out.png", "--method", "brute")
        self.assertNotIn(b"%", done.stderr)


if __name__ == "__main__":
    main()
