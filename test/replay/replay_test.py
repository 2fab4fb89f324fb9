#!/usr/bin/env python3
"""The replay program from its command line: cuts of boxes and of every other tissue, and what it refuses.

usage: replay_test.py REPLAY PACKAGE [--bags]   (--bags: it was built with ROS and reads bags)
"""

import copy
import csv
import filecmp
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

REPLAY, PACKAGE = sys.argv[1:3]
WITH_BAGS = "--bags" in sys.argv
BOX = os.path.join(PACKAGE, "config", "gelatine_box.yaml")
# The bunny as its mesh is, with y upwards, held at its feet only.
BUNNY = ["tissue.rpy=[0,0,0]", "tissue.fixed=[{box: {min: [-1,-1,-1], max: [1,-0.045,1]}}]", "tissue.composite_level=1"]
OPEN_MESH = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n"
needs_bags = unittest.skipUnless(WITH_BAGS, "built without ROS")


def bag(name):
    return os.path.join(PACKAGE, "test", "bags", name + ".bag")


def write_stroke(path, bottom, seconds=3.0, rate=50):
    """A horizontal edge along x, wider than the box, pressed straight down from above it to a height (m)."""
    count = int(seconds * rate)
    with open(path, "w") as file:
        file.write("t,x,y,z,qx,qy,qz,qw\n")
        for i in range(count + 1):
            file.write("%.9g,-0.01,0.0513,%.9g,0,0,0,1\n" % (i / rate, 0.053 + (bottom - 0.053) * i / count))


def write_path(path, waypoints, speed=0.03, rate=100):
    """A tool that is not turned, along waypoints (m) at a speed (m/s)."""
    points = [waypoints[0]]
    for a, b in zip(waypoints, waypoints[1:]):
        count = max(1, round(sum((q - p) ** 2 for p, q in zip(a, b)) ** 0.5 / speed * rate))
        points += [[p + (q - p) * (i + 1) / count for p, q in zip(a, b)] for i in range(count)]
    with open(path, "w") as file:
        file.write("t,x,y,z,qx,qy,qz,qw\n")
        for i, point in enumerate(points):
            file.write("%.9g,%.12g,%.12g,%.12g,0,0,0,1\n" % (i / rate, *point))


class ReplayTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def start(self, out, *arguments, config=BOX):
        return subprocess.run([REPLAY, "--config", config, "--out", self.path(out), *arguments],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, timeout=500)

    def replay(self, out, *arguments, config=BOX):
        done = self.start(out, *arguments, config=config)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.path(out), "summary.json")) as file:
            return json.load(file)

    def rows(self, out, table):
        with open(os.path.join(self.path(out), table)) as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]

    def stroke(self, bottom):
        write_stroke(self.path("poses.csv"), bottom)
        return ["--poses", self.path("poses.csv"), "--set", "blade.edge=[[0,0,0],[0.12,0,0]]"]


class Cuts(ReplayTest):
    def test_through_cut_and_stopped_cut_on_each_level(self):
        for level in (0, 1, 2):
            options = ["--set", "tissue.composite_level=%d" % level, "--set", "tissue.voxel_size=0.005"]
            through = self.replay("through", *self.stroke(-0.008), *options)
            self.assertEqual(through["pieces"], 2, level)
            self.assertAlmostEqual(sum(through["piece_volumes_m3"]), 0.1 * 0.1 * 0.05, delta=1e-15)
            self.assertAlmostEqual(through["cut_area_m2"], 0.1 * 0.05, delta=0.02 * 0.1 * 0.05)
            self.assertTrue(through["surface"]["closed"] and through["surface"]["manifold"])
            self.assertEqual(self.replay("stopped", *self.stroke(0.010), *options)["pieces"], 1, level)

    def test_links_of_a_urdf_take_the_place_of_the_configured_edge(self):
        urdf = os.path.join(PACKAGE, "urdf", "scalpel_no11.urdf")
        blade = ("blade.edge=[]", "blade.edge_links=[heel, tip]", "blade.urdf=" + urdf)
        summary = self.replay("out", "--duration", "0.02", *[o for s in blade for o in ("--set", s)])
        self.assertEqual(summary["steps"], 2)

    def test_immediate_mode_fractures_in_every_step_that_meets_links(self):
        self.replay("out", *self.stroke(0.01), "--set", "fracture.mode=immediate")
        steps, severed = self.rows("out", "steps.csv"), 0.0
        self.assertGreater(steps[-1]["links_severed"], 0)
        for step in steps:
            self.assertEqual(step["candidates"], 0)
            self.assertEqual(step["phase"] == 2, step["links_severed"] > severed)
            severed = step["links_severed"]

    def test_delayed_mode_is_a_saw(self):
        # d0 = 3 mm on voxels of 4 mm, as shipped: no unit is shorter than d0 but the last ones.
        summary = self.replay("out", *self.stroke(0.01))
        events, steps = self.rows("out", "events.csv"), self.rows("out", "steps.csv")
        self.assertGreaterEqual(len(events), 3)
        self.assertLess(len(events), 0.053 / 0.003)
        for event in events:
            after = [s["fz"] for s in steps if event["t"] < s["t"] < event["t"] + 0.05]
            self.assertGreater(event["peak_force"], 2.0 * min(abs(f) for f in after))
        self.assertGreater(summary["blade_work_j"], summary["fracture_work_j"])

    def test_front_of_every_step_adds_up_to_the_summary(self):
        summary = self.replay("out", *self.stroke(0.01))
        rows = self.rows("out", "front.csv")
        self.assertEqual(len(rows), summary["steps"])
        for part in ("crease", "cut_end", "covered"):
            whole = summary["front"][part]
            self.assertEqual(sum(row[part + "_samples"] for row in rows), whole["samples"])
            self.assertAlmostEqual(max(row[part + "_max"] for row in rows), whole["max_m"], delta=1e-12)
        self.assertGreater(summary["front"]["crease"]["samples"], 0)
        self.assertEqual(sum(row["buried_samples"] for row in rows), summary["front"]["buried_samples"])

    @needs_bags
    def test_liver_bunny_bread_and_steak(self):
        cuts = (("liver", "liver_incision"), ("bunny", "bunny_cut"), ("bread", "bread_slices"), ("steak", "steak_cut"))
        for config, name in cuts:
            file = os.path.join(PACKAGE, "config", config + ".yaml")
            summary = self.replay(config, "--bag", bag(name), config=file)
            self.assertGreaterEqual(summary["fracture_events"], 3, config)
            self.assertGreater(summary["links_severed"], 10, config)
            self.assertTrue(summary["surface"]["closed"] and summary["surface"]["manifold"], config)
            if config in ("bunny", "steak"):  # straight edges; the steak's runs in an earlier cut for a part
                for part in ("crease", "cut_end"):
                    self.assertLess(summary["front"][part]["max_m"], 3e-5, (config, part))

    @needs_bags
    def test_crease_and_cut_end_are_on_the_edge_beside_an_earlier_cut_and_in_a_stab(self):
        for name in ("repeated_strokes", "stab_and_draw"):
            summary = self.replay(name, "--bag", bag(name))
            for part in ("crease", "cut_end"):
                self.assertGreater(summary["front"][part]["samples"], 500, (name, part))
                self.assertLess(summary["front"][part]["max_m"], 4e-5, (name, part))
            self.assertEqual(summary["front"]["buried_samples"], 0, name)
            # No pit is left where the edge went in and out: that of the box of voxels' centres, to 0.002 %.
            self.assertAlmostEqual(summary["surface"]["volume_m3"], 4.992e-4, delta=1e-8, msg=name)
            self.assertEqual(summary["surface"]["flipped"] + summary["surface"]["degenerate"], 0, name)

    def test_cut_of_an_edge_whose_heel_leaves_ends_where_the_heel_was(self):
        # Without an end to it, the trace ran on to the skin, a voxel beyond what was swept.
        write_path(self.path("poses.csv"), [(0.031588, 0.011193, 0.050349), (0.031588, 0.011193, 0.030349),
                                            (0.019588, -0.000807, 0.026349)])
        settings = ["blade.edge=[[0,0,0],[0.003941,0.021653,-0.01731]]", "blade.back=[0,0,1]", "tissue.voxel_size=0.002",
                    "tissue.box_size=[0.064,0.048,0.032]", "tissue.fixed=[{box: {min: [-1,-1,-1], max: [1,1,0.001]}}]"]
        summary = self.replay("out", "--poses", self.path("poses.csv"), *[o for s in settings for o in ("--set", s)])
        for part in ("crease", "cut_end"):
            self.assertGreater(summary["front"][part]["samples"], 300)
            self.assertLess(summary["front"][part]["max_m"], 0.01 * 0.002)
        self.assertLess(summary["cut_faces"]["max_m"], 0.2 * 0.002)

    def test_crease_and_cut_end_are_on_the_edge_on_liver_and_bunny(self):
        # Straight edges in the tissue's frame: across the liver's front, with the tip in it from the first pose on, across the
        # bunny, and with the tip in its back.
        across = ["blade.edge=[[0,0,0],[0,0.0199,0.199]]", "blade.back=[0,-1,0]"]
        stab = ["blade.edge=[[0,0,0],[0,0.02425,0.014]]", "blade.back=[0,-0.5,0.866]"]
        tip = BUNNY + ["blade.edge=[[0,0,0],[0,-0.01582,0.0231]]", "blade.back=[0,0.825,0.565]"]
        over = BUNNY + ["blade.edge=[[0,0,0],[0.1193,0.00597,0.01193]]", "blade.back=[0,1,0]"]
        cuts = (("liver", 0.008, across, [(0.173, -0.01, 0.02), (0.173, 0.03, 0.02)]),
                ("liver", 0.004, across, [(0.173, -0.01, 0.02), (0.173, 0.03, 0.02)]),
                ("liver", 0.004, stab, [(0.172, 0.009, 0.128), (0.172, 0.024, 0.128), (0.172, 0.024, 0.092)]),
                ("bunny", 0.004, over, [(-0.06, 0.05, -0.012), (-0.06, 0.0, -0.012)]),
                ("bunny", 0.004, tip, [(0.02, 0.036, 0.012), (0.02, 0.018, 0.01), (0.02, 0.017, -0.04)]))
        for config, voxel, blade, waypoints in cuts:
            write_path(self.path("poses.csv"), waypoints)
            settings = [o for s in blade + ["tissue.voxel_size=%g" % voxel] for o in ("--set", s)]
            summary = self.replay("%s%g" % (config, voxel), "--poses", self.path("poses.csv"), *settings,
                                  config=os.path.join(PACKAGE, "config", config + ".yaml"))
            for part in ("crease", "cut_end", "vertices"):
                self.assertGreater(summary["front"][part]["samples"], 100, (config, voxel, part))
                self.assertLess(summary["front"][part]["max_m"], 0.01 * voxel, (config, voxel, part))
            if blade is not over:  # its ears lap over the edge when they are cut off
                self.assertEqual(summary["front"]["covered"]["samples"], 0, (config, voxel))
            self.assertEqual(summary["surface"]["flipped"] + summary["surface"]["degenerate"], 0)
            self.assertGreater(summary["cut_faces"]["samples"], 100)
            self.assertIn("max_m", summary["cut_faces"]["held_corners"])
            self.assertLess(summary["cut_faces"]["max_m"], 0.1 * voxel, (config, voxel))

    def test_crease_and_cut_end_stay_in_their_tissue_where_the_bunnys_ears_fold(self):
        # Ears of a voxel or two, which bend round the edge, beside pieces that only touch them. Traces that went on into
        # those, joined contact points of two pieces, or led back along the edge, left it by up to 0.7 voxel; vertices of a
        # piece that the trace is not in by 0.01.
        cuts = ((0.008, [0.11862609, 0.00094304, 0.01808210], (-0.06055725, -0.01078274), (0.05104831, 0.00104831), 0.05),
                (0.004, [0.11862609, 0.00094304, 0.01808210], (-0.06055725, -0.01078274), (0.05104831, 0.00104831), 0.05),
                (0.008, [0.11859808, 0.01064249, 0.01487389], (-0.05872877, -0.01034278), (0.05003610, 0.00003610), 0.015),
                (0.004, [0.11960630, -0.00340280, 0.00909689], (-0.05862819, -0.01115017), (0.04933586, -0.00066414), 0.015))
        for i, (voxel, edge, (x, z), heights, speed) in enumerate(cuts):
            write_path(self.path("poses.csv"), [(x, y, z) for y in heights], speed)
            settings = BUNNY + ["blade.edge=[[0,0,0],%s]" % edge, "blade.back=[0,1,0]", "tissue.voxel_size=%g" % voxel]
            summary = self.replay("out%d" % i, "--poses", self.path("poses.csv"), *[o for s in settings for o in ("--set", s)],
                                  config=os.path.join(PACKAGE, "config", "bunny.yaml"))
            for part in ("crease", "cut_end"):
                self.assertLess(summary["front"][part]["max_m"], 0.01 * voxel, (i, part))
            self.assertGreater(summary["front"]["crease"]["samples"], 500)
            self.assertEqual(summary["surface"]["flipped"] + summary["surface"]["degenerate"], 0)

    @needs_bags
    def test_blade_that_touches_nothing_is_told(self):
        summary = self.replay("out", "--bag", bag("straight_slice"), "--set", "blade.edge=[[0.5,0,0],[0.6,0,0]]")
        self.assertEqual(len(summary["warnings"]), 1, summary["warnings"])
        for words in ("touched no tissue", "the tissue is within [0, 0, 0] to [0.1, 0.1, 0.0"):
            self.assertIn(words, summary["warnings"][0])

    @needs_bags
    def test_bad_poses_in_a_bag_change_nothing(self):
        import rosbag

        poses = []
        with rosbag.Bag(bag("straight_slice")) as clean:
            messages = list(clean.read_messages())
        with rosbag.Bag(self.path("bad.bag"), "w") as bad:
            for i, (topic, message, time) in enumerate(messages):
                if topic.endswith("measured_cp"):
                    poses.append(message)
                    if len(poses) % 20 == 10:
                        for spoil in (dict(w=float("inf")), dict(x=2.0), dict(x=0.0, y=0.0, z=0.0, w=0.0)):
                            spoilt = copy.deepcopy(message)
                            spoilt.header.stamp += type(time).from_sec(0.001) - type(time)()
                            for key, value in spoil.items():
                                setattr(spoilt.pose.orientation, key, value)
                            bad.write(topic, spoilt, time)
                        bad.write(topic, poses[-5], time)  # late
                bad.write(topic, message, time)
        self.assertGreater(len(poses), 100)
        self.replay("clean", "--bag", bag("straight_slice"))
        summary = self.replay("bad", "--bag", self.path("bad.bag"))
        for table in ("steps.csv", "events.csv"):
            self.assertTrue(filecmp.cmp(*[os.path.join(self.path(o), table) for o in ("clean", "bad")], shallow=False))
        self.assertIn("unit quaternion", " ".join(summary["warnings"]))
        self.assertIn("out of order", " ".join(summary["warnings"]))

    @needs_bags
    def test_same_bag_gives_identical_files_on_any_number_of_threads(self):
        outs = ["first", "second", "third"]
        for out, threads in zip(outs, (1, 1, 2)):
            self.replay(out, "--bag", bag("straight_slice"), "--set", "solver.threads=%d" % threads)
        names = [n for n in os.listdir(self.path("first")) if not n.startswith("timing")]
        self.assertGreater(len(names), 6)
        for out in outs[1:]:
            _, differing, missing = filecmp.cmpfiles(self.path("first"), self.path(out), names, shallow=False)
            self.assertEqual((differing, missing), ([], []))


def nested_keys(figures, prefix=""):
    for key, value in figures.items():
        yield from nested_keys(value, prefix + key + ".") if isinstance(value, dict) else [prefix + key]


class Documentation(ReplayTest):
    def test_every_file_column_and_key_is_explained(self):
        with open(os.path.join(PACKAGE, "doc", "outputs.md")) as file:
            text = file.read()
        sections = {title.split(":")[0]: body for title, body in
                    (section.split("\n", 1) for section in text.split("\n## ")[1:])}
        options = ["--set", "fracture.mode=immediate", "--set", "probes=[[0.05, 0.05, 0.04]]", "--surface-every", "1"]
        self.replay("out", *self.stroke(0.03), *options)
        for name in os.listdir(self.path("out")):
            self.assertIn(re.sub(r"\d{4}", "0000", name), text)
            section = sections["timing.csv and timing.json" if name.startswith("timing") else
                               "Surfaces" if name.endswith(".ply") else name]
            for key in self.keys("out", name):
                self.assertIn("`%s`" % key, section, name)

    def keys(self, out, name):
        """Columns of a table; whole paths of keys, of which distances have the same three at their ends."""
        with open(os.path.join(self.path(out), name), errors="replace") as file:
            if name.endswith(".csv"):
                return next(csv.reader(file))
            if not name.endswith(".json"):
                return []
            keys = set(nested_keys(json.load(file)))
        for key in [k for k in keys if k.endswith(".samples")]:
            distances = key[: -len(".samples")]
            keys -= {distances + end for end in (".max_m", ".mean_m", ".samples")}
            keys |= {distances, "….max_m", "….mean_m", "….samples"}
        return keys


class Refusals(ReplayTest):
    def refuse(self, words, *arguments, config=BOX):
        done = self.start("refused", *arguments, config=config)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertFalse(os.path.exists(self.path("refused")))

    def refuse_setting(self, words, setting):
        self.refuse(words, "--duration", "0.1", "--set", setting)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
        return self.path(name)

    def test_files(self):
        self.refuse(["none.yaml"], "--duration", "1", config=self.path("none.yaml"))
        self.refuse(["none.csv"], "--poses", self.path("none.csv"))
        self.refuse_setting(["tissue.source", "none.off", "No such file"], "tissue.source=" + self.path("none.off"))
        os.mkdir(self.path("folder.off"))
        self.refuse_setting(["folder.off", "Is a directory"], "tissue.source=" + self.path("folder.off"))
        self.refuse_setting(["open.off", "open edges"], "tissue.source=" + self.write("open.off", OPEN_MESH))
        text = "t,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n1,0,many,0,0,0,0,1\n"
        self.refuse(["bad.csv:3", "column y", "many"], "--poses", self.write("bad.csv", text))

    def test_settings(self):
        self.refuse_setting(["tissue.voxelsize", "unknown"], "tissue.voxelsize=0.01")
        self.refuse_setting(["release_offset", "0.003", "less than"], "fracture.release_offset=0.003")
        self.refuse_setting(["poisson_ratio", "0.5"], "tissue.materials=[{poisson_ratio: 0.5}]")
        self.refuse_setting(["tissue.voxel_size", "-0.004"], "tissue.voxel_size=-0.004")
        self.refuse_setting(["voxels", "tissue.voxel_size"], "tissue.voxel_size=0.00008")
        self.refuse_setting(["tissue.voxel_size", "[1, 1, 1]", "[0.1, 0.1, 0.05]"], "tissue.voxel_size=1")
        self.refuse_setting(["blade.edge", "two points"], "blade.edge=[[0,0,0]]")
        self.refuse_setting(["blade.edge_links", "exactly one"], "blade.edge_links=[heel, tip]")

    def test_empty_volume(self):
        config = os.path.join(PACKAGE, "config", "liver.yaml")
        self.refuse(["none of the selected labels"], "--duration", "1", "--set", "tissue.labels=[7]", config=config)

    @needs_bags
    def test_bags(self):
        self.refuse(["none.bag", "No such file"], "--bag", self.path("none.bag"))
        self.refuse(["no.bag", "is no bag"], "--bag", self.write("no.bag", "no bag\n" * 100))
        self.refuse(["no topic", "/elsewhere"], "--bag", bag("straight_slice"), "--topic", "/elsewhere")
        with open(bag("straight_slice"), "rb") as file, open(self.path("cut_off.bag"), "wb") as part:
            part.write(file.read(20000))
        self.refuse(["cut_off.bag", "rosbag reindex"], "--bag", self.path("cut_off.bag"))


class Signals(ReplayTest):
    def test_stopped_run_keeps_what_it_has_apart(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            out = number.name
            run = subprocess.Popen([REPLAY, "--config", BOX, "--out", self.path(out), "--duration", "1000000"],
                                   stderr=subprocess.PIPE, universal_newlines=True)
            self.wait_for_text(os.path.join(self.path(out + ".partial"), "steps.csv"))
            run.send_signal(number)
            _, errors = run.communicate(timeout=60)
            self.assertEqual(run.returncode, 128 + number, errors)
            self.assertEqual(errors.count("\n"), 1, errors)
            steps = len(self.rows(out + ".partial", "steps.csv"))
            for words in (number.name, "after %d steps" % steps, self.path(out + ".partial"), "incomplete"):
                self.assertIn(words, errors)
            self.assertNotIn("summary.json", os.listdir(self.path(out + ".partial")))
            self.assertFalse(os.path.exists(self.path(out)))
            self.replay(out, "--duration", "0.1")
            self.assertFalse(os.path.exists(self.path(out + ".partial")))

    def test_ignored_signal_stays_ignored(self):
        run = subprocess.Popen([REPLAY, "--config", BOX, "--out", self.path("out"), "--duration", "1000000"],
                               stderr=subprocess.PIPE, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
        steps = os.path.join(self.path("out.partial"), "steps.csv")
        self.wait_for_text(steps)
        run.send_signal(signal.SIGINT)
        self.wait_for_text(steps, more_than=2 * os.path.getsize(steps))  # goes on
        run.send_signal(signal.SIGTERM)
        run.communicate(timeout=60)
        self.assertEqual(run.returncode, 128 + signal.SIGTERM)

    def wait_for_text(self, path, more_than=0):
        end = time.monotonic() + 60
        while not (os.path.exists(path) and os.path.getsize(path) > more_than):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
