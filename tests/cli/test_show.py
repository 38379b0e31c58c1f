"""heightcast show: pictures of fields and maps, in files and in a terminal."""

import fcntl
import os
import pty
import signal
import struct
import subprocess
import termios
import time
import unittest

from picture import read_picture
from program import INPUT_OUTPUT, PROGRAM, USAGE, Case, main

MARGIN, ABOVE, BELOW = 8, 18, 34  # around panels, their title, their scale


class Show(Case):
    def picture(self, *arguments):
        self.run_program("show", *arguments, "--out", "p.png", "--overwrite")
        return read_picture(self.path("p.png").read_bytes())

    def test_field(self):
        """A field of 2 x 1 is drawn 256 x 128: its left half dark, its right half bright."""
        self.write_pgm("a.pgm", [[0, 255]])
        width, height, rows = self.picture("a.pgm")
        self.assertEqual((width, height), (256 + 2 * MARGIN, 128 + 2 * MARGIN + ABOVE + BELOW))
        row = rows[MARGIN + ABOVE + 64]
        self.assertEqual(tuple(row[3 * 20 : 3 * 21]), (20, 20, 48))
        self.assertEqual(tuple(row[3 * 200 : 3 * 201]), (255, 245, 190))

    def test_quadrants_share_a_scale(self):
        self.run_program("bake", self.hills(), "quad.npy", "--cones", "quad")
        figures = self.json("show", "quad.npy", "--out", "p.png")
        tops = [channel["top"] for channel in figures["channels"]]
        self.assertEqual(len(tops), 4)
        self.assertEqual(len(set(tops)), 1)
        self.assertGreater(tops[0], 0)
        drawn = 24 * (256 // 24), 17 * (256 // 24)
        width, height, _ = read_picture(self.path("p.png").read_bytes())
        self.assertEqual(width, MARGIN + 2 * (drawn[0] + MARGIN))
        self.assertEqual(height, MARGIN + 2 * (drawn[1] + MARGIN + ABOVE + BELOW))

    def test_the_map_of_2006_is_shown_with_its_root(self):
        """Half a field per height: the root of 0.5, as code 180 of 255, rounded down."""
        self.write_pgm("a.pgm", [[0, 255]])
        self.run_program("bake", "a.pgm", "map.png", "--layout", "dummer")
        channels = self.json("show", "map.png", "--out", "p.png")["channels"]
        self.assertEqual([(c["channel"], c["top"]) for c in channels],
                         [("height", 1), ("root", 1), ("slope_x", 1), ("slope_y", 1)])
        _, _, rows = self.picture("map.png")
        x = 256 + 2 * MARGIN + 20
        part = 180 / 255 * 4 - 2
        expected = [a + part * (b - a) for a, b in zip((190, 50, 110), (245, 140, 50))]
        for value, wanted in zip(rows[MARGIN + ABOVE + 64][3 * x : 3 * x + 3], expected):
            self.assertAlmostEqual(value, wanted, delta=1)

    def test_scale_ends_at_most_ratios(self):
        self.run_program("bake", self.hills(), "a.npy")
        ratios = sorted(r for r in self.read_npy("a.npy")[1][1::2] if r != float("inf"))
        height, ratio = self.json("show", "a.npy", "--out", "p.png")["channels"]
        self.assertEqual(height["top"], 1)
        self.assertAlmostEqual(ratio["top"], ratios[(len(ratios) - 1) * 95 // 100], places=6)

    def test_falling_gradients_are_drawn_as_steep(self):
        self.write_pgm("up.pgm", [[0, 255]])
        self.write_pgm("down.pgm", [[255, 0]])
        for name in ("up", "down"):
            self.run_program("bake", f"{name}.pgm", f"{name}.npy", "--map", "gradient")
        self.assertEqual(self.picture("up.npy"), self.picture("down.npy"))

    def test_ctrl_c_while_writing_leaves_no_part(self):
        self.run_program("gen", "noise", "wide.npy", "--size", "1200x1200")
        running = subprocess.Popen([PROGRAM, "show", "wide.npy", "--out", "p.png"], cwd=self.folder,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        while running.poll() is None and len(self.files()) == 1:
            time.sleep(0.001)
        running.send_signal(signal.SIGINT)
        running.wait(timeout=60)
        self.assertIn(self.files(), [["wide.npy"], ["p.png", "wide.npy"]])

    def test_refusals(self):
        self.refused("show", self.hills(), code=USAGE, says=["no terminal", "--out"])
        self.refused("show", "hills.pgm", "--json", code=USAGE, says="--json")
        self.refused("show", "hills.pgm", "--out", "p.jpg", code=USAGE, says=".png")
        self.refused("show", "none.pgm", "--out", "p.png", code=INPUT_OUTPUT, says="none.pgm")
        self.path("p.png").write_bytes(b"precious")
        self.refused("show", "hills.pgm", "--out", "p.png", code=INPUT_OUTPUT, says="--overwrite")
        self.assertEqual(self.path("p.png").read_bytes(), b"precious")

    @unittest.skipUnless(os.environ.get("HEIGHTCAST_CHAFA") == "1", "built without libchafa")
    def test_terminal(self):
        """In a terminal it draws coloured cells, and no more rows than there are."""
        main_end, terminal = pty.openpty()
        self.addCleanup(os.close, main_end)
        fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 12, 40, 0, 0))
        environment = {**os.environ, "TERM": "xterm-256color", "COLORTERM": "truecolor"}
        self.run_program("show", self.hills(), "-q", stdout=terminal, env=environment)
        os.close(terminal)
        drawn = b""
        try:
            while chunk := os.read(main_end, 65536):
                drawn += chunk
        except OSError:  # how Linux says that the other end is closed
            pass
        self.assertIn(b"\x1b[38;2;", drawn)
        self.assertGreater(drawn.count(b"\n"), 3)
        self.assertLessEqual(drawn.count(b"\n"), 12)


if __name__ == "__main__":
    main()
