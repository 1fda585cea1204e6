"""Run by the environment of the peers: robotics-toolbox ``fkine`` on the RX-90.

Usage: python peer_fkine.py joints.npy poses.npy a3 d3. Writes the poses, prints
``{"seconds": ...}``. Imports nothing of ours: it is another environment.
"""

import json
import sys
from math import pi
from time import perf_counter

import numpy as np
from roboticstoolbox import DHRobot, RevoluteMDH


def main(joints_file, poses_file, a3, d3):
    robot = DHRobot(
        [
            RevoluteMDH(),
            RevoluteMDH(alpha=pi / 2),
            RevoluteMDH(a=float(a3)),
            RevoluteMDH(alpha=-pi / 2, d=float(d3)),
            RevoluteMDH(alpha=pi / 2),
            RevoluteMDH(alpha=-pi / 2),
        ]
    )
    q = np.load(joints_file)
    robot.fkine(q[:10])
    start = perf_counter()
    poses = robot.fkine(q)
    seconds = perf_counter() - start
    np.save(poses_file, poses.A)
    print(json.dumps({"seconds": seconds}))


main(*sys.argv[1:])
