#!/usr/bin/env python3
"""Poses of Open3D's global registrations, each refined by GICP, for `"poses"` of a variant.

open3d_poses.py SCENES REFERENCE METHOD OUT_CSV [VOXEL_M]

SCENES is a folder that `croon simulate` wrote; REFERENCE the sensor that the others are calibrated to, "top";
METHOD "ransac" (FPFH features, RANSAC over their matches) or "fgr" (fast global registration, Zhou et al.
2016). Clouds are thinned to one point per VOXEL_M, 0.4 by default; normals and features follow Open3D's own
example (radii of 2 and 5 voxels). The refinement is Open3D's generalized ICP at 0.5 and 0.2 m. No start is
used. Prints the mean processor time per sensor. Needs Debian's python3-open3d; OMP_NUM_THREADS=1 keeps it on
one thread.
"""
import csv
import math
import os
import sys
import time

import numpy as np
import open3d as o3d

REG = o3d.pipelines.registration


def read_cloud(path):
    """The points of a file, without those within a metre of the sensor (the car's own body)."""
    cloud = o3d.io.read_point_cloud(path)
    points = np.asarray(cloud.points)
    far = np.linalg.norm(points, axis=1) >= 1.0
    return cloud.select_by_index(np.nonzero(far)[0])


def features_of(cloud, voxel_m):
    """The thinned cloud with normals, and its FPFH features."""
    thin = cloud.voxel_down_sample(voxel_m)
    thin.estimate_normals(o3d.geometry.KDTreeSearchParamHybrid(radius=2.0 * voxel_m, max_nn=30))
    thin.orient_normals_towards_camera_location()
    search = o3d.geometry.KDTreeSearchParamHybrid(radius=5.0 * voxel_m, max_nn=100)
    return thin, REG.compute_fpfh_feature(thin, search)


def global_pose(source, target, method, voxel_m):
    """T_target_source from two (cloud, features)."""
    limit_m = 1.5 * voxel_m
    if method == "fgr":
        option = REG.FastGlobalRegistrationOption(maximum_correspondence_distance=limit_m)
        return REG.registration_fgr_based_on_feature_matching(
            source[0], target[0], source[1], target[1], option).transformation
    checkers = [REG.CorrespondenceCheckerBasedOnEdgeLength(0.9),
                REG.CorrespondenceCheckerBasedOnDistance(limit_m)]
    return REG.registration_ransac_based_on_feature_matching(
        source[0], target[0], source[1], target[1], True, limit_m,
        REG.TransformationEstimationPointToPoint(False), 3, checkers,
        REG.RANSACConvergenceCriteria(100000, 0.999)).transformation


def refined(source, target, pose):
    """The pose after generalized ICP on clouds of one point per 10 cm."""
    for limit_m in (0.5, 0.2):
        pose = REG.registration_generalized_icp(source, target, limit_m, pose).transformation
    return pose


def quaternion(rotation):
    """(x, y, z, w) of a rotation matrix, by its largest component."""
    w = math.sqrt(max(0.0, 1.0 + rotation[0, 0] + rotation[1, 1] + rotation[2, 2])) / 2.0
    xyz = [math.copysign(math.sqrt(max(0.0, 1.0 + 2.0 * rotation[i, i] - np.trace(rotation))) / 2.0,
                         rotation[(i + 2) % 3, (i + 1) % 3] - rotation[(i + 1) % 3, (i + 2) % 3])
           for i in range(3)]
    length = math.sqrt(w * w + sum(value * value for value in xyz))
    return [value / length for value in (*xyz, w)]


def main(scenes, reference, method, out_csv, voxel_m="0.4"):
    """Writes a line for each scene and sensor."""
    voxel = float(voxel_m)
    o3d.utility.random.seed(1)
    with open(out_csv, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow("scene,sensor,tx_m,ty_m,tz_m,qx,qy,qz,qw".split(","))
        seconds = []
        for scene in sorted(os.listdir(scenes)):
            folder = os.path.join(scenes, scene)
            if not os.path.isdir(folder):
                continue
            names = sorted(name[:-4] for name in os.listdir(folder) if name.endswith(".pcd"))
            begin = time.process_time()
            clouds = {name: read_cloud(os.path.join(folder, name + ".pcd")) for name in names}
            views = {name: features_of(cloud, voxel) for name, cloud in clouds.items()}
            fine = {name: cloud.voxel_down_sample(0.1) for name, cloud in clouds.items()}
            for name in names:
                if name == reference:
                    continue
                pose = global_pose(views[name], views[reference], method, voxel)
                pose = refined(fine[name], fine[reference], pose)
                writer.writerow([scene, name, *pose[:3, 3], *quaternion(pose[:3, :3])])
            seconds.append((time.process_time() - begin) / max(1, len(names) - 1))
        if seconds:
            print(f"{np.mean(seconds):.2f} s of processor time per sensor")


if __name__ == "__main__":
    main(*sys.argv[1:])
