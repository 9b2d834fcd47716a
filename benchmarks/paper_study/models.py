"""Truth, model and data of the study, and the cases of its figures."""
import concurrent.futures
import math

from anatomy import ERROR_REGIONS, OUTLET, PARTS, SUPPORTED, held, stiffness, vessel
from workshop import read

LIGHT = 1e4  # dyn/cm3: the paper's theta = 0, k = LIGHT 2^theta
TRUTH = {**dict.fromkeys(SUPPORTED, LIGHT), **{f"spine_{k}": 1e6 for k in PARTS}, **{f"vicinity_{k}": 1e5 for k in PARTS}, "outlet": 1e6}
NONE = dict.fromkeys([*SUPPORTED, "outlet"], LIGHT)
BY_HAND = {**NONE, **{f"spine_{k}": 3e6 for k in PARTS}, **{f"vicinity_{k}": 2e5 for k in PARTS}, "outlet": 3e6}  # too stiff, as the paper's
FOUR = {"spine": [stiffness(f"spine_{k}") for k in PARTS], "vicinity": [stiffness(f"vicinity_{k}") for k in PARTS],
        "light": [stiffness(r) for r in SUPPORTED if r.startswith(("opposite", "ascending", "arch"))], "outlet": [OUTLET]}
ELEVEN = {**{f"{name}_{k}": ([stiffness(f"{name}_{k}")], mother) for name, mother in (("spine", "spine"), ("vicinity", "vicinity"), ("opposite", "light")) for k in PARTS},
          "arch": ([stiffness("ascending"), stiffness("arch")], "light"), "outlet": ([OUTLET], "")}
PAPER_VARIANCES = {"spine": 1.25, "vicinity": 0.125, "light": 0.125, "outlet": 0.625}
PRIORS = {  # name: (mean of each, variance of theta of each)
    "light": (dict.fromkeys(FOUR, LIGHT), PAPER_VARIANCES),
    "by_hand": ({"spine": 3e6, "vicinity": 2e5, "light": LIGHT, "outlet": 3e6}, dict.fromkeys(FOUR, 0.125)),
    "wide": (dict.fromkeys(FOUR, 1e5), dict.fromkeys(FOUR, 9.0)),
    "wide_stiff": (dict.fromkeys(FOUR, 1e6), dict.fromkeys(FOUR, 9.0)),
}
# The paper weighs a frame's squared distances by 180/(0.1 cm)2 per area: errors of 1 mm, each over 1/180 cm2 (K.5), whose correlation length would be 0.3 mm.
PAPER_WEIGHTS = {"observations.surfaces.twin.noise.deviation": 0.1, "observations.surfaces.twin.noise.correlation_length": round(math.sqrt(1 / (180 * 2 * math.pi)), 5)}
TRUE_OF_FOUR = {"spine": 1e6, "vicinity": 1e5, "light": LIGHT, "outlet": 1e6}
PART_VARIANCE = 0.067  # the paper's P0 of eleven
HELD_OUT = [3, 7]  # by the diagnosis; figure 13 is judged on nine other frames
BEAT = 0.8955  # [s]
FRAME_APART = BEAT / 10
NOISE = "0.3 mm"  # alike over 5 mm
OUTLETS = ("brachiocephalic", "left_carotid", "left_subclavian", "descending")
WRONG_START = -8  # mmHg: pressure behind the outlets at the start, against the right one
IMAGE_PRESSURE = 75  # mmHg, of configs/thoracic_aorta: the runs' pressures are relative to it


def theta(value):
    return math.log2(value / LIGHT)


class Study:
    """The shared steps: meshes, truth, data; each figure makes its own on top."""

    def __init__(self, shop, size):
        self.shop, self.size = shop, size

    def prepare(self):
        truth = vessel(self.shop, "fine", self.size.truth)
        self.beat = vessel(self.shop, "plain", self.size.model)
        self.truth = self.shop.case("truth", truth, {"time.step": self.size.truth.step, "output.write_every": 100000, **held(TRUTH)})
        self.truth_run = self.shop.make("simulate", self.truth, after=["fine_mesh", "fine_outlets"])
        self.model = self.shop.case("model", self.beat, {"time.step": self.size.model.step, "output.write_every": 100000, **held(NONE)})
        with concurrent.futures.ThreadPoolExecutor(2) as workers:  # each twin is made by one process
            between = workers.submit(self.twin, "between", 100, first=FRAME_APART / 2)
            self.data = dict(zip(self.size.seeds, workers.map(lambda seed: self.twin(f"data_{seed}", seed), self.size.seeds)))
        self.between = between.result()

    def twin(self, name, seed, first=0, deviation=NOISE):
        """The model's case with ten frames of the truth, 90 ms apart; all twins share the truth's run."""
        made = self.shop.case(f"{name}_twin", self.model, {"twin": {
            "truth": "truth.yaml", "seed": seed, "frames": 10, "first": first, "beat": BEAT,
            "image": {"voxel": [f"{v} mm" for v in self.size.voxel], "blur": "0.4 mm"}, "noise": {"deviation": deviation, "correlation_length": "5 mm"},
            "hidden": {"effects": {name: {"effect": "visco_elastic", "where": name, "amplitude": TRUTH[f"{name}_1"], "unit": "g/(cm2 s2)"} for name in ("spine", "vicinity")}}}})
        sealed = self.shop.folder / name / "sealed"
        sealed.mkdir(parents=True, exist_ok=True)
        if not (sealed / "run").exists():
            (sealed / "run").symlink_to(self.truth_run)
        return self.shop.make("twin", made, after=["truth", "plain_mesh"], name=name) / "case.yaml"

    def direct(self, name, fields, seed=None):
        """A run, compared with the data, and with frames between theirs that nothing is fitted to: all but the last, at
        0.85 s, for a source may not be held out as a whole."""
        seed = seed or self.size.seeds[0]
        source = {"file": str(self.between.parent / "data/lumen.csv"), "unit": "cm", "held_out": list(range(9)), "noise": {"deviation": NOISE, "correlation_length": "5 mm"}}
        told_for = {region: {"of": parts} for region, parts in ERROR_REGIONS.items()}
        case = self.shop.case(name, self.data[seed], {"observations.surfaces.between": source, "observations.regions": told_for, **fields})
        self.shop.make("simulate", case, after=[f"data_{seed}", "between"])
        return self.shop.make("compare", case, after=[name], name=name)

    def wrong_start(self):
        """Fields of a run whose outlets, and with them blood and wall, begin in another state."""
        outlets = read(self.shop.folder / "plain_outlets/outlets.json")["outlets"]
        return {f"fluid.outlets.{o['name']}.initial_pressure": f"{o['initial_pressure'] - IMAGE_PRESSURE + WRONG_START} mmHg" for o in outlets}

    def identified(self, name, fields, seed=None, after=()):
        seed = seed or self.size.seeds[0]
        return self.shop.make("identify", self.shop.case(name, self.data[seed], fields), after=[f"data_{seed}", *after])


def four(prior, gain=3, **more):
    """Fields of an identification of four parameters."""
    means, variances = PRIORS[prior]
    return {"observer.gain": gain, **more, **{f"identification.parameters.{name}": {
        "of": numbers, "transform": "log2", "mean": means[name], "deviation": round(math.sqrt(variances[name]), 6)} for name, numbers in FOUR.items()}}


def eleven(earlier, gain=3):
    """Of eleven, each from the posterior of the one of four that it is a part of."""
    fields = {"observer.gain": gain, "identification.prior_from": str(earlier / "estimate.json")}
    for name, (numbers, mother) in ELEVEN.items():
        prior = {"part_of": mother, "deviation": round(math.sqrt(PART_VARIANCE), 6)} if mother else {}
        fields[f"identification.parameters.{name}"] = {"of": numbers, "transform": "log2", **prior}
    return fields
