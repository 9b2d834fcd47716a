"""Segmented surfaces of a run of another code (data/peer_hidden): another triangulation, errors along the normal."""
import numpy as np

RADIUS, LENGTH, PERIOD = 2.0, 10.0, 0.9  # [cm, cm, s]
AROUND, ALONG = 46, 37  # of the surfaces, whose places fit no node of a model
WAVES = 600


class Lattice:
    """A field at the nodes of a tube, which lie on a lattice of angles and places along it."""

    def __init__(self, nodes):
        angle = np.round(np.arctan2(nodes[:, 1], nodes[:, 0]) / (2 * np.pi), 6) % 1  # of a turn
        along = np.round(nodes[:, 2], 6)
        self.around, self.along = len(np.unique(angle)), len(np.unique(along))
        self.order = np.lexsort((along, angle)).reshape(self.around, self.along)

    def at(self, field, angle, along):
        """By cubic convolution (Keys 1981), periodic in the angle. field [nodes x 3]; angle, along [n] -> [n x 3]."""
        values = field[self.order]
        ends = 2 * values[:, [0, -1]] - values[:, [1, -2]]
        values = np.concatenate([ends[:, :1], values, ends[:, 1:]], axis=1)
        x, y = angle / (2 * np.pi) * self.around, along / LENGTH * (self.along - 1)
        i, j = np.floor(x).astype(int), np.minimum(np.floor(y).astype(int), self.along - 2)
        result = np.zeros((len(angle), 3))
        for a, in_x in enumerate(self._weights(x - i)):
            for b, in_y in enumerate(self._weights(y - j)):
                result += (in_x * in_y)[:, None] * values[(i + a - 1) % self.around, j + b]
        return result

    @staticmethod
    def _weights(s):
        return ((-s + 2 * s**2 - s**3) / 2, (2 - 5 * s**2 + 3 * s**3) / 2, (s + 4 * s**2 - 3 * s**3) / 2, (s**3 - s**2) / 2)


def triangulation(generator, around=AROUND, rings=ALONG):
    """Angles, places along [n] and triangles of a tube whose nodes are moved at random and whose diagonals change."""
    angle, along = np.meshgrid((np.arange(around) + 0.5) / around * 2 * np.pi, np.linspace(0, LENGTH, rings), indexing="ij")
    angle = angle + generator.uniform(-0.25, 0.25, angle.shape) * 2 * np.pi / around
    along = along.copy()
    along[:, 1:-1] += generator.uniform(-0.25, 0.25, (around, rings - 2)) * LENGTH / (rings - 1)
    triangles = []
    for i in range(around):
        for j in range(rings - 1):
            p, q = i * rings + j, (i + 1) % around * rings + j
            triangles += [(p, q, q + 1), (p, q + 1, p + 1)] if generator.random() < 0.5 else [(p, q, p + 1), (q, q + 1, p + 1)]
    return angle.ravel() % (2 * np.pi), along.ravel(), np.array(triangles)


def errors(places, deviation, length, correlation, generator):
    """Of normal distribution, alike over `length`: by waves with the spectrum of exp(-r/l) or exp(-(r/l)^2/2)."""
    waves = generator.normal(size=(WAVES, 3)) / length
    if correlation == "exponential":
        waves /= np.abs(generator.normal(size=(WAVES, 1)))  # (T.1)
    phase = generator.uniform(0, 2 * np.pi, WAVES)
    return deviation * np.sqrt(2 / WAVES) * np.cos(places @ waves.T + phase).sum(axis=1)


def normals(points, triangles):
    """Outward, at the nodes."""
    sides = np.cross(points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]])
    sums = np.zeros_like(points)
    for corner in range(3):
        np.add.at(sums, triangles[:, corner], sides)
    return sums / np.linalg.norm(sums, axis=1)[:, None]


def write_ply(path, points, triangles):
    with open(path, "w") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
                   f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
        np.savetxt(file, points, fmt="%.7g")
        np.savetxt(file, np.c_[np.full(len(triangles), 3), triangles], fmt="%d")


def motion_of(run):
    """Nodes at rest [n, 3], displacements [k, n, 3] and their times [k]: of a .npz of data/peer_hidden, or of a run of Tether (lumen.motion)."""
    if run.suffix == ".npz":
        data = np.load(run)
        return data["X"], data["U"].astype(float), data["t"]
    with open(run, "rb") as file:
        checksum = [("checksum", "<u8")] if file.readline().strip().endswith(b"2") else []  # those of before had none
        count = int(np.fromfile(file, "<i8", 1)[0])
        nodes = np.fromfile(file, "<f8", 3 * count).reshape(count, 3)
        file.seek(8 * len(checksum), 1)
        records = np.fromfile(file, np.dtype([("time", "<f8"), ("vectors", "<f4", (count, 3)), *checksum]))
    later = records["time"] > 0
    return nodes, records["vectors"][later].astype(float), records["time"][later]


def moments(frames):
    """Times of the frames of a beat [s]."""
    return np.arange(frames) * PERIOD / frames


class Moving:
    """A run's lumen at any place and moment, linear between what was recorded."""

    def __init__(self, run):
        self.nodes, motion, times = motion_of(run)
        self.lattice = Lattice(self.nodes)
        self.times, self.motion = np.concatenate([[0], times]), np.concatenate([np.zeros((1, *motion.shape[1:])), motion])

    def at(self, time, angle, along):
        """angle, along [n] -> places [n x 3]."""
        after = min(max(int(np.searchsorted(self.times, time)), 1), len(self.times) - 1)
        share = (time - self.times[after - 1]) / (self.times[after] - self.times[after - 1])
        return self.lattice.at(self.nodes + (1 - share) * self.motion[after - 1] + share * self.motion[after], angle, along)


def write(folder, frames, triangles):
    """frames: moments and the nodes at them."""
    folder.mkdir(parents=True, exist_ok=True)
    rows = ["file,time [s]"]
    for k, (time, points) in enumerate(frames):
        write_ply(folder / f"frame_{k}.ply", points, triangles)
        rows.append(f"frame_{k}.ply,{time:.6f}")
    (folder / "times.csv").write_text("\n".join(rows) + "\n")


def make(run, folder, frames, deviation, length, correlation, seed):
    """Surfaces of a run at `frames` moments of a beat, and times.csv, into a folder."""
    moving, generator = Moving(run), np.random.default_rng(seed)
    angle, along, triangles = triangulation(generator)
    rest = np.c_[RADIUS * np.cos(angle), RADIUS * np.sin(angle), along]

    def seen(time):
        points = moving.at(time, angle, along)
        return points + normals(points, triangles) * errors(rest, deviation, length, correlation, generator)[:, None]

    write(folder, [(time, seen(time)) for time in moments(frames)], triangles)


def make_without_errors(run, folder, frames):
    """The same so fine that chords across the triangles are no error either."""
    moving, finer = Moving(run), 4
    angle, along, triangles = triangulation(np.random.default_rng(0), finer * AROUND, finer * ALONG)
    write(folder, [(time, moving.at(time, angle, along)) for time in moments(frames)], triangles)
