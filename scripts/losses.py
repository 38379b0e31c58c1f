#!/usr/bin/env python3
"""What every method of casting rays loses, as Markdown tables (docs/measuring.md).

usage: losses.py [--program build/heightcast] [--rays 20000] [--size 512] [--seed 1] [FIELD ...]

FIELD: a named field, or a file; without any: fbm, dunes, spikes, ridge and the real elevations.
Misses, late and early hits, and steps are those of `heightcast verify --rays`.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FIELDS = ["fbm", "dunes", "spikes", "ridge", str(ROOT / "data/jacksboro_fault_dem.pgm")]


def percent(part, whole):
    value = 100.0 * part / whole
    return f"{value:.2g}" if 0.0 < value < 10.0 else f"{value:.0f}"


def both(report, method, *names):
    """Two shares of the rays, or one 0."""
    parts = [method[name] for name in names]
    return " + ".join(percent(part, report["rays"]) for part in parts) if sum(parts) > 0 else "0"


TABLES = [
    ("First hits lost, % of the rays: missed + late", lambda r, m: both(r, m, "missed", "late")),
    ("Hits too early, %: early + made up", lambda r, m: both(r, m, "early", "false_hits")),
    ("Steps: mean / 99 %", lambda r, m: f"{m['mean_steps']:.1f} / {m['steps_99']:.0f}"),
]


def run(arguments):
    return subprocess.run(arguments, check=True, capture_output=True, text=True).stdout


def field_file(args, name, folder):
    """The file of a field, the arguments that read it, and what to call it."""
    path = pathlib.Path(name)
    if path.exists():
        return str(path), ["--range", "data"], path.stem
    made = f"{folder}/{name}.pfm"
    size = f"{args.size}x{args.size}"
    run([args.program, "gen", name, made, "--size", size, "--seed", str(args.seed), "-q"])
    return made, [], name


def print_table(title, reports, cell):
    columns = [title, *reports]
    print(f"| {' | '.join(columns)} |\n{'|---' * len(columns)}|")
    for rows in zip(*[report["methods"] for report in reports.values()]):
        cells = [cell(report, row) for report, row in zip(reports.values(), rows)]
        print(f"| `{rows[0]['method']}` | {' | '.join(cells)} |")
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--program", default=str(ROOT / "build/heightcast"))
    parser.add_argument("--rays", type=int, default=20000)
    parser.add_argument("--size", type=int, default=512, help="side of named fields")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("fields", nargs="*", default=FIELDS, metavar="FIELD")
    args = parser.parse_args()
    reports = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in args.fields:
            path, how, title = field_file(args, name, folder)
            command = [args.program, "verify", path, *how, "--json", "--seed", str(args.seed)]
            reports[title] = json.loads(run([*command, "--rays", str(args.rays)]))
    for title, cell in TABLES:
        print_table(title, reports, cell)


if __name__ == "__main__":
    main()
