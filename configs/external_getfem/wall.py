#!/usr/bin/python3
"""A hyperelastic wall in GetFEM 5.4 in the place of Tether's solid: curved hexahedra of second order, a mesh of its own. It solves
Tether's equations (S.1, S.4, S.5 of docs/equations.md): neo-Hookean, visco-elastic supports per region, the midpoint rule, clamped
ends."""
import itertools
import math
import sys

import getfem as gf
import numpy as np
import tether
from scipy import sparse
from scipy.sparse.linalg import splu

gf.util("trace level", 0)
TOLERANCE = 1e-10  # of the last correction of the velocity, and of a step's move by a thousandth of the thickness
STRESS = "(mu*pow(Det(F),-2/3)*(F-Norm_sqr(F)/3*Inv(F)')+kappa/2*(sqr(Det(F))-1)*Inv(F)')"  # first Piola-Kirchhoff (S.1)
# With V the mean velocity over the step, y = y0 + dt V/2 in its middle.
WALL = (f"Def F:=Id(3)+Grad_y0+dt/2*Grad_V; {STRESS}:Grad_Test_V+2*density/dt*(V-u0).Test_V")
SUPPORT = "(k_{0}*(y0+dt/2*V)+c_{0}*V).Test_V"  # (S.4)


class Tube:
    """Nodes of hexahedra of second order of a tube along z: of a lattice around, along and through the wall, of which each second place is
    a corner. Nodes lie on the cylinders."""

    def __init__(self, radius, thickness, length, around, along, layers):
        self.cells, self.shape = (around, along, layers), (2 * around, 2 * along + 1, 2 * layers + 1)
        i, j, k = np.meshgrid(*map(np.arange, self.shape), indexing="ij")
        angle, r = math.pi * i / around, radius + thickness * k / (2 * layers)
        self.points = np.stack([r * np.cos(angle), r * np.sin(angle), length * j / (2 * along)], axis=-1).reshape(-1, 3)
        self.number = lambda places: np.ravel_multi_index((places % np.array([2 * around, 10**9, 10**9])).T, self.shape)
        around_them = np.array(list(itertools.product(range(2 * around), range(2 * along))))
        a, b, c, d = (self.number(np.column_stack([around_them + step, np.zeros(len(around_them), int)])) for step in ([0, 0], [1, 0], [1, 1], [0, 1]))
        self.triangles = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])  # of the lumen; normals into the wall

    def mesh(self):
        mesh = gf.Mesh("empty", 3)
        shape = gf.GeoTrans("GT_QK(3,2)")
        steps = np.array([(x, y, z) for z in range(3) for y in range(3) for x in range(3)])
        for cell in itertools.product(*map(range, self.cells)):
            mesh.add_convex(shape, self.points[self.number(2 * np.array(cell) + steps)].T)
        return mesh

    def loads(self):
        """Nodal forces are integrals of the traction with the linear functions of the announced triangles; an element of second order is
        loaded by those with its own, or it ripples from node to node. A function that makes the one of the other, through the traction,
        which is linear on the triangles, so that the sum of the forces stays. [lumen nodes, 3] both."""
        points = [(w, np.roll([c, c, 1 - 2 * c], turn)) for c, w in ((0.470142064105115, 0.132394152788506), (0.101286507323456, 0.125939180544827))
                  for turn in range(3)] + [(0.225, np.full(3, 1 / 3))]  # Dunavant (1985), degree 5
        lumen = np.unique(self.triangles)
        place = np.full(len(self.points), -1)
        place[lumen] = np.arange(len(lumen))
        i, j = np.meshgrid(np.arange(2 * self.cells[0]), np.arange(2 * self.cells[1]), indexing="ij")
        i, j = i.ravel(), j.ravel()
        at = lambda x, y: place[self.number(np.column_stack([x, y, 0 * x]))]
        facets = np.column_stack([at(i - i % 2 + x, j - j % 2 + y) for y in range(3) for x in range(3)])
        mass, second = (sparse.csc_matrix((len(lumen), len(lumen))) for _ in range(2))
        for corners in np.array([((0, 0), (1, 0), (1, 1)), ((0, 0), (1, 1), (0, 1))]):
            nodes = np.column_stack([at(i + x, j + y) for x, y in corners])
            x = self.points[lumen][nodes]
            areas = np.linalg.norm(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1) / 2
            mass += assembled(nodes, nodes, areas, np.tile((np.ones((3, 3)) + np.eye(3)) / 12, (len(nodes), 1, 1)), len(lumen))
            for weight, share in points:
                within = np.column_stack([i % 2, j % 2]) + share @ corners  # from 0 to 2 over the facet
                one, other = (np.column_stack([(s - 1) * (s - 2) / 2, s * (2 - s), s * (s - 1) / 2]) for s in within.T)
                shapes = (other[:, :, None] * one[:, None, :]).reshape(-1, 9)
                second += assembled(facets, nodes, areas, weight * shapes[:, :, None] * share, len(lumen))
        solver = splu(mass)
        return lumen, lambda forces: second @ solver.solve(forces)


def assembled(rows, columns, areas, local, size):
    """The sum of what triangles contribute: local [triangles, rows, columns] times their areas."""
    values = areas[:, None, None] * local
    places = [np.broadcast_to(one, values.shape).ravel() for one in (rows[:, :, None], columns[:, None, :])]
    return sparse.csc_matrix((values.ravel(), places), shape=(size, size))


class Wall:
    program = "getfem wall 1"

    def __init__(self):
        case = tether.case(sys.argv[1])
        self.solid, self.swept = case["solid"], case["mesh"]["swept"]
        if self.solid["material"]["type"] != "neo_hookean":
            raise ValueError(f"solid.material.type: {self.solid['material']['type']}: this wall knows neo_hookean only")
        self.tube = Tube(self.swept["radius"], self.swept["wall_thickness"], self.swept["length"], **self.solid["mesh"])
        self.lumen, self.consistent = self.tube.loads()
        self.points = self.tube.points[self.lumen]
        self.triangles = np.searchsorted(self.lumen, self.tube.triangles)
        self.state_size = 2 * self.tube.points.size
        self.set_up()

    def set_up(self):
        mesh = self.tube.mesh()
        space, integrals = gf.MeshFem(mesh, 3), gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(3,5)"))
        space.set_fem(gf.Fem("FEM_QK(3,2)"))
        self.kept = mesh, space, integrals  # the model only refers to them
        self.order = self.numbers_of(space.basic_dof_nodes().T[::3])
        self.model = gf.Model("real")
        self.model.add_fem_variable("V", space)
        for name in ("y0", "u0"):
            self.model.add_fem_data(name, space)
        self.declare()
        self.model.add_nonlinear_term(integrals, WALL)
        for number, region in enumerate(self.swept["regions"], 1):
            mesh.set_region(number, self.outside(mesh, region))
            self.model.add_linear_term(integrals, SUPPORT.format(region), number)
        z = self.tube.points[:, 2]
        self.free = np.repeat((z > 0) & (z < self.swept["length"]), 3)
        self.y0, self.u0, self.V = (np.zeros(self.tube.points.shape) for _ in range(3))

    def numbers_of(self, nodes):
        """Of GetFEM's nodes among the tube's."""
        rounded = lambda points: [tuple(row) for row in np.round(points * 1e6 / self.swept["radius"]).astype(int)]
        numbers = {where: number for number, where in enumerate(rounded(self.tube.points))}
        return np.array([numbers[where] for where in rounded(nodes)])

    def outside(self, mesh, region):
        """Faces on the outer cylinder in a region's angles; in one without angles, all that no other has."""
        faces = mesh.outer_faces()
        outer = self.swept["radius"] + self.swept["wall_thickness"]
        nodes = [mesh.pts(mesh.pid_in_faces(face.reshape(2, 1))) for face in faces.T]
        kept = [k for k, x in enumerate(nodes) if np.hypot(x[0], x[1]).min() > 0.999 * outer and self.region_at(x.mean(axis=1)) == region]
        return faces[:, kept]

    def region_at(self, place):
        angle = math.degrees(math.atan2(place[1], place[0])) % 360
        for name, where in self.swept["regions"].items():
            if not where or where["angle"][0] < angle < where["angle"][1]:
                return name
        return None

    def declare(self):
        """Numbers that may be identified."""
        self.numbers, self.parameters = {}, []
        self.number("material.young", self.solid["material"]["young"], unit="g/(cm s2)")
        for region, support in self.solid["support"]["regions"].items():
            self.number(f"support.regions.{region}.stiffness", support["stiffness"], absent=0, scale=1e6, unit="g/(cm2 s2)")
            self.number(f"support.regions.{region}.damping", support["damping"], absent=0, scale=1e4, unit="g/(cm2 s)")
        for name in ("mu", "kappa", *(f"{letter}_{region}" for region in self.swept["regions"] for letter in "kc")):
            self.model.add_initialized_data(name, [1.0])
        self.model.add_initialized_data("density", [self.solid["density"]])
        self.model.add_initialized_data("dt", [1.0])
        self.set_parameters({})

    def number(self, name, value, **more):
        self.numbers[name] = value
        self.parameters.append(dict(name=name, value=value, meaning=f"of {self.program}", transform="log2", prior_deviation=1, lower=0, **more))

    def set_parameters(self, values):
        self.numbers |= values
        young, nu = self.numbers["material.young"], self.solid["material"]["poisson"]
        self.model.set_variable("mu", [young / (2 * (1 + nu))])
        self.model.set_variable("kappa", [young / (3 * (1 - 2 * nu))])
        for region in self.swept["regions"]:
            self.model.set_variable(f"k_{region}", [self.numbers[f"support.regions.{region}.stiffness"]])
            self.model.set_variable(f"c_{region}", [self.numbers[f"support.regions.{region}.damping"]])

    def begin_step(self, step, time, dt, predicted):
        self.dt, self.V = dt, self.u0.copy()  # what a step begins with is known from the state alone
        self.model.set_variable("dt", [dt])
        for name, field in (("y0", self.y0), ("u0", self.u0)):
            self.model.set_variable(name, field[self.order].ravel())
        self.factor = None

    def evaluate(self, load):
        least, before = 1e-3 * self.swept["wall_thickness"] * math.sqrt(len(self.V)), math.inf
        for _ in range(50):
            right = self.assembled(load)
            correction = self.factor.solve(right)
            self.V.ravel()[self.free] += correction
            size = np.linalg.norm(correction)
            if size <= TOLERANCE * (np.linalg.norm(self.V) + least / self.dt):
                return self.y0[self.lumen] + self.dt * self.V[self.lumen], self.V[self.lumen]
            if size > 0.3 * before:
                self.factor = None  # a tangent that has grown old is made anew
            before = size
        raise RuntimeError("the wall's Newton iteration did not converge in 50 corrections")

    def tangent(self, load_change):
        self.factor = None
        self.assembled(np.zeros_like(load_change))
        change = np.zeros(self.V.shape)
        change.ravel()[self.free] = self.factor.solve(self.nodal(load_change)[self.free])
        return self.dt * change[self.lumen], change[self.lumen]

    def end_step(self, accepted):
        if accepted:
            self.y0 = self.y0 + self.dt * self.V
            self.u0 = 2 * self.V - self.u0  # (S.5)

    def get_state(self):
        return np.concatenate([self.y0.ravel(), self.u0.ravel()])

    def set_state(self, values):
        self.y0, self.u0 = (part.reshape(-1, 3).copy() for part in np.split(values, 2))

    def nodal(self, load):
        """A load of the interface at all nodes of the wall [3 nodes]."""
        forces = np.zeros(self.tube.points.shape)
        forces[self.lumen] = self.consistent(load)
        return forces.ravel()

    def assembled(self, load):
        """What is left of equilibrium with V; a factor of the tangent, if there is none."""
        self.model.set_variable("V", self.V[self.order].ravel())
        self.model.assembly("build_rhs" if self.factor else "build_all")
        left = np.zeros(self.tube.points.shape)
        left[self.order] = self.model.rhs().reshape(-1, 3)
        if not self.factor:
            matrix = self.model.tangent_matrix()
            starts, rows = matrix.csc_ind()
            unknowns = (3 * self.order[:, None] + np.arange(3)).ravel()  # of the tube's order, by GetFEM's
            ours = sparse.csc_matrix((matrix.csc_val(), rows, starts)).tocoo()
            place = np.cumsum(self.free) - 1
            row, column = unknowns[ours.row], unknowns[ours.col]
            both = self.free[row] & self.free[column]
            self.factor = splu(sparse.csc_matrix((ours.data[both], (place[row[both]], place[column[both]]))), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
        return (left.ravel() + self.nodal(load))[self.free]


if __name__ == "__main__":
    sys.exit(tether.serve("solid", Wall))
