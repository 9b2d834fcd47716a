"""Distances of a compared run by error region (figure 7, right)."""
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


def source_of(folder, name):
    return next(s for s in read(folder / "comparison.json")["sources"] if s["name"] == name)


def moments(folder, apparent=False):
    """At each of the ten frames. apparent: of the imaged lumen, in place of the run's."""
    found = []
    for moment in source_of(folder, "twin")["moments"]:
        groups = {g["region"]: g["apparent"] if apparent else g for g in moment["groups"] if g["region"]}
        of = lambda key: {region: MM * groups[region][key] if groups[region]["samples"] > 0 else math.nan for region in ERROR_REGIONS}
        found.append(Moment(moment["time"], of("l2"), of("linf")))
    return found


def whole(folder):
    """Root mean square over the lumen and all frames [mm]: of the data, and of the frames between."""
    group = lambda source, kind: next(g for g in source_of(folder, source)[kind]["all_frames"] if g["region"] is None)
    return MM * group("twin", "training")["l2"], MM * group("between", "held_out")["l2"]


def over_beat(found, region):
    """Root mean square over the moments, and the largest distance of all."""
    values = [m.l2[region] for m in found]
    return math.sqrt(sum(v * v for v in values) / len(values)), max(m.linf[region] for m in found)
