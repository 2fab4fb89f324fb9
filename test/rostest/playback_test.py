#!/usr/bin/env python3
"""A bag played to the node in lossless timing gives what replay gives, and everything that the node publishes."""

import os

import rosbag
import rospy
import rostest
from visualization_msgs.msg import Marker, MarkerArray

from cfem_cutting.msg import ContactForces, SurfaceMesh
from cfem_cutting.srv import SaveSurface

from node_test import SLICE, NodeTest, force, is_zero, play, replay, wait_until


class PlaybackTest(NodeTest):
    def setUp(self):
        super().setUp()
        self.markers, self.surfaces, self.contacts = [], [], []
        self.subscribers += [
            rospy.Subscriber("tissue/markers", MarkerArray, self.markers.append),
            rospy.Subscriber("tissue/surface", SurfaceMesh, self.surfaces.append),
            rospy.Subscriber("contact_forces", ContactForces, self.contacts.append),
        ]
        wait_until(lambda: all(s.get_num_connections() for s in self.subscribers), "the node is connected")

    def play_to_the_end(self):
        with rosbag.Bag(SLICE) as bag:
            last = max(m.header.stamp.to_sec() for _, m, _ in bag.read_messages("tool/measured_cp"))
        self.assertEqual(play(SLICE).wait(), 0)
        self.wait_for_step(last)
        wait_until(lambda: is_zero(self.wrenches[-1]), "a zero wrench follows the last pose")

    def test_playback_equals_replay(self):
        self.play_to_the_end()
        expected = replay(SLICE)
        self.assertGreater(len(expected), 3)
        wait_until(lambda: len(self.events) >= len(expected), "all events are here")
        for events in (self.events, self.all_events()):
            self.assertEqual([e.unit for e in events], [e["unit"] for e in expected])
            self.assertEqual([e.links_severed for e in events], [e["links_severed"] for e in expected])
            for event, row in zip(events, expected):
                self.assertAlmostEqual(event.area, row["area"], delta=1e-9)
                self.assertAlmostEqual(event.header.stamp.to_sec(), row["t"], delta=1e-6)
        self.check_steps()
        self.check_scene()
        self.check_saving()

    def check_steps(self):
        stamps = [step.header.stamp.to_sec() for step in self.steps]
        self.assertEqual(stamps, sorted(stamps))
        self.assertAlmostEqual(stamps[-1] - stamps[0], 0.01 * (len(stamps) - 1), delta=1e-5)  # none is missing
        self.assertEqual(len(self.contacts), len(self.steps))
        self.assertTrue(any(force(wrench) > 0.01 for wrench in self.wrenches))
        self.assertEqual(self.wrenches[0].header.frame_id, "scalpel")

    def check_scene(self):
        wait_until(lambda: self.surfaces and any(self.surfaces[-1].cut), "the cut is seen")
        surface = self.surfaces[-1]
        self.assertEqual(surface.header.frame_id, "tissue")
        self.assertEqual(len(surface.vertices), len(surface.normals))
        self.assertEqual(len(surface.vertices), 3 * len(surface.scalars))
        self.assertEqual(len(surface.triangles), 3 * len(surface.cut))
        self.assertLess(max(surface.triangles), len(surface.scalars))
        ids = {(m.ns, m.id) for array in self.markers for m in array.markers}
        self.assertEqual(ids, {("skin", 0), ("cut_faces", 1), ("blade", 2), ("force", 3)})
        last = {m.ns: m for m in self.markers[-1].markers}
        for name in ("skin", "cut_faces", "blade"):
            self.assertEqual(last[name].action, Marker.ADD, name)
            self.assertEqual(len(last[name].points) % 3, 0)
            self.assertFalse(last[name].colors, "rviz lights markers of one colour only")

    def check_saving(self):
        save = rospy.ServiceProxy("cutting_node/save_surface", SaveSurface)
        answer = save("cut")
        self.assertTrue(answer.success, answer.message)
        self.assertTrue(os.path.isfile(answer.path))
        os.remove(answer.path)
        for path in ("../cut", "/tmp/cut", "", ".cut", "a b"):
            self.assertFalse(save(path).success, path)

    def test_pause_lets_go(self):
        self.assertTrue(self.call("pause").success)
        wait_until(lambda: self.states[-1] == "PAUSED", "the node is paused")
        wait_until(lambda: self.wrenches and is_zero(self.wrenches[-1]), "a zero wrench is sent")
        self.send_slice(5000.0, seconds=0.2)
        rospy.sleep(0.5)
        self.assertFalse(self.steps)
        self.assertTrue(self.call("reset").success)
        rospy.sleep(0.2)
        self.assertEqual(self.states[-1], "PAUSED", "a reset lets nothing go on")
        self.assertTrue(self.call("resume").success)
        wait_until(lambda: self.states[-1] == "ENABLED", "the node goes on")


if __name__ == "__main__":
    rospy.init_node("playback_test")
    rostest.rosrun("cfem_cutting", "playback", PlaybackTest)
