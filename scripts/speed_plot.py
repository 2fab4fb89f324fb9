#!/usr/bin/env python3
"""Plots the elasticity benchmark's times against the number of elements, and prints how steps grow.

Runs lib/cfem_cutting/benchmark_elasticity of the build (-DCFEM_CUTTING_BENCHMARKS=ON), or takes what it left before:

    scripts/speed_plot.py [RESULTS.json [PICTURE]]

By default the picture is doc/speed.svg.
"""

import collections
import json
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402

PACKAGE = pathlib.Path(__file__).resolve().parent.parent
CURVES = {  # label: how names of its benchmarks begin and end
    "element product": ("product/", "/0"),
    "multigrid cycle": ("v_cycle/", "/1/real_time"),
    "step": ("step/", "/0/1/real_time"),
    "step, two threads": ("step/", "/0/2/real_time"),
    "start-up": ("start_up/", "/0/iterations:2"),
}
SMALLEST = 4000  # elements that the exponent is taken from


def run_benchmark():
    programs = list((PACKAGE / ".build").glob("**/benchmark_elasticity"))
    if not programs:
        sys.exit("speed_plot.py: no benchmark_elasticity in .build: run scripts/build")
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "speed.json"
        arguments = [f"--benchmark_out={out}", "--benchmark_out_format=json", "--benchmark_repetitions=5"]
        subprocess.run([programs[0], *arguments], check=True)
        return json.loads(out.read_text(encoding="utf-8"))


def find_curve(results, begin, end):
    """Elements, yardsticks an element, the median of repetitions; of steps: per step."""
    yardsticks = collections.defaultdict(list)
    for entry in results["benchmarks"]:
        name = entry["name"]
        if name.startswith(begin) and name.endswith(end) and "elements" in entry and entry["run_type"] == "iteration":
            yardsticks[int(name.split("/")[1]) ** 3].append(entry["yardsticks"])
    return numpy.array(sorted((count, numpy.median(values)) for count, values in yardsticks.items())).T


def main():
    results = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")) if len(sys.argv) > 1 else run_benchmark()
    picture = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else PACKAGE / "doc" / "speed.svg"
    figure, axes = plt.subplots(figsize=(7, 4.5))
    for label, (begin, end) in CURVES.items():
        points = find_curve(results, begin, end)
        if points.size == 0:
            sys.exit(f"speed_plot.py: no results named {begin}…{end}")
        axes.loglog(*points, marker="o", label=label)
        if label.startswith("step"):
            large = points[:, points[0] >= SMALLEST]
            exponent = 1.0 + numpy.polyfit(numpy.log(large[0]), numpy.log(large[1]), 1)[0]
            print(f"{label}: time ~ N^{exponent:.2f} from {large[0, 0]:.0f} to {large[0, -1]:.0f} elements")
    axes.set_xlabel("elements")
    axes.set_ylabel("yardstick products an element")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    figure.tight_layout()
    plt.rcParams["svg.hashsalt"] = "cfem_cutting"
    figure.savefig(picture, metadata={"Date": None} if picture.suffix == ".svg" else None)


if __name__ == "__main__":
    main()
