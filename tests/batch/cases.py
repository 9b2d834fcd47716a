"""What jobs and hosts run: a small tube, and two of its springs identified from a twin."""

import os
import subprocess

MODEL = """base: {tube}
name: tube
time: {{step: 4e-3{end}}}
mesh: {{swept: {{around: 12, along: 8}}}}
"""
TWIN = """base: tube.yaml
name: lost_spring
solid: {support: {regions: {spine: {stiffness: 1e5}}}}
twin:
  truth: tube.yaml
  seed: 1
  frames: 6
  image: {voxel: [1 mm, 1 mm, 1.5 mm]}
  noise: {deviation: 0.15 mm, correlation_length: 5 mm}
  hidden: {effects: {visco_elastic: {where: spine, amplitude: 1e6, unit: g/(cm2 s2)}}}
"""
IDENTIFICATION = """base: case.yaml
name: springs
output: {checkpoint_every: 5}
identification:
  parameters:
    spine: {of: [solid.support.regions.spine.stiffness]}
    opposite: {of: [solid.support.regions.opposite.stiffness]}
"""
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def write_tube(folder, configs, end="", more=""):
    """tube.yaml; `end`: of the run [s], a beat by default; `more`: lines that it says too."""
    (folder / "tube.yaml").write_text(MODEL.format(tube=configs / "tube/case.yaml", end=end and f", end: {end}") + more)


def write_twin(folder, tether):
    """The twin of tube.yaml that lacks a spring, and the identification in it, whose path is returned."""
    (folder / "twin.yaml").write_text(TWIN)
    subprocess.run([tether, "twin", "twin.yaml", "--output", "twin", "--quiet"], cwd=folder, env=os.environ | AS_ROOT, check=True, capture_output=True)
    (folder / "twin/springs.yaml").write_text(IDENTIFICATION)
    return folder / "twin/springs.yaml"


def estimates(folder):
    return (folder / "estimate.csv").read_bytes()
