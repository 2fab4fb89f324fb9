#!/usr/bin/env python3
"""Writes doc/verification.md and its pictures from what the analytic tests left in the build:

    ctest --test-dir .build -R '^analytic' && scripts/verification_table.py

usage: verification_table.py [RESULTS_DIRECTORY [DOC_DIRECTORY]]
"""

import collections
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SECTIONS = [  # in the order of the page, by how their names begin
    "Cantilever, tip", "Displacements node by node", "Gravity column", "Patch test", "K_au", "Rigid rotation", "Torsion",
    "Co-rotational simple shear", "Natural frequencies", "Elastic force", "Stiffness against", "Constraint force",
    "Equation of motion", "Orders", "Uncut composite", "Element matrices", "Stabilisation", "Severed mid-plane",
    "Clamped strip", "Cantilever shifted", "Cantilever turned", "Energy of", "Momenta", "Gelatine block"]

PICTURES = {  # name: (title, x label, y label, logarithmic, order lines)
    "cantilever": ("Cantilever: tip deflection over Timoshenko's", "elements across", "ratio", False, {}),
    "torsion": ("Torsion of a square bar: error of J", "elements across", "relative error", True, {-2: "order 2"}),
    "orders": ("Manufactured solution: errors", "h, m", "error", True, {2: "order 2", 1: "order 1"}),
    "time": ("Implicit Euler: errors", "dt over the largest dt", "error", True, {1: "order 1"}),
}

Case = collections.namedtuple("Case", "name source expected obtained rule passed")


def read(directory):
    sections = collections.defaultdict(list)
    curves = collections.defaultdict(lambda: collections.defaultdict(list))
    for path in sorted(directory.glob("*.tsv")):
        for line in path.read_text(encoding="utf-8").splitlines():
            kind, *fields = line.split("\t")
            if kind == "case":
                sections[fields[0]].append(Case(*fields[1:]))
            else:
                curves[fields[0]][fields[1]].append((float(fields[2]), float(fields[3])))
    return sections, curves


def rank(section):
    for position, start in enumerate(SECTIONS):
        if section.startswith(start):
            return position, section
    return len(SECTIONS), section


def rounded(text, digits):
    return f"{float(text):.{digits}g}" if text else ""


def table(section, cases):
    lines = [f"## {section}", "", "| case | source | expected | obtained | tolerance |", "|---|---|---|---|---|"]
    for case in cases:
        # Where the bound is one of rounding, the digits are too.
        obtained = rounded(case.obtained, 1 if case.rule.startswith("≤") and "e-" in case.rule else 5)
        if case.passed != "yes":
            obtained = f"**{obtained}**"
        lines.append(f"| {case.name} | {case.source} | {case.expected} | {obtained} | {case.rule or '(noted)'} |")
    return lines + [""]


def draw(name, curves, path):
    title, x_label, y_label, logarithmic, orders = PICTURES[name]
    figure, axes = plt.subplots(figsize=(5.2, 3.6))
    for label, points in sorted(curves.items()):
        points = sorted(points)
        axes.plot(*zip(*points), marker="o", markersize=4, label=label)
        for order, text in orders.items() if label == sorted(curves)[0] else ():
            (x0, y0), x1 = points[-1], points[0][0]
            axes.plot([x0, x1], [y0, y0 * (x1 / x0) ** order], "k:", linewidth=0.8)
            axes.annotate(text, (x1, y0 * (x1 / x0) ** order), fontsize=7)
    if logarithmic:
        axes.loglog()
    else:
        axes.axhline(1.0, color="k", linewidth=0.8)
    axes.set(title=title, xlabel=x_label, ylabel=y_label)
    axes.grid(alpha=0.3, which="both")
    axes.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=90, metadata={"Software": None})
    plt.close(figure)


def main():
    package = pathlib.Path(__file__).resolve().parent.parent
    results = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else package / ".build" / "verification"
    doc = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else package / "doc"
    sections, curves = read(results)
    if not sections:
        sys.exit(f"{results}: no results; run the analytic tests first: ctest -R '^analytic'")
    cases = sum(len(rows) for rows in sections.values())
    failed = sum(case.passed != "yes" for rows in sections.values() for case in rows)
    lines = ["# Verification of the elasticity", "",
             "Are the equations solved right? Written by `scripts/verification_table.py` from what `ctest -R analytic` "
             "obtained; the tests fail where a value leaves its tolerance.", "",
             f"{cases} cases, {failed} out of tolerance.", ""]
    for name in PICTURES:
        if name in curves:
            draw(name, curves[name], doc / f"verification_{name}.png")
            lines += [f"![{PICTURES[name][0]}](verification_{name}.png)"]
    lines.append("")
    for section in sorted(sections, key=rank):
        lines += table(section, sections[section])
    (doc / "verification.md").write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
