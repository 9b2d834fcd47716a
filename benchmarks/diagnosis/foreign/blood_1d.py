#!/usr/bin/python3
"""The blood of configs/external_blood_1d on the nodes of another run's wall, in the place of `fluid`.

Started by fsi_master (coupling.programs.fluid) with the path of a case; its own input is the case's path with the
ending .blood.json: {"motion": lumen.motion of a run with the wall's mesh, "flow": CSV file, "density", "viscosity",
"proximal_resistance", "distal_resistance", "compliance", "distal_pressure"}, in the case's units."""
import json
import pathlib
import sys

import numpy as np
import surfaces

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "tools/python"), str(ROOT / "configs/external_blood_1d")]
import tether  # noqa: E402
from blood import PARAMETERS, Blood, Lattice  # noqa: E402


def on_the_wall():
    given = json.loads(pathlib.Path(sys.argv[1]).with_suffix(".blood.json").read_text())
    points = surfaces.motion_of(pathlib.Path(given["motion"]))[0]
    times, flows = np.loadtxt(given["flow"], delimiter=",", skiprows=1, usecols=(1, 2)).T
    numbers = {name: given[name.rsplit(".", 1)[-1]] for name in PARAMETERS} | {"distal_pressure": given["distal_pressure"]}
    blood = Blood(Lattice(points, surfaces.Lattice(points).order), lambda time: np.interp(time % times[-1], times, flows), numbers)
    blood.parameters = []  # its numbers stand beside the case, not in it
    return blood


if __name__ == "__main__":
    sys.exit(tether.serve("fluid", on_the_wall))
