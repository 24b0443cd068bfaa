"""Calibrates the LiDARs of a simulated car from two scenes and prints the verdicts.

Usage: calibrate.py [FOLDER]. With FOLDER, writes the extrinsics to it for ROS 2 and as CSV.
"""

import sys

import croon

scenes = croon.simulate(2, rig="croon_five", mix={"urban": 1}, noise="real", seed=3)
calibration = croon.calibrate([scene.clouds for scene in scenes], reference="top")
print(calibration)
if len(sys.argv) > 1:
    for path in calibration.save(sys.argv[1], ["ros2", "csv"]):
        print(path)
