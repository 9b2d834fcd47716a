#!/usr/bin/python3
"""A wall of your own: rings of a thin elastic tube in soft tissue, which do not know of each other (docs/couple-your-code.md)."""

import sys

import numpy as np
import tether


class RingSolid:
    program = "ring solid 1"

    def __init__(self):
        case = tether.case(sys.argv[1])
        tube, wall = case["mesh"]["swept"], case["solid"]
        self.make_interface(tube["radius"], tube["length"], **wall["mesh"])
        self.hoop = tube["wall_thickness"] / tube["radius"] ** 2  # times Young's modulus: pressure per radial displacement
        self.values = {"material.young": wall["material"]["young"], "tissue.stiffness": wall["tissue"]["stiffness"]}
        units = {"material.young": "g/(cm s2)", "tissue.stiffness": "g/(cm2 s2)"}
        self.parameters = [dict(name=name, value=value, unit=units[name], transform="log2", lower=0) for name, value in self.values.items()]
        self.parameters[1].update(absent=0, scale=1e6)
        self.damping, self.mass = wall["tissue"]["damping"], wall["density"] * tube["wall_thickness"]
        self.y, self.u = np.zeros_like(self.points), np.zeros_like(self.points)
        self.state_size = 2 * self.points.size

    def make_interface(self, radius, length, around, along):
        angle, z = np.meshgrid(2 * np.pi * np.arange(around) / around, np.linspace(0, length, along + 1))
        outward = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1).reshape(-1, 3)
        self.points = radius * outward + np.stack([0 * z, 0 * z, z], axis=-1).reshape(-1, 3)
        self.radial = outward[:, :, None] * outward[:, None, :]  # takes of a vector what is radial
        quads = [(j * around + i, j * around + (i + 1) % around) for j in range(along) for i in range(around)]
        self.triangles = [t for a, b in quads for t in ((a, b, b + around), (a, b + around, a + around))]
        a, b, c = (self.points[corner] for corner in np.transpose(self.triangles))
        thirds = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6
        self.area = np.zeros(len(self.points))
        for corner in np.transpose(self.triangles):
            np.add.at(self.area, corner, thirds)
        self.held = np.isin(self.points[:, 2], (0, length))

    def begin_step(self, step, time, dt, predicted):
        """Of each node a 3 x 3 matrix: mass/dt + damping + dt (springs), times its area."""
        self.dt = dt
        self.springs = self.values["tissue.stiffness"] * np.eye(3) + self.values["material.young"] * self.hoop * self.radial
        self.matrix = self.area[:, None, None] * ((self.mass / dt + self.damping) * np.eye(3) + dt * self.springs)

    def evaluate(self, load):
        at_start = self.mass / self.dt * self.u - np.einsum("nij,nj->ni", self.springs, self.y)
        self.v = np.linalg.solve(self.matrix, (load + self.area[:, None] * at_start)[:, :, None])[:, :, 0]
        self.v[self.held] = 0
        return self.y + self.dt * self.v, self.v

    def end_step(self, accepted):
        if accepted:
            self.y, self.u = self.y + self.dt * self.v, self.v

    def get_state(self):
        return np.concatenate([self.y.ravel(), self.u.ravel()])

    def set_state(self, values):
        self.y, self.u = values.reshape(2, -1, 3)

    def set_parameters(self, values):
        self.values.update(values)


sys.exit(tether.serve("solid", RingSolid))
