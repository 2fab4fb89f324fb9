"""What the tests of the running node share."""

import csv
import math
import os
import signal
import subprocess
import tempfile
import threading
import time
import unittest

import rospkg
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, WrenchStamped
from std_msgs.msg import String
from std_srvs.srv import Trigger

from cfem_cutting.msg import FractureEvent, StepReport
from cfem_cutting.srv import GetEvents

PACKAGE = rospkg.RosPack().get_path("cfem_cutting")
BOX = os.path.join(PACKAGE, "test", "rostest", "box.yaml")
SLICE = os.path.join(PACKAGE, "test", "bags", "straight_slice.bag")
PATIENCE = 120.0  # s; only a hang takes as long


def wait_until(condition, what, seconds=PATIENCE):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end or rospy.is_shutdown():
            raise AssertionError("waited %g s in vain until %s" % (seconds, what))
        time.sleep(0.02)


def play(bag, *options):
    """Starts rosbag play for the topics that the node listens to."""
    return subprocess.Popen(["rosbag", "play", "--quiet", "--wait-for-subscribers", bag, *options])


def replay(bag, *options):
    """Runs replay offline with the tests' box; returns its events as dictionaries of numbers."""
    out = tempfile.mkdtemp()
    subprocess.run(["rosrun", "cfem_cutting", "replay", "--config", BOX, "--bag", bag, "--out", out, *options],
                   check=True, stdout=subprocess.DEVNULL)
    with open(os.path.join(out, "events.csv")) as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def force(wrench):
    f = wrench.wrench.force
    return math.sqrt(f.x * f.x + f.y * f.y + f.z * f.z)


def is_zero(wrench):
    t = wrench.wrench.torque
    return force(wrench) == 0 and (t.x, t.y, t.z) == (0, 0, 0)


def make_pose(stamp, xyz, quaternion=(0, 0.29552, 0, 0.95534), frame="tissue"):
    """A pose of the blade with its tip down."""
    pose = PoseStamped()
    pose.header.stamp = rospy.Time.from_sec(stamp) if stamp else rospy.Time()
    pose.header.frame_id = frame
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = xyz
    o = pose.pose.orientation
    o.x, o.y, o.z, o.w = quaternion
    return pose


def slice_poses(start, seconds=3.0, rate=50.0):
    """Stamped positions of a blade that goes down into the box and is drawn through it."""
    count = int(seconds * rate)
    for i in range(count + 1):
        s = i / count
        yield start + i / rate, (0.06 - 0.05 * s, 0.05, 0.07 - 0.03 * min(1.0, 2 * s))


class NodeTest(unittest.TestCase):
    """Listens to a running cutting_node."""

    node = "cutting_node"
    state = "operating_state_name"

    def setUp(self):
        self.lock = threading.Lock()
        self.steps, self.events, self.wrenches, self.states, self.diagnostics = [], [], [], [], {}
        hints = dict(tcp_nodelay=True)
        self.subscribers = [
            rospy.Subscriber("step_report", StepReport, self.steps.append, **hints),
            rospy.Subscriber("fracture_events", FractureEvent, self.events.append),
            rospy.Subscriber("tool/body/measured_cf", WrenchStamped, self.wrenches.append, **hints),
            rospy.Subscriber(self.state, String, lambda m: self.states.append(m.data)),
            rospy.Subscriber("/diagnostics", DiagnosticArray, self.keep_diagnostics),
        ]
        self.poses = rospy.Publisher("tool/measured_cp", PoseStamped, queue_size=100000, tcp_nodelay=True)
        wait_until(lambda: self.states, "the node says how it is")
        wait_until(lambda: all(s.get_num_connections() for s in self.subscribers[:3]), "the node is connected")
        wait_until(lambda: self.poses.get_num_connections(), "the node takes poses")
        self.call("reset")
        del self.steps[:], self.events[:], self.wrenches[:]

    def tearDown(self):
        for subscriber in self.subscribers:
            subscriber.unregister()
        self.poses.unregister()

    def keep_diagnostics(self, message):
        for status in message.status:
            if status.name.startswith(self.node + ":"):
                kept = {value.key: value.value for value in status.values}
                kept["message"], kept["level"] = status.message, status.level
                self.diagnostics[status.name.split(": ")[1]] = kept

    def count(self, key):
        return int(self.diagnostics.get("tool input", {}).get(key, 0))

    def call(self, name):
        rospy.wait_for_service(self.node + "/" + name, PATIENCE)
        return rospy.ServiceProxy(self.node + "/" + name, Trigger)()

    def all_events(self):
        return rospy.ServiceProxy(self.node + "/get_events", GetEvents)().events

    def wait_for_step(self, stamp):
        wait_until(lambda: self.steps and self.steps[-1].header.stamp.to_sec() >= stamp - 0.0101,
                   "the step at %.3f" % stamp)

    def send_slice(self, start, **options):
        last = start
        for last, xyz in slice_poses(start, **options):
            self.poses.publish(make_pose(last, xyz))
        return last
