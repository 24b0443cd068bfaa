"""Stages in Python."""

import pathlib
import threading
import unittest

import numpy as np

import croon
from support import GROUND, METHOD, TestCase, experiment, two_clouds

TOP, LEFT, TRUTH = two_clouds()


@croon.stage("step", "test_nudge", summary="Moves the sensor.", source="a test", parameters=[
    croon.number("shift_m", 0.25, range=(0, 1), help="How far."),
    croon.integer("times", 1, range=(1, 3), help="How often."),
    croon.boolean("is_back", False, help="Moves back."),
    croon.text("note", "none", help="Any text."),
    croon.choice("axis", "x", ["x", "y", "z"], help="Along which axis."),
    croon.numbers("weights", [1, 0.5], range=(0, None), help="Weights."),
], gives=[croon.extra("test_nudge", "how far the sensor was moved", float), croon.extra("test_note", "the note")])
class Nudge(croon.Step):
    """Uses all that a step has."""

    def __init__(self):
        self.made_with = self.shift_m

    def advance(self, estimate, rng):
        pose = estimate.pose
        pose["xyz".index(self.axis), 3] += (-1 if self.is_back else 1) * self.times * self.shift_m * self.weights[0]
        estimate.pose = pose
        estimate.diagnostics = {"shift_m": self.shift_m, "points": len(estimate.target), "draw": rng.normal()}
        estimate.put("test_nudge", float(self.times * self.shift_m))
        estimate.put("test_note", {"note": self.note})
        return estimate


@croon.stage("step", "test_needs_note", summary="Reads the note.", takes=[croon.extra("test_note", "the note")])
class NeedsNote(croon.Step):
    def advance(self, estimate, rng):
        estimate.rejection = estimate.get("test_note")["note"]
        return estimate


@croon.stage("step", "test_do", summary="Calls a function.", parameters=[croon.text("what", "nothing", help="Which.")])
class Do(croon.Step):
    functions = {}

    def advance(self, estimate, rng):
        return self.functions[self.what](estimate, rng)


def do(function):
    """Runs the step with this function."""
    Do.functions["it"] = function
    return croon.Pipeline([{"step": "test_do", "name": "do", "what": "it"}]).run(TOP, LEFT, TRUTH)


class Steps(TestCase):
    def test_have_parameters(self):
        result = croon.Pipeline([{"step": "test_nudge"}]).run(TOP, LEFT)
        self.assertEqual(result.pose[0, 3], 0.25)
        self.assertEqual(result.diagnostics["test_nudge"]["points"], len(TOP))
        steps = [{"step": "test_nudge", "times": 3, "axis": "z", "is_back": True, "shift_m": 1, "weights": [2]}]
        self.assertEqual(croon.Pipeline(steps).run(TOP, LEFT).pose[2, 3], -6.0)
        self.assertEqual(croon.Pipeline(steps).steps, [
            {"name": "test_nudge", "step": "test_nudge", "shift_m": 1, "times": 3, "is_back": True, "note": "none",
             "axis": "z", "weights": [2]}])

    def test_with_wrong_parameters_are_refused(self):
        for wrong, expected in (({"shift": 1}, 'unknown key "shift"; did you mean "shift_m"?'),
                                ({"shift_m": 2}, "expected a number from 0 to 1, found 2"),
                                ({"times": 0}, "expected a whole number from 1 to 3, found 0"),
                                ({"is_back": 1}, "expected true or false, found 1"), ({"note": ""}, "not empty"),
                                ({"axis": "w"}, "expected one of x, y, z"), ({"weights": [-1]}, "at least 0"),
                                ({"weights": []}, "at least one")):
            message = self.line_of(croon.InputError, croon.Pipeline, [{"step": "test_nudge", **wrong}])
            self.assertIn(expected, message)
        self.assertIn('did you mean "test_nudge"?', self.line_of(croon.InputError, croon.Pipeline, [{"step": "test_nugde"}]))

    def test_give_and_take_extras(self):
        pipeline = croon.Pipeline([{"step": "test_nudge", "note": "beware"}, {"step": "test_needs_note"}])
        self.assertEqual(pipeline.run(TOP, LEFT).rejection, "test_needs_note: beware")
        self.assertIn("which no earlier step provides",
                      self.line_of(croon.InputError, croon.Pipeline, [{"step": "test_needs_note"}]))

    def test_reject_with_a_reason_alone(self):
        for wrong in (False, np.bool_(True), 0, ""):
            def reject(estimate, rng):
                estimate.rejection = wrong
                return estimate

            self.assertIn("expected None or a reason", self.line_of(croon.StageError, do, reject))

    def test_see_clouds_and_grounds(self):
        seen = []

        def look(estimate, rng):
            seen.append(estimate)
            return estimate.pose

        Do.functions["it"] = look
        croon.Pipeline([GROUND, {"step": "test_do", "what": "it"}]).run(TOP, LEFT, TRUTH)
        estimate = seen[0]
        self.assertTrue((estimate.target.points == croon.xyz(TOP)).all())
        self.assertFalse(estimate.target.points.flags.writeable)
        self.assertTrue((estimate.source.channels["ring"] == LEFT["ring"]).all())
        self.assertFalse(estimate.source.channels["ring"].flags.writeable)
        self.assertEqual(estimate.source.to_array().tobytes(), LEFT.tobytes())
        ground = estimate.target_ground
        self.assertAlmostEqual(np.linalg.norm(ground.normal), 1)
        heights = ground.non_ground.points @ ground.normal + ground.offset_m
        self.assertGreater(np.median(heights), 0.2)
        self.assertTrue((estimate.up == ground.normal).all())
        self.assertIsNone(estimate.trial)
        indices, distances = estimate.target.nearest(croon.xyz(TOP)[:5] + np.float32(0.001), 0.5)
        self.assertTrue((distances < 0.01).all())
        self.assertEqual(estimate.target.nearest(np.full((1, 3), 1e6), 1.0)[0].tolist(), [-1])
        normals = estimate.target.normals(20)
        self.assertEqual(normals.shape, (len(TOP), 3))
        lengths = np.linalg.norm(normals, axis=1)
        self.assertLess(np.abs(lengths[lengths > 0] - 1).max(), 1e-3)
        self.assertGreater((lengths > 0).mean(), 0.9)

    def test_compute_once_for_a_cloud(self):
        calls = []

        def once(estimate, rng):
            for _ in range(3):
                estimate.target.once("sum", lambda: calls.append(1) or estimate.target.points.sum())
            estimate.diagnostics = {"sum": estimate.target.once("sum", None)}
            return estimate

        self.assertGreater(abs(do(once).diagnostics["do"]["sum"]), 0)
        self.assertEqual(len(calls), 1)

        def recurse(estimate, rng):
            return estimate.target.once("a", lambda: estimate.target.once("a", list))

        self.assertEqual(self.line_of(croon.StageError, do, recurse), 'do: the value "a" needs itself')

    def test_that_fail_are_stage_errors(self):
        def fail(estimate, rng):
            raise croon.StageError("there are no walls")

        def divide(estimate, rng):
            return 1 / 0

        with self.assertRaises(croon.StageError) as raised:
            do(fail)
        self.assertEqual(str(raised.exception), "do: there are no walls")
        with self.assertRaises(croon.StageError) as raised:
            do(divide)
        self.assertEqual(str(raised.exception), "do: ZeroDivisionError: division by zero")
        self.assertIsInstance(raised.exception.__cause__, ZeroDivisionError)
        frames = []
        trace = raised.exception.__cause__.__traceback__
        while trace:
            frames.append(trace.tb_frame.f_code.co_name)
            trace = trace.tb_next
        self.assertIn("divide", frames)

    def test_that_return_nonsense_are_stage_errors(self):
        for wrong in (None, 3, "pose", np.eye(3), np.full((4, 4), np.nan), 2 * np.eye(4), [], object()):
            self.assertIn("do: advance: expected", self.line_of(croon.StageError, do, lambda *_: wrong))
        for name, wrong in (("pose", None), ("pose", np.zeros((4, 4))), ("information", np.eye(3)), ("diagnostics", {1: 2}),
                            ("diagnostics", {"a": "b"}), ("diagnostics", 3), ("diagnostics", {"a": None})):
            def assign(estimate, rng):
                setattr(estimate, name, wrong)
                return estimate

            self.assertTrue(self.line_of(croon.StageError, do, assign).startswith("do: "))
        for call in (lambda e, rng: rng.below(0), lambda e, rng: e.get("nothing"), lambda e, rng: e.target.nearest("x"),
                     lambda e, rng: e.target.nearest(np.zeros((2, 2), "f4"))):
            self.assertTrue(self.line_of(croon.StageError, do, call).startswith("do: "))

    def test_may_give_a_covariance(self):
        def judge(estimate, rng):
            self.assertIsNone(estimate.covariance)
            self.assertIsNone(estimate.observability)
            estimate.covariance = 4 * np.eye(6)
            estimate.observability = {"yaw": "weak"}
            return estimate

        result = do(judge)
        self.assertTrue((result.covariance == 4 * np.eye(6)).all())
        self.assertEqual((result.observability["yaw"], result.observability["x"]), ("weak", "determined"))
        self.assertIsNone(do(lambda e, rng: e).covariance)
        for name, wrong in (("covariance", -np.eye(6)), ("covariance", np.eye(5)), ("covariance", np.triu(np.ones((6, 6)))),
                            ("observability", {"x": "weak"})):
            def assign(estimate, rng):
                setattr(estimate, name, wrong)
                return estimate

            self.assertTrue(self.line_of(croon.StageError, do, assign).startswith("do: "))

    def test_let_an_interrupt_through(self):
        def interrupt(estimate, rng):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            do(interrupt)
        with self.assertRaises(KeyboardInterrupt):
            croon.run(experiment(pipeline=[{"step": "test_do", "what": "it"}]), out="out")

    def test_draw_the_same_numbers_as_stages_in_c_plus_plus(self):
        def draw(estimate, rng):
            numbers = {"uniform": rng.uniform(), "normal": rng.normal(), "low": rng.uniform(2, 3), "below": rng.below(10),
                       "numpy": rng.numpy().random()}
            estimate.diagnostics = numbers
            return estimate

        first = do(draw).diagnostics["do"]
        self.assertEqual(first, do(draw).diagnostics["do"])
        self.assertTrue(2 <= first["low"] < 3 and 0 <= first["below"] < 10)

    def test_may_keep_what_they_were_given(self):
        kept = []

        def keep(estimate, rng):
            kept.append((estimate, rng, estimate.target.points, estimate.source.channels))
            return estimate.pose

        do(keep)
        estimate, rng, points, channels = kept.pop()
        del estimate
        self.assertTrue((points == croon.xyz(TOP)).all())
        self.assertTrue((channels["ring"] == LEFT["ring"]).all())
        self.assertTrue(0 <= rng.uniform() < 1)


class OtherKinds(TestCase):
    """Each does what a stage of croon does, or something near it."""

    def test_searches(self):
        kept = []

        @croon.stage("yaw_search", "test_grid", summary="Tries every degree.")
        class Grid(croon.YawSearch):
            def minimise(self, cost):
                kept.append(cost)
                return min((np.radians(degree) for degree in range(-45, 46)), key=cost)

        @croon.stage("pose_search", "test_stay", summary="Goes somewhere else.", parameters=[
            croon.number("shift_m", 5.0, help="How far.")])
        class Stay(croon.PoseSearch):
            def minimise(self, cost, start):
                kept.append(cost)
                other = start.copy()
                other[0, 3] += self.shift_m
                return other

        turn = np.array([[0.94, -np.sqrt(1 - 0.94**2), 0, 0], [np.sqrt(1 - 0.94**2), 0.94, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        steps = [GROUND, {"step": "yaw_alignment", "search": {"type": "test_grid"}}, {"step": "registration"},
                 {"step": "volume_refinement", "search": {"type": "test_stay"}}]
        result = croon.Pipeline(steps).run(TOP, LEFT, turn @ TRUTH)
        self.assertLess(np.abs(result.pose - TRUTH).max(), 0.1)
        self.assertEqual(result.diagnostics["yaw_alignment"]["evaluations"], 92)
        with self.assertRaisesRegex(RuntimeError, "the search of this cost function has already returned"):
            kept[0](0.0)
        with self.assertRaisesRegex(RuntimeError, "the search of this cost function has already returned"):
            kept[1](np.eye(4))

    def test_preprocessors_and_extractors(self):
        @croon.stage("preprocessor", "test_far", summary="Keeps what is far.", channels=["ring"], parameters=[
            croon.choice("how", "mask", ["mask", "array", "wrong"], help="What it returns.")])
        class Far(croon.Preprocessor):
            def apply(self, cloud):
                mask = (np.hypot(cloud["x"], cloud["y"]) > 10) & (cloud["ring"] >= 0)
                return {"mask": mask, "array": cloud[mask], "wrong": mask[1:]}[self.how]

        @croon.stage("ground_extractor", "test_flat", summary="Knows the height.", parameters=[
            croon.number("height_m", 0.0, help="Above the ground.")])
        class Flat(croon.GroundExtractor):
            def extract(self, cloud, rng):
                rng.uniform()
                low = np.percentile(cloud["z"], 20)
                return [0, 0, 2], -2 * low, cloud["z"] < low + 0.2

        def pipeline(how):
            return croon.Pipeline([
                {"step": "preprocessing", "reference": [{"type": "test_far", "how": how}]},
                {"step": "ground_alignment", "extractor": {"type": "test_flat"}}])

        masked, array = (pipeline(how).run(TOP, TOP) for how in ("mask", "array"))
        self.assertEqual(masked.pose.tobytes(), array.pose.tobytes())
        self.assertLess(masked.diagnostics["preprocessing"]["target_points"], len(TOP))
        self.assertIn("true or false for each point", self.line_of(croon.StageError, pipeline("wrong").run, TOP, TOP))
        self.assertIn("ring", self.line_of(croon.StageError, pipeline("mask").run, croon.xyz(TOP), TOP))

    def test_registrations_and_scorers(self):
        @croon.stage("icp", "test_mean", summary="Aligns the nearest points.")
        class Mean(croon.Icp):
            def align(self, target, source, start):
                moved = source.points @ start[:3, :3].T + start[:3, 3]
                indices, _ = target.nearest(moved.astype("f4"), 1.0)
                found = indices >= 0
                pose = start.copy()
                pose[:3, 3] += (target.points[indices[found]] - moved[found]).mean(0)
                return croon.Registration(pose, rmse_m=0.5, correspondences=int(found.sum()), information=np.eye(6))

        @croon.stage("volume_scorer", "test_cells", summary="Counts cells.")
        class Cells(croon.VolumeScorer):
            def bind(self, target, source):
                def cells(points):
                    return set(map(tuple, np.floor(points[::50] / 0.5).astype(int).tolist()))

                of_target = cells(target.points)
                return lambda pose: len(of_target | cells(source.points @ pose[:3, :3].T + pose[:3, 3])), 0.5

        result = croon.Pipeline([{"step": "registration", "icp": {"type": "test_mean"}},
                                 {"step": "volume_refinement", "scorer": {"type": "test_cells"}}]).run(TOP, LEFT, TRUTH)
        self.assertEqual(result.diagnostics["registration"]["rmse_m"], 0.5)
        self.assertTrue((result.information == np.eye(6)).all())
        self.assertGreater(result.diagnostics["volume_refinement"]["volume_m3"], 0)

        @croon.stage("volume_scorer", "test_wrong", summary="Is wrong.", parameters=[
            croon.number("leaves", 1, help="How many."), croon.number("leaf_size_m", 1, help="Their size.")])
        class Wrong(croon.VolumeScorer):
            def bind(self, target, source):
                return lambda pose: self.leaves, self.leaf_size_m

        for wrong in ({"leaves": -1}, {"leaves": 1e30}, {"leaf_size_m": 0}, {"leaf_size_m": -1}):
            pipeline = croon.Pipeline([{"step": "volume_refinement", "scorer": {"type": "test_wrong", **wrong}}])
            self.assertIn("bind: expected a", self.line_of(croon.StageError, pipeline.run, TOP, LEFT))


class RigSteps(TestCase):
    @croon.stage("step", "test_first", summary="Gives all scenes of a trial the pose of the first.", parameters=[
        croon.choice("how", "right", ["right", "list", "result", "failure", "raise"], help="What it does.")])
    class First(croon.RigStep):
        def adjust(self, rig, rng):
            if self.how == "raise":
                raise ValueError("no rig")
            first = {}
            for sensor in rig:
                pose = first.setdefault(sensor.source, sensor.estimate.pose)
                sensor.estimate.pose = pose
                sensor.estimate.diagnostics = {"size": len(rig)}
                if self.how == "failure" and sensor.source == "left":
                    sensor.failure = "left is odd"
            if self.how == "list":
                rig.clear()
            return rig if self.how == "result" else None

    @staticmethod
    def steps(how):
        return [{"step": "ground_alignment"}, {"step": "test_first", "how": how}]

    def test_see_all_scenes_of_a_trial(self):
        rigs = experiment(scenes_per_trial=2, pipeline=self.steps("right"), variants=[
            {"name": "failure", "replace": {"test_first.how": "failure"}}])
        for jobs in (1, 4):
            croon.run(rigs, out=f"out{jobs}", jobs=jobs)
        for name in ("trials.csv", "diagnostics.csv"):
            self.assertEqual(pathlib.Path("out1", name).read_bytes(), pathlib.Path("out4", name).read_bytes())
        results = croon.load("out1")
        self.assertEqual(set(results.diagnostics["value"][results.diagnostics["name"] == "size"]), {4.0})
        failed = results.trials[results.trials["status"] == "failed"]
        self.assertEqual({tuple(row) for row in failed[["variant", "sensor", "reason"]].tolist()},
                         {("failure", "left", "in all scenes; in 000000: test_first: left is odd")})

    def test_see_one_pair_too(self):
        for how in ("right", "list"):
            result = croon.Pipeline(self.steps(how)).run(TOP, LEFT, TRUTH)
            self.assertEqual(result.diagnostics["test_first"]["size"], 1)
        for how, expected in (("result", "found a list"), ("raise", "ValueError: no rig")):
            self.assertIn(expected, self.line_of(croon.StageError, croon.Pipeline(self.steps(how)).run, TOP, LEFT))


class Registering(TestCase):
    def test_wants_what_is_right(self):
        def register(kind="step", name="test_other", base=croon.Step, **more):
            croon.stage(kind, name, **{"summary": "Does it.", **more})(type("Other", (base,), {}))

        number = croon.number("a", 1, help="It.")
        for wrong, expected in (({"kind": "stepp"}, "expected one of step"), ({"base": croon.Icp}, "derives from croon.Step"),
                                ({"base": object}, "derives from croon.Step"), ({"name": "a b"}, "expected a name"),
                                ({"name": ""}, "expected a name"), ({"name": "registration"}, "croon already has a stage"),
                                ({"name": "test_nudge"}, "has this name"), ({"version": 0}, "version"),
                                ({"parameters": [number, number]}, "each key once"), ({"summary": 3}, "summary"),
                                ({"parameters": [number._replace(key="a.b")]}, "another key"),
                                ({"parameters": [number._replace(key="advance")]}, "another key"),
                                ({"parameters": [number._replace(key="__init__")]}, "another key"),
                                ({"parameters": [number._replace(key="a-b")]}, "another key"), ({"channels": [3]}, "channels")):
            self.assertIn(expected, self.line_of(croon.InputError, register, **wrong))
        for call in (lambda: croon.number("a", 2, range=(0, 1), help="It."), lambda: croon.number("a", "x", help="It."),
                     lambda: croon.integer("a", 1.5, help="It."), lambda: croon.choice("a", "x", ["y"], help="It.")):
            self.assertIn("its default: expected", self.line_of(croon.InputError, register, parameters=[call()]))
        for call in (lambda: croon.number("a", float("nan"), help="It."), lambda: croon.number("a", 1, help=""),
                     lambda: croon.number("a", 1, range=3, help="It."), lambda: croon.number(3, 1, help="It.")):
            self.assertTrue(self.line_of(croon.InputError, call))

    def test_again_replaces_the_class(self):
        def register(shift_m):
            @croon.stage("step", "test_again", summary="Moves the sensor.")
            class Again(croon.Step):
                def advance(self, estimate, rng):
                    pose = estimate.pose
                    pose[0, 3] += shift_m
                    return pose

        register(1)
        old = croon.Pipeline([{"step": "test_again"}])
        register(2)
        self.assertEqual(croon.Pipeline([{"step": "test_again"}]).run(TOP, LEFT).pose[0, 3], 2)
        self.assertEqual(old.run(TOP, LEFT).pose[0, 3], 1)

    def test_is_shown_by_help(self):
        page = croon.help_on("step/test_nudge")
        for part in ("Moves the sensor.", "a test", "shift_m: a number from 0 to 1; default 0.25", "test_note"):
            self.assertIn(part, page)
        self.assertIn("test_nudge", croon.help_on("step"))
        self.assertIn("icp/icpn", croon.help_on("icp/icpn"))
        self.assertTrue(self.line_of(croon.InputError, croon.help_on, "icp/icpnn"))
        self.assertIn("jsonx", self.line_of(croon.InputError, croon.help_on, "icp", "jsonx"))

    def test_of_a_class_that_cannot_be_made_is_a_fault(self):
        @croon.stage("step", "test_unmade", summary="Fails.")
        class Unmade(croon.Step):
            def __init__(self):
                raise OSError("no model")

            def advance(self, estimate, rng):
                return estimate

        @croon.stage("step", "test_bare", summary="Lacks its method.")
        class Bare(croon.Step):
            pass

        for name, expected in (("test_unmade", "OSError: no model"), ("test_bare", "abstract method advance")):
            message = self.line_of(croon.InputError, croon.Pipeline, [{"step": name}])
            self.assertIn("/0: the stage cannot be constructed: ", message)
            self.assertIn(expected, message)

    def test_by_many_threads(self):
        def register(k):
            for i in range(5):
                croon.stage("step", f"test_thread_{k}_{i}", summary="Stays.")(
                    type(f"S{k}{i}", (croon.Step,), {"advance": lambda *_: None}))
                croon.Pipeline([{"step": f"test_thread_{k}_{i}"}])

        threads = [threading.Thread(target=register, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for k in range(4):
            self.assertIn(f"test_thread_{k}_4", croon.help_on("step"))


class Experiments(TestCase):
    EXPERIMENT = experiment(pipeline=[GROUND, {"step": "test_nudge", "shift_m": 0.05}, {"step": "registration"}],
                            variants=[{"name": "far", "replace": {"test_nudge.shift_m": 0.2}}],
                            grid={"test_nudge.axis": ["x", "y"]})

    def test_have_the_same_bytes_for_any_number_of_jobs(self):
        for jobs in (1, 4):
            croon.run(self.EXPERIMENT, out=f"out{jobs}", jobs=jobs)
        for name in ("trials.csv", "diagnostics.csv", "summary.csv"):
            self.assertEqual(pathlib.Path("out1", name).read_bytes(), pathlib.Path("out4", name).read_bytes())
        results = croon.load("out1")
        self.assertEqual(len(set(results.trials["variant"])), 4)
        self.assertEqual(results.manifest["versions"]["step/test_nudge"], 1)

    def test_do_not_mix_versions(self):
        def register(version):
            @croon.stage("step", "test_version", summary="Stays.", version=version)
            class Version(croon.Step):
                def advance(self, estimate, rng):
                    return estimate

        register(1)
        steps = experiment(pipeline=[{"step": "test_version"}])
        croon.run(steps, out="out", trials=1)
        register(2)
        self.assertIn("test_version", self.line_of(croon.InputError, croon.run, steps, out="out"))

    def test_say_that_a_step_gives_a_covariance(self):
        gives = [croon.extra("covariance", "the covariance of the pose")]
        for name, given in (("test_certain", gives), ("test_silent", [])):
            @croon.stage("step", name, summary="Sets a covariance.", gives=given)
            class Certain(croon.Step):
                def advance(self, estimate, rng):
                    estimate.covariance = 1e-4 * np.eye(6)
                    return estimate

        def run(name):
            steps = [{"step": name}, {"step": "consensus", "weights": "covariance"}]
            return croon.run(experiment(pipeline=steps), out=name, trials=1)

        self.assertNotIn("failed", run("test_certain").trials["status"])
        self.assertIn('needs the extra "covariance"', self.line_of(croon.InputError, run, "test_silent"))

    def test_record_what_failed(self):
        def fail(estimate, rng):
            if estimate.trial.number == 1:
                raise ValueError(f"not {estimate.trial.sensor}")
            return estimate

        Do.functions["it"] = fail
        results = croon.run(experiment(pipeline=[{"step": "test_do", "what": "it"}]), out="out", jobs=3)
        trials = results.trials
        self.assertEqual(set(trials["trial"][trials["status"] == "failed"]), {1})
        self.assertIn("test_do: ValueError: not left", trials["reason"])


if __name__ == "__main__":
    unittest.main()
