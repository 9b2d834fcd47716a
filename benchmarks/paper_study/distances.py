"""Distances of a compared run by error region (figure 7, right): each is one or several support regions."""
import dataclasses
import math

from anatomy import ERROR_REGIONS
from workshop import read

MM = 10  # in a cm


@dataclasses.dataclass
class Moment:
    time: float  # [s]
    l2: dict  # by error region [mm]
    linf: dict


def joined(groups, regions):
    """Root mean square over the area of several regions, and the largest distance."""
    parts = [g for g in groups if g["region"] in regions and g["samples"] > 0]
    area = sum(g["extent"] for g in parts)
    if area == 0:
        return math.nan, math.nan
    return MM * math.sqrt(sum(g["extent"] * g["l2"] ** 2 for g in parts) / area), MM * max(g["linf"] for g in parts)


def source_of(folder, name):
    return next(s for s in read(folder / "comparison.json")["sources"] if s["name"] == name)


def moments(folder, apparent=False):
    """At each of the ten frames. apparent: of the imaged lumen, in place of the run's."""
    found = []
    for moment in source_of(folder, "twin")["moments"]:
        groups = [{**g["apparent"], "region": g["region"]} if apparent else g for g in moment["groups"]]
        each = {name: joined(groups, parts) for name, parts in ERROR_REGIONS.items()}
        found.append(Moment(moment["time"], {n: v[0] for n, v in each.items()}, {n: v[1] for n, v in each.items()}))
    return found


def whole(folder):
    """Root mean square over the lumen and all frames [mm]: of the data, and of the frames between."""
    group = lambda source, kind: next(g for g in source_of(folder, source)[kind]["all_frames"] if g["region"] is None)
    return MM * group("twin", "training")["l2"], MM * group("between", "held_out")["l2"]


def over_beat(found, region):
    """Root mean square over the moments, and the largest distance of all."""
    values = [m.l2[region] for m in found]
    return math.sqrt(sum(v * v for v in values) / len(values)), max(m.linf[region] for m in found)
