"""croon.calibrate: rigs from arrays in memory."""

import os
import pathlib
import signal
import time
import unittest

import numpy as np

import croon
from support import GROUND, METHOD, RIG, TestCase

# Quick, and the same for every layout of the clouds.
STEPS = [GROUND, {"step": "registration"}]


def scenes(count=1, **parameters):
    return croon.simulate(count, rig=RIG, mix={"urban": 1}, seed=3, **parameters)


def noisy(cloud):
    """N×3 with points among them that are not measured."""
    points = np.insert(croon.xyz(cloud), [0, 5, len(cloud)], np.nan, axis=0)
    return np.insert(points, [2, 100], 0, axis=0)


@croon.stage("step", "sends_signal", summary="Sends the signal of Ctrl-C.")
class SendsSignal(croon.Step):
    def advance(self, estimate, rng):
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.3)
        return estimate


class Rig(TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenes = scenes(2, noise="real")
        cls.calibration = croon.calibrate([scene.clouds for scene in cls.scenes], seed=5)

    def test_is_calibrated_without_a_guess(self):
        calibration = self.calibration
        self.assertEqual((calibration.reference, list(calibration.sensors)), ("top", ["left", "right"]))
        self.assertTrue(calibration.accepted, str(calibration))
        for name, sensor in calibration.sensors.items():
            self.assertLess(abs(sensor.pose - self.scenes[0].truth[name]).max(), 0.03)
            self.assertEqual((sensor.covariance.shape, sensor.nominal, sensor.reasons), ((6, 6), None, []))
            self.assertIs(sensor.contradicted, False)
            self.assertEqual(set(sensor.observability), {"roll", "pitch", "yaw", "x", "y", "z"})
            self.assertEqual([scene.scene for scene in sensor.scenes], ["0", "1"])
        self.assertRegex(str(calibration), "ACCEPTED +left")
        self.assertIn("left accepted, right accepted", repr(calibration))
        self.assertIn(calibration.composition, croon.pipelines())

    def test_is_the_same_for_any_number_of_jobs(self):
        again = croon.calibrate({name: [scene.cloud(name) for scene in self.scenes] for name in ("top", "left", "right")},
                                seed=5, jobs=1)
        for name, sensor in self.calibration.sensors.items():
            self.assertEqual(again.sensors[name].pose.tobytes(), sensor.pose.tobytes())

    def test_has_files_in_the_formats_of_others(self):
        base = np.eye(4)
        base[2, 3] = 2
        texts = self.calibration.to_format("csv")
        left = dict(zip(*(line.split(",") for line in texts["extrinsics.csv"].splitlines()[:2])))
        self.assertEqual((left["sensor"], left["verdict"]), ("left", "accepted"))
        self.assertAlmostEqual(float(left["tz_m"]), self.calibration.sensors["left"].pose[2, 3])
        self.assertTrue(any("base_link" in text for text in self.calibration.to_format("ros2", base=base).values()))
        paths = self.calibration.save("out/here", ["csv", "ros2"])
        self.assertEqual(pathlib.Path("out/here/report.txt").read_text(), f"{self.calibration}\n")
        self.assertTrue(all(path.is_file() for path in paths))
        self.assertIn("ros2", self.line_of(croon.InputError, self.calibration.save, "none", ["ros3"]))
        self.assertFalse(pathlib.Path("none").exists())


class Clouds(TestCase):
    def test_may_have_any_layout(self):
        scene, = scenes(noise="none")
        nominal = scene.truth
        top, left = croon.xyz(scene.cloud("top")), croon.xyz(scene.cloud("left"))
        expected = croon.calibrate({"top": top, "left": left}, nominal=nominal, pipeline=STEPS).sensors["left"].pose
        self.assertLess(abs(expected - nominal["left"]).max(), 0.03)
        intensity = np.zeros((len(left), 1), "f4")
        croon.write_cloud("left.pcd", left)
        for name, cloud, columns in (
                ("structured", scene.cloud("left"), None),
                ("with points that are not measured", noisy(scene.cloud("left")), None),
                ("float64", left.astype("f8"), None),
                ("big-endian", left.astype(">f4"), None),
                ("not contiguous", np.repeat(left, 2, axis=0)[::2], None),
                ("in the order of Fortran", np.asfortranarray(left), None),
                ("N×4", np.hstack([left, intensity]), None),
                ("columns", np.hstack([intensity, left[:, ::-1], intensity]), {"left": ("ring", "z", "y", "x", "_")}),
                ("an image", left[:len(left) // 1].reshape(1, -1, 3), None),
                ("a dict", {"x": left[:, 0], "y": left[:, 1], "z": left[:, 2]}, None),
                ("a file", pathlib.Path("left.pcd"), None)):
            with self.subTest(name):
                found = croon.calibrate({"top": top, "left": cloud}, nominal=nominal, pipeline=STEPS, columns=columns)
                self.assertEqual(found.sensors["left"].pose.tobytes(), expected.tobytes())

    def test_that_are_missing_are_named(self):
        first, second, third = scenes(3, noise="none")
        found = croon.calibrate(
            {"top": [first.cloud("top"), None, third.cloud("top")],
             "left": [first.cloud("left"), second.cloud("left"), None]}, nominal=first.truth, pipeline=STEPS)
        self.assertEqual(found.unused[:2], ["Scene 1: no cloud of the reference top.", "Scene 2: no cloud besides that of top."])
        self.assertEqual(len(found.sensors["left"].scenes), 1)

    def test_have_nominal_poses_in_any_frame(self):
        scene, = scenes(noise="none")
        clouds = {name: scene.cloud(name) for name in ("top", "left")}
        expected = croon.calibrate(clouds, nominal=scene.truth, pipeline=STEPS).sensors["left"]
        T_vehicle_top = np.array([[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]], float)
        vehicle = {"top": T_vehicle_top, "left": T_vehicle_top @ scene.truth["left"]}
        found = croon.calibrate(clouds, nominal=vehicle, pipeline=STEPS).sensors["left"]
        self.assertTrue(np.allclose(found.nominal, scene.truth["left"], atol=1e-12))
        self.assertTrue(np.allclose(found.pose, expected.pose, atol=1e-6))

    def test_that_are_wrong_are_refused_in_one_line(self):
        scene, = scenes(noise="none")
        top, left = scene.cloud("top"), croon.xyz(scene.cloud("left"))
        both = {"top": top, "left": left}
        wide = np.zeros((9, 6))
        for wrong, named, expected in (
                ("top", {}, "a dict of clouds by sensor"), ([top, left], {}, "clouds[0]: expected a dict"),
                ({}, {}, "at least two sensors"), ({"top": top}, {}, "at least two sensors"),
                ({3: top, "left": left}, {}, "expected a string"),
                ({"top": [top, top], "left": [left]}, {}, "top: 2, left: 1"),
                ({"top": top, "left": [left]}, {}, "one cloud"),
                ({"top": top, "left": wide}, {}, "columns="), ({"top": top, "left": wide}, {"columns": ("x", "y")}, "6 different"),
                ({"top": top, "left": left.astype(int)}, {}, "left: expected an N×3 array"),
                ({"top": top, "left": [[1, 2, 3]]}, {}, "one cloud"), (both, {"columns": "xyz"}, "a list of names"), ({"top": top, "left": 3}, {}, "found an int"),
                ({"top": top, "left": {"x": left[:, 0]}}, {}, "x, y and z"), ({"top": top, "left": "none.pcd"}, {}, "none.pcd"),
                (both, {"reference": "topp"}, "top, left"), (both, {"pipeline": "bst"}, 'did you mean "best"?'),
                (both, {"pipeline": [{"step": "ground_alignmen"}]}, 'did you mean "ground_alignment"?'),
                (both, {"pipeline": "none.json"}, "none.json"), (both, {"nominal": {"lft": np.eye(4)}}, "lft"),
                (both, {"nominal": {"left": np.ones((4, 4))}}, "nominal[\"left\"]: expected a 4×4 pose"),
                (both, {"nominal": 3}, "dict of 4×4"), (both, {"seed": -1}, "from 0"), (both, {"jobs": "two"}, "jobs")):
            self.assertIn(expected, self.line_of(croon.InputError, croon.calibrate, wrong, **named))

    def test_without_a_measured_point_are_not_calibrated(self):
        scene, = scenes(noise="none")
        with self.assertRaises(croon.InputError) as raised:
            croon.calibrate({"top": scene.cloud("top"), "left": np.zeros((50, 3))})
        self.assertIn("left", str(raised.exception))

    def test_are_left_when_interrupted(self):
        scene, = scenes(noise="none")
        with self.assertRaises(KeyboardInterrupt):
            croon.calibrate({"top": scene.cloud("top"), "left": scene.cloud("left")},
                            pipeline=[{"step": "sends_signal"}, *METHOD])


if __name__ == "__main__":
    unittest.main()
