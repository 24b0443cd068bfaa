"""Pipelines on arrays."""

import json
import pathlib
import pickle
import sys
import threading
import unittest

import numpy as np

import croon
from support import METHOD, TestCase, two_clouds

TOP, LEFT, TRUTH = two_clouds()
XYZ = [{"step": "preprocessing"}]


class Pipelines(TestCase):
    def test_are_dicts_texts_or_files(self):
        path = pathlib.Path("pipeline.json")
        path.write_text(json.dumps({"pipeline": METHOD}))
        steps = croon.Pipeline(METHOD).steps
        self.assertEqual([step["name"] for step in steps], ["ground_alignment", "yaw_alignment", "registration"])
        for given in ({"pipeline": METHOD}, json.dumps(METHOD), json.dumps({"pipeline": METHOD}), path, str(path), steps):
            self.assertEqual(croon.Pipeline(given).steps, steps)
        self.assertEqual(pickle.loads(pickle.dumps(croon.Pipeline(METHOD))).steps, steps)

    def test_that_are_wrong_say_all_that_is(self):
        with self.assertRaises(croon.InputError) as raised:
            croon.Pipeline([{"step": "registraton"}, {"step": "yaw_alignment", "searchh": 1}])
        lines = str(raised.exception).split("\n")
        self.assertEqual(len(lines), 2)
        self.assertIn('did you mean "registration"?', lines[0])
        self.assertIn('pipeline: /1/searchh: unknown key "searchh"; did you mean "search"?', lines[1])
        self.assertEqual(raised.exception.faults[1].where, "/1/searchh")
        self.assertIsInstance(raised.exception, ValueError)

    def test_warn_of_former_names_of_keys(self):
        with self.assertWarnsRegex(FutureWarning, '"slides" is now called "split_directions"') as caught:
            steps = croon.Pipeline([{"step": "verdict", "slides": 1}]).steps
        self.assertEqual(pathlib.Path(caught.filename).name, "pipeline_test.py")
        self.assertEqual(steps[0]["split_directions"], 1)

    def test_take_what_json_has(self):
        for wrong in ([], {}, "[", None, 3, [{"step": "registration", "icp": float("nan")}], [object()], "", "none.json",
                      "a\0b", b"[]", "\ud800", "[\ud800]", [{"step": "registration"}] * 2):
            with self.subTest(wrong=wrong):
                self.assertTrue(self.line_of(croon.InputError, croon.Pipeline, wrong))
        steps = [{"step": "yaw_alignment", "max_points": np.int64(100), "max_distance_m": np.float32(0.5)}]
        self.assertEqual(croon.Pipeline(steps).steps[0]["max_points"], 100)

    def test_find_the_pose(self):
        result = croon.Pipeline(METHOD).run(TOP, LEFT, TRUTH)
        self.assertEqual((result.pose.shape, result.pose.dtype), ((4, 4), np.dtype("f8")))
        self.assertLess(np.abs(result.pose - TRUTH).max(), 0.02)
        self.assertEqual(result.information.shape, (6, 6))
        self.assertIsNone(result.rejection)
        self.assertGreater(result.diagnostics["registration"]["correspondences"], 100)
        self.assertGreater(result.seconds["registration"], 0)
        self.assertIsNone(croon.Pipeline(XYZ).run(TOP, LEFT).information)

    def test_start_at_the_identity(self):
        self.assertTrue((croon.Pipeline(XYZ).run(TOP, LEFT).pose == np.eye(4)).all())

    def test_take_arrays_of_any_layout(self):
        pipeline = croon.Pipeline(METHOD)
        expected = pipeline.run(TOP, LEFT, TRUTH).pose
        top, left = croon.xyz(TOP), croon.xyz(LEFT)
        swapped = left.astype(">f4")
        other_order = LEFT[["intensity", "z", "y", "x"]]
        for source in (left, left.astype("f8"), np.asfortranarray(left), np.repeat(left, 2, axis=0)[::2], swapped,
                       left.tolist(), other_order):
            self.assertTrue((pipeline.run(top, source, TRUTH).pose == expected).all())

    def test_refuse_what_is_no_cloud(self):
        pipeline = croon.Pipeline(XYZ)
        good = croon.xyz(TOP)
        not_finite = good.copy()
        not_finite[3, 1] = np.nan
        huge = good.astype("f8")
        huge[0, 0] = 1e300
        text = np.zeros(3, [("x", "f4"), ("y", "f4"), ("z", "f4"), ("label", "U3")])
        for wrong, expected in (
                (not_finite, "found 1 of"), (huge, "found 1 of"), (good[:0], "expected points, found none"),
                (TOP[:0], "expected points, found none"), (good[:, :2], ", 2)"), (good[None], "(1, "),
                (good.astype("i4"), "int32"), (good.astype("f2"), "float16"), (good.astype("c8"), "complex64"),
                (TOP[["x", "y"]], "N×3"), (TOP.reshape(1, -1), "N×3"), (text, '"label", found <U3'), (None, "NoneType"),
                (np.ma.masked_array(good, good > 1), "MaskedArray"), ("cloud.pcd", "a str"), (object(), "object"), ([[1, 2], [3]], "list"), (7, "shape ()"), ([], "shape (0,)")):
            with self.subTest(expected=expected):
                message = self.line_of(croon.InputError, pipeline.run, good, wrong)
                self.assertTrue(message.startswith("source: "), message)
                self.assertIn(expected, message)
                self.assertTrue(self.line_of(croon.InputError, pipeline.run, wrong, good).startswith("target: "))

    def test_refuse_what_is_no_pose(self):
        pipeline = croon.Pipeline(XYZ)
        shifted = np.eye(4)
        shifted[3, 0] = 1e-3
        for wrong in (np.eye(3), np.full((4, 4), np.nan), 2 * np.eye(4), -np.eye(4), np.diag([1.0, 1, -1, 1]), shifted,
                      "pose", np.eye(4, dtype=bool), [[1]], np.eye(4).ravel(), np.diag([np.inf, 1, 1, 1])):
            self.assertTrue(self.line_of(croon.InputError, pipeline.run, TOP, LEFT, wrong).startswith("initial: "))
        pipeline.run(TOP, LEFT, np.eye(4, dtype=int).tolist())

    def test_refuse_wrong_names(self):
        pipeline = croon.Pipeline(XYZ)
        for name, wrong in (("seed", -1), ("seed", 2**64), ("seed", 1.5), ("seed", None), ("seed", True), ("trial", -1),
                            ("trial", 2**31), ("trial", float("nan")), ("scene", 3), ("sensor", None), ("reference", b"top"),
                            ("scene", "\ud800")):
            message = self.line_of(croon.InputError, pipeline.run, TOP, LEFT, **{name: wrong})
            self.assertTrue(message.startswith(name + ": expected"), message)

    def test_say_which_step_failed(self):
        line = np.zeros((50, 3))
        line[:, 0] = np.arange(50)
        pipeline = croon.Pipeline([{"step": "ground_alignment", "name": "level"}])
        self.assertTrue(self.line_of(croon.StageError, pipeline.run, line, line).startswith("level: "))

    def test_draw_from_the_seed_and_the_names(self):
        poses = [croon.Pipeline(METHOD).run(TOP, LEFT, TRUTH, **names).pose.tobytes()
                 for names in ({}, {}, {"seed": 2}, {"scene": "b"}, {"reference": "b"}, {"sensor": "b"})]
        self.assertEqual(poses[0], poses[1])
        self.assertGreater(len(set(poses)), 1)

    def test_leave_the_interpreter_to_others(self):
        counts = []
        has_started, is_done = threading.Event(), threading.Event()

        @croon.stage("step", "test_mark", summary="Notes how far another thread has counted.")
        class Mark(croon.Step):
            def advance(self, estimate, rng):
                has_started.set()
                marks.append(len(counts))
                return estimate

        def count():
            has_started.wait()
            while not is_done.is_set() and len(counts) < 10**6:
                counts.append(1)

        # No thread is asked to give way: the other one runs only while this one lets it.
        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(1000)
        marks = []
        other = threading.Thread(target=count)
        other.start()
        mark = {"step": "test_mark"}
        croon.Pipeline([{**mark, "name": "a"}, *METHOD, {**mark, "name": "b"}]).run(TOP, LEFT, TRUTH)
        is_done.set()
        other.join()
        self.assertGreater(marks[1], marks[0])

    def test_are_shared_by_threads(self):
        pipeline = croon.Pipeline(METHOD)
        poses = [None] * 4

        def run(k):
            poses[k] = pipeline.run(TOP, LEFT, TRUTH).pose.tobytes()

        threads = [threading.Thread(target=run, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(set(poses)), 1)

    def test_copy_an_array_once(self):
        points = np.ones((4_000_000, 3), np.float32)
        pipeline = croon.Pipeline(XYZ)
        pipeline.run(points[:10], points[:10])
        before = _memory("VmRSS")
        pathlib.Path("/proc/self/clear_refs").write_text("5")  # The peak begins anew.
        pipeline.run(points, points)
        grown = _memory("VmHWM") - before
        self.assertLess(grown, 2 * points.nbytes * 1.25)


def _memory(name):
    """Bytes."""
    for line in pathlib.Path("/proc/self/status").read_text().splitlines():
        if line.startswith(name + ":"):
            return int(line.split()[1]) * 1024
    raise KeyError(name)


if __name__ == "__main__":
    unittest.main()
