#!/usr/bin/env python3
"""Draws the pressure on the axis of the tube at several times, from the results of configs/pressure_pulse.

Usage: plot.py RESULTS PICTURE.png [STEP...]"""

import array
import pathlib
import re
import subprocess
import sys

DYN_PER_MMHG = 1333.22


def fields_of(path):
    """{name: numbers} of the double fields of a .vtu file written by Tether (raw appended data, a length of 8 bytes first)."""
    raw = path.read_bytes()
    start = raw.index(b"_", raw.index(b'<AppendedData encoding="raw">')) + 1
    fields = {}
    for kind, name, offset in re.findall(rb'<DataArray type="(\w+)" Name="(\w+)"[^>]*offset="(\d+)"', raw[:start]):
        if kind == b"Float64":
            begin = start + int(offset)
            size = int.from_bytes(raw[begin:begin + 8], "little")
            fields[name.decode()] = array.array("d", raw[begin + 8:begin + 8 + size])
    return fields


def pressure_on_axis(path):
    """Pairs (z [cm], pressure [mmHg]), by z."""
    fields = fields_of(path)
    x, p = fields["points"], fields["pressure"]
    return sorted((x[3 * i + 2], p[i] / DYN_PER_MMHG) for i in range(len(p)) if abs(x[3 * i]) + abs(x[3 * i + 1]) < 1e-6)


def main():
    results, picture = pathlib.Path(sys.argv[1]), sys.argv[2]
    steps = [int(step) for step in sys.argv[3:]] or [20, 40, 60, 80, 100, 120]
    curves = ", ".join(f"'-' with lines lw 2 title '{step / 10:g} ms'" for step in steps)
    script = (f"set terminal pngcairo size 800,400\nset output '{picture}'\nset xlabel 'along the tube [cm]'\n"
              f"set ylabel 'pressure [mmHg]'\nset grid\nplot {curves}\n")
    for step in steps:
        script += "".join(f"{z} {p}\n" for z, p in pressure_on_axis(results / f"vtk/fluid_{step:06d}.vtu")) + "e\n"
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


if __name__ == "__main__":
    main()
