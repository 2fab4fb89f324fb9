#!/usr/bin/env python3
"""Draws the pictures of doc/paper.md from what `replay` wrote; scripts/paper_figures makes both. Needs a display.

usage: draw_figures.py RESULTS_FOLDER DOC_FOLDER
"""

import csv
import pathlib
import sys

import numpy
import rosbag
import yaml
from PIL import Image, ImageDraw, ImageFont
from tissue_picture import Blade, Camera, Surface, draw

PACKAGE = pathlib.Path(__file__).resolve().parent.parent
EVERY = 2  # steps from surface to surface, as scripts/paper_figures asks for


class Run:
    """A replay: its surfaces over time, its fractures, and where the blade was."""

    def __init__(self, folder, config, bag):
        self.folder = folder
        self.settings = yaml.safe_load((PACKAGE / "config" / f"{config}.yaml").read_text())
        self.times = numpy.array([float(row["t"]) for row in csv.DictReader(open(folder / "steps.csv"))])
        self.fractures = [float(row["t"]) for row in csv.DictReader(open(folder / "events.csv"))]
        with rosbag.Bag(str(PACKAGE / "test/bags" / f"{bag}.bag")) as file:
            messages = [message for _, message, _ in file.read_messages("tool/measured_cp")]
        self.stamps = numpy.array([message.header.stamp.to_sec() for message in messages])
        self.poses = [message.pose for message in messages]

    def moment(self, surface):
        """Time (s) of a surface."""
        return self.times[(surface + 1) * EVERY - 1]

    def surface_at(self, time):
        """Number of the last surface up to a time (s)."""
        return max(0, int(numpy.searchsorted(self.times, time, "right")) // EVERY - 1)

    def units(self, wanted):
        """Numbers of the surfaces just before the fractures of some units, and of those a little later.

        Units are given by their place among all, from 0 (the first) to 1 (the last).
        """
        ends = [self.fractures[round(place * (len(self.fractures) - 1))] for place in wanted]
        return [surface for end in ends for surface in (self.surface_at(end - 0.01), self.surface_at(end + 0.1))]

    def blade(self, surface):
        return Blade(self.settings["blade"], self.pose(self.moment(surface)))

    def tile(self, surface, camera):
        mesh = Surface.read(self.folder / f"surface_{surface:04d}.ply")
        label_colours = self.settings.get("surface", {}).get("label_colours", [])
        return draw(mesh, {c["label"]: c["colour"] for c in label_colours}, self.blade(surface), camera)

    def pose(self, time):
        """The recorded pose next to a time: at 50 Hz that is near enough for a picture."""
        return self.poses[int(numpy.argmin(abs(self.stamps - time)))]


def label(text, length):
    """A line of text, centred in a white strip of a length (pixels)."""
    image = Image.new("RGB", (length, 34), "white")
    font = ImageFont.truetype("DejaVuSans.ttf", 20)
    ImageDraw.Draw(image).text((length // 2, 17), text, "black", font, anchor="mm")
    return numpy.asarray(image)


def sheet(rows, row_names, column_names):
    """Tiles put together, with white lines in between, names over the columns and, turned, beside the rows."""
    padded = [[numpy.pad(tile, ((2, 2), (2, 2), (0, 0)), constant_values=255) for tile in row] for row in rows]
    sides = [numpy.rot90(label(name, row[0].shape[0])) for name, row in zip(row_names, padded, strict=True)]
    lines = [numpy.hstack([side, *row]) for side, row in zip(sides, padded, strict=True)]
    top = [label(name, tile.shape[1]) for name, tile in zip(column_names, padded[0], strict=True)]
    corner = numpy.full((34, 34, 3), 255, numpy.uint8)
    return numpy.vstack([numpy.hstack([corner, *top]), *lines])


def inset(tile, close_up):
    """A smaller tile in the lower right corner of another, framed."""
    framed = numpy.pad(close_up, ((2, 2), (2, 2), (0, 0)), constant_values=255)
    height, width = framed.shape[:2]
    tile = tile.copy()
    tile[-height:, -width:] = framed
    return tile


def save(path, picture):
    Image.fromarray(picture).quantize(256, kmeans=3, dither=Image.Dither.NONE).save(path, optimize=True)
    print(path, picture.shape, path.stat().st_size // 1000, "kB")


LIVER = Camera(focus=(0.172, 0.036, 0.105), away=(0.58, -0.8, 0.15), distance=0.085, size=(400, 320))
WIDTH = (266, 230)
MODELS = {  # places of the units shown, camera
    "bunny": ((0.25, 0.75, 1.0), Camera((0.016, 0.0, 0.008), (0.3, -1.0, 0.6), 0.075, WIDTH)),
    "bread": ((0.1, 0.24, 0.42), Camera((0.045, 0.04, 0.045), (-0.35, -1.0, 0.65), 0.19, WIDTH)),
    "steak": ((0.25, 0.55, 1.0), Camera((0.08, 0.035, 0.012), (-0.3, -1.0, 0.8), 0.125, WIDTH)),
}


def close_up(run, surface):
    """From above the cut, with the edge drawn in."""
    blade = run.blade(surface)
    focus = blade.edge.mean(axis=0)
    return run.tile(surface, Camera(focus, blade.spine[0] - blade.edge[0], 0.038, (180, 216), trace=True))


def liver(results):
    """Rows: immediate, delayed, delayed with adaptation; at the same times."""
    runs = [Run(results / f"liver_{name}", "liver", "liver_press") for name in ("immediate", "delayed", "adaptation")]
    shown = runs[2].units((0.0, 0.6))
    rows = []
    for run in runs:
        last = run.surface_at(run.times[-1])
        tiles = [run.tile(surface, LIVER) for surface in (*shown[:3], last)]
        rows.append([inset(tile, close_up(run, surface)) for tile, surface in zip(tiles, shown[:3])] + tiles[3:])
    return sheet(rows, ("immediate", "delayed", "delayed, adaptation"),
                 ("before a fracture", "after it", "before a later one", "the blade is out"))


def models(results):
    """Three units each, before and after their fracture."""
    bags = {"bunny": "bunny_cut", "bread": "bread_slices", "steak": "steak_cut"}
    rows = []
    for name, (units, camera) in MODELS.items():
        run = Run(results / name, name, bags[name])
        rows.append([run.tile(surface, camera) for surface in run.units(units)])
    return sheet(rows, MODELS, ["deformed", "cut"] * 3)


if __name__ == "__main__":
    results_folder, doc_folder = (pathlib.Path(argument) for argument in sys.argv[1:3])
    save(doc_folder / "paper_fig6.png", liver(results_folder))
    save(doc_folder / "paper_fig7.png", models(results_folder))
