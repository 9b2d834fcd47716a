#!/usr/bin/python3
"""Blood in OpenFOAM 1912 in the place of Tether's fluid: pimpleFoam on hexahedra in a straight tube along z that move with its wall.

An evaluation is a run of pimpleFoam over one step: from the step's start, which is written each time, to where the wall is to be. What
it leaves (points, U, p, Uf) is the next step's start once the step is accepted; nothing else goes from step to step.

The wall's motion and the inflow are given in an evaluation, so that incompressible blood leaves the tube as they say, whatever the
pressure at the outlet: that lifts all pressures alike. So pimpleFoam has no pressure there, and what the Windkessel answers to its outflow is
added to what it finds."""
import pathlib
import sys

import numpy as np
import tether
from foam import Case, Field
from tube import Tube

FIELDS = {"U": ("volVectorField", "[0 1 -1 0 0 0 0]"), "Uf": ("surfaceVectorField", "[0 1 -1 0 0 0 0]"), "p": ("volScalarField", "[0 2 -2 0 0 0 0]"),
          "pointDisplacement": ("pointVectorField", "[0 1 0 0 0 0 0]")}
REST = "uniform (0 0 0)"
PARAMETERS = {"density": "g/cm3", "rheology.viscosity": "g/(cm s)", "outlets.outlet.proximal_resistance": "g/(cm4 s)",
              "outlets.outlet.distal_resistance": "g/(cm4 s)", "outlets.outlet.compliance": "cm4 s2/g"}  # Windkessel's last, in its order


class Start:
    """What a step starts from. displacement: [points, 3]; U: [cells + outer faces, 3]; Uf: [faces, 3], velocities at faces; p: [cells], over
    the density, less the outlet's; stored: the Windkessel's pressure."""

    def __init__(self, displacement, U, Uf, p, stored):
        self.displacement, self.U, self.Uf, self.p, self.stored = displacement, U, Uf, p, stored

    @classmethod
    def at_rest(cls, tube):
        cells, faces, inner = len(tube.cells), len(tube.faces), len(tube.neighbour)
        return cls(np.zeros_like(tube.points), np.zeros((cells + faces - inner, 3)), np.zeros((faces, 3)), np.zeros(cells), 0.0)

    def vector(self):
        return np.concatenate([self.displacement.ravel(), self.U.ravel(), self.Uf.ravel(), self.p, [self.stored]])

    def taken_from(self, values):
        """One of the same sizes."""
        displacement, U, Uf, p, stored = np.split(values, np.cumsum([self.displacement.size, self.U.size, self.Uf.size, self.p.size]))
        return Start(displacement.reshape(-1, 3), U.reshape(-1, 3), Uf.reshape(-1, 3), p, stored[0])


class Blood:
    program = "OpenFOAM blood 1"
    observables = [("inlet.flow", "cm3/s"), ("outlet.flow", "cm3/s"), ("inlet.pressure", "g/(cm s2)"), ("outlet.pressure", "g/(cm s2)")]

    def __init__(self):
        case = tether.case(sys.argv[1])
        swept, fluid = case["mesh"]["swept"], case["fluid"]
        refuse_others("fluid.rheology", fluid["rheology"], "newtonian")
        refuse_others("fluid.outlets.outlet", fluid["outlets"]["outlet"], "windkessel")
        self.numbers = {name: within(fluid, name) for name in PARAMETERS}
        self.parameters = [dict(name=name, value=self.numbers[name], unit=unit, transform="log2", prior_deviation=1, lower=0) for name, unit in PARAMETERS.items()]
        self.distal_pressure, self.flow = within(fluid, "outlets.outlet.distal_pressure"), tether.Curve(**fluid["inlets"]["inlet"]["flow"])
        lattice = fluid["mesh"]
        self.tube = Tube(swept["radius"], swept["length"], lattice["around"], lattice["along"], lattice["rings"])
        self.radius, self.length, self.along = swept["radius"], swept["length"], lattice["along"]
        self.set_up_interface()
        self.case = Case("pimpleFoam", pathlib.Path(__file__).parent / "foam", self.tube)
        self.start, self.told = Start.at_rest(self.tube), [0.0] * 4
        self.state_size = len(self.start.vector())

    def set_up_interface(self):
        """Nodes in the order in which the wall's faces name them, which is OpenFOAM's of the patch; two triangles a face."""
        faces = self.faces("wall")
        nodes, first = np.unique(faces, return_index=True)
        self.wall = nodes[np.argsort(first)]
        self.points = self.tube.points[self.wall]
        place = np.zeros(len(self.tube.points), dtype=int)
        place[self.wall] = np.arange(len(self.wall))
        self.triangles = place[faces[:, [0, 1, 2, 0, 2, 3]]].reshape(-1, 3)

    def set_parameters(self, values):
        self.numbers |= values

    def begin_step(self, step, time, dt, predicted):
        self.dt, self.inflow = dt, self.flow(time + dt)
        self.density, self.viscosity, *outlet = (self.numbers[name] for name in PARAMETERS)
        self.windkessel = tether.Windkessel(*outlet, self.distal_pressure, self.start.stored, dt)
        self.write_start()

    def write_start(self):
        inner, cells = len(self.tube.neighbour), len(self.tube.cells)
        outer = {name: slice(part.start - inner, part.stop - inner) for name, part in self.tube.patches.items()}
        U, Uf = ({name: values[some] for name, some in outer.items()} for values in (self.start.U[cells:], self.start.Uf[inner:]))
        self.case.write_points(self.tube.points + self.start.displacement)
        self.write_field("U", self.start.U[:cells], {
            "wall": {"type": "movingWallVelocity", "value": U["wall"]},
            "inlet": self.parabola(),
            "outlet": {"type": "pressureInletOutletVelocity", "value": U["outlet"]}})
        self.write_field("p", self.start.p, {
            "wall": {"type": "zeroGradient"}, "inlet": {"type": "zeroGradient"}, "outlet": {"type": "fixedValue", "value": "uniform 0"}})
        self.write_field("Uf", self.start.Uf[:inner], {name: {"type": "calculated", "value": values} for name, values in Uf.items()})

    def write_field(self, name, inside, patches):
        self.case.write_field(name, *FIELDS[name], inside, patches)

    def parabola(self):
        """Of the inlet, in OpenFOAM's words: it brings the step's inflow however the faces move in their plane."""
        return {"type": "exprFixedValue", "value": REST,
                "variables": f'("shape = 1 - (sqr(pos().x()) + sqr(pos().y())) / {self.radius**2!r}")',
                "valueExpr": f'"vector(0, 0, {self.inflow!r}) * shape / sum(shape * area())"'}

    def faces(self, patch):
        """Corners [faces, 4]."""
        return self.tube.faces[self.tube.patches[patch]]

    def evaluate(self, displacement, velocity):
        self.write_field("pointDisplacement", REST, {
            "wall": {"type": "fixedValue", "value": displacement}, "inlet": {"type": "slip"}, "outlet": {"type": "slip"}})
        self.read(self.case.step(self.dt, nu=self.viscosity / self.density))
        return self.forces(self.points + displacement)

    def read(self, folder):
        """What a step leaves: `trial` is what the next one would start from."""
        cells, inner = len(self.tube.cells), len(self.tube.neighbour)
        motion, U, Uf, p, phi, shear = (Field(folder / name, self.tube.patches) for name in ("pointDisplacement", "U", "Uf", "p", "phi", "wallShearStress"))
        inflow, outflow = -phi.at("inlet").sum(), phi.at("outlet").sum()
        self.trial = Start(motion.inside(len(self.tube.points)), U.whole(cells), Uf.whole(inner), p.inside(cells), self.windkessel.stored(outflow))
        if not self.tube.is_sound(self.tube.points + self.trial.displacement):
            raise RuntimeError("the wall moves so far that cells are turned inside out")
        at_outlet = self.windkessel.offset + self.windkessel.slope * outflow
        self.pressure, self.shear = at_outlet + self.density * p.inside(cells), shear.at("wall")  # of cells; of faces, over the density
        self.trial_told = [inflow, outflow, self.beside("inlet").mean(), at_outlet]

    def beside(self, patch):
        """Pressure [faces] of the cells at a patch."""
        return self.pressure[self.tube.owner[self.tube.patches[patch]]]

    def forces(self, nodes):
        """On the wall's nodes [nodes, 3], of pressure and friction that are the same all over each face."""
        a, b, c = (nodes[corner] for corner in self.triangles.T)
        normal = np.cross(b - a, c - a) / 2
        of_face = np.arange(len(self.triangles)) // 2
        friction = -self.density * self.shear[of_face] * np.linalg.norm(normal, axis=1)[:, None]
        forces = np.zeros_like(nodes)
        np.add.at(forces, self.triangles, ((self.beside("wall")[of_face, None] * normal + friction) / 3)[:, None])
        return forces

    def end_step(self, accepted):
        if accepted:
            self.start, self.told = self.trial, self.trial_told
        return self.told

    def get_state(self):
        return self.start.vector()

    def set_state(self, values):
        self.start = self.start.taken_from(values)


def refuse_others(where, section, own):
    if section["type"] != own:
        raise ValueError(f"{where}.type: {section['type']}: this blood knows {own} only")


def within(section, name):
    """What a section of the case has at a place, `outlets.outlet.compliance`."""
    for key in name.split("."):
        section = section[key]
    return section


if __name__ == "__main__":
    sys.exit(tether.serve("fluid", Blood))
