#!/usr/bin/python3
"""One-dimensional blood in a straight tube, in the place of `fluid`: a code of another kind, with another model of the blood.

Started by fsi_master (coupling.programs.fluid) with the path of a case; its own input is the case's path with the
ending .blood.json: {"motion": lumen.motion of a run with the wall's mesh, "flow": CSV file, "density", "viscosity",
"proximal_resistance", "distal_resistance", "compliance", "distal_pressure"}, in the case's units.

Between stations, the rings of nodes of the wall, with the area A(z, t) that the wall has, flow Q and pressure p:

    dA/dt + dQ/dz = 0,   rho (dQ/dt + d(beta Q^2/A)/dz) + A dp/dz = -friction Q/A,

an inflow that is given, and a Windkessel at the outlet; implicit Euler. beta and friction are those of a blunt profile of
order nine (Smith, Pullan and Hunter 2002): 1.1 and 22 pi mu."""
import json
import pathlib
import sys

import numpy as np
import surfaces

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "tools/python"))
import tether.coupling as tether  # noqa: E402

BETA, FRICTION = 1.1, 22 * np.pi
SMALL = 1e-6  # change of the velocity in a difference, of the largest


def triangles_of(order):
    """Of a tube whose nodes lie on a lattice [around x along]; normals outward."""
    around, along = order.shape
    quads = [(order[i, j], order[(i + 1) % around, j], order[(i + 1) % around, j + 1], order[i, j + 1]) for i in range(around) for j in range(along - 1)]
    return np.array([corners for a, b, c, d in quads for corners in ((a, b, c), (a, c, d))])


class Blood:
    program = "blood_1d"
    observables = [("inlet.flow", "cm3/s"), ("outlet.flow", "cm3/s"), ("inlet.pressure", "dyn/cm2"), ("outlet.pressure", "dyn/cm2")]

    def __init__(self):
        given = json.loads(pathlib.Path(sys.argv[1]).with_suffix(".blood.json").read_text())
        self.points = surfaces.motion_of(pathlib.Path(given["motion"]))[0]
        self.rings = surfaces.Lattice(self.points).order
        self.triangles = triangles_of(self.rings)
        self.length = np.diff(self.points[self.rings[0], 2])
        self.flow = np.loadtxt(given["flow"], delimiter=",", skiprows=1, usecols=(1, 2))
        self.density, self.viscosity = given["density"], given["viscosity"]
        self.near, self.far = given["proximal_resistance"], given["distal_resistance"]
        self.compliance, self.beyond = given["compliance"], given["distal_pressure"]
        self.area, self.through, self.stored, self.pressure = self.areas(self.points), np.zeros(self.rings.shape[1]), 0.0, np.zeros(self.rings.shape[1])
        self.state_size = 2 * len(self.area) + 1

    def areas(self, nodes):
        """Of the cross-sections, seen along the tube [stations]."""
        x, y = nodes[self.rings, 0], nodes[self.rings, 1]
        return np.sum(x * np.roll(y, -1, axis=0) - np.roll(x, -1, axis=0) * y, axis=0) / 2

    def begin_step(self, step, time, dt, predicted):
        self.time, self.dt = time + dt, dt

    def evaluate(self, displacement, velocity):
        self.displacement, self.velocity = displacement, velocity
        self.trial = self.blood(displacement)
        return self.load(displacement, self.trial[2])

    def tangent(self, change):
        size = np.abs(change).max()
        if size == 0:
            return np.zeros_like(change)
        step = SMALL * max(np.abs(self.velocity).max(), 1) / size
        forces = [self.load(at, self.blood(at)[2]) for at in (self.displacement + sign * step * self.dt * change for sign in (1, -1))]
        return (forces[0] - forces[1]) / (2 * step)

    def blood(self, displacement):
        """Areas, flows, pressures [stations] and the reservoir's pressure at the end of the step."""
        area = self.areas(self.points + displacement)
        filled = self.length * (area - self.area)[:-1] / 2 + self.length * (area - self.area)[1:] / 2
        inflow = np.interp(self.time % self.flow[-1, 0], *self.flow.T)
        through = inflow - np.concatenate([[0], np.cumsum(filled)]) / self.dt
        share = self.dt / self.compliance
        stored = (self.stored + share * (through[-1] + self.beyond / self.far)) / (1 + share / self.far)
        middle = lambda values: (values[:-1] + values[1:]) / 2
        inertia = self.density * (middle(through - self.through) / self.dt + BETA * np.diff(through**2 / area) / self.length)
        drop = self.length * (inertia + FRICTION * self.viscosity * middle(through) / middle(area)) / middle(area)
        pressure = stored + self.near * through[-1] + np.concatenate([np.cumsum(drop[::-1])[::-1], [0]])
        return area, through, pressure, stored

    def load(self, displacement, pressure):
        """Forces [nodes x 3] of the pressure on the wall as it lies now."""
        nodes, at_nodes = self.points + displacement, np.empty(len(self.points))
        at_nodes[self.rings] = pressure
        a, b, c = (nodes[self.triangles[:, k]] for k in range(3))
        normal, p = np.cross(b - a, c - a) / 2, at_nodes[self.triangles]
        forces = np.zeros_like(nodes)
        for corner in range(3):
            np.add.at(forces, self.triangles[:, corner], ((p.sum(axis=1) + p[:, corner]) / 12)[:, None] * normal)
        return forces

    def end_step(self, accepted):
        if accepted:
            self.area, self.through, self.pressure, self.stored = self.trial
        return [self.through[0], self.through[-1], self.pressure[0], self.pressure[-1]]

    def get_state(self):
        return np.concatenate([self.area, self.through, [self.stored]])

    def set_state(self, values):
        self.area, self.through = np.split(values[:-1], 2)
        self.stored = values[-1]


if __name__ == "__main__":
    sys.exit(tether.serve("fluid", Blood))
