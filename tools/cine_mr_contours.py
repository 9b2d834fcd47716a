#!/usr/bin/env python3
"""From contours of cine MR series (descending_aorta_contours.csv: columns series, frame, trigger_time_ms, point, x_mm, y_mm, z_mm) and the
series' RR intervals (SERIES_geometry.txt, last line: RR in ms, ...) the table that `observations.contours` reads: times become fractions of
each series' own beat, because the series come from separate breath-holds.

Usage: cine_mr_contours.py FOLDER SLICES.csv SERIES..."""

import csv
import pathlib
import sys


def beat_ms(folder, series):
    lines = (folder / f"{series}_geometry.txt").read_text(encoding="utf-8").splitlines()
    return float(lines[-1].split()[0])


def main():
    folder, result, wanted = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3:]
    beats = {series: beat_ms(folder, series) for series in wanted}
    rows = {series: [] for series in wanted}
    with open(folder / "descending_aorta_contours.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["series"] in rows:
                rows[row["series"]].append(row)
    with open(result, "w", encoding="utf-8") as file:
        file.write("# Lumen of a descending thoracic aorta in cine MR slices, all frames of a beat, patient coordinates LPS (see SOURCE.md); time as\n")
        file.write("# fraction of the slice's own RR interval; made by tools/cine_mr_contours.py\n")
        file.write("slice,frame,time,x [mm],y [mm],z [mm]\n")
        for series in wanted:
            for row in rows[series]:
                time = float(row["trigger_time_ms"]) / beats[series]
                file.write(f"{series},{row['frame']},{time:.5f},{row['x_mm']},{row['y_mm']},{row['z_mm']}\n")
    for series in wanted:
        frames = {row["frame"] for row in rows[series]}
        print(f"{series}: {len(frames)} frames, {len(rows[series])} points, RR {beats[series]:g} ms")


if __name__ == "__main__":
    main()
