#!/usr/bin/python3
"""A solid of your own in Python: a mass, a damper and a spring at each interface node, backward Euler."""

import sys

import numpy as np
import tether


class SpringSolid:
    program = "python spring solid 1"
    m, c, k = 1.0, 2.0, 50.0
    parameters = [dict(name="stiffness", value=50.0, unit="dyn/cm", transform="log2", lower=0)]

    def __init__(self):
        around, along = 6, 3  # the interface: a tube of radius 1 and length 2
        self.points = np.array([(np.cos(a), np.sin(a), z) for z in np.linspace(0, 2, along)
                                for a in 2 * np.pi * np.arange(around) / around])
        quads = [(j * around + i, j * around + (i + 1) % around) for j in range(along - 1) for i in range(around)]
        self.triangles = [t for a, b in quads for t in ((a, b, b + around), (a, b + around, a + around))]
        self.y0, self.u0 = np.zeros_like(self.points), np.zeros_like(self.points)
        self.state_size = 2 * self.points.size

    def begin_step(self, step, time, dt, predicted):
        self.dt, self.tangent_number = dt, self.m / dt + self.c + self.k * dt

    def evaluate(self, load):
        self.v = (load + self.m * self.u0 / self.dt - self.k * self.y0) / self.tangent_number
        return self.y0 + self.dt * self.v, self.v

    def tangent(self, change):
        return self.dt * change / self.tangent_number, change / self.tangent_number

    def end_step(self, accepted):
        if accepted:
            self.y0, self.u0 = self.y0 + self.dt * self.v, self.v

    def set_parameters(self, values):
        self.k = values["stiffness"]

    def get_state(self):
        return np.concatenate([self.y0.ravel(), self.u0.ravel()])

    def set_state(self, values):
        self.y0, self.u0 = values.reshape(2, -1, 3)


sys.exit(tether.serve("solid", SpringSolid))
