#!/usr/bin/python3
"""A hyperelastic wall in dolfinx 0.5 in the place of Tether's solid: curved tetrahedra of second order, a mesh of its own, any number of
processes. It solves Tether's equations (S.1, S.4, S.5 of docs/equations.md): neo-Hookean, visco-elastic supports per region, the
midpoint rule, clamped ends."""
import itertools
import logging
import math
import sys

import numpy as np
import tether
import ufl
from dolfinx import fem, mesh
from dolfinx.fem import petsc
from petsc4py import PETSc
from scipy import sparse
from scipy.sparse.linalg import splu

# Edges of a tetrahedron in the order in which dolfinx numbers their nodes.
EDGES = ((2, 3), (1, 3), (1, 2), (0, 3), (0, 2), (0, 1))
# Newton ends with a correction this small, of the velocity and of a step's move by a thousandth of the thickness: evaluations must
# repeat to 1e-8.
TOLERANCE = 1e-10
logging.disable(logging.INFO)  # of the compiler of forms


class Tube:
    """Nodes and tetrahedra of second order of a tube along z, and the triangles of its lumen: of the places of a lattice around, along
    and through the wall, each second one is a corner. Nodes lie on the cylinders."""

    def __init__(self, radius, thickness, length, around, along, layers):
        self.shape = np.array([2 * around, 2 * along + 1, 2 * layers + 1])
        i, j, k = np.meshgrid(*map(np.arange, self.shape), indexing="ij")
        angle, r = 2 * math.pi * i / self.shape[0], radius + thickness * k / (2 * layers)
        self.points = np.stack([r * np.cos(angle), r * np.sin(angle), length * j / (2 * along)], axis=-1).reshape(-1, 3)
        corners = np.array(list(itertools.product(range(0, 2 * around, 2), range(0, 2 * along, 2), range(0, 2 * layers, 2))))
        self.cells = np.concatenate([self.tetrahedra(corners, order) for order in itertools.permutations(range(3))])
        lumen = np.array([place for place in itertools.product(range(2 * around), range(2 * along))])
        a, b, c, d = (self.number(np.column_stack([lumen + step, np.zeros(len(lumen), int)]))
                      for step in ([0, 0], [1, 0], [1, 1], [0, 1]))
        self.triangles = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])  # normals into the wall
        corners = lumen[(lumen % 2 == 0).all(axis=1)]
        around_them = (((0, 0), (2, 0), (2, 2), (1, 0), (2, 1), (1, 1)), ((0, 0), (2, 2), (0, 2), (1, 1), (1, 2), (0, 1)))
        self.facets = np.concatenate([np.column_stack([self.number(np.column_stack([corners + step, np.zeros(len(corners), int)]))
                                                       for step in steps]) for steps in around_them])  # of six nodes

    def number(self, places):
        places = places.copy()
        places[:, 0] %= self.shape[0]
        return np.ravel_multi_index(places.T, self.shape)

    def tetrahedra(self, corners, order):
        """One of the six of each brick, from its first corner along the three directions in this order (Kuhn)."""
        steps = 2 * np.eye(3, dtype=int)[list(order)]
        vertices = [corners, corners + steps[0], corners + steps[0] + steps[1], corners + 2]
        nodes = vertices + [(vertices[a] + vertices[b]) // 2 for a, b in EDGES]
        return np.column_stack([self.number(node) for node in nodes])


def made_mesh(communicator, tube):
    """Of all processes; the first one has the cells to begin with."""
    of_second_order = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.Cell("tetrahedron", geometric_dimension=3), 2))
    first = communicator.rank == 0
    cells = tube.cells if first else np.zeros((0, 10), dtype=np.int64)
    return mesh.create_mesh(communicator, cells, tube.points if first else np.zeros((0, 3)), of_second_order)


def to_second_order(tube, place):
    """Nodal forces are integrals of the traction with the linear functions of the announced triangles; an element of second order is
    loaded by those with its own, or it ripples from node to node. Returns what makes the one of the other: through the traction, which
    is linear on the triangles, so that the sum of the forces stays."""
    a, b, wa, wb = 0.445948490915965, 0.091576213509771, 0.223381589678011, 0.109951743655322  # Dunavant (1985), degree 4
    points = [(w, np.roll([c, c, 1 - 2 * c], turn)) for c, w in ((a, wa), (b, wb)) for turn in range(3)]
    nodes = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.5, 0.5, 0], [0, 0.5, 0.5], [0.5, 0, 0.5]])  # of a facet
    linear, mixed = np.zeros((6, 6)), np.zeros((6, 6))  # of a facet of area 1
    for part in ([0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]):
        for weight, at in points:
            L = at @ nodes[part]
            quadratic = np.concatenate([L * (2 * L - 1), 4 * np.array([L[0] * L[1], L[1] * L[2], L[2] * L[0]])])
            linear[np.ix_(part, part)] += weight / 4 * np.outer(at, at)
            mixed[:, part] += weight / 4 * np.outer(quadratic, at)
    x = tube.points[tube.facets]
    areas = np.linalg.norm(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1) / 2
    rows, columns = np.repeat(place[tube.facets], 6, axis=1).ravel(), np.tile(place[tube.facets], 6).ravel()
    whole = [sparse.csc_matrix(((areas[:, None, None] * local).ravel(), (rows, columns))) for local in (linear, mixed)]
    traction = splu(whole[0])
    return lambda load: whole[1] @ traction.solve(load)


def in_region(X, angles):
    """1 where a place's angle about the axis, from +x, lies between the two [degrees], else 0; exact at the points of integration."""
    def turned(angle):  # seen from the middle of the region, so that it does not matter where angles begin
        middle = math.radians(sum(angles) / 2)
        return ufl.atan_2(X[1] * math.cos(middle) - X[0] * math.sin(middle), X[0] * math.cos(middle) + X[1] * math.sin(middle))
    return ufl.conditional(ufl.le(abs(turned(angles)), math.radians(angles[1] - angles[0]) / 2), 1.0, 0.0)


class Wall:
    program = "dolfinx wall 1"

    def __init__(self, communicator):
        case = tether.case(sys.argv[1])
        solid, swept = case["solid"], case["mesh"]["swept"]
        tube = Tube(swept["radius"], swept["wall_thickness"], swept["length"], **solid["mesh"])
        self.communicator = communicator
        self.mesh = made_mesh(self.communicator, tube)
        self.space = fem.VectorFunctionSpace(self.mesh, ("Lagrange", 2))
        self.order(tube)
        self.declare(solid)
        self.set_up(solid, swept)

    def order(self, tube):
        """Which nodes of the tube this process owns, and the interface in the tube's order."""
        space, geometry = self.space.dofmap, self.mesh.geometry
        node = np.zeros(space.index_map.size_local + space.index_map.num_ghosts, dtype=np.int64)
        for cell in range(self.mesh.topology.index_map(3).size_local + self.mesh.topology.index_map(3).num_ghosts):
            node[space.cell_dofs(cell)] = geometry.dofmap.links(cell)
        self.local = np.asarray(geometry.input_global_indices)[node]  # with those that others own
        self.owned = self.local[: space.index_map.size_local]
        lumen = np.unique(tube.triangles)
        place = np.full(len(tube.points), -1)
        place[lumen] = np.arange(len(lumen))
        self.points, self.triangles = tube.points[lumen], place[tube.triangles]
        self.consistent = to_second_order(tube, place)
        self.at_lumen = np.flatnonzero(place[self.owned] >= 0)  # among the owned nodes
        self.lumen = place[self.owned][self.at_lumen]  # their numbers on the interface
        self.nodes = len(tube.points)
        self.state_size = 6 * self.nodes

    def declare(self, solid):
        """Numbers that may be identified."""
        self.constants, self.parameters = {}, []
        stress = dict(unit="g/(cm s2)", transform="log2", prior_deviation=1, lower=0)
        self.parameter("material.young", solid["material"]["young"], **stress)
        for region, support in solid["support"]["regions"].items():
            self.parameter(f"support.regions.{region}.stiffness", support["stiffness"], absent=0, scale=1e6,
                           **dict(stress, unit="g/(cm2 s2)"))
            self.parameter(f"support.regions.{region}.damping", support["damping"], absent=0, scale=1e4,
                           **dict(stress, unit="g/(cm2 s)"))

    def parameter(self, name, value, **more):
        self.constants[name] = fem.Constant(self.mesh, PETSc.ScalarType(value))
        self.parameters.append(dict(name=name, value=float(value), meaning=f"of {self.program}", **more))

    def set_up(self, solid, swept):
        self.y0, self.u0, self.V = (fem.Function(self.space) for _ in range(3))
        self.dt = fem.Constant(self.mesh, PETSc.ScalarType(1))
        self.least = 1e-3 * swept["wall_thickness"] * math.sqrt(self.nodes)
        theta, w, dV = 0.5, ufl.TestFunction(self.space), ufl.TrialFunction(self.space)
        young, nu = self.constants["material.young"], solid["material"]["poisson"]
        mu, kappa = young / (2 * (1 + nu)), young / (3 * (1 - 2 * nu))
        y = self.y0 + theta * self.dt * self.V
        F = ufl.variable(ufl.Identity(3) + ufl.grad(y))
        J = ufl.det(F)
        energy = mu / 2 * (ufl.tr(F.T * F) * J ** (-2 / 3) - 3) + kappa / 4 * (J**2 - 1 - 2 * ufl.ln(J))  # (S.1)
        residual = ufl.inner(ufl.diff(energy, F), ufl.grad(w)) + solid["density"] / (theta * self.dt) * ufl.inner(self.V - self.u0, w)
        residual = residual * ufl.dx(degree=4) + self.support(y, w, swept)
        self.residual_form, self.tangent_form = fem.form(residual), fem.form(ufl.derivative(residual, self.V, dV))
        length = swept["length"]
        ends = fem.locate_dofs_geometrical(self.space, lambda x: np.isclose(x[2], 0) | np.isclose(x[2], length))
        self.clamped = fem.dirichletbc(np.zeros(3, dtype=PETSc.ScalarType), ends, self.space)
        self.matrix = petsc.create_matrix(self.tangent_form)
        self.solver = PETSc.KSP().create(self.communicator)
        self.solver.setOperators(self.matrix)
        self.solver.setType("preonly")
        self.solver.getPC().setType("lu")
        self.solver.getPC().setFactorSolverType("mumps")

    def support(self, y, w, swept):
        """Tissue around the wall (S.4)."""
        outer = swept["radius"] + swept["wall_thickness"]
        facets = mesh.locate_entities_boundary(self.mesh, 2, lambda x: np.hypot(x[0], x[1]) > outer - swept["wall_thickness"] / 4)
        tags = mesh.meshtags(self.mesh, 2, np.sort(facets), np.full(len(facets), 1, dtype=np.int32))
        outside = ufl.Measure("ds", domain=self.mesh, subdomain_data=tags, metadata={"quadrature_degree": 8})(1)
        X, form, rest = ufl.SpatialCoordinate(self.mesh), 0, 1.0
        for region, where in swept["regions"].items():
            here = in_region(X, where["angle"]) if where else rest
            rest = rest - here
            k, c = (self.constants[f"support.regions.{region}.{number}"] for number in ("stiffness", "damping"))
            form += here * ufl.inner(k * y + c * self.V, w) * outside
        return form

    def set_parameters(self, values):
        for name, value in values.items():
            self.constants[name].value = value

    def begin_step(self, step, time, dt, predicted):
        PETSc.garbage_cleanup(self.V.vector.comm)  # vectors that nobody names any more
        self.dt.value = dt
        self.V.x.array[:] = self.u0.x.array  # what a step begins with is known from the state alone
        self.factored = False

    def evaluate(self, load):
        before = math.inf
        for _ in range(50):
            correction = self.solve(self.residual(load), new_tangent=not self.factored)
            self.V.vector.axpy(-1, correction)
            self.V.x.scatter_forward()
            size = correction.norm()
            if size <= TOLERANCE * (self.V.vector.norm() + self.least / self.dt.value):
                return self.interface_values(self.y0.x.array + self.dt.value * self.V.x.array), self.interface_values(self.V.x.array)
            self.factored, before = size < 0.3 * before, size  # a tangent that has grown old is made anew
        raise RuntimeError("the wall's Newton iteration did not converge in 50 corrections")

    def tangent(self, load_change):
        right = self.V.vector.duplicate()
        right.set(0)
        self.add_load(right, load_change)
        change = self.interface_values(self.solve(right, new_tangent=True).array)
        return self.dt.value * change, change

    def end_step(self, accepted):
        if accepted:
            self.y0.x.array[:] += self.dt.value * self.V.x.array
            self.u0.x.array[:] = 2 * self.V.x.array - self.u0.x.array  # (S.5)

    def get_state(self):
        own = len(self.owned)
        parts = [self.gathered(f.x.array.reshape(-1, 3)[:own], self.owned, self.nodes) for f in (self.y0, self.u0)]
        return None if parts[0] is None else np.concatenate(parts).ravel()

    def set_state(self, values):
        for function, part in zip((self.y0, self.u0), values.reshape(2, -1, 3)):
            function.x.array[:] = part[self.local].ravel()

    def residual(self, load):
        vector = petsc.assemble_vector(self.residual_form)
        vector.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
        self.add_load(vector, -load)
        return vector

    def add_load(self, vector, load):
        """Nodal forces of the interface to a vector, which is then zero where the wall is clamped."""
        vector.array.reshape(-1, 3)[self.at_lumen] += self.consistent(load)[self.lumen]
        petsc.set_bc(vector, [self.clamped])

    def solve(self, right, new_tangent):
        if new_tangent:
            self.matrix.zeroEntries()
            petsc.assemble_matrix(self.matrix, self.tangent_form, bcs=[self.clamped])
            self.matrix.assemble()
            self.factored = True
        solution = right.duplicate()
        self.solver.solve(right, solution)
        return solution

    def interface_values(self, values):
        return self.gathered(values.reshape(-1, 3)[self.at_lumen], self.lumen, len(self.points))

    def gathered(self, values, places, count):
        """Of all processes, at the first one."""
        return tether.gathered(self.communicator, values, places, count)


if __name__ == "__main__":
    sys.exit(tether.serve("solid", Wall, together=True))
