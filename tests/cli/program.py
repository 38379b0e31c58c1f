"""What the tests of the command line share: running it, and making and reading small files."""

import ast
import json
import os
import pathlib
import re
import struct
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["HEIGHTCAST"]
SOURCE = pathlib.Path(__file__).resolve().parents[2]
ELEVATIONS = SOURCE / "data" / "jacksboro_fault_dem.pgm"

# A sanitizer has words of its own for allocations that fail.
SANITIZED = os.environ.get("HEIGHTCAST_SANITIZED") == "1"

DONE, USAGE, INPUT_OUTPUT, BAD_FILE, MEMORY, VERIFY_FAILED = range(6)


class Case(unittest.TestCase):
    """A folder of its own for each test, and the program run in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="heightcast-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, *arguments, code=DONE, **options):
        """Run it, check the exit code, and that errors are one line on standard error."""
        if "input" not in options:
            options["stdin"] = subprocess.DEVNULL
        done = subprocess.run(
            [PROGRAM, *map(str, arguments)],
            cwd=self.folder,
            capture_output="stdout" not in options,
            timeout=300,
            check=False,
            **options,
        )
        self.assertEqual(done.returncode, code, f"{arguments}: {done.stderr}")
        return done

    def text(self, *arguments, **options):
        return self.run_program(*arguments, **options).stdout.decode()

    def json(self, *arguments, **options):
        """The one object that --json prints, which holds the exit code too."""
        done = self.run_program(*arguments, "--json", **options)
        figures = json.loads(done.stdout)
        self.assertEqual(figures["exit_code"], done.returncode)
        return figures

    def refused(self, *arguments, code, says):
        """The program must fail with this code and one line that has all these words."""
        error = self.run_program(*arguments, code=code).stderr.decode()
        self.assertEqual(error.count("\n"), 1, error)
        self.assertTrue(error.startswith("heightcast"), error)
        for words in [says] if isinstance(says, str) else says:
            self.assertIn(words, error)
        return error

    def wait_until_it_catches(self, running, number, patience=60):
        """Until the program has its handler for a signal: how long that takes nobody knows."""
        for _ in range(100 * patience):
            self.assertIsNone(running.poll(), "it was too fast to be stopped")
            status = pathlib.Path(f"/proc/{running.pid}/status").read_text()
            caught = int(re.search(r"(?m)^SigCgt:\s*([0-9a-f]+)$", status)[1], 16)
            if caught >> (number - 1) & 1:
                return
            time.sleep(0.01)
        self.fail(f"no handler for signal {number}")

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def path(self, name):
        return self.folder / name

    def write_pgm(self, name, rows, maxval=255):
        size = f"P5\n{len(rows[0])} {len(rows)}\n{maxval}\n".encode()
        code = ">H" if maxval > 255 else "B"
        self.path(name).write_bytes(size + b"".join(struct.pack(code, s) for r in rows for s in r))
        return name

    def hills(self, name="hills.pgm", width=24, height=17):
        """A small field with slopes everywhere, the same each time."""
        rows = [[(x * 37 + y * 91 + x * y * 13) % 251 for x in range(width)] for y in range(height)]
        return self.write_pgm(name, rows)

    def read_npy(self, name):
        """(shape, values) of a float32 NPY file."""
        data = self.path(name).read_bytes()
        start = 10 + struct.unpack_from("<H", data, 8)[0]
        head = data[10:start].decode()
        shape = ast.literal_eval(head[head.index("(") : head.index(")") + 1])
        return shape, list(struct.unpack_from(f"<{(len(data) - start) // 4}f", data, start))

    def patch_npy(self, name, index, value):
        """Overwrite one float of an NPY file."""
        data = bytearray(self.path(name).read_bytes())
        start = 10 + struct.unpack_from("<H", data, 8)[0]
        struct.pack_into("<f", data, start + 4 * index, value)
        self.path(name).write_bytes(data)


def main():
    unittest.main(verbosity=1)
