"""Figures of identifications: 11, 12 and 15, the joint estimator, the time between frames, and what an explanation finds."""
import csv
import math

import plots
from anatomy import SUPPORTED
from models import ELEVEN, HELD_OUT, LIGHT, PAPER_WEIGHTS, PRIORS, TRUE_OF_FOUR, TRUTH, eleven, four, theta
from workshop import Failed, read


def evolution(folder):
    """Times, and theta with its deviation of each parameter, counted from LIGHT."""
    with open(folder / "estimate.csv") as lines:
        rows = list(csv.DictReader(lines, skipinitialspace=True))
    time = next(name for name in rows[0] if name.startswith("time"))
    names = [p["name"] for p in read(folder / "estimate.json")["parameters"]]
    of = lambda name: [float(row[name]) for row in rows]
    return of(time), {n: ([v - math.log2(LIGHT) for v in of(f"{n}.theta")], of(f"{n}.theta_deviation")) for n in names}


def found(folder, truth):
    """For each parameter: truth, estimate, interval, error in deviations, deviation after over before, retained."""
    rows = {}
    for p in read(folder / "estimate.json")["parameters"]:
        e, true = p["estimate"], truth[p["name"]]
        rows[p["name"]] = {"truth": true, "value": e["value"], "lower": e["lower_95"], "upper": e["upper_95"], "deviations": (e["theta"] - math.log2(true)) / e["theta_deviation"],
                           "after_before": e["theta_deviation"] / p["prior"]["theta_deviation"], "retained": p["retained_information"], "octaves": e["theta"] - math.log2(true),
                           "theta": e["theta"] - math.log2(LIGHT), "theta_deviation": e["theta_deviation"]}
    return rows


def values_by_region(folder):
    """What an identification found, for supports()."""
    values = {region: LIGHT for region in SUPPORTED}
    for p in read(folder / "estimate.json")["parameters"]:
        for number in p["sets"]:
            values["outlet" if ".rings." in number["name"] else number["name"].split(".")[3]] = number["value"]
    return values


def four_parameters(study, figure):
    """Figure 11: the paper's two priors with its weights, the same with the noise as it is, and two wide priors of our own."""
    fields = {**{prior: four(prior) for prior in PRIORS}, **{f"{prior}_weighed": four(prior, **PAPER_WEIGHTS) for prior in ("light", "by_hand")}}
    folders = study.shop.those_made({prior: lambda prior=prior: study.identified(f"four_{prior}", fields[prior]) for prior in fields}, at_once=2)
    thetas = {name: theta(value) for name, value in TRUE_OF_FOUR.items()}
    titles = {"light_weighed": "prior theta = 0, the paper's weights", "by_hand_weighed": "prior by hand, the paper's weights", "wide": "wide prior, noise as it is"}
    plots.evolutions(figure("figure11"), [(title, *evolution(folders[p]), thetas) for p, title in titles.items() if p in folders])
    return folders


def seeds(study):
    """{observe: {seed: what is found}} with the wide prior on all sets of errors, corrected between frames (the default) or at frames only."""
    def of(seed, observe):
        first, name = seed == study.size.seeds[0], "four_wide" if observe == "every_step" else "four_frames"
        fields = four("wide", **({} if observe == "every_step" else {"identification.observe": observe}))
        return found(study.identified(name if first else f"{name}_seed_{seed}", fields, seed), TRUE_OF_FOUR)

    return {observe: study.shop.those_made({seed: lambda seed=seed: of(seed, observe) for seed in study.size.seeds}, at_once=2) for observe in ("every_step", "frames")}


def eleven_parameters(study, figure, earlier):
    """Figure 12: from the posterior of figure 11."""
    folder = study.identified("eleven", eleven(earlier), after=[earlier.name])
    truth = {name: TRUTH["outlet" if name == "outlet" else "arch" if name == "arch" else name] for name in ELEVEN}
    plots.evolutions(figure("figure12"), [("eleven regions, from figure 11", *evolution(folder), {n: theta(v) for n, v in truth.items()})])
    return folder, truth


def identifiability(study, figure):
    """Figure 15: the deviations that the data would leave, over the beat, in prior deviations; nothing is corrected. The wide prior, without observer."""
    folder = study.identified("watched", four("wide", gain=0, **{"identification.observe": "never"}))
    times, of = evolution(folder)
    share = {n: ([d / deviations[0] for d in deviations], [0] * len(times)) for n, (_, deviations) in of.items()}
    plots.evolutions(figure("figure15"), [("what the data would leave", times, share, dict.fromkeys(share, 0))], label="deviation over the prior's")
    return {"parameters": found(folder, TRUE_OF_FOUR), **{key: read(folder / "estimate.json")[key] for key in ("correlations", "identifiability")}}


def cost(folder):
    c = read(folder / "estimate.json")["cost"]
    return c["cpu_seconds"] + c["master_loop_cpu_seconds"]


def rms(rows):
    return math.sqrt(sum(r["octaves"] ** 2 for r in rows.values()) / len(rows))


def judged(study, name, fields):
    """Parameters, bias, cost and misfit of an identification; None: it broke off."""
    try:
        folder = study.identified(name, fields)
    except Failed as failed:
        study.shop.tell(failed)
        return None
    rows = found(folder, TRUE_OF_FOUR)
    return rows, rms(rows), cost(folder), read(folder / "estimate.json")["innovations"]["chi_square_per_datum"]


def joint(study):
    """The filter alone and with the observer, from the right start and a wrong one, with the wide prior: each by itself, for they are timed."""
    starts = {"right": {}, "wrong": study.wrong_start()}
    return study.shop.those_made({(start, gain): lambda start=start, gain=gain: judged(study, f"joint_{gain}_{start}", four("wide", gain, **starts[start]))
                                  for start in starts for gain in (0, 3)})


def between_frames(study):
    """Corrected between frames too, or at the frames only: with the study's data, and with hardly an error but the voxels'."""
    at_frames = four("wide", 0, **{"identification.observe": "frames"})
    data = study.twin("data_quiet", study.size.seeds[0], deviation="0.01 mm")
    quiet = lambda name, fields: study.shop.make("identify", study.shop.case(name, data, fields), after=["data_quiet"])
    runs = {("the study's data", "every_step"): lambda: study.identified("joint_0_right", four("wide", 0)), ("the study's data", "frames"): lambda: study.identified("frames", at_frames),
            ("errors of 0.01 mm beside the voxels'", "every_step"): lambda: quiet("quiet_every_step", four("wide", 0)), ("errors of 0.01 mm beside the voxels'", "frames"): lambda: quiet("quiet_frames", at_frames)}
    return {key: found(folder, TRUE_OF_FOUR) for key, folder in study.shop.those_made(runs, at_once=2).items()}


def explained(study):
    """What tether explain says to the same data, from the model without support: springs and contacts in each region, loose rings, a stiffer wall."""
    case = study.shop.case("explained", study.data[study.size.seeds[0]], {"diagnosis": {"candidates": ["visco_elastic", "contact", "stiffness_factor"], "most": 3}, "observations.surfaces.twin.held_out": HELD_OUT})
    return read(study.shop.make("explain", case, after=[f"data_{study.size.seeds[0]}"]) / "explain.json")
