"""Drawings by gnuplot, small enough for a page."""
import math
import subprocess

from anatomy import ERROR_REGIONS

COLOURS = ("#1b6ca8", "#d1495b", "#edae49", "#3a7d44", "#7d5ba6", "#444444", "#2ab7ca", "#fe4a49", "#b5651d", "#88aa00", "#cc79a7")
KEY = "set key top left horizontal maxcols 3 font 'sans,8'"
SHOWN = [name.replace("_", " ") for name in ERROR_REGIONS]


def gnuplot(script):
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def quoted(text):
    """For gnuplot."""
    return "'" + str(text).replace("'", "''") + "'"


def table(rows):
    return "\n".join(" ".join("NaN" if math.isnan(v) else f"{v:.6g}" for v in row) for row in rows)


def page_of(file, width, height, columns, rows):
    return (f"set terminal pngcairo noenhanced size {width},{height} font 'sans,10'\nset output {quoted(file)}\nset grid lc '#dddddd'\nset xtics 0.18\n"
            f"set multiplot layout {rows},{columns}\n")


def distances(file, rows):
    """Root mean square and largest distance over the beat, a row for each (title, moments), all rows on one scale."""
    script = page_of(file, 860, 30 + 210 * len(rows), 2, len(rows))
    top = [max(v for _, found in rows for m in found for v in getattr(m, norm).values() if not math.isnan(v)) for norm in ("l2", "linf")]
    for k, (title, found) in enumerate(rows):
        data = table([m.time, *m.l2.values(), *m.linf.values()] for m in found)
        script += f"$d{k} << EOD\n{data}\nEOD\n"
        for column, (norm, name) in enumerate((("l2", "L2"), ("linf", "largest"))):
            first = 2 + column * len(SHOWN)
            lines = ", ".join(f"$d{k} using 1:{first + i} with linespoints lw 1.5 pt 7 ps 0.5 lc rgb '{COLOURS[i]}' title {quoted(region)}" for i, region in enumerate(SHOWN))
            script += f"set title {quoted(f'{title}: {name} [mm]')}\nset yrange [0:{1.3 * top[column]:.3g}]\n{KEY if k == column == 0 else 'unset key'}\nplot {lines}\n"
    gnuplot(script + "unset multiplot\n")


def evolutions(file, panels, label="theta: stiffness = 1e4 2^theta dyn/cm3"):
    """Numbers over time with their deviations, a panel for each (title, times, {name: (number, deviation)}, {name: truth})."""
    script = page_of(file, 430 * len(panels), 420, len(panels), 1)
    for k, (title, times, series, truth) in enumerate(panels):
        names = list(series)
        data = table([t, *(v for n in names for v in (series[n][0][i], series[n][1][i]))] for i, t in enumerate(times))
        script += f"$d{k} << EOD\n{data}\nEOD\nset title {quoted(title)}\nset key outside bottom center horizontal font 'sans,8'\nset xlabel 'time [s]'\nset ylabel {quoted(label)}\n"
        bands = [f"$d{k} using 1:(${2 * i + 2}-${2 * i + 3}):(${2 * i + 2}+${2 * i + 3}) with filledcurves fc rgb '{COLOURS[i]}' fs transparent solid 0.15 notitle" for i in range(len(names))]
        lines = [f"$d{k} using 1:{2 * i + 2} with lines lw 2 lc rgb '{COLOURS[i]}' title {quoted(n.replace('_', ' '))}" for i, n in enumerate(names)]
        true = [f"{truth[n]:.5g} with lines dt 2 lc rgb '{COLOURS[i]}' notitle" for i, n in enumerate(names)]
        script += "plot " + ", ".join(bands + true + lines) + "\n"
    gnuplot(script + "unset multiplot\n")


def curves(file, panels):
    """A panel for each (title, {name: (times, values)})."""
    script = page_of(file, 1100, 20 + 220 * (len(panels) // 4), 4, len(panels) // 4) + "set key top right font 'sans,8'\n"
    for k, (title, lines) in enumerate(panels):
        for i, (times, values) in enumerate(lines.values()):
            script += f"$d{k}_{i} << EOD\n{table(zip(times, values))}\nEOD\n"
        script += f"set title {quoted(title)}\nplot " + ", ".join(f"$d{k}_{i} with lines lw 1.5 lc rgb '{COLOURS[i]}' title {quoted(name)}" for i, name in enumerate(lines)) + "\n"
    gnuplot(script + "unset multiplot\n")


def outlines(file, panels):
    """A square panel for each (title, {name: segments}), a segment being two points in the plane of a cut [mm]."""
    script = page_of(file, 360 * len(panels), 390, len(panels), 1) + "set size ratio -1\nset xtics 5\nset ytics 5\nset key outside bottom center horizontal font 'sans,8'\n"
    for k, (title, lines) in enumerate(panels):
        for i, segments in enumerate(lines.values()):
            data = "\n\n".join(table(segment) for segment in segments)
            script += f"$d{k}_{i} << EOD\n{data}\nEOD\n"
        script += f"set title {quoted(title)}\nplot " + ", ".join(f"$d{k}_{i} with lines lw 1.5 lc rgb '{COLOURS[i]}' title {quoted(name)}" for i, name in enumerate(lines)) + "\n"
    gnuplot(script + "unset multiplot\n")
