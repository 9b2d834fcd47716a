#!/usr/bin/python3
"""What blood.py says of flows that are known, without Tether: verify.py CASE.yaml. Each line: a quantity, what it should be, how far off it
is in %."""
import sys

import numpy as np
from blood import Blood


def tell(name, found, exact):
    print(f"{name:60s} {exact:12.6g}  {100 * (found / exact - 1):+.2g} %", flush=True)


def prepared(numbers, inflow):
    blood = Blood()
    blood.set_parameters(numbers)
    blood.flow = lambda time: inflow
    return blood


def advance(blood, dt, displacement):
    """One step that is accepted. Returns the forces of the last evaluation."""
    blood.begin_step(0, 0.0, dt, displacement)
    forces = blood.evaluate(displacement, None)
    blood.end_step(True)
    return forces


def along(blood):
    """z of the discs of cells, and the mean pressure in each."""
    return blood.length * (np.arange(blood.along) + 0.5) / blood.along, blood.pressure.reshape(blood.along, -1).mean(axis=1)


def poiseuille():
    """Steady flow between walls at rest: dp/dz = -8 mu Q / (pi R^4), and friction that holds it."""
    viscosity, flow, dt = 4.0, 10.0, 0.01
    blood = prepared({"rheology.viscosity": viscosity}, flow)
    for _ in range(150):
        forces = advance(blood, dt, np.zeros_like(blood.points))
    z, p = along(blood)
    middle = abs(z - blood.length / 2) < blood.length / 4
    exact = 8 * viscosity * flow / (np.pi * blood.radius**4)
    tell("Poiseuille: fall of pressure [g/(cm2 s2)]", -np.polyfit(z[middle], p[middle], 1)[0], exact)
    tell("Poiseuille: friction on the wall [g cm/s2]", forces[:, 2].sum(), exact * np.pi * blood.radius**2 * blood.length)


def contraction():
    """A wall that closes all along at r'' = -a squeezes inviscid blood out of a tube shut at the inlet: p falls by rho a L^2 / R while all
    motion is small, and what leaves is what the lumen loses."""
    acceleration, dt, steps = 10.0, 2e-3, 5
    blood = prepared({"rheology.viscosity": 1e-6}, 0.0)
    outward = blood.points * [1, 1, 0] / blood.radius
    before = np.zeros_like(outward)
    for k in range(1, steps + 1):
        lost, displacement = volume(blood, before), -acceleration / 2 * (k * dt) ** 2 * outward
        forces = advance(blood, dt, displacement)
        lost, before = lost - volume(blood, displacement), displacement
    z, p = along(blood)
    tell("contraction: fall of pressure [g/(cm s2)]", p[0] - p[-1], blood.density * acceleration * (z[-1] ** 2 - z[0] ** 2) / blood.radius)
    tell("contraction: outflow [cm3/s]", blood.told[1], lost / dt)


def volume(blood, displacement):
    """Of the lumen, whose ends stay in their planes."""
    nodes = blood.tube.points.copy()
    nodes[blood.wall] += displacement
    a, b, c = np.moveaxis(nodes[blood.wall][blood.triangles], 1, 0)
    outlet = nodes[blood.faces("outlet")]
    area = np.cross(outlet[:, 2] - outlet[:, 0], outlet[:, 3] - outlet[:, 1])[:, 2].sum() / 2
    return (np.einsum("ij,ij", np.cross(a, b), c) / 2 + area * blood.length) / 3


if __name__ == "__main__":
    poiseuille()
    contraction()
