#!/usr/bin/python3
"""One-dimensional blood in a straight tube along z, in the place of Tether's fluid: a code of another kind, with another model of the blood.

Between stations, the rings of nodes of its interface, with the area A(z, t) that the wall has, flow Q and pressure p:

    dA/dt + dQ/dz = 0,   rho (dQ/dt + d(beta Q^2/A)/dz) + A dp/dz = -friction Q/A,

an inflow that is given, and a Windkessel at the outlet; implicit Euler. beta and friction are those of a blunt profile of
order nine (Smith, Pullan and Hunter 2002): 1.1 and 22 pi mu. The wall's motion says all areas, so that each step is two sums along the
tube: of what the wall takes up, from the inlet on, and of the pressure's drop, from the outlet back."""
import sys

import numpy as np
import tether

BETA, FRICTION = 1.1, 22 * np.pi
SMALL = 1e-6  # change of the velocity in a difference, of the largest


class Lattice:
    """Nodes of a tube in rings, and its triangles. points: [nodes, 3]; rings: numbers of nodes [around, stations]."""

    def __init__(self, points, rings):
        self.points, self.rings = points, rings
        a, d = rings[:, :-1], rings[:, 1:]
        b, c = np.roll(a, -1, axis=0), np.roll(d, -1, axis=0)
        self.triangles = np.concatenate([np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))])  # normals outward
        self.spacing = np.diff(points[rings[0], 2])

    @classmethod
    def of_tube(cls, radius, length, around, along):
        angle, z = np.meshgrid(2 * np.pi * np.arange(around) / around, np.linspace(0, length, along + 1), indexing="ij")
        points = np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=-1).reshape(-1, 3)
        return cls(points, np.arange(len(points)).reshape(angle.shape))

    def areas(self, nodes):
        """Of the cross-sections, seen along the tube [stations]: of what is round through the corners of their polygons, whose own area is
        1 % less with 24 of them."""
        x, y = nodes[self.rings, 0], nodes[self.rings, 1]
        polygon = np.sum(x * np.roll(y, -1, axis=0) - np.roll(x, -1, axis=0) * y, axis=0) / 2
        turn = 2 * np.pi / len(self.rings)
        return polygon * turn / np.sin(turn)

    def forces(self, nodes, pressure):
        """[nodes, 3] of a pressure [stations] on the wall as it lies, with linear functions on its triangles."""
        at_nodes = np.empty(len(nodes))
        at_nodes[self.rings] = pressure
        a, b, c = (nodes[self.triangles[:, k]] for k in range(3))
        normal, p = np.cross(b - a, c - a) / 2, at_nodes[self.triangles]
        forces = np.zeros_like(nodes)
        for corner in range(3):
            np.add.at(forces, self.triangles[:, corner], ((p.sum(axis=1) + p[:, corner]) / 12)[:, None] * normal)
        return forces


class Blood:
    program = "blood_1d 1"
    observables = [("inlet.flow", "cm3/s"), ("outlet.flow", "cm3/s"), ("inlet.pressure", "g/(cm s2)"), ("outlet.pressure", "g/(cm s2)")]

    def __init__(self, lattice, inflow, numbers):
        """numbers: the places of PARAMETERS below `fluid`, and `distal_pressure`, in the case's units."""
        self.lattice, self.inflow, self.numbers = lattice, inflow, numbers
        self.points, self.triangles = lattice.points, lattice.triangles
        stations = len(lattice.spacing) + 1
        self.area, self.through, self.stored = lattice.areas(self.points), np.zeros(stations), 0.0
        self.pressure = np.zeros(stations)
        self.state_size = 2 * stations + 1
        self.parameters = [dict(name=name, value=numbers[name], unit=unit, transform="log2", prior_deviation=1, lower=0) for name, unit in PARAMETERS.items()]

    def set_parameters(self, values):
        self.numbers |= values

    def begin_step(self, step, time, dt, predicted):
        self.time, self.dt = time + dt, dt

    def evaluate(self, displacement, velocity):
        self.displacement, self.velocity = displacement, velocity
        self.trial = self.blood(displacement)
        return self.lattice.forces(self.points + displacement, self.trial[2])

    def tangent(self, change):
        size = np.abs(change).max()
        if size == 0:
            return np.zeros_like(change)
        step = SMALL * max(np.abs(self.velocity).max(), 1) / size
        forces = [self.lattice.forces(self.points + at, self.blood(at)[2]) for at in (self.displacement + sign * step * self.dt * change for sign in (1, -1))]
        return (forces[0] - forces[1]) / (2 * step)

    def blood(self, displacement):
        """Areas, flows, pressures [stations] and the reservoir's pressure at the end of the step."""
        density, viscosity, near, far, compliance = (self.numbers[name] for name in PARAMETERS)
        area, spacing = self.lattice.areas(self.points + displacement), self.lattice.spacing
        filled = spacing * middle(area - self.area)
        through = self.inflow(self.time) - np.concatenate([[0], np.cumsum(filled)]) / self.dt
        share = self.dt / compliance
        stored = (self.stored + share * (through[-1] + self.numbers["distal_pressure"] / far)) / (1 + share / far)
        inertia = density * (middle(through - self.through) / self.dt + BETA * np.diff(through**2 / area) / spacing)
        drop = spacing * (inertia + FRICTION * viscosity * middle(through) / middle(area)) / middle(area)
        pressure = stored + near * through[-1] + np.concatenate([np.cumsum(drop[::-1])[::-1], [0]])
        return area, through, pressure, stored

    def end_step(self, accepted):
        if accepted:
            self.area, self.through, self.pressure, self.stored = self.trial
        return [self.through[0], self.through[-1], self.pressure[0], self.pressure[-1]]

    def get_state(self):
        return np.concatenate([self.area, self.through, [self.stored]])

    def set_state(self, values):
        self.area, self.through = np.split(values[:-1], 2)
        self.stored = values[-1]


# In the order in which Blood.blood takes them.
PARAMETERS = {"density": "g/cm3", "rheology.viscosity": "g/(cm s)", "outlets.outlet.proximal_resistance": "g/(cm4 s)",
              "outlets.outlet.distal_resistance": "g/(cm4 s)", "outlets.outlet.compliance": "cm4 s2/g"}


def middle(values):
    return (values[:-1] + values[1:]) / 2


def of_case():
    """As the case says."""
    case = tether.case(sys.argv[1])
    tube, fluid = case["mesh"]["swept"], case["fluid"]
    flow, outlet = fluid["inlets"]["inlet"]["flow"], fluid["outlets"]["outlet"]
    for place, kind, own in (("fluid.rheology", fluid["rheology"]["type"], "newtonian"), ("fluid.outlets.outlet", outlet["type"], "windkessel")):
        if kind != own:
            raise ValueError(f"{place}.type: {kind}: this blood knows {own} only")
    numbers = {"density": fluid["density"], "rheology.viscosity": fluid["rheology"]["viscosity"], "distal_pressure": outlet["distal_pressure"],
               **{name: outlet[name.rsplit(".", 1)[1]] for name in PARAMETERS if name.startswith("outlets.")}}
    mesh = fluid.get("mesh", tube)
    return Blood(Lattice.of_tube(tube["radius"], tube["length"], mesh["around"], mesh["along"]), tether.Curve(**flow), numbers)


if __name__ == "__main__":
    sys.exit(tether.serve("fluid", of_case))
