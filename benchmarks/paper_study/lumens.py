"""Moving and measured lumens, and their cuts by planes."""
import base64
import csv
import xml.etree.ElementTree

import numpy

from workshop import read


def positions(moment):
    """Of the nodes at a moment of wall.json [n x 3]."""
    packed = moment["positions"]  # a row for each direction
    return numpy.frombuffer(base64.b64decode(packed["float32"]), dtype="<f4").reshape(packed["shape"]).astype(float).T


def of_run(folder, frame):
    """Positions [n x 3] and triangles of a compared run at a frame."""
    wall = read(folder / "wall.json")
    source = next(s for s in wall["sources"] if s["name"] == "twin")
    return positions(source["moments"][frame]), numpy.array(wall["triangles"]).reshape(-1, 3)


def normals(points, triangles):
    """At nodes, of the triangles around them by area."""
    corners = points[triangles]
    areas = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = numpy.zeros_like(points)
    for corner in range(3):
        numpy.add.at(sums, triangles[:, corner], areas)
    return sums / numpy.linalg.norm(sums, axis=1)[:, None]


CURVES = {"the chord": (0, 8, 8, 0), "the curve": (-1, 9, 9, -1)}  # sixteenths of four frames alike far apart, half way between the middle two (O.3)


def off_the_curves(folder, regions):
    """How far a run's lumen is from where its frames put it, half way between two of them, along its normal: root mean
    square over the beat and the largest [mm], by curve and region. regions: {name: names in the run}."""
    wall = read(folder / "wall.json")
    triangles = numpy.array(wall["triangles"]).reshape(-1, 3)
    at = {s["name"]: [positions(m) for m in s["moments"]] for s in wall["sources"]}
    names = numpy.array(wall["regions"])[numpy.array(wall["region"])]
    def off(shares):
        made = lambda k: sum(share / 16 * frame for share, frame in zip(shares, at["twin"][k - 1:k + 3]))
        middles = [(k, at["between"][k]) for k in range(1, len(at["twin"]) - 2)]
        return 10 * numpy.array([numpy.sum((x - made(k)) * normals(x, triangles), axis=1) for k, x in middles])
    def by_region(values):
        of = lambda parts: values[:, numpy.isin(names, parts)]
        return {name: (float(numpy.sqrt(numpy.mean(of(parts) ** 2))), float(numpy.abs(of(parts)).max())) for name, parts in regions.items()}
    return {curve: by_region(off(shares)) for curve, shares in CURVES.items()}


def measured(folder, frame):
    """The same of a twin's surface: numbers lie behind the text, each array with its length before it."""
    head, _, numbers = (folder / f"data/lumen_{frame:02}.vtp").read_bytes().partition(b'<AppendedData encoding="raw">\n_')
    arrays = {a.get("Name"): a for a in xml.etree.ElementTree.fromstring(head + b"</VTKFile>").iter("DataArray")}

    def values(name, kind):
        start = int(arrays[name].get("offset"))
        size = int.from_bytes(numbers[start:start + 8], "little")
        return numpy.frombuffer(numbers[start + 8:start + 8 + size], kind).reshape(-1, 3)

    return values("points", "<f4").astype(float), values("connectivity", "<i4").astype(int)


def cut(points, triangles, origin, normal, reach):
    """Segments in which a plane cuts triangles within reach of the origin, in the plane's coordinates [mm]."""
    across = numpy.cross(normal, [1.0, 0, 0])
    across /= numpy.linalg.norm(across)
    axes = numpy.array([across, numpy.cross(normal, across)])
    height = (points - origin) @ normal
    segments = []
    for t in triangles[numpy.linalg.norm(points[triangles[:, 0]] - origin, axis=1) < reach]:
        ends = []
        for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])):
            if (height[a] < 0) != (height[b] < 0):
                share = height[a] / (height[a] - height[b])
                ends.append(10 * axes @ (points[a] + share * (points[b] - points[a]) - origin))
        if len(ends) == 2:
            segments.append(ends)
    return segments


def centreline(file, branch):
    """Points of a branch [cm]."""
    with open(file) as lines:
        rows = list(csv.DictReader((line for line in lines if not line.startswith("#")), skipinitialspace=True))
    scale = 0.1 if "x [mm]" in rows[0] else 1.0
    unit = "mm" if scale == 0.1 else "cm"
    return scale * numpy.array([[float(r[f"{axis} [{unit}]"]) for axis in "xyz"] for r in rows if r["branch"] == branch])


def place_along(line, distance):
    """Point and direction at a distance from a line's start."""
    steps = numpy.linalg.norm(numpy.diff(line, axis=0), axis=1)
    k = min(int(numpy.searchsorted(numpy.cumsum(steps), distance)), len(steps) - 1)
    return line[k], (line[k + 1] - line[k]) / steps[k]
