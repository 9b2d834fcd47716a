"""Figures of direct and observed runs: 7 to 10, 13 and 14. Each makes its runs, draws, and returns what the page says."""
import csv
import math
import shutil
import subprocess

import lumens
import plots
from anatomy import ERROR_REGIONS, SUPPORTED, supports, vessel
from distances import moments, over_beat, whole
from models import BY_HAND, FRAME_APART, IMAGE_PRESSURE, OUTLETS
from workshop import PROGRAMS, Failed

GAINS = (0, 3, 15, 30)
HARDLY = 1e3  # dyn/cm3, a tenth of the light support
CLAMPED = [f"solid.rings.{name}_ring" for name in ("ascending", *OUTLETS)]


def regions_picture(study, figure):
    """Figure 7: support regions and those for distances, as tether mesh draws them."""
    undivided = vessel(study.shop, "undivided", study.size.model, divided=False)
    for case, name in ((study.model, "support"), (undivided, "error")):
        folder = study.shop.folder / f"regions_{name}"
        if not (folder / "mesh/regions.png").exists():
            subprocess.run([PROGRAMS / "tether", "mesh", case, "--output", folder, "--overwrite"], check=True, capture_output=True)
        shutil.copy(folder / "mesh/regions.png", figure(f"figure7_{name}"))


def apparent(study, figure):
    """Figure 8, from any compared run."""
    found = moments(study.direct("none", {}), apparent=True)
    plots.distances(figure("figure8"), [("apparent motion", found)])
    return {region: over_beat(found, region) for region in ERROR_REGIONS}


def clamped(study, figure):
    """Figure 9: all ends fixed, and hardly anything else holds the aorta. None: it broke off."""
    fields = {path: {"type": "clamped"} for path in CLAMPED}
    fields |= {f"solid.support.regions.{region}": {"stiffness": HARDLY} for region in SUPPORTED}
    try:
        found = moments(study.direct("clamped", fields))
    except Failed as failed:
        study.shop.tell(failed)
        return None
    plots.distances(figure("figure9"), [("clamped at its ends", found)])
    return {region: over_beat(found, region) for region in ERROR_REGIONS}


def pulled(gain):
    """By the observer; not in the branches: their few elements lie up to 2 mm off the data from the first frame on, and fold."""
    return {"observer.gain": gain, "observer.regions.small_arteries.gain": 0}


def observed(study, figure):
    """Figure 10: calibrated by hand, as the paper's, pulled toward the data by four gains, from the right start and a wrong one."""
    table = {}
    for start, fields in (("right", {}), ("wrong", study.wrong_start())):
        runs = {gain: lambda gain=gain, fields=fields: study.direct(f"observed_{gain}_{start}", {**pulled(gain), **supports(BY_HAND), **fields}) for gain in GAINS}
        if start == "right":
            runs[0] = lambda: study.direct("by_hand", supports(BY_HAND))
        folders = study.shop.those_made(runs, at_once=2)
        rows = [(f"gain {gain} 1/s, {start} start", moments(folder)) for gain, folder in folders.items()]
        table |= {(start, gain): (*whole(folders[gain]), max(v for m in found for v in m.linf.values())) for gain, (_, found) in zip(folders, rows)}
        if rows:
            plots.distances(figure(f"figure10_{start}"), rows)
    return table


def direct_runs(study, figure, identified):
    """Figure 13. identified: [(name, values by region)]."""
    models = {"no support": ("none", {}), "by hand": ("by_hand", supports(BY_HAND)), **{title: (f"direct_{name}", supports(values)) for name, title, values in identified}}
    folders = study.shop.those_made({title: lambda name=name, fields=fields: study.direct(name, fields) for title, (name, fields) in models.items()}, at_once=2)
    rows = {title: moments(folder) for title, folder in folders.items()}
    plots.distances(figure("figure13"), list(rows.items()))
    return {title: (*whole(folders[title]), {region: over_beat(found, region)[0] for region in ERROR_REGIONS}) for title, found in rows.items()}


def series(folder):
    """Columns of timeseries.csv by name, in the case's units."""
    with open(folder / "timeseries.csv") as lines:
        heads = next(csv.reader(lines), [])
        rows = [[float(v) if v else math.nan for v in row] for row in csv.reader(lines) if row and not row[0].startswith("#")]
    names = [head.split("[")[0].strip() for head in heads]
    return dict(reversed(list(zip(names, zip(*rows)))))  # pressures stand there twice, in the case's unit first


def contours_and_openings(study, figure, identified):
    """Figure 14: outlines at peak systole, and flow and pressure at the outlets. identified: name of a run."""
    truth, found = series(study.truth_run), series(study.shop.folder / identified)
    peak = truth["time"][max(range(len(truth["time"])), key=lambda i: truth["fluid.ascending.pressure"][i])]
    frame = round(peak / FRAME_APART)
    line = lumens.centreline(study.shop.folder / "plain_mesh/model/centreline.csv", "descending")
    panels = []
    for distance in (4, 17, 24):
        origin, way = lumens.place_along(line, distance)
        outline = lambda lumen: lumens.cut(*lumen, origin, way, 3.0)
        panels.append((f"{10 * distance} mm from the root, {frame * FRAME_APART:.2f} s", {
            "data": outline(lumens.measured(study.data[study.size.seeds[0]].parent, frame)),
            "by hand": outline(lumens.of_run(study.shop.folder / "by_hand", frame)),
            "identified": outline(lumens.of_run(study.shop.folder / identified, frame))}))
    plots.outlines(figure("figure14_outlines"), panels)
    mmhg = lambda of, name: [IMAGE_PRESSURE + p / 1333.22 for p in of[f"fluid.{name}.pressure"]]
    curves = [(f"{o.replace('_', ' ')}: flow [ml/s]", {"truth": (truth["time"], truth[f"fluid.{o}.flow"]), "identified": (found["time"], found[f"fluid.{o}.flow"])}) for o in OUTLETS]
    curves += [(f"{o.replace('_', ' ')}: pressure [mmHg]", {"truth": (truth["time"], mmhg(truth, o)), "identified": (found["time"], mmhg(found, o))}) for o in OUTLETS]
    plots.curves(figure("figure14_outlets"), curves)
    total = sum(sum(found[f"fluid.{o}.flow"]) for o in OUTLETS)
    return {o: (min(mmhg(found, o)), max(mmhg(found, o)), 100 * sum(found[f"fluid.{o}.flow"]) / total) for o in OUTLETS}
