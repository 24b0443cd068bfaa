"""Experiments that are run from Python give what the program gives."""

import json
import os
import pathlib
import signal
import threading
import time
import unittest

import numpy as np

import croon
from support import TestCase, experiment, program

VARIANTS = [{"name": "no yaw", "remove": ["yaw_alignment"]}]


class Runs(TestCase):
    def test_write_the_bytes_of_the_program(self):
        pathlib.Path("small.json").write_text(json.dumps(experiment(variants=VARIANTS)))
        self.assertIn(program("run", "small.json", "--out", "expected", "--quiet").returncode, (0, 3))
        of_file = croon.run("small.json", out="file", jobs=1)
        of_dict = croon.run(experiment(variants=VARIANTS), out="dict", jobs=4)
        for name in ("trials.csv", "summary.csv", "comparison.csv", "diagnostics.csv", "extrinsics.json"):
            expected = pathlib.Path("expected", name).read_bytes()
            self.assertEqual(pathlib.Path("file", name).read_bytes(), expected, name)
            self.assertEqual(pathlib.Path("dict", name).read_bytes(), expected, name)
        self.assertEqual(str(of_file), str(of_dict))
        self.assertIn("no yaw", str(of_file))
        self.assertEqual(of_file.complaints, [])

    def test_and_pipelines_give_the_same_bits(self):
        results = croon.run(experiment(), out="out")
        starts = croon.starts(experiment())
        pipeline = croon.Pipeline(experiment())
        scenes = {scene.name: scene for scene in croon.scenes(experiment()["dataset"])}
        self.assertEqual(len(starts), len(results.trials))
        for trial, pose, start in zip(results.trials, results.poses, starts):
            names = {name: str(trial[name]) for name in ("scene", "sensor")}
            self.assertEqual(names, {name: start[name] for name in names})
            scene = scenes[names["scene"]]
            result = pipeline.run(scene.cloud(scene.reference), scene.cloud(names["sensor"]), start["pose"], seed=7,
                                  reference=scene.reference, trial=int(trial["trial"]), **names)
            self.assertEqual(result.pose.tobytes(), pose.tobytes())

    def test_go_on_where_they_ended(self):
        croon.run(experiment(), out="out", trials=1, only=["base"])
        self.assertEqual(len(croon.load("out").trials), 4)
        self.assertEqual(len(croon.run(experiment(), out="out").trials), 12)
        other = experiment(seed=8)
        self.assertIn("seed", self.line_of(croon.InputError, croon.run, other, out="out"))
        self.assertEqual(croon.run(other, out="out", fresh=True).seed, 8)
        self.assertEqual(len(croon.run(experiment(), out="half", shard="1/2").trials), 6)

    def test_that_are_wrong_are_refused_before_anything_is_written(self):
        wrong = experiment(pipeline=[{"step": "registraton"}], sed=1)
        with self.assertRaises(croon.InputError) as raised:
            croon.run(wrong, out="out")
        self.assertEqual(len(raised.exception.faults), 2)
        for arguments in ({"jobs": -1}, {"jobs": 10**9}, {"trials": 1.5}, {"only": ["bas"]}, {"only": [3]}, {"shard": "3/2"},
                          {"data": 3}, {"out": b"x"}, {"jobs": float("nan")}):
            self.assertTrue(self.line_of(croon.InputError, croon.run, experiment(), **{"out": "out", **arguments}))
        with self.assertRaises(croon.InputError):
            croon.run({})
        self.assertTrue(self.line_of(croon.InputError, croon.run, None))
        self.assertTrue(self.line_of(croon.InputError, croon.load, "out"))
        self.assertEqual(os.listdir(), [])

    def test_in_a_dict_extend_files_of_the_working_directory(self):
        pathlib.Path("base.json").write_text(json.dumps(experiment()))
        results = croon.run({"extends": "base.json", "name": "more", "starts": {"rotation_deg": 1, "trials": 1}}, out="out")
        self.assertEqual((results.name, len(results.trials)), ("more", 4))
        self.assertEqual([file["path"] for file in results.manifest["experiment_files"]], ["experiment", "base.json"])

    def test_end_when_they_are_interrupted(self):
        slow = experiment(starts={"rotation_deg": 45, "trials": 20000})
        timer = threading.Timer(1.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            croon.run(slow, out="out", jobs=2)
        self.assertLess(time.monotonic() - begin, 60)
        done = croon.load("out")
        self.assertTrue(0 < len(done.trials) < done.planned)


class Tables(TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = TestCase()
        cls.temporary.setUp()
        cls.results = croon.run(experiment(variants=VARIANTS), out="out")
        cls.bytes = {name: pathlib.Path("out", name).read_text() for name in ("trials.csv", "summary.csv", "comparison.csv")}
        cls.temporary.doCleanups()

    def test_have_the_columns_of_the_files(self):
        for array, name, more in ((self.results.trials, "trials.csv", 1), (self.results.summary, "summary.csv", 0),
                                  (self.results.comparisons, "comparison.csv", 0)):
            header, *rows = self.bytes[name].splitlines()
            self.assertEqual(array.dtype.names[:len(array.dtype.names) - more], tuple(header.split(",")))
            self.assertEqual(len(array), len(rows))

    def test_have_the_values_of_the_files(self):
        header, *rows = self.bytes["trials.csv"].splitlines()
        trials = self.results.trials
        for name, column in zip(header.split(","), zip(*(row.split(",") for row in rows))):
            if trials.dtype[name].kind == "U":
                self.assertEqual(trials[name].tolist(), list(column))
            elif trials.dtype[name].kind == "f" and name != "agrees":
                self.assertTrue(np.array_equal(trials[name], [float(cell or "nan") for cell in column], equal_nan=True))
        self.assertEqual(trials["trial"].dtype, np.dtype("i8"))
        self.assertIn("all", self.results.comparisons["sensor"])
        self.assertEqual(set(self.results.diagnostics.dtype.names),
                         {"variant", "scene", "sensor", "trial", "step", "name", "value"})
        self.assertEqual(len(self.results.covariances), 0)
        self.assertIn("c00", self.results.covariances.dtype.names)
        self.assertEqual(self.results.poses.shape, (len(trials), 4, 4))
        self.assertEqual(self.results.extrinsics["extrinsics"][0]["variant"], "base")

    def test_are_data_frames(self):
        frame = self.results.trials_frame()
        self.assertEqual(len(frame), len(self.results.trials))
        by_variant = frame.groupby("variant")["rotation_error_deg"].median()
        trials = self.results.trials
        for name in ("base", "no yaw"):
            errors = trials["rotation_error_deg"][trials["variant"] == name]
            self.assertEqual(by_variant[name], np.nanmedian(errors))
        self.assertEqual(len(self.results.summary_frame()), len(self.results.summary))
        self.assertEqual(len(self.results.comparisons_frame()), len(self.results.comparisons))
        self.assertEqual(len(self.results.covariances_frame()), 0)
        self.assertEqual(len(self.results.diagnostics_frame()), len(self.results.diagnostics))


if __name__ == "__main__":
    unittest.main()
