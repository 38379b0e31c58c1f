"""heightcast bench: what it reports; not how fast anything is."""

import csv
import json
import signal
import subprocess
import time

from program import BAD_FILE, ELEVATIONS, INPUT_OUTPUT, PROGRAM, USAGE, Case, main

SMALL = ["--sizes", "16,32", "--repeat", "2"]


class Bench(Case):
    def report(self, *options):
        return json.loads(self.text("bench", "bake", *SMALL, *options, "--json"))

    def test_all_rows(self):
        report = self.report()
        rows = report["rows"]
        self.assertEqual({row["side"] for row in rows}, {16, 32})
        methods = {row["method"] for row in rows}
        for method in ["exact", "brute", "ring", "quick", "quick-improved", "quick-centre",
                       "quick-naive-centre", "gems", "falling-edge", "pyramid", "bounds",
                       "gradient", "cells"]:
            self.assertIn(method, methods)
        self.assertEqual({row["cones"] for row in rows if row["method"] == "exact"},
                         {"l2", "l1", "quad", "aniso"})
        for row in rows:
            self.assertGreater(row["seconds"], 0)
            self.assertLessEqual(row["fastest"], row["seconds"])
            self.assertLessEqual(row["seconds"], row["slowest"])
            self.assertEqual(row["runs"], 2)
            self.assertAlmostEqual(row["ns_per_texel"], 1e9 * row["seconds"] / row["side"] ** 2)

    def test_opengl(self):
        done = self.run_program("bench", "bake", "--sizes", "16,32", "--repeat", "2", "--backend",
                                "gl", "--json", "gl.json") if self.has_opengl() else None
        if done is None:
            self.skipTest("no OpenGL here")
        report = json.loads(self.path("gl.json").read_text())
        self.assertIn("timer", report)
        rows = {(row["method"], row.get("cones"), row["side"]): row for row in report["rows"]}
        for method in ["exact", "brute", "quick", "quick-improved", "quick-centre",
                       "quick-naive-centre", "falling-edge"]:
            self.assertGreater(rows[method, "l2", 32]["seconds"], 0)
        for cones in ["l1", "quad", "aniso"]:
            self.assertIn(("exact", cones, 16), rows)
        for row in report["rows"]:
            if row["method"] in ["exact", "brute"]:
                self.assertEqual((row["wider"], row["wider_share"]), (0, 0))
        self.assertIn("OpenGL 4.", report["driver"])
        self.assertLess(rows["quick", "l2", 32]["mean_ratio"],
                        rows["exact", "l2", 32]["mean_ratio"])
        self.assertAlmostEqual(rows["falling-edge", "l2", 32]["wider_share"],
                               rows["falling-edge", "l2", 32]["wider"] / 32 ** 2)
        self.assertLess(rows["quick", "l2", 32]["mean_kept"], 1)
        self.assertAlmostEqual(report["figures"][1]["quick_improved_over_exact"],
                               rows["quick-improved", "l2", 32]["seconds"]
                               / rows["exact", "l2", 32]["seconds"])
        self.refused("bench", "bake", "--backend", "gl", "--methods", "ring", code=USAGE,
                     says=["ring", "quick-improved"])

    def test_opengl_stops_what_takes_too_long(self):
        if not self.has_opengl():
            self.skipTest("no OpenGL here")
        done = self.run_program("bench", "bake", "--sizes", "64", "--repeat", "1",
                                "--backend", "gl", "--methods", "brute,pyramid",
                                "--limit", "0.000001", "--json", "gl.json", "--csv", "gl.csv")
        self.assertEqual(done.returncode, 0)
        brute, pyramid = json.loads(self.path("gl.json").read_text())["rows"]
        self.assertEqual((brute["runs"], brute["seconds"], pyramid["runs"]), (0, None, 1))
        self.assertGreater(brute["expected_seconds"], 0)
        self.assertIn(b"stopped: would take about", done.stdout)
        with open(self.path("gl.csv"), newline="") as file:
            self.assertEqual(next(csv.DictReader(file))["seconds"], "")
        self.refused("bench", "bake", "--limit", "3", code=USAGE, says="--backend gl")

    def has_opengl(self):
        return self.json("bake", self.hills(), "a.exr", "--backend", "gl")["backend"] == "gl"

    def test_quality(self):
        quality = {row["method"]: row for row in self.report()["rows"] if row.get("cones") == "l2"}
        for same in ["exact", "brute", "ring"]:
            self.assertEqual((quality[same]["mean_kept"], quality[same]["wider"]), (1, 0))
        self.assertEqual(quality["quick"]["wider"], 0)
        self.assertLess(quality["quick"]["mean_kept"], 1)
        self.assertGreater(quality["falling-edge"]["wider"], 0)

    def test_figures(self):
        report = self.report("--methods", "exact,ring,quick-improved", "-j", 3)
        small, large = report["figures"]
        self.assertEqual((small["side"], large["side"]), (16, 32))
        self.assertEqual((large["growth_from_side"], large["growth_texels"]), (16, 4))
        time_of = {(r["method"], r["side"], r["threads"]): r["seconds"] for r in report["rows"]
                   if r["cones"] == "l2"}
        self.assertAlmostEqual(large["ring_over_exact"],
                               time_of["ring", 32, 1] / time_of["exact", 32, 1])
        self.assertAlmostEqual(large["quick_improved_over_exact"],
                               time_of["quick-improved", 32, 1] / time_of["exact", 32, 1])
        self.assertAlmostEqual(large["threads_speedup"],
                               time_of["exact", 32, 1] / time_of["exact", 32, 3])
        self.assertAlmostEqual(large["growth_seconds"],
                               time_of["exact", 32, 1] / time_of["exact", 16, 1])

    def test_machine(self):
        report = self.report("--methods", "pyramid")
        for key in ["cpu", "cores", "system", "compiler", "commit", "isa"]:
            self.assertTrue(report["machine"][key], key)
        self.assertGreater(report["seconds"]["bake"], 0)

    def test_memory_is_measured(self):
        rows = json.loads(self.text("bench", "--sizes", 1024, "--methods", "gradient,pyramid",
                                    "--repeat", 1, "--json"))["rows"]
        for row in rows:
            # A field of 4 MiB; the gradient has 8, the pyramid 5.3. Neither takes work memory.
            expected = {"gradient": 12, "pyramid": 9.33}[row["method"]] * 2**20
            if row["peak_bytes"] > 0:
                self.assertGreater(row["peak_bytes"], 0.95 * expected)
                self.assertLess(row["peak_bytes"], 1.25 * expected)

    def test_files(self):
        self.path("report.json.part").write_bytes(b"precious")
        table = self.text("bench", "bake", *SMALL, "--field", "fbm,spikes", "--methods", "exact",
                          "--json", "report.json", "--csv", "report.csv")
        report = json.loads(self.path("report.json").read_text())
        with open(self.path("report.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(report["rows"]))
        self.assertEqual({row["field"] for row in rows}, {"fbm", "spikes"})
        for row, same in zip(rows, report["rows"]):
            self.assertAlmostEqual(float(row["seconds"]), same["seconds"])
            self.assertEqual(row["commit"], report["machine"]["commit"])
        self.assertRegex(table, r"(?m)^spikes +32 exact +quad ")
        self.refused("bench", "bake", "--json", "report.json", code=INPUT_OUTPUT,
                     says="--overwrite")
        self.assertEqual(self.path("report.json.part").read_bytes(), b"precious")
        self.assertEqual(self.files(), ["report.csv", "report.json", "report.json.part"])

    def test_rays(self):
        table = self.text("bench", "trace", "--sizes", "24", "--field", f"fbm,{ELEVATIONS}",
                          "--methods", "fast", "--rays", 30000, "--repeat", 1,
                          "--csv", "rays.csv", "--json", "rays.json")
        rows = json.loads(self.path("rays.json").read_text())["rows"]
        self.assertEqual({row["field"] for row in rows}, {"fbm", ELEVATIONS.name})
        self.assertEqual({row["rays"] for row in rows},
                         {"fly", "walk", "sight", "shadow", "random"})
        self.assertEqual({row["threads"] for row in rows}, {1, 2})
        self.assertEqual({row["count"] for row in rows}, {30000})
        for row in rows:
            self.assertGreater(row["rays_per_second"], 0)
            if row["rays"] != "shadow":  # 24 samples of a gentle slope
                self.assertGreater(row["hits"], 0)
        with open(self.path("rays.csv"), newline="") as file:
            self.assertEqual(len(list(csv.DictReader(file))), len(rows))
        self.assertNotIn("nan", table)

    def steps(self, *options):
        return json.loads(self.text("bench", "steps", "--sizes", "8,16,32", "--rays", 4000,
                                    *options, "--json"))

    def test_render(self):
        report = json.loads(self.text("bench", "render", "--sizes", 32, "--size", "48x32",
                                      "--repeat", 1, "--csv", "render.csv", "--json"))
        rows = report["rows"]
        self.assertEqual(len(rows), 24 + 15)
        quick = [row for row in rows if row["method"] in ("quick", "relaxed")]
        self.assertEqual({row["map"] for row in quick},
                         {"brute", "relaxed", "quick-improved", "quick-centre"})
        self.assertEqual({(row["steps"], row["refine"]) for row in quick},
                         {(s, r) for s in (32, 200) for r in ("none", "secant", "binary")})
        for row in rows:
            self.assertGreater(row["milliseconds"], 0)
            self.assertGreater(row["mean_steps"], 0)
            if row["method"] in ("safe", "maxmip"):
                self.assertEqual((row["lost"], row["made_up"]), (0, 0))
        self.assertGreater(sum(row["lost"] + row["made_up"] for row in quick), 0)
        safe = next(row for row in rows if row["map"] == "quadrant")
        maxmip = next(row for row in rows if row["method"] == "maxmip")
        self.assertAlmostEqual(report["figures"][0]["over_maxmip"]["ratio"],
                               safe["milliseconds"] / maxmip["milliseconds"])
        self.assertIn("over_loop", report["figures"][0])
        with open(self.path("render.csv"), newline="") as file:
            self.assertEqual(len(list(csv.DictReader(file))), len(rows))
        self.refused("bench", "render", "--methods", "safe", code=USAGE, says="--methods")

    def terrain(self, *options):
        return json.loads(self.text("bench", "terrain", "--size", "40x24", "--repeat", 1, *options,
                                    "--json"))

    def test_terrain(self):
        report = self.terrain("--sizes", "32,64", "--csv", "terrain.csv")
        rows = {(row["side"], row["method"]): row for row in report["rows"]}
        self.assertEqual(set(rows), {(side, method) for side in (32, 64)
                                     for method in ("fast", "maxmip", "pdm", "safe",
                                                    "cone-loop", "qdm")})
        for (side, method), row in rows.items():
            self.assertEqual((row["runs"], row["stopped"]), (1, ""))
            self.assertGreater(row["seconds"], 0)
            # Heights; safe has four ratios besides, cone-loop one.
            self.assertGreaterEqual(row["bytes"], side**2 * {"safe": 20, "cone-loop": 8}.get(
                method, 4))
            for tour in (row["fly"], row["walk"]):
                self.assertGreater(tour["frames_per_second"], 0)
                self.assertGreater(tour["mean_crossings"], 0)
                self.assertEqual((tour["frames"], tour["judged"]), (5, 5))
                if method not in ("cone-loop", "qdm"):  # tops are not patches
                    self.assertEqual((tour["lost"], tour["made_up"]), (0, 0))
        self.assertGreater(rows[64, "cone-loop"]["walk"]["lost"]
                           + rows[64, "cone-loop"]["walk"]["made_up"], 0)
        for figure, row in zip(report["figures"], report["rows"]):
            other = rows[row["side"], "pdm"]["fly"]["frames_per_second"]
            self.assertAlmostEqual(figure["over_pdm"]["fly"],
                                   other / row["fly"]["frames_per_second"])
            smallest = rows[32, row["method"]]["walk"]["frames_per_second"]
            self.assertAlmostEqual(figure["growth"]["walk"],
                                   smallest / row["walk"]["frames_per_second"])
        with open(self.path("terrain.csv"), newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual([float(line["bytes"]) for line in lines],
                         [row["bytes"] for row in report["rows"]])

    def test_terrain_by_opengl(self):
        if not self.has_opengl():
            self.skipTest("no OpenGL here")
        report = self.terrain("--sizes", 64, "--backend", "gl")
        rows = {row["method"]: row for row in report["rows"]}
        self.assertEqual(set(rows), {"fast", "maxmip", "pdm", "safe", "cone-loop", "qdm", "mesh",
                                     "lod"})
        for method in "mesh", "lod":
            self.assertEqual(rows[method]["bytes"], 4 * 64 * 64)
            self.assertEqual(rows[method]["fly"]["mean_crossings"], 0)
            self.assertGreater(rows[method]["walk"]["frames_per_second"], 0)
        self.assertGreater(rows["maxmip"]["fly"]["mean_crossings"], 1)

    def test_terrain_polygons_need_opengl(self):
        self.refused("bench", "terrain", "--sizes", 16, "--methods", "mesh", code=BAD_FILE,
                     says="only gl")

    def test_terrain_within_a_limit(self):
        report = self.terrain("--sizes", 128, "--methods", "cone-loop,maxmip", "--limit", 1e-6,
                              "--csv", "limit.csv")
        baked, drawn = report["rows"]
        self.assertEqual((baked["stopped"], baked["fly"]["frames"], baked["walk"]["judged"]),
                         ("limit", 0, 0))
        self.assertEqual(drawn["stopped"], "")
        for tour in drawn["fly"], drawn["walk"]:
            self.assertEqual((tour["frames"], tour["judged"]), (1, 1))
            self.assertGreater(tour["frames_per_second"], 0)
        self.assertEqual([figure["method"] for figure in report["figures"]], ["maxmip"])
        with open(self.path("limit.csv"), newline="") as file:
            self.assertEqual([line["stopped"] for line in csv.DictReader(file)], ["limit", ""])
        # so small that no progress is reported
        table = self.text("bench", "terrain", "--sizes", 8, "--methods", "cone-loop", "--limit",
                          1e-9, "--size", "8x8")
        self.assertRegex(table, r"cone-loop .* - .* stopped: limit")

    def test_terrain_of_a_file(self):
        row, = self.terrain("--field", ELEVATIONS, "--sizes", 48, "--methods", "linear")["rows"]
        self.assertEqual((row["field"], row["side"], row["method"]),
                         (ELEVATIONS.name, 48, "linear"))
        self.assertGreater(row["fly"]["lost"] + row["walk"]["lost"], 0)

    def test_steps(self):
        report = self.steps("--field", "fbm,spikes", "-j", 1, "--csv", "steps.csv")
        rows = {(r["field"], r["side"], r["rays"], r["method"]): r for r in report["rows"]}
        self.assertEqual(len(rows), 2 * 3 * 6 * 3)
        for (field, side, rays, method), row in rows.items():
            self.assertLessEqual(row["mean_steps"], row["worst_steps"])
            self.assertLessEqual(row["steps_99"], row["worst_steps"])
            # All three find every hit.
            self.assertAlmostEqual(row["hits"], rows[field, side, rays, "safe"]["hits"], delta=1e-4)
        for graze in [row for row in report["rows"] if row["rays"] == "graze"]:
            self.assertGreater(graze["hits"], 0.4)
            self.assertLess(graze["hits"], 0.8)
        with open(self.path("steps.csv"), newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual([float(line["worst_steps"]) for line in lines],
                         [row["worst_steps"] for row in report["rows"]])
        self.assertEqual(report["rows"], self.steps("--field", "fbm,spikes", "-j", 2)["rows"])

    def test_growth_of_steps(self):
        report = self.steps("--methods", "maxmip")
        rows = {(r["side"], r["rays"]): r for r in report["rows"]}
        self.assertEqual({f["rays"] for f in report["figures"]},
                         {"fly", "walk", "sight", "shadow", "random", "graze"})
        for figure in report["figures"]:
            self.assertEqual((figure["from_side"], figure["to_side"]), (16, 32))
            small, large = rows[16, figure["rays"]], rows[32, figure["rays"]]
            self.assertAlmostEqual(figure["growth_mean"],
                                   large["mean_steps"] / small["mean_steps"])
            self.assertAlmostEqual(figure["growth_worst"],
                                   large["worst_steps"] / small["worst_steps"])

    def test_usage(self):
        self.refused("bench", "steps", "--methods", "fast,linear", code=USAGE, says="maxmip")
        self.refused("bench", "sky", code=USAGE, says="'sky'")
        self.refused("bench", "terrain", "--methods", "fsat", code=USAGE, says="'fast'")
        self.refused("bench", "terrain", "--rays", 9, code=USAGE, says="bench steps")
        self.refused("bench", "bake", "--rays", 9, code=USAGE, says="bench steps")
        self.refused("bench", "steps", "--rays", 0, code=USAGE, says="100000000")
        self.refused("bench", "trace", "--backend", "gl", code=USAGE, says="--backend")
        self.refused("bench", "bake", "--backend", "auto", code=USAGE, says="--backend auto")
        self.refused("bench", "--size", "9", code=USAGE, says="--size is for bench render")
        self.refused("bench", "trace", "--methods", "embre", code=USAGE, says="fast")
        self.refused("bench", "--sizes", "16,x", code=USAGE, says=["--sizes", "x"])
        self.refused("bench", "--sizes", "16,", code=USAGE, says="--sizes 16,")
        self.refused("bench", "--sizes", "9999999", code=USAGE, says="1048576")
        self.refused("bench", "--field", "fbn", code=USAGE, says="did you mean 'fbm'?")
        self.refused("bench", "--methods", "exact,rign", code=USAGE, says="did you mean 'ring'?")

    def test_ctrl_c(self):
        running = subprocess.Popen(
            [PROGRAM, "bench", "bake", "--sizes", "1024", "--methods", "brute", "--csv", "a.csv"],
            cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.wait_until_it_catches(running, signal.SIGINT)
        time.sleep(0.3)  # until it measures
        running.send_signal(signal.SIGINT)
        _, stderr = running.communicate(timeout=30)
        self.assertEqual(running.returncode, 130, stderr)
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    main()
