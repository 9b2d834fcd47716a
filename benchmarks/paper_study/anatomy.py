"""The vessel: configs/thoracic_aorta at another size, its wall divided as the paper divides it (figure 7)."""
from workshop import ROOT

CONFIG = ROOT / "configs/thoracic_aorta"
PARTS = (1, 2, 3)
# What distances are given for, and the support regions that make it up.
ERROR_REGIONS = {"ascending": ["ascending"], "arch": ["arch"], "small_arteries": ["small_arteries"],
                 **{name: [f"{name}_{k}" for k in PARTS] for name in ("spine", "vicinity", "opposite")}}
SUPPORTED = [region for name, parts in ERROR_REGIONS.items() for region in parts if name != "small_arteries"]
OUTLET = "solid.rings.descending_ring.stiffness"
DIVIDED = (("spine: {branches", "spine: {divide: 3, branches"), ("vicinity: {branches", "vicinity: {divide: 3, branches"),
           ("opposite: {}", "opposite: {divide: 3, branches: [descending], along: [13, 33]}"))


def stiffness(region):
    return f"solid.support.regions.{region}.stiffness"


def edited(file, edits):
    """A file of the config with other words; its paths are made absolute."""
    text = (CONFIG / file).read_text()
    for before, after in (*edits, ("../../data", str(ROOT / "data")), ("file: spine.csv", f"file: {CONFIG}/spine.csv"), ("file: flow.csv", f"file: {CONFIG}/flow.csv")):
        text = text.replace(before, after)
    return text


def vessel(shop, name, mesh, divided=True):
    """A case with mesh, outlets and heart motion; soft all around."""
    written = {}
    for verb, file, edits in (
        ("build-model", "study", (("{longest: 4 mm}", mesh.edges), ("thickness: 2 mm\n", f"thickness: 2 mm\n    layers: {mesh.layers}\n"), *(DIVIDED if divided else ()))),
        ("fit-outlets", "outlets", (("../../out/thoracic_aorta/model", str(shop.folder / f"{name}_mesh/model")),)),
    ):
        step = f"{name}_{'mesh' if verb == 'build-model' else file}"
        written[verb] = shop.folder / f"{step}.yaml"
        written[verb].write_text(edited(f"{file}.yaml", edits))
        shop.make(verb, written[verb], after=[f"{name}_mesh"] if verb == "fit-outlets" else [])
    beat = shop.folder / f"{name}_beat.yaml"
    beat.write_text(edited("beat.yaml", (("../../out/thoracic_aorta_outlets/case.yaml", f"{name}_outlets/case.yaml"),)))
    return beat


def held(values):
    """Fields of a case that builds on vessel(): springs and dampers in all support regions, in place of those of the config."""
    fields = {}
    for name, parts in ERROR_REGIONS.items():
        if parts != [name]:
            fields[f"solid.support.regions.{name}"] = None
        for region in [part for part in parts if part in SUPPORTED]:
            fields[f"solid.support.regions.{region}"] = {"type": "visco_elastic", "stiffness": values[region], "damping": 2e3}
    return {**fields, OUTLET: values["outlet"]}


def supports(values):
    """Fields of a case that builds on one with held(): other stiffnesses."""
    return {**{stiffness(region): values[region] for region in SUPPORTED}, OUTLET: values["outlet"]}
