#!/usr/bin/env python3
"""Holds `rosbag play` back while the simulation lags, so that the tool in tf and the tissue are shown at one time.
Expects the player to have been started with --pause."""

import rospy
from cfem_cutting.msg import StepReport
from std_msgs.msg import String
from std_srvs.srv import SetBool

LARGEST_LAG = 0.1  # s; the longest time step, or a halted player might wait for a step that waits for a pose


def main():
    rospy.init_node("pace_playback")
    pause = rospy.ServiceProxy("playback/pause_playback", SetBool, persistent=True)
    rospy.wait_for_message("operating_state_name", String)  # the tissue is ready
    pause.wait_for_service()
    paused = True

    def let_play(playing):
        nonlocal paused
        if paused != playing:
            return
        try:
            pause(not playing)
            paused = not playing
        except rospy.ServiceException:
            rospy.signal_shutdown("the bag has been played")

    let_play(True)
    rospy.Subscriber("step_report", StepReport, lambda report: let_play(report.lag <= LARGEST_LAG), tcp_nodelay=True)
    rospy.spin()


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
