"""heightcast render relief --animate: fields that change, their cones baked anew for each frame."""

import os

from picture import read_picture
from program import INPUT_OUTPUT, USAGE, Case, main

SMALL = ["--size", "32x24", "--samples", "1", "--overwrite"]


class Animate(Case):
    def frames(self, motion, *arguments, count=3, **options):
        figures = self.json("render", "relief", self.hills(), "--animate", motion, "--frames",
                            str(count), "--out", "a.png", *SMALL, *arguments, **options)
        self.assertEqual(figures["frames"], count)
        return figures, [self.path(f"a_000{i}.png").read_bytes() for i in range(count)]

    def test_frames_differ_and_are_the_same_on_every_run(self):
        for motion in ["waves", "erode"]:
            figures, pictures = self.frames(motion, "-j", "1")
            self.assertEqual(figures["rays"], 3 * 32 * 24)
            self.assertIn("bake", figures["seconds"])
            self.assertEqual(len(set(pictures)), 3)
            self.assertEqual(self.frames(motion, "-j", "3")[1], pictures)

    def test_erosion_begins_with_the_field(self):
        _, pictures = self.frames("erode")
        self.json("render", "relief", self.hills(), "--out", "still.png", *SMALL)
        self.assertEqual(self.path("still.png").read_bytes(), pictures[0])

    def test_waves_end_as_they_began(self):
        _, two = self.frames("waves", count=2)
        _, four = self.frames("waves", count=4)
        self.assertEqual([four[0], four[2]], two)

    def test_no_frame_is_cast_with_the_cones_of_another(self):
        for motion in ["waves", "erode"]:
            for cones in ["l1", "quad"]:
                figures, _ = self.frames(motion, "--view", "missed", "--cones", cones,
                                         "--depth", "0.6", "--samples", "4")
                self.assertGreater(figures["hits"], 1000)
                self.assertEqual((figures["lost"], figures["made_up"]), (0, 0))

    def test_every_kind_of_map_on_both_backends(self):
        for method in ["safe", "cone-exact", "relaxed", "linear", "maxmip"]:
            with self.subTest(method=method):
                _, on_cpu = self.frames("waves", "--method", method, "--object", "torus", count=2)
                figures, on_gl = self.frames("waves", "--method", method, "--object", "torus",
                                             "--backend", "gl", count=2)
                if figures["backend"] == "cpu":
                    self.skipTest(figures["warnings"][0])
                for cpu, gl in zip(on_cpu, on_gl):
                    rows = zip(read_picture(cpu)[2], read_picture(gl)[2])
                    odd = sum(abs(a - b) > 2 for p, q in rows for a, b in zip(p, q))
                    self.assertLessEqual(odd, 6)
        figures, _ = self.frames("erode", "--view", "missed", "--backend", "gl")
        self.assertEqual((figures["backend"], figures["lost"]), ("gl", 0))

    def test_without_opengl_the_cpu_bakes_and_draws(self):
        _, on_cpu = self.frames("erode")
        figures, pictures = self.frames(
            "erode", "--backend", "gl",
            env={**os.environ, "__EGL_VENDOR_LIBRARY_FILENAMES": "/nowhere.json"})
        if figures["backend"] == "gl":
            self.skipTest("this driver does not listen")
        self.assertIn("the CPU bakes and draws", figures["warnings"][0])
        self.assertEqual(pictures, on_cpu)

    def test_the_cpu_goes_on_where_opengl_is_lost(self):
        faults = os.environ.get("HEIGHTCAST_GL_FAULTS")
        if faults is None:
            self.skipTest("this build has no way to make OpenGL fail")
        _, on_cpu = self.frames("erode")
        for method in ["safe", "maxmip"]:
            figures, pictures = self.frames(
                "erode", "--backend", "auto", "--method", method,
                env={**os.environ, "LD_PRELOAD": faults, "HC_GL_FAULT": "lost"})
            self.assertEqual(figures["backend"], "cpu")
            if "lost its context" not in figures["warnings"][0]:
                self.skipTest(figures["warnings"][0])
            if method == "safe":
                self.assertEqual(pictures, on_cpu)

    def test_the_cpu_goes_on_where_a_picture_is_too_wide_for_opengl(self):
        wide = ["--size", "20000x1"]
        _, on_cpu = self.frames("erode", *wide, count=2)
        figures, pictures = self.frames("erode", *wide, "--backend", "auto", count=2)
        if figures["backend"] == "gl":
            self.skipTest("this driver draws so much")
        self.assertEqual(pictures, on_cpu)

    def test_what_makes_no_sense(self):
        field = self.hills()
        for arguments, says in [
            (["--animate", "waves"], "--animate needs --frames"),
            (["--frames", "3"], "--frames needs --animate"),
            (["--animate", "wave", "--frames", "3"], "did you mean 'waves'?"),
        ]:
            self.refused("render", "relief", field, "--out", "b.png", *arguments, code=USAGE,
                         says=says)
        self.path("b_0001.png").write_text("mine")
        self.refused("render", "relief", field, "--out", "b.png", "--animate", "waves",
                     "--frames", "2", code=INPUT_OUTPUT, says=["b_0001.png", "--overwrite"])
        self.assertEqual(self.files(), ["b_0001.png", "hills.pgm"])


if __name__ == "__main__":
    main()
