#!/usr/bin/env python3
"""The loaf and the steak come out the same every time, and `replay` reads them with their two materials.

usage: make_tissue_test.py REPLAY PACKAGE
"""

import filecmp
import json
import os
import subprocess
import sys
import tempfile
import unittest

REPLAY, PACKAGE = sys.argv[1:3]
SOURCES = {"bread": "bread.nii.gz", "steak": "steak.mha"}


class MakeTissueTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def make(self, name):
        subprocess.run([sys.executable, os.path.join(PACKAGE, "scripts", "make_tissue"), self.path(name)], check=True)

    def mass(self, name, density):
        """kg, with the given densities (kg/m³) of the labels 1 and 2."""
        materials = ",".join("{label: %d, density: %g}" % entry for entry in enumerate(density, 1))
        subprocess.run([REPLAY, "--config", os.path.join(PACKAGE, "config", name + ".yaml"), "--duration", "0.02",
                        "--set", "tissue.source=" + self.path("first", SOURCES[name]),
                        "--set", "tissue.materials=[%s]" % materials, "--out", self.path(name)],
                       check=True, stdout=subprocess.DEVNULL)
        with open(self.path(name, "summary.json")) as file:
            return json.load(file)["mass_kg"]

    def test_the_same_every_time(self):
        self.make("first")
        self.make("second")
        names = sorted(SOURCES.values())
        self.assertEqual(sorted(os.listdir(self.path("first"))), names)
        self.assertEqual(filecmp.cmpfiles(self.path("first"), self.path("second"), names, shallow=False)[0], names)

    def test_two_materials_fill_a_known_volume(self):
        self.make("first")
        for name, volume, share in (("bread", 0.907e-3, 0.63), ("steak", 0.240e-3, 0.22)):  # m³, of label 2
            both = self.mass(name, (1000, 1000)) / 1000
            second = (self.mass(name, (1000, 2000)) - 1000 * both) / 1000
            self.assertAlmostEqual(both, volume, delta=0.02 * volume, msg=name)
            self.assertAlmostEqual(second / both, share, delta=0.03, msg=name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
