#!/usr/bin/env python3
"""Transforms that come late, frames that are never known, and time that runs backwards."""

import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

from node_test import SLICE, NodeTest, make_pose, play, slice_poses, wait_until


class TfAndTimeTest(NodeTest):
    def send_transform(self, publisher, stamp, frame):
        transform = TransformStamped()
        transform.header.stamp = rospy.Time.from_sec(stamp)
        transform.header.frame_id = "tissue"
        transform.child_frame_id = frame
        transform.transform.translation.y = 0.02
        transform.transform.rotation.w = 1
        publisher.publish(TFMessage([transform]))

    def test_poses_wait_for_tf(self):
        tf = rospy.Publisher("/tf", TFMessage, queue_size=1000)
        wait_until(lambda: tf.get_num_connections(), "the node listens to tf")
        for stamp, (x, y, z) in slice_poses(1000.0):
            self.poses.publish(make_pose(stamp, (x, y - 0.02, z), frame="robot"))
        rospy.sleep(1.5)
        self.assertFalse(self.steps)
        for at in (999.9, stamp + 0.1):
            self.send_transform(tf, at, "robot")
        self.wait_for_step(stamp)
        late = [(e.unit, e.links_severed) for e in self.all_events()]
        self.call("reset")
        self.wait_for_step(self.send_slice(2000.0))
        self.assertEqual(late, [(e.unit, e.links_severed) for e in self.all_events()])

    def test_bag_played_twice(self):
        self.assertEqual(play(SLICE).wait(), 0)
        wait_until(lambda: self.diagnostics and self.count("received") == self.count("used"), "it is all used")
        jumps = self.count("time_jumps")
        steps = len(self.steps)
        severed = self.steps[-1].links_severed
        self.assertGreater(severed, 0)
        self.assertEqual(play(SLICE).wait(), 0)
        wait_until(lambda: self.count("time_jumps") == jumps + 1, "the jump is counted")
        wait_until(lambda: len(self.steps) >= 2 * steps - 1, "the bag's steps are taken again")
        self.assertGreaterEqual(self.steps[-1].links_severed, severed)  # the tissue is kept
        self.assertEqual(self.states[-1], "ENABLED")


if __name__ == "__main__":
    rospy.init_node("tf_and_time_test")
    rostest.rosrun("cfem_cutting", "tf_and_time", TfAndTimeTest)
