#!/usr/bin/python3
"""Fit a three-element Windkessel to one measured beat of pressure and flow, periodic, by least squares in time.

    tools/fit_windkessel.py FLOW.csv PRESSURE.csv [--share 0.65]

Both files: columns `time [s]` and a value in ml/s or mmHg, equally spaced over one beat. The share is the part of the flow that goes through
the outlet (the rest leaves through branches that the model does not have). Prints the elements, the pressure stored at the beat's start, and
the misfit.
"""
import argparse

import numpy as np


def read(path):
    rows = [line for line in open(path) if line.strip() and not line.startswith("#")]
    return np.loadtxt(rows[1:], delimiter=",").T


def pressures(elements, flow, step):
    """Steady periodic inlet pressure and stored pressure: p = Rp q + P, C dP/dt + P/Rd = q [mmHg]."""
    proximal, compliance, distal = elements
    omega = 2j * np.pi * np.fft.rfftfreq(len(flow), step)
    spectrum = np.fft.rfft(flow)
    stored = np.fft.irfft(distal / (1 + omega * compliance * distal) * spectrum, len(flow))
    return proximal * flow + stored, stored


def fit(flow, pressure, step):
    """Levenberg-Marquardt in the logarithms of the elements."""
    x, damping = np.log([0.05, 1.0, pressure.mean() / flow.mean()]), 1e-3
    misfit = lambda x: pressures(np.exp(x), flow, step)[0] - pressure
    for _ in range(200):
        now = misfit(x)
        slope = np.array([(misfit(x + 1e-6 * unit) - now) / 1e-6 for unit in np.eye(3)]).T
        normal = slope.T @ slope
        change = -np.linalg.solve(normal + damping * np.diag(np.diag(normal)), slope.T @ now)
        better = np.sum(misfit(x + change) ** 2) < np.sum(now**2)
        x, damping = (x + change, damping / 3) if better else (x, damping * 5)
    return np.exp(x)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("flow")
    parser.add_argument("pressure")
    parser.add_argument("--share", type=float, default=1.0)
    options = parser.parse_args()
    time, flow = read(options.flow)
    _, pressure = read(options.pressure)
    flow, step = options.share * flow, time[1] - time[0]
    elements = fit(flow, pressure, step)
    inlet, stored = pressures(elements, flow, step)
    print(f"proximal_resistance: {elements[0]:.5f} mmHg s/ml")
    print(f"compliance: {elements[1]:.4f} ml/mmHg")
    print(f"distal_resistance: {elements[2]:.4f} mmHg s/ml")
    print(f"# stored pressure at the start {stored[0]:.2f} mmHg; inlet pressure {inlet[0]:.2f} at the start, {inlet.min():.1f} to {inlet.max():.1f} mmHg")
    print(f"# misfit {np.sqrt(np.mean((inlet - pressure) ** 2)):.2f} mmHg (root mean square); measured {pressure.min():.1f} to {pressure.max():.1f} mmHg")


if __name__ == "__main__":
    main()
