#!/usr/bin/python3
"""A fluid that tells its velocity: load = -2 v on each node of a tube, and a parabola along it."""

import sys

import numpy as np
import tether


class Fluid:
    program = "python fluid 1"

    def __init__(self):
        around = 6
        self.points = np.array([(np.cos(a), np.sin(a), z) for z in (0, 1, 2) for a in 2 * np.pi * np.arange(around) / around])
        quads = [(j * around + i, j * around + (i + 1) % around) for j in range(2) for i in range(around)]
        self.triangles = [t for a, b in quads for t in ((a, b, b + around), (a, b + around, a + around))]

    def begin_step(self, step, time, dt, predicted):
        pass

    def evaluate(self, displacement, velocity):
        return -2 * velocity

    def end_step(self, accepted):
        pass

    def velocity(self, points):
        share = 1 - np.sum(points[:, :2] ** 2, axis=1)
        found = np.zeros_like(points)
        found[:, 2] = share
        found[(share <= 0) | (points[:, 2] < 0) | (points[:, 2] > 2)] = np.nan
        return found


sys.exit(tether.serve("fluid", Fluid))
