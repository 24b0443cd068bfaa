"""The interpreter ends cleanly, whatever croon is doing."""

import subprocess
import sys
import textwrap
import unittest

from support import TestCase

HEAD = """
    import threading, time
    import numpy as np
    import croon
    from support import experiment

    @croon.stage("step", "test_busy", summary="Counts.")
    class Busy(croon.Step):
        def advance(self, estimate, rng):
            sum(range(100000))
            return estimate

    CLOUD = np.ones((100, 3), np.float32)
    PIPELINE = croon.Pipeline([{"step": "test_busy"}])
"""


class Endings(TestCase):
    def ends(self, body, code=0):
        script = textwrap.dedent(HEAD) + textwrap.dedent(body)
        ended = subprocess.run([sys.executable, "-B", "-X", "faulthandler", "-c", script], check=False, timeout=120,
                               text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(ended.returncode, code, ended.stdout)
        return ended.stdout

    def test_with_stages_and_pipelines_alive(self):
        self.assertEqual(self.ends("kept = [PIPELINE, PIPELINE.run(CLOUD, CLOUD)]"), "")

    def test_while_other_threads_calibrate(self):
        self.assertEqual(self.ends("""
            def calibrate():
                while True:
                    PIPELINE.run(CLOUD, CLOUD)

            for _ in range(4):
                threading.Thread(target=calibrate, daemon=True).start()
            time.sleep(0.3)
        """), "")

    def test_while_another_thread_runs_an_experiment(self):
        self.assertEqual(self.ends("""
            steps = experiment(pipeline=[{"step": "test_busy"}], starts={"rotation_deg": 1, "trials": 5000})
            threading.Thread(target=croon.run, args=(steps, "out"), kwargs={"jobs": 4}, daemon=True).start()
            time.sleep(2)
        """), "")

    def test_from_inside_a_stage(self):
        self.assertEqual(self.ends("""
            Busy.advance = lambda self, estimate, rng: exit(3)
            PIPELINE.run(CLOUD, CLOUD)
        """, 3), "")

    def test_with_an_error_that_has_no_text(self):
        self.assertIn("StageError: test_busy: Odd", self.ends("""
            class Odd(Exception):
                def __str__(self):
                    raise ValueError

            def fail(self, estimate, rng):
                raise Odd

            Busy.advance = fail
            try:
                PIPELINE.run(CLOUD, CLOUD)
            except croon.StageError as error:
                print("StageError:", error)
        """))


if __name__ == "__main__":
    unittest.main()
