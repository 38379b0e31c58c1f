#!/usr/bin/env python3
"""How the steps of rays grow with the field: tables in Markdown and a plot (docs/measuring.md).

usage: growth.py [--program build/heightcast] [--csv bench/results/steps.csv]
                 [--plot docs/gallery/steps.png] [--sizes N,...] [--methods NAME,...] [FIELD ...]

Measures with `heightcast bench steps`, which takes an hour for all made fields, and writes the CSV;
rows of what is not measured, other fields and other methods, stay. Without any FIELD the CSV is
taken as it is. The plot needs gnuplot.
"""

import argparse
import csv
import math
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
METHODS = ["fast", "safe", "maxmip"]
PANELS = [
    ("mean steps, line of sight", "mean_steps", ["sight"]),
    ("mean steps, grazing", "mean_steps", ["graze"]),
    ("99 % of the grazing rays take no more", "steps_99", ["graze"]),
    ("worst ray of all sets", "worst_steps",
     ["fly", "walk", "sight", "shadow", "random", "graze"]),
]

COLOURS = ["#1b9e3e", "#c8a000", "#d62728", "#7f7f7f", "#9467bd", "#17a2c8", "#1f4fd6", "#8c564b",
           "#e377c2"]

PLOT = """
set terminal pngcairo size 1500,1300 font "sans,11" background "white"
set output "{plot}"
set datafile missing "-"
set logscale xy 2
set xrange [56:4700]
set yrange [1:20000]
set xtics (64,128,256,512,1024,2048,4096) rotate by 45 right
set ytics 4
set key left top maxrows 4 samplen 2
set grid lw 0.5 lc rgb "#cccccc"
set style data linespoints
set tmargin 2.5
set multiplot layout {rows},{columns} columnsfirst
{plots}
unset multiplot
"""


def read(path):
    """(field, method, set of rays, side) -> row"""
    with open(path, newline="") as file:
        return {(r["field"], r["method"], r["rays"], int(r["side"])): r
                for r in csv.DictReader(file)}


def write(path, rows):
    with open(path, "w", newline="") as file:
        out = csv.DictWriter(file, next(iter(rows.values())).keys(), lineterminator="\n")
        out.writeheader()
        out.writerows(rows.values())


def measure(args):
    """The rows of the CSV, with those that are measured anew; it is written after every field."""
    rows = read(args.csv) if pathlib.Path(args.csv).exists() else {}
    with tempfile.TemporaryDirectory() as folder:
        part = pathlib.Path(folder) / "part.csv"
        for field in args.fields:
            subprocess.run([args.program, "bench", "steps", "-q", "--field", field, "--sizes",
                            args.sizes, "--methods", args.methods, "--csv", str(part),
                            "--overwrite"], check=True)
            rows.update(read(part))
            write(args.csv, rows)


def value(rows, field, method, panel, side):
    """The panel's figure, or None where it was not measured."""
    _, figure, sets = panel
    found = [float(rows[key][figure]) for key in [(field, method, name, side) for name in sets]
             if key in rows]
    return max(found) if len(found) == len(sets) else None


def cell(values, sides):
    """First, middle and last value, and the growth from the middle to the last."""
    known = [(side, v) for side, v in zip(sides, values) if v is not None]
    if len(known) < 2:
        return "-"
    middle, last = known[(len(known) - 1) // 2], known[-1]
    picked = [known[0], middle, last]
    text = " ".join(f"{v:.0f}" if v >= 10 else f"{v:.1f}" for _, v in picked)
    doublings = math.log2(last[0] / middle[0])
    return f"{text}; {(last[1] / middle[1]) ** (1 / doublings):.2f}" if middle[1] > 0 else text


def print_tables(rows, fields, sides):
    for panel in PANELS:
        print(f"| {panel[0]} | " + " | ".join(f"`{m}`" for m in METHODS) + " |")
        print("|---" * (len(METHODS) + 1) + "|")
        for field in fields:
            cells = [cell([value(rows, field, m, panel, s) for s in sides], sides)
                     for m in METHODS]
            print(f"| {field} | {' | '.join(cells)} |")
        print()


def draw(rows, fields, sides, plot):
    with tempfile.TemporaryDirectory() as folder:
        plots = []
        for method in METHODS:
            for number, panel in enumerate(PANELS):
                path = f"{folder}/{method}{number}.txt"
                points = [[value(rows, f, method, panel, side) for f in fields] for side in sides]
                with open(path, "w") as file:
                    for side, values in zip(sides, points):
                        file.write(" ".join(str(v) if v else "-" for v in [side, *values]) + "\n")
                styles = [f"lc rgb '{colour}' pt 7 ps 0.6 lw 1.5" for colour in COLOURS]
                curves = [f"'{path}' using 1:{i + 2} notitle {styles[i]}"
                          for i in range(len(fields)) if any(values[i] for values in points)]
                curves.append("5*log(x)/log(2) notitle with lines lc rgb 'black' dt 2")
                curves.append("x notitle with lines lc rgb 'black' dt 3")
                if method == METHODS[0] and number == 0:  # some curve may not be in this panel
                    curves += [f"keyentry with linespoints {styles[i]} title '{field}'"
                               for i, field in enumerate(fields)]
                    curves.append("keyentry with lines lc rgb 'black' dt 2 title 'log n'")
                    curves.append("keyentry with lines lc rgb 'black' dt 3 title 'n'")
                plots.append(f"set title '{method}: {panel[0]}'")
                plots.append("plot " + ", ".join(curves))
        text = PLOT.format(plot=plot, rows=len(PANELS), columns=len(METHODS),
                           plots="\n".join(plots))
        subprocess.run(["gnuplot"], input=text, text=True, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--program", default=str(ROOT / "build/heightcast"))
    parser.add_argument("--csv", default=str(ROOT / "bench/results/steps.csv"))
    parser.add_argument("--plot", default=str(ROOT / "docs/gallery/steps.png"))
    parser.add_argument("--sizes", default="64,128,256,512,1024,2048,4096")
    parser.add_argument("--methods", default=",".join(METHODS))
    parser.add_argument("fields", nargs="*", metavar="FIELD")
    args = parser.parse_args()
    if args.fields:
        measure(args)
    rows = read(args.csv)
    fields = list(dict.fromkeys(key[0] for key in rows))
    sides = sorted({key[3] for key in rows})
    print_tables(rows, fields, sides)
    draw(rows, fields, sides, args.plot)


if __name__ == "__main__":
    main()
