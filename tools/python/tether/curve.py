"""Curves over time as a case states them, for codes that read their own inflow."""

import bisect
import csv
import math


class Curve:
    """A curve as Tether reads it: linear between its times, again in each period, risen smoothly from zero during `ramp`.

    `Curve(**case["fluid"]["inlets"]["inlet"]["flow"])`: `file` is a .csv whose heading names the columns `time` and `value`; curves are in
    the units of their file, which must be the case's. Raises OSError, ValueError of a file that is no such table.
    """

    def __init__(self, file, period, time="time", value="value", scale=1.0, ramp=0.0):
        with open(file, encoding="utf-8") as lines:
            heading, *rows = csv.reader(line for line in lines if line.strip() and not line.startswith("#"))
        names = [name.split("[")[0].strip() for name in heading]
        for name in (time, value):
            if name not in names:
                raise ValueError(f"{file}: no column {name}")
        self.times, self.values = ([float(row[names.index(name)]) for row in rows] for name in (time, value))
        if self.times[-1] < self.times[0] + period:
            self.times.append(self.times[0] + period)
            self.values.append(self.values[0])
        self.period, self.scale, self.ramp = period, scale, ramp

    def __call__(self, time):
        phase = self.times[0] + (time - self.times[0]) % self.period
        after = min(max(bisect.bisect_right(self.times, phase), 1), len(self.times) - 1)
        (t0, t1), (v0, v1) = self.times[after - 1:after + 1], self.values[after - 1:after + 1]
        risen = (1 - math.cos(math.pi * min(1.0, time / self.ramp))) / 2 if self.ramp > 0 else 1.0
        return self.scale * risen * (v0 + (v1 - v0) * (phase - t0) / (t1 - t0))
