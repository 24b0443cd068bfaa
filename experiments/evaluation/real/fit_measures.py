"""How well two clouds fit at a pose, as Open3D's evaluate_registration defines it. Needs NumPy only."""
import numpy as np


def lzf(data, size):
    """Decompresses `size` bytes of LZF, the compression of binary_compressed PCD files."""
    out, at = bytearray(), 0
    while at < len(data) and len(out) < size:
        control, at = data[at], at + 1
        if control < 32:
            out += data[at:at + control + 1]
            at += control + 1
            continue
        length = control >> 5
        if length == 7:
            length, at = length + data[at], at + 1
        start, at, length = len(out) - ((control & 31) << 8) - data[at] - 1, at + 1, length + 2
        while length > 0:  # A copy may overlap what it writes.
            part = out[start:start + length]
            out += part
            start, length = start + len(part), length - len(part)
    return bytes(out)


def read_pcd(path):
    """The finite points (n×3, m) of a PCD file, in the sensor's frame, without those at zero."""
    content = path.read_bytes()
    end = content.index(b"\n", content.index(b"\nDATA ") + 1) + 1
    header = {line.split()[0]: line.split()[1:] for line in content[:end].decode().splitlines() if line[:1] != "#"}
    names, count = header["FIELDS"], int(header["POINTS"][0])
    types = [kind.lower() + size for kind, size in zip(header["TYPE"], header["SIZE"])]
    if header["DATA"] == ["binary"]:
        table = np.frombuffer(content, np.dtype(list(zip(names, types))), count, end)
        points = np.stack([table[name] for name in "xyz"], 1).astype(float)
    elif header["DATA"] == ["ascii"]:
        table = np.array(content[end:].split(), float).reshape(count, -1)
        points = table[:, [names.index(name) for name in "xyz"]]
    else:
        packed, size = np.frombuffer(content, np.uint32, 2, end)
        columns, at, data = {}, 0, lzf(content[end + 8:end + 8 + int(packed)], int(size))
        for name, kind in zip(names, types):
            columns[name] = np.frombuffer(data, kind, count, at)
            at += columns[name].nbytes
        points = np.stack([columns[name] for name in "xyz"], 1).astype(float)
    return points[np.isfinite(points).all(1) & points.any(1)]


def thinned(points, leaf_m=0.1, min_range_m=0.0):
    """The mean of the points in each cube, as voxel_down_sample of Open3D does, of those that are not too near."""
    points = points[np.linalg.norm(points, axis=1) >= min_range_m]
    _, group = np.unique(np.floor(points / leaf_m).astype(np.int64), axis=0, return_inverse=True)
    return np.stack([np.bincount(group, points[:, i]) for i in range(3)], 1) / np.bincount(group)[:, None]


class Neighbours:
    """A grid over a cloud that finds the nearest point within a radius."""

    def __init__(self, points, radius_m):
        self.radius_m, self.low, self.high = radius_m, points.min(0) - radius_m, points.max(0) + radius_m
        # A margin on all sides, so that no column of cells runs over into the next one.
        self.shape = np.floor((self.high - self.low) / radius_m).astype(np.int64) + 4
        key = self.keys(self.cells(points))
        order = np.argsort(key, kind="stable")
        self.key, self.points = key[order], points[order]

    def cells(self, points):
        """The indices of the cells (n×3) in which points are."""
        return np.floor((points - self.low) / self.radius_m).astype(np.int64) + 1

    def keys(self, cells):
        """One number per cell; cells one above the other have successive numbers."""
        return (cells[..., 0] * self.shape[1] + cells[..., 1]) * self.shape[2] + cells[..., 2]

    def distances_m(self, points):
        """For each point the distance to the nearest one, infinite if it is beyond the radius."""
        inside = ((points >= self.low) & (points <= self.high)).all(1)
        query, found = points[inside], np.full(len(points), np.inf)
        nearest, cells = np.full(len(query), np.inf), self.cells(query)
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                middle = self.keys(cells + (dx, dy, 0))  # The cells below and above have the next keys.
                first = np.searchsorted(self.key, middle - 1, "left")
                number = np.searchsorted(self.key, middle + 1, "right") - first
                some = np.flatnonzero(number)
                if some.size == 0:
                    continue
                first, number = first[some], number[some]
                starts = np.cumsum(number) - number
                other = np.arange(number.sum()) - np.repeat(starts - first, number)
                squares = ((self.points[other] - np.repeat(query[some], number, axis=0)) ** 2).sum(1)
                nearest[some] = np.minimum(nearest[some], np.minimum.reduceat(squares, starts))
        nearest = np.sqrt(nearest)
        found[inside] = np.where(nearest <= self.radius_m, nearest, np.inf)
        return found


def moved(points, quaternion_xyzw, translation_m):
    """R p + t of each point."""
    x, y, z, w = np.asarray(quaternion_xyzw) / np.linalg.norm(quaternion_xyzw)
    R = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                  [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                  [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    return points @ R.T + translation_m


def fit(distances_m, max_distance_m):
    """Open3D's fitness and inlier RMSE (infinite without inliers), and the number of inliers."""
    inliers = distances_m[distances_m <= max_distance_m]
    rmse = float(np.sqrt((inliers ** 2).mean())) if inliers.size else float("inf")
    return inliers.size / len(distances_m), rmse, int(inliers.size)
