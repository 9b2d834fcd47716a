#!/usr/bin/python3
"""A solid that fails in its set-up, in its first evaluation or in what it says, as the environment variable FAIL_IN says."""

import os
import sys

import tether


class FailingSolid:
    program = "failing solid"
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)] * 6  # as many nodes as the fake fluid has
    triangles = [(0, 1, 2)]

    def __init__(self):
        if os.environ["FAIL_IN"] == "set-up":
            raise ValueError("case.yaml:3: no such mesh")
        if os.environ["FAIL_IN"] == "parameters":
            self.parameters = [{"name": "stiffness"}]

    def begin_step(self, step, time, dt, predicted):
        pass

    def evaluate(self, load):
        if os.environ["FAIL_IN"] == "shape":
            return load[:, :2], load
        if os.environ["FAIL_IN"] == "order":
            return load.T, load.T
        if os.environ["FAIL_IN"] == "count":
            return load
        raise RuntimeError("did not converge")

    def end_step(self, accepted):
        pass


sys.exit(tether.serve("solid", FailingSolid))
