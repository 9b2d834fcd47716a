"""Models of the tube of data/peer_tube that lack something, and the runs that their data are of."""
import dataclasses
import json
import os
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
DATA = ROOT / "data/peer_hidden"
TETHER = pathlib.Path(os.environ.get("TETHER_PROGRAMS", ROOT / "build/bin")) / "tether"
FRAMES, HELD_OUT = 10, [2, 5, 8]
DEVIATION, LENGTH = 0.03, 0.5  # [cm]
ERRORS = ["exponential", "gaussian", "voxels"]
UNIFORM, STIFF, DAMPED = [(1e5, 2e3)] * 3, [(2e6, 1e4), (3e5, 5e3), (5e4, 1e3)], [(5e4, 1e5), (5e4, 1e3), (5e4, 1e3)]

SPRING = [("solid.support.regions.spine.stiffness", ""), ("visco_elastic", "spine"), ("normal_visco_elastic", "spine")]
DAMPER = [("solid.support.regions.spine.damping", ""), ("normal_visco_elastic", "spine")]
COMPLIANCE = [("fluid.outlets.outlet.compliance", "")]

HALF = [("stiffness_factor", "outlet half")]
PAIR = [SPRING, HALF]


@dataclasses.dataclass
class Model:
    """What a model lacks, and what of."""
    data: str  # the run that the data are of
    supports: list = dataclasses.field(default_factory=lambda: UNIFORM)  # of the model: at the spine, beside it, elsewhere
    rest: str = ""  # what else the model has
    hidden: list = dataclasses.field(default_factory=list)
    size: float | None = None  # of what is hidden, or of the first of it


COMPLIANT = "fluid: {outlets: {outlet: {compliance: %g}}}\n"
STIFFER_HALF = "  effects: {hidden: {type: stiffness_factor, factor: %g, from: 0.5}}\n"
MODELS = {
    "nothing": Model("N"),
    "spring": Model("support_A", [(1e5, 1e4), *STIFF[1:]], "", [SPRING], 2e6),
    "damper": Model("damping_C", [(5e4, 1e3), *DAMPED[1:]], "", [DAMPER], 1e5),
    "compliance": Model("N", UNIFORM, COMPLIANT % 3e-3, [COMPLIANCE], 1.5e-3),
    "half": Model("half", hidden=[HALF], size=2),
    "pair": Model("pair", [(1e5, 1e4), *STIFF[1:]], "", PAIR, 2e6),
    # of one model: the truth has another mesh, and what the model lacks in three sizes
    "other_nothing": Model("other_nothing"),
    **{f"other_spring_{n}": Model(f"other_spring_{n}", hidden=[SPRING], size=s) for n, s in zip("abc", (6e5, 2e6, 6e6))},
    **{f"other_damper_{n}": Model(f"other_damper_{n}", hidden=[DAMPER], size=s) for n, s in zip("abc", (3e4, 6e4, 1.5e5))},
    **{f"other_compliance_{n}": Model(f"other_compliance_{n}", hidden=[COMPLIANCE], size=s) for n, s in zip("abc", (9e-4, 7.5e-4, 5e-4))},
    **{f"other_half_{n}": Model(f"other_half_{n}", hidden=[HALF], size=s) for n, s in zip("abc", (1.6, 2, 3))},
    **{f"other_pair_{n}": Model(f"other_pair_{n}", hidden=PAIR, size=s) for n, s in zip("abc", (6e5, 2e6, 6e6))},
}
# of the same model: one-dimensional blood in the truth (blood_1d.py), and what is hidden in the middle size
MODELS["blood_nothing"] = Model("blood_nothing")
for _part in ("spring", "damper", "compliance", "half", "pair"):
    MODELS[f"blood_{_part}"] = dataclasses.replace(MODELS[f"other_{_part}_b"], data=f"blood_{_part}")
FACES = ROOT / "data/peer_tube/solid/faces"
SAME_MESH = ["mesh:", "  files:", "    outside:", "      outside: null",
             *[f"      {r}: {{file: {FACES}/outside_{r}.vtp}}" for r in ("spine", "vicinity_a", "vicinity_b", "opposite")]]
OTHER_MESH = ["mesh:", "  source: swept", "  files: null", "  swept:", "    radius: 2", "    length: 10", "    wall_thickness: 0.2", "    around: 30", "    along: 26", "    layers: 2", "    regions:",
              "      spine: {angle: [150, 210]}", "      vicinity_a: {angle: [120, 150]}", "      vicinity_b: {angle: [210, 240]}", "      opposite: {}"]


@dataclasses.dataclass
class Truth:
    """A run of ours."""
    supports: list = dataclasses.field(default_factory=lambda: UNIFORM)
    solid: str = ""  # what else the wall has
    compliance: float | None = None  # of the outlet
    mesh: list = dataclasses.field(default_factory=lambda: OTHER_MESH)
    one_dimensional: bool = False  # the blood


TRUTHS = {"half": Truth(UNIFORM, STIFFER_HALF % 2, mesh=SAME_MESH), "pair": Truth(STIFF, STIFFER_HALF % 2, mesh=SAME_MESH), "other_nothing": Truth()}
for _name, _half in zip("abc", (1.6, 2, 3)):
    _of = {part: MODELS[f"other_{part}_{_name}"].size for part in ("spring", "damper", "compliance", "half")}
    TRUTHS |= {
        f"other_spring_{_name}": Truth([(_of["spring"], 2e3), *UNIFORM[1:]]),
        f"other_damper_{_name}": Truth([(1e5, _of["damper"]), *UNIFORM[1:]]),
        f"other_compliance_{_name}": Truth(compliance=_of["compliance"]),
        f"other_half_{_name}": Truth(solid=STIFFER_HALF % _of["half"]),
        f"other_pair_{_name}": Truth([(_of["spring"], 2e3), *UNIFORM[1:]], STIFFER_HALF % _of["half"]),
    }
TRUTHS |= {name: dataclasses.replace(TRUTHS[name.replace("blood", "other") + ("" if name.endswith("nothing") else "_b")], one_dimensional=True) for name in MODELS if name.startswith("blood")}


def case_with(name, supports, rest, mesh):
    """The tube with supports at the spine, beside it, and elsewhere."""
    regions = ["spine", "vicinity_a", "vicinity_b", "opposite"]
    of = dict(zip(regions, [supports[0], supports[1], supports[1], supports[2]]))
    return "\n".join([
        f"name: foreign_{name}", f"base: {ROOT}/benchmarks/peer_tube/case.yaml", *mesh, "output: {points: null}", "solid:", "  support:",
        "    regions:", "      outside: null", *[f"      {r}: {{stiffness: {of[r][0]:g}, damping: {of[r][1]:g}}}" for r in regions], rest])


def case_of(model, data):
    """The case of a model with the data in a folder."""
    noise = f"{{deviation: {DEVIATION}, correlation_length: {LENGTH}}}"
    observed = ["time: {step: 4e-3}"]
    if data:
        observed += ["observations:", "  surfaces:", f"    ct: {{file: {data}/times.csv, unit: cm, period: 0.9, held_out: {HELD_OUT}, noise: {noise}}}"]
    return case_with("model", MODELS[model].supports, "\n".join([*observed, MODELS[model].rest]), SAME_MESH)


def write_blood_1d(case, compliance, output):
    """The input of blood_1d.py beside a case. Its stations are the rings of nodes of another run's wall."""
    windkessel = {"proximal_resistance": 150, "distal_resistance": 1850, "compliance": compliance or 1.5e-3, "distal_pressure": -106657.6}
    case.with_suffix(".blood.json").write_text(json.dumps({
        "motion": str(truth_of("other_nothing", output)), "flow": str(ROOT / "data/peer_tube/flow_pressure.csv"), "density": 1.06, "viscosity": 0.04, **windkessel}))
    return f"coupling: {{programs: {{fluid: {HERE / 'blood_1d.py'}}}}}\n"


def truth_of(model, output):
    """The run that the data are of, made if it is ours and not there yet, with half the model's step."""
    name = MODELS[model].data
    if name not in TRUTHS:
        return DATA / f"{name}.npz"
    run, truth = output / "truths" / name, TRUTHS[name]
    if not (run / "summary.json").exists():
        case = output / f"truth_{name}.yaml"
        blood = write_blood_1d(case, truth.compliance, output) if truth.one_dimensional else COMPLIANT % truth.compliance if truth.compliance else ""
        case.write_text(case_with(name, truth.supports, f"{truth.solid}time: {{step: 2e-3}}\n{blood}", truth.mesh))
        subprocess.run([TETHER, "simulate", case, "--output", run, "--overwrite", "--quiet"], check=True)
    return run / "lumen.motion"
