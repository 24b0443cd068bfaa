"""Reads the files of every format with readers that are not croon's, and compares the poses.

foreign_readers.py FOLDER: the folder has a folder per format. Exits with 77 if a reader is missing.
"""
import ast
import csv
import json
import math
import pathlib
import sys
import xml.etree.ElementTree

try:
    import numpy as np
    import yaml
except ImportError as error:
    print(f"missing: {error.name}")
    sys.exit(77)


def from_quaternion(x, y, z, w):
    """The rotation of a quaternion, by Hamilton's product with the unit vectors."""
    def product(a, b):
        return np.array([a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
                         a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
                         a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
                         a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]])
    columns = [product(product((x, y, z, w), (*unit, 0.0)), (-x, -y, -z, w))[:3]
               for unit in np.eye(3)]
    return np.array(columns).T


def from_rpy(roll, pitch, yaw):
    """Turns about the fixed axes x, y, z, one after the other."""
    rotation = np.eye(3)
    for axis, angle in enumerate((roll, pitch, yaw)):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn = np.eye(3)
        turn[i, i] = turn[j, j] = math.cos(angle)
        turn[j, i], turn[i, j] = math.sin(angle), -math.sin(angle)
        rotation = turn @ rotation
    return rotation


def pose(rotation, translation):
    matrix = np.eye(4)
    matrix[:3, :3] = rotation
    matrix[:3, 3] = translation
    return matrix


def stamped(transform):
    rotation, translation = transform["rotation"], transform["translation"]
    return pose(from_quaternion(*(rotation[k] for k in "xyzw")), [translation[k] for k in "xyz"])


def load(path):
    with open(path, encoding="utf-8") as file:
        return yaml.safe_load(file)


def ros2(folder):
    tree = ast.parse((folder / "extrinsics.launch.py").read_text("utf-8"))
    for node in ast.walk(tree):
        if not (isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Node"):
            continue
        words = ast.literal_eval({k.arg: k.value for k in node.keywords}["arguments"])
        options = dict(zip(words[::2], words[1::2]))
        assert options["--frame-id"] == "top"
        numbers = {k[2:]: float(v) for k, v in options.items() if not k.endswith("-id")}
        yield options["--child-frame-id"], pose(
            from_quaternion(*(numbers["q" + k] for k in "xyzw")), [numbers[k] for k in "xyz"])


def ros2_yaml(folder):
    for transform in load(folder / "extrinsics.yaml")["transforms"]:
        assert transform["frame_id"] == "top" and transform["verdict"] in ("accepted", "rejected")
        yield transform["child_frame_id"], stamped(transform)


def urdf(folder):
    robot = xml.etree.ElementTree.parse(folder / "extrinsics.urdf").getroot()
    links = [link.get("name") for link in robot.findall("link")]
    assert len(set(links)) == len(links)
    for joint in robot.findall("joint"):
        origin = joint.find("origin")
        assert joint.get("type") == "fixed" and joint.find("parent").get("link") == "top"
        yield joint.find("child").get("link"), pose(
            from_rpy(*map(float, origin.get("rpy").split())), list(map(float, origin.get("xyz").split())))


def autoware(folder):
    for name, child in load(folder / "sensor_kit_calibration.yaml")["top"].items():
        assert all(isinstance(value, float) for value in child.values()), child
        yield name, pose(from_rpy(child["roll"], child["pitch"], child["yaw"]), [child[k] for k in "xyz"])


def apollo(folder):
    for path in folder.glob("*_extrinsics.yaml"):
        file = load(path)
        assert file["header"]["frame_id"] == "top"
        yield file["child_frame_id"], stamped(file["transform"])


def kitti(folder):
    with open(folder / "calib.txt", encoding="utf-8") as file:
        for line in file:
            key, value = line.split(":", 1)
            try:
                numbers = np.array([float(word) for word in value.split()])
            except ValueError:
                continue
            yield key[3:-len("_to_top")], np.vstack([numbers.reshape(3, 4), [0, 0, 0, 1]])


def nuscenes(folder):
    tables = {name: json.loads((folder / name).read_text("utf-8"))
              for name in ("sensor.json", "calibrated_sensor.json")}
    channels = {sensor["token"]: sensor["channel"] for sensor in tables["sensor.json"]}
    for record in tables["calibrated_sensor.json"]:
        w, x, y, z = record["rotation"]
        yield channels[record["sensor_token"]], pose(from_quaternion(x, y, z, w), record["translation"])


def kalibr(folder):
    for name, sensor in load(folder / "extrinsics_camchain.yaml").items():
        yield name, np.linalg.inv(np.array(sensor["T_sensor_parent"]))


def opencalib(folder):
    """As the authors' program reads it: two lines per device, and what follows the numbers ignored."""
    lines = (folder / "initial_extrinsic.txt").read_text("utf-8").splitlines()
    for device, line in zip(lines[::2], lines[1::2]):
        name = device.split("#", 1)[1].strip()
        numbers = [float(word) for word in line.split()[1:7]]
        if int(device.split()[1]) > 0:
            yield name, pose(from_rpy(*np.radians(numbers[:3])), numbers[3:])


def matrix(folder):
    for path in folder.glob("*.txt"):
        name = [line.split(": ", 1)[1] for line in path.read_text("utf-8").splitlines()
                if line.startswith("# sensor: ")][0]
        yield name, np.loadtxt(path)


def from_csv(folder):
    with open(folder / "extrinsics.csv", encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            assert row["verdict"] in ("accepted", "rejected")
            yield row["sensor"], pose(from_quaternion(*(float(row["q" + k]) for k in "xyzw")),
                                      [float(row[f"t{k}_m"]) for k in "xyz"])


READERS = {"ros2": ros2, "ros2-yaml": ros2_yaml, "urdf": urdf, "autoware": autoware, "apollo": apollo,
           "kitti": kitti, "nuscenes": nuscenes, "kalibr": kalibr, "opencalib": opencalib,
           "matrix": matrix, "csv": from_csv}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1])
    assert {path.name for path in root.iterdir() if path.is_dir()} == set(READERS)
    expected = dict(from_csv(root / "csv"))
    for name, reader in READERS.items():
        poses = dict(reader(root / name))
        assert len(poses) == len(expected), (name, sorted(poses))
        # KITTI has no room for some characters.
        pairs = zip(poses.values(), expected.values()) if name == "kitti" else (
            (poses[sensor], expected[sensor]) for sensor in expected)
        error = max(np.abs(a - b).max() for a, b in pairs)
        print(f"{name}: {error:.1e}")
        assert error < 1e-9, name


if __name__ == "__main__":
    main()
