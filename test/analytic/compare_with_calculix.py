#!/usr/bin/env python3
"""Runs CalculiX on specimens that the export program writes, and compares displacements node by node.

usage: compare_with_calculix.py EXPORT_PROGRAM WORK_DIRECTORY RESULTS.tsv
"""

import pathlib
import shutil
import subprocess
import sys

TOLERANCE = 1e-4  # of the largest displacement
SECTION = "Displacements node by node, largest difference over the largest displacement"


def read_own(path):
    rows = (line.split(",") for line in path.read_text().splitlines())
    return {int(row[0]): [float(value) for value in row[1:]] for row in rows}


def read_calculix(path):
    """Lines of node, ux, uy, uz in a .dat file."""
    displacements = {}
    for line in path.read_text().splitlines():
        fields = line.split()
        if len(fields) == 4 and fields[0].isdigit():
            displacements[int(fields[0])] = [float(value) for value in fields[1:]]
    return displacements


def run_calculix(ccx, inp):
    result = subprocess.run([ccx, inp.stem], cwd=inp.parent, capture_output=True, text=True, timeout=300, check=False)
    if result.returncode != 0:
        sys.exit(f"ccx failed on {inp.name}:\n{result.stdout[-2000:]}{result.stderr[-2000:]}")
    return read_calculix(inp.with_suffix(".dat"))


def compare(own, other):
    if own.keys() != other.keys():
        sys.exit(f"{len(own)} nodes here, {len(other)} from CalculiX")
    largest = max(abs(value) for row in other.values() for value in row)
    return max(abs(a - b) for node in own for a, b in zip(own[node], other[node])) / largest


def main():
    program, directory, results = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    ccx = shutil.which("ccx")
    if ccx is None:
        sys.exit("ccx is not installed: apt-get install calculix-ccx (scripts/setup does so)")
    shutil.rmtree(directory, ignore_errors=True)
    directory.mkdir(parents=True)
    subprocess.run([program, str(directory)], check=True)
    results.parent.mkdir(parents=True, exist_ok=True)
    lines, failed = [], False
    for inp in sorted(directory.glob("*.inp")):
        error = compare(read_own(inp.with_suffix(".csv")), run_calculix(ccx, inp))
        passed = error <= TOLERANCE
        failed = failed or not passed
        print(f"{inp.stem}: {error:.2e} {'' if passed else 'too much'}")
        name, _, element = inp.stem.rpartition("_")
        lines.append(["case", SECTION, f"{name.replace('_', ' ')}, {element.upper()}", "CalculiX (ccx)", "0",
                      f"{error:.3g}", f"≤ {TOLERANCE:g}", "yes" if passed else "no"])
    results.write_text("".join("\t".join(line) + "\n" for line in lines), encoding="utf-8")
    if failed or not lines:
        sys.exit(1)


if __name__ == "__main__":
    main()
