#!/usr/bin/env python3
"""Watches the running demo until every pose of the bag is stepped, sums up, and takes pictures of the screen if asked
to. Exits with one line on standard error if anything is wrong. Usage: watch_demo.py BAG OUTPUT_DIR [--pictures]"""

import json
import pathlib
import signal
import subprocess
import sys
import time

import numpy
import rosbag
import rospy
from cfem_cutting.msg import StepReport
from cfem_cutting.srv import GetEvents, SaveSurface
from geometry_msgs.msg import WrenchStamped

PATIENCE = 60.0  # s, for the next step
DENT = 0.0025  # m, largest offset that is worth a picture
COLOURS = {"skin": (0.54, 0.16, 0.13), "cut face": (0.88, 0.36, 0.34)}  # as in src/ros/markers.cpp


def take_picture(path):
    subprocess.check_call(["import", "-silent", "-window", "root", path])
    return path


def check_picture(path):
    """It has to show skin and cut faces: a lit colour keeps its hue."""
    data = subprocess.check_output(["convert", path, "-depth", "8", "rgb:-"])
    pixels = numpy.frombuffer(data, numpy.uint8).reshape(-1, 3) / 255.0 + 1e-6
    for name, colour in COLOURS.items():
        hue_error = abs(pixels / pixels[:, :1] - numpy.array(colour) / colour[0]).max(axis=1)
        if ((hue_error < 0.04) & (pixels[:, 0] > 0.1)).mean() < 0.001:
            sys.exit(f"no {name} is to be seen in {path}")


class Watch:
    def __init__(self):
        self.report, self.steps, self.peak_force = None, 0, 0.0
        self.began = self.newest = self.shown = time.monotonic()
        rospy.Subscriber("step_report", StepReport, self.on_report, tcp_nodelay=True)
        rospy.Subscriber("tool/body/measured_cf", WrenchStamped, self.on_wrench, tcp_nodelay=True)

    def on_report(self, report):
        self.newest = time.monotonic()
        if self.steps == 0:
            self.began = self.newest
        self.report, self.steps = report, self.steps + 1

    def on_wrench(self, message):
        force = message.wrench.force
        self.peak_force = max(self.peak_force, numpy.linalg.norm([force.x, force.y, force.z]))

    def wait_for(self, condition):
        """Waits for a step whose report meets the condition."""
        while not (self.report and condition(self.report)):
            time.sleep(0.02)
            if time.monotonic() - self.newest > PATIENCE:
                sys.exit(f"no step for {PATIENCE:.0f} s")
            if self.report and time.monotonic() - self.shown > 5.0:
                self.shown = time.monotonic()
                print(f"step {self.steps}, fractures so far: {self.report.unit - 1}", flush=True)


def sum_up(watch):
    return {
        "steps": watch.steps,
        "fracture_events": len(rospy.ServiceProxy("cutting_node/get_events", GetEvents)().events),
        "cut_area_m2": watch.report.cut_area,
        "pieces": watch.report.pieces,
        "peak_force_n": watch.peak_force,
        "steps_per_second": watch.steps / (watch.newest - watch.began),
    }


def main(bag, output_dir, with_pictures):
    with rosbag.Bag(bag) as poses:
        end = max(pose.header.stamp.to_sec() for _, pose, _ in poses.read_messages("tool/measured_cp"))
    rospy.init_node("watch_demo", disable_signals=True)
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    watch = Watch()
    if with_pictures:
        watch.wait_for(lambda report: report.unit > 1 and report.largest_offset > DENT)
        take_picture(output_dir / "dented.png")
    watch.wait_for(lambda report: report.header.stamp.to_sec() > end - rospy.get_param("cutting_node/solver/time_step"))
    if with_pictures:
        time.sleep(2.0)  # until the last step is drawn
        check_picture(take_picture(output_dir / "demo.png"))
    figures = sum_up(watch)
    if figures["fracture_events"] == 0:
        sys.exit("nothing was cut")
    saved = rospy.ServiceProxy("cutting_node/save_surface", SaveSurface)("surface")
    if not saved.success:
        sys.exit(f"no surface was saved: {saved.message}")
    (output_dir / "summary.json").write_text(json.dumps(figures, indent=2) + "\n")
    print("\n" + "\n".join(f"{name:17} {figure:.4g}" for name, figure in figures.items()))


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]), "--pictures" in sys.argv[3:])
