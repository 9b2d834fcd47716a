"""README.md of the study: tables of what was measured, beside what the paper says."""
from anatomy import ERROR_REGIONS
from models import FRAME_APART, NOISE, NONE, TRUE_OF_FOUR, TRUTH
from workshop import read

PAPER = "Moireau et al. (2012)"


def row(*cells):
    return "| " + " | ".join(str(c) for c in cells) + " |\n"


def table(heads, rows):
    return "\n" + row(*heads) + "|" + "---|" * len(heads) + "\n" + "".join(row(*r) for r in rows) + "\n"


def regions(study):
    return ("\n## Figure 7: regions\n\nLeft: support, each with a spring; right: those for which distances are given, unions of these.\n\n"
            '<img src="figure7_support.png" width="420"> <img src="figure7_error.png" width="420">\n')


def whole(size, study, parts, missing):
    """The page."""
    truth, model, shop = study.size.truth, study.size.model, study.shop
    counts = {name: read(shop.folder / f"{name}_mesh/model/quality.json") for name in ("fine", "plain")}
    nodes = {name: (q["blood"]["nodes"], q["wall"]["nodes"]) for name, q in counts.items()}
    return (
        f"# {PAPER}, section 5, on a twin\n\nWritten by `benchmarks/paper_study/run`: do not edit. Made with `--size {size}`.\n\n"
        "**No patient is in this.** All data are a twin's: a run of `configs/thoracic_aorta` (a synthetic arch, pulled by the measured motion of another person's valve ring) on a mesh of its own, held by springs that are known. "
        "What the paper found on a patient, whose truth nobody knows, is tried here where it is known.\n" +
        table(("", "truth", "model"), [
            ("nodes of blood, wall", *(f"{nodes[n][0]}, {nodes[n][1]}" for n in ("fine", "plain"))),
            ("triangles of the lumen", f"`{truth.edges}`", f"`{model.edges}`"), ("layers of the wall", truth.layers, model.layers), ("step", f"{1e3 * truth.step:g} ms", f"{1e3 * model.step:g} ms"),
            ("springs [dyn/cm3]: spine, vicinity, elsewhere, outlet ring", *(", ".join(f"{v[r]:g}" for r in ("spine_1", "vicinity_1", "arch", "outlet")) for v in (TRUTH, NONE)))]) +
        f"Data: ten frames {FRAME_APART * 1e3:.1f} ms apart from the first of the beat on, voxels of {' x '.join(map(str, study.size.voxel))} mm, blurred by 0.4 mm, segmented, with errors of {NOISE} that are alike over 5 mm; nine others, half way between them, judge: nothing is fitted to them. "
        f"The paper's noise is about 1 mm, but its weight `w` takes a frame for 180 cm2 x 180 independent errors per cm2 (32,400); by their correlation length they are 115 here ([K.5](../../docs/equations.md#k-identification)).\n\n"
        f"One beat of 0.8955 s from the imaged state, whose outlets begin in their periodic state. Cost of what is on this page: {shop.cpu_seconds():.0f} CPU s of all processes; {shop.wall_seconds() / 60:.0f} minutes on two cores.\n" +
        (f"\nNot made in this size: {', '.join(missing)}, and rows that are absent below.\n" if missing else "") + broken(shop.broken) + "".join(parts.values()))


def broken(steps):
    return "\nBroke off:\n\n" + "".join(f"- `{step}`: {cause}\n" for step, cause in steps.items()) if steps else ""


def found_table(rows):
    return table(("parameter", "truth", "estimate", "95 % interval", "truth inside", "error in deviations", "deviation after/before", "retained"),
                 [(n.replace("_", " "), f"{r['truth']:.3g}", f"{r['value']:.3g}", f"{r['lower']:.3g} .. {r['upper']:.3g}", "yes" if is_inside(r) else "no", f"{r['deviations']:+.2f}",
                   f"{r['after_before']:.2f}", f"{r['retained']:.2f}") for n, r in rows.items()])


def is_inside(r):
    return r["lower"] <= r["truth"] <= r["upper"]


def inside(rows):
    return f"{sum(map(is_inside, rows.values()))} of {len(rows)}"


def by_region(columns):
    """columns: {title: {region: (rms, largest)}}."""
    return table(("rms, largest over the beat [mm]", *columns), [(region.replace("_", " "), *(f"{c[region][0]:.2f}, {c[region][1]:.1f}" for c in columns.values())) for region in ERROR_REGIONS])


def holds(is_so):
    return "holds" if is_so else "does not hold"


def motion(apparent, clamped):
    if clamped is None:
        return ("\n## Figures 8 and 9: motion, and a model without surroundings\n\n![apparent motion](figure8.png)\n" + by_region({"apparent motion (8)": apparent}) +
                "The model of figure 9, clamped at its ends with hardly anything behind it (1e3 dyn/cm3), broke off ([decision 107](../../docs/decisions/0107-the-papers-study.md)). The paper's axes end at 4 mm (rms) and 8 mm (largest).\n")
    ratio = {region: clamped[region][0] / apparent[region][0] for region in ERROR_REGIONS}
    worst = sorted(ratio, key=ratio.get)[-2:]
    return (
        "\n## Figures 8 and 9: motion, and a model without surroundings\n\n![apparent motion](figure8.png)\n![ends clamped](figure9.png)\n" +
        by_region({"apparent motion (8)": apparent, "ends clamped, hardly a support (9)": clamped}) +
        f"The paper: errors of the order of the motion itself, *and even much larger in some areas such as the spine and its vicinity*. Here error over motion is " +
        ", ".join(f"{region.replace('_', ' ')} {ratio[region]:.1f}" for region in ERROR_REGIONS) + f": **{holds(set(worst) == {'spine', 'vicinity'} and min(ratio[r] for r in worst) > 1.2)}**"
        f" (largest: {worst[1].replace('_', ' ')}, {worst[0].replace('_', ' ')}). Springs of 1e3 dyn/cm3 and the dampers are left behind it. The paper's axes end at 4 mm (rms) and 8 mm (largest); its vessel's radius is about 10 mm, as here.\n")


def observer(of):
    rows = [(start, gain, *(f"{v:.3f}" for v in values)) for (start, gain), values in of.items()]
    errors = [[v[0] for (s, gain), v in of.items() if s == start and gain <= 15] for start in ("right", "wrong")]
    falls = all(later < earlier for of_start in errors for earlier, later in zip(of_start, of_start[1:]))
    return ("\n## Figure 10: the state observer\n\nSupports set by hand, as the paper's; a wrong start is one whose outlets begin 8 mmHg too low, and with them blood and wall.\n\n"
            "".join(f"![{start} start](figure10_{start}.png)\n" for start in ("right", "wrong") if any(s == start for s, _ in of)) +
            table(("start", "gain [1/s]", "data: rms [mm]", "frames between", "largest [mm]"), rows) +
            "The paper: distances fall in all regions with 3, further with 15 (there with an inlet band masked), and the mesh folds at 30. Here it pulls everywhere but in the branches, whose few elements fold with 15 1/s in the smallest size. " +
            (f"They fall with each gain up to 15: **{holds(falls)}**.\n" if len(of) > 1 else "\n"))


FINDINGS = (  # of figure 11: what the paper says, whether it is so, of which theta
    ("spine and outlet become stiff", lambda of: min(of["spine"]["theta"], of["outlet"]["theta"]) > 2, ("spine", "outlet")),
    ("vicinity and light support stay near theta = 0 (truth here: 3.3 and 0)", lambda of: max(of["vicinity"]["theta"], of["light"]["theta"]) < 1, ("vicinity", "light")),
    ("the spine comes out softer than by hand (theta = 8.2)", lambda of: of["spine"]["theta"] < 8.2, ("spine",)),
)


PRIOR_TITLES = {"light_weighed": "First prior, the paper's weights", "by_hand_weighed": "Second prior, the paper's weights", "light": "First prior, the noise as it is",
                "by_hand": "Second prior, the noise as it is", "wide": "A wide prior of ours, 1e5 with a deviation of three powers of two; the noise as it is",
                "wide_stiff": "Another wide prior of ours, 1e6 with a deviation of three powers of two; the noise as it is"}


def thetas(of, names):
    return ", ".join(f"{n} {of[n]['theta']:.1f}" for n in names)


def apart(one, other):
    """Of two estimates, in the larger of their deviations."""
    return {n: abs(one[n]["theta"] - other[n]["theta"]) / max(one[n]["theta_deviation"], other[n]["theta_deviation"]) for n in one}


def agreement(rows, one, other):
    if one not in rows or other not in rows:
        return "not made yet"
    far = apart(rows[one], rows[other])
    return f"**{holds(max(far.values()) <= 1)}**: " + ", ".join(f"{n} {v:.1f}" for n, v in far.items()) + " deviations apart"


def finding(rows, which, is_so, names):
    return f"**{holds(is_so(rows[which]))}**: {thetas(rows[which], names)}" if which in rows else "not made yet"


def four(rows, seeds):
    text = ("\n## Figure 11: four parameters, observer with 3 1/s\n\n![theta over the beat](figure11.png)\n\n*Lines: estimate and deviation of theta; dashed: truth.*\n\n"
            "`theta` counts powers of two from 1e4 dyn/cm3. The paper's first prior is `theta` = 0 with variances of 1.25 (spine), 0.125 (vicinity, light support), 0.625 (outlet); its second has values set by hand, and 0.125. "
            "Its weight `w` takes a frame for 32,400 independent errors of 1 mm.\n")
    text += "".join(f"\n{title}:\n{found_table(rows[key])}" for key, title in PRIOR_TITLES.items() if key in rows)
    text += "".join(over_seeds(observe, of) for observe, of in seeds.items() if of)
    return text + ("The paper's priors allow the truth, which its authors did not know, least where they are surest: `vicinity` is 3.3 powers of two from `theta` = 0, nine of that prior's deviations. So two priors that allow it are held against each other, too.\n" +
        table(("two priors", "lead to the same values"), [
            ("the paper's, with its weights", agreement(rows, "light_weighed", "by_hand_weighed")), ("the paper's, the noise as it is", agreement(rows, "light", "by_hand")),
            ("wide ones, 1e5 and 1e6, the noise as it is", agreement(rows, "wide", "wide_stiff"))])) + table(("the paper", "here, with its weights", "wide prior, noise as it is"), [
        *((what, finding(rows, "light_weighed", is_so, names), finding(rows, "wide", is_so, names)) for what, is_so, names in FINDINGS)])


def over_seeds(observe, of):
    """Of the wide prior, a column for each set of errors."""
    sets = list(of.values())
    return (f"\nThe wide prior on {len(of)} sets of errors, `observe: {observe}`: error in powers of two, and in deviations:\n" +
            table(("parameter", *(f"seed {seed}" for seed in of), "truth inside"),
                  [(name, *(f"{rows[name]['octaves']:+.2f} ({rows[name]['deviations']:+.1f})" for rows in sets), f"{sum(is_inside(rows[name]) for rows in sets)} of {len(sets)}")
                   for name in sets[0]]))


def eleven(rows):
    return ("\n## Figure 12: eleven regions\n\nThe posterior of figure 11 (wide prior) is the prior: each part begins from the region that it is a part of, and may differ from it by the paper's variance of 0.067 (`prior_from`, `part_of`: [identification](../../docs/identification.md#a-posterior-as-the-next-prior)). "
            "The same frames are used twice, as in the paper.\n\n![theta over the beat](figure12.png)\n" + found_table(rows) + f"Inside their intervals: {inside(rows)}.\n")


def direct(of):
    order = [values[1] for values in of.values()]
    return ("\n## Figure 13: direct runs\n\n![distances](figure13.png)\n" +
            table(("model", "data: rms [mm]", "frames between", *(r.replace("_", " ") for r in ERROR_REGIONS)), [(n, f"{a:.3f}", f"{b:.3f}", *(f"{v:.2f}" for v in c.values())) for n, (a, b, c) in of.items()]) +
            f"The paper's order, none > by hand > identified, on the frames between, which nothing is fitted to: **{holds(order[0] > order[1] > min(order[2:]))}**.\n")


def outlets(of):
    return ("\n## Figure 14: at peak systole\n\n![outlines](figure14_outlines.png)\n![outlets](figure14_outlets.png)\n" +
            table(("outlet", "pressure [mmHg]", "share of the flow [%]"), [(o.replace("_", " "), f"{a:.0f} .. {b:.0f}", f"{s:.1f}") for o, (a, b, s) in of.items()]) +
            "The paper's pressures lie between 60 and 140 mmHg.\n")


def identifiability(of):
    names = list(of["parameters"])
    information = ", ".join(f"{v:.3g}" for v in of["identifiability"]["information"])
    return ("\n## Figure 15: identifiability\n\n`observe: never`, wide prior: what these data can tell at all.\n\n![deviations](figure15.png)\n" +
            table(("parameter", "deviation left, of the prior's", "retained", *names), [(n, f"{of['parameters'][n]['after_before']:.3f}", f"{of['parameters'][n]['retained']:.2f}", *(f"{c:+.2f}" for c in of["correlations"][i])) for i, n in enumerate(names)]) +
            f"Columns behind `retained`: correlations. Information over the prior's by direction: {information}.\n")


def joint_row(start, gain, result, alone):
    if result is None:
        return (start, gain, "broke off", *[""] * 8)
    rows, bias, cpu, chi = result
    return (start, gain, f"{bias:.2f}", inside(rows), f"{chi:.2f}", f"{cpu:.0f}", f"{cpu / alone[2]:.2f}" if alone else "", *(f"{r['octaves']:+.2f}" for r in rows.values()))


def joint(of):
    return ("\n## Filter and observer together\n\nWide prior; bias: root mean square error of theta of the four, in powers of two. A wrong start: outlets 8 mmHg too low (from 20 both break off in the smallest size). CPU is that of the identification's own processes.\n" +
            table(("start", "observer [1/s]", "bias", "inside", "chi-square per datum", "CPU s", "over the filter alone", *TRUE_OF_FOUR),
                  [joint_row(start, gain, result, of.get((start, 0))) for (start, gain), result in of.items()]) +
            "Goal: at most 1.15 times the filter alone. *Broke off*: a particle's wall could not be computed, even in halves of the step; the run ends and names the particle.\n")


def between(of, off):
    return ("\n## Between frames\n\nDiscrepancies are made of those of the frames around, 90 ms apart (`observe: every_step`, the default; [O.3](../../docs/equations.md#o-observation)), or taken at frames only (`frames`). Half way between two frames a lumen is off the straight line between its places at these two, and off the curve through four frames, along its normal by (the run set by hand):\n" +
            by_region({f"off {curve}": values for curve, values in off.items()}) + "Wide prior, no observer: error of theta in powers of two, and in deviations:\n" +
            table(("data", "observe", "bias", *next(iter(of.values()))), [(kind, f"`{observe}`", f"{(sum(r['octaves'] ** 2 for r in rows.values()) / len(rows)) ** 0.5:.2f}", *(f"{r['octaves']:+.2f} ({r['deviations']:+.1f})" for r in rows.values())) for (kind, observe), rows in of.items()]))


def amount(effect):
    a = effect["amplitude"]
    return f"{effect['name']}{' at ' + effect['where'] if effect['where'] else ''}: {a['value']:.3g} ({a['lower']:.3g} .. {a['upper']:.3g}) {a['unit']}"


def explanation(of, voxel):
    seen = (0.4 ** 2 + sum(v * v for v in voxel) / 36) / 100  # variances of the blur, and of a place in a voxel, mean of the three axes
    models = [(m["number"], "; ".join(map(amount, m["added"])) or "as given", "yes" if m["accepted"] else f"no: {m['reason']}", *(f"{10 * m[kind]['l2']:.3f}, {m[kind]['in_noise']:.2f}" for kind in ("training", "held_out"))) for m in of["models"]]
    return ("\n## What the paper could not: what is missing?\n\n`tether explain` on the same data from the model without support, two of the ten frames held out; candidates: springs and dampers, contact, a stiffer wall, inputs and errors of the data. Missing in truth: springs of 1e6 behind the spine and of 1e5 in its vicinity, and of 1e6 at the outlet's ring. What blur and voxels make is in the data: a variance of some " + f"{seen:.4f} cm2.\n\n" + "Verdict: **" + of["verdict"] + "**\n\n" + "".join(f"> {s}\n" for s in of["sentences"]) +
            table(("model", "with", "kept", "frames used [mm, noises]", "held out"), models) + f"{of['cost']['cpu_seconds']:.0f} CPU s.\n")
