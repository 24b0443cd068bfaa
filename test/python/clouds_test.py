"""Files of clouds, and simulated scenes."""

import pathlib
import unittest

import numpy as np

import croon
from support import TestCase, program


class Files(TestCase):
    def test_give_back_every_byte(self):
        cloud = croon.simulate(mix={"urban": 1}, noise="real")[0].cloud("left")
        many = np.zeros(5, [("x", "f4"), ("y", "f4"), ("z", "f4"), ("id", "<u8"), ("d", "<f4", (3,)), ("b", "i1")])
        many["x"] = 1  # A point at exactly zero would be dropped.
        many["id"] = 2**60 + np.arange(5)
        many["d"] = np.arange(15).reshape(5, 3)
        for name, encoding, array in (("a.pcd", "binary", cloud), ("b.pcd", "ascii", cloud), ("c.ply", "binary", cloud),
                                      ("d.pcd", "binary_compressed", cloud), ("e.ply", "ascii", cloud),
                                      ("f.pcd", "binary", many), ("g.pcd", "binary", cloud[:0])):
            croon.write_cloud(name, array, encoding)
            found = croon.read_cloud(pathlib.Path(name))
            self.assertEqual(found.dtype, array.dtype)
            self.assertEqual(found.tobytes(), array.tobytes())
        croon.write_cloud("plain.ply", croon.xyz(cloud))
        self.assertEqual(croon.read_cloud("plain.ply").dtype.names, ("x", "y", "z"))

    def test_that_are_none_are_refused(self):
        pathlib.Path("bad.pcd").write_bytes(b"VERSION .7\nnonsense")
        for call, arguments in ((croon.read_cloud, ("none.pcd",)), (croon.read_cloud, ("bad.pcd",)),
                                (croon.read_cloud, (3,)), (croon.read_cloud, ("x.las",)),
                                (croon.write_cloud, ("x.bin", np.zeros((1, 3), "f4"))),
                                (croon.write_cloud, ("x.pcd", "cloud")),
                                (croon.write_cloud, ("x.ply", np.zeros((1, 3), "f4"), "binary_compressed")),
                                (croon.write_cloud, ("none/x.ply", np.zeros((1, 3), "f4")))):
            self.assertTrue(self.line_of(croon.InputError, call, *arguments))

    def test_with_fields_that_would_be_renamed_are_refused(self):
        for name, read in (("t", "time"), ("timestamp", "time"), ("i", "intensity"), ("_", "padding")):
            cloud = np.zeros(2, [("x", "f4"), ("y", "f4"), ("z", "f4"), (name, "f4")])
            for file in ("renamed.pcd", "renamed.ply"):
                self.assertIn(read, self.line_of(croon.InputError, croon.write_cloud, file, cloud))
                self.assertFalse(pathlib.Path(file).exists())

    def test_with_a_name_that_is_not_utf_8_are_refused(self):
        pathlib.Path("latin.pcd").write_bytes(
            b"VERSION .7\nFIELDS x y z h\xf6he\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\n"
            b"DATA ascii\n1 2 3 4\n")
        self.assertIn("latin.pcd", self.line_of(croon.InputError, croon.read_cloud, "latin.pcd"))

    def test_with_points_that_are_not_finite_lose_them(self):
        pathlib.Path("nan.pcd").write_text(
            "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n"
            "1 2 3\nnan 1 1\n")
        self.assertEqual(croon.read_cloud("nan.pcd").tolist(), [(1, 2, 3)])


class SimulatedScenes(TestCase):
    def test_are_those_of_the_dataset(self):
        pathlib.Path("x.json").write_text(
            '{"name": "x", "dataset": {"type": "simulated", "scenes": 1, "mix": {"urban": 1}, "noise": "real", "seed": 5},'
            ' "starts": {"trials": 1}, "pipeline": [{"step": "ground_alignment"}]}')
        self.assertEqual(program("simulate", "x.json", "--out", "scenes", "--quiet").returncode, 0)
        scene, = croon.simulate(mix={"urban": 1}, noise="real", seed=5)
        self.assertEqual((scene.name, scene.kind, scene.reference), ("000000", "urban", "top"))
        for sensor, cloud in scene.clouds.items():
            self.assertEqual(croon.read_cloud(f"scenes/000000/{sensor}.pcd").tobytes(), cloud.tobytes())
        written, = croon.scenes({"type": "opencalib", "path": "."}, data="scenes")
        self.assertEqual(set(written.sensors), set(scene.sensors))
        for sensor, pose in written.truth.items():
            self.assertTrue((pose == scene.truth[sensor]).all())

    def test_with_wrong_parameters_are_refused(self):
        for wrong, expected in (({"rig": "croon_fiv"}, 'did you mean "croon_five"?'), ({"scens": 1}, 'did you mean "scenes"?'),
                                ({"scenes": 0}, "from 1"), ({"scenes": float("nan")}, "expected JSON values"),
                                ({"scenes": 10**9}, "from 1")):
            self.assertIn(expected, self.line_of(croon.InputError, croon.simulate, **wrong))
        scene, = croon.simulate()
        self.assertIn('did you mean "left"?', self.line_of(croon.InputError, scene.cloud, "leftt"))
        self.assertTrue(self.line_of(croon.InputError, scene.cloud, None))
        self.assertTrue(self.line_of(croon.InputError, croon.scenes, {"type": "opencalib", "path": "none"}))


if __name__ == "__main__":
    unittest.main()
