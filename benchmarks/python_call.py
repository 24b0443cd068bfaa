"""What does a call from Python cost?

A pipeline of a step that does nothing, on two arrays of float32: what is measured is the call alone, with the copy of the
points. The same with a step in Python that does nothing.

    PYTHONPATH=build/test/python python3 benchmarks/python_call.py
"""

import timeit

import numpy

import croon


@croon.stage("step", "python_identity", summary="Leaves the estimate as it is.")
class Identity(croon.Step):
    def advance(self, estimate, rng):
        return estimate


def main():
    print(f"{'points':>8}  {'step':<16}  microseconds per call, least of 7")
    for points in (1, 1000, 10000, 100000):
        cloud = numpy.random.default_rng(1).uniform(-50, 50, (points, 3)).astype(numpy.float32)
        for step in ("identity", "python_identity"):
            pipeline = croon.Pipeline([{"step": step}])
            calls = 200
            seconds = min(timeit.repeat(lambda: pipeline.run(cloud, cloud), number=calls, repeat=7)) / calls
            print(f"{points:8}  {step:<16}  {1e6 * seconds:.0f}")


if __name__ == "__main__":
    main()
