#!/usr/bin/python3
"""Three-dimensional blood in dolfinx 0.5 in the place of Tether's fluid: tetrahedra of first order in a straight tube along z that move
with its wall, any number of processes. Incompressible Navier-Stokes in moving coordinates, implicit Euler, stabilised as usual (SUPG,
PSPG: Tezduyar 1991), the advection of the step before; a parabolic inflow that is given, and a Windkessel at the outlet.

The mesh of a step is where its prediction puts the wall, so that a step is linear: one factor, and for each velocity of the wall one
solve with it. Forces on the wall are what its rows of the equations lack: they and the wall's velocity do the work that the blood loses."""
import logging
import math
import sys

import numpy as np
import tether
import ufl
from dolfinx import fem, mesh
from dolfinx.fem import petsc
from petsc4py import PETSc

logging.disable(logging.INFO)  # of the compiler of forms


class Tube:
    """Nodes and tetrahedra of a tube along z, and the triangles of its side: discs of rings with six nodes more each, a disc at each
    station. around: nodes of the outermost ring, a multiple of six."""

    def __init__(self, radius, length, around, along):
        rings = around // 6
        if around != 6 * rings:
            raise ValueError(f"fluid.mesh.around: {around}: this blood has rings with multiples of six nodes")
        first = [1 + 3 * k * (k - 1) for k in range(rings + 1)]  # node of each ring; the centre is node 0
        first[0] = 0
        number = lambda k, i: first[k] + i % (6 * k) if k else 0
        disc = np.zeros((first[rings] + around, 2))
        for k in range(1, rings + 1):
            angle = 2 * math.pi * np.arange(6 * k) / (6 * k)
            disc[first[k]:first[k] + 6 * k] = radius * k / rings * np.column_stack([np.cos(angle), np.sin(angle)])
        flat = []
        for k in range(1, rings + 1):
            for sector in range(6):
                outer, inner = lambda j: number(k, sector * k + j), lambda j: number(k - 1, sector * (k - 1) + j)
                flat += [(outer(j), outer(j + 1), inner(j)) for j in range(k)] + [(inner(j), outer(j + 1), inner(j + 1)) for j in range(k - 1)]
        size, stations = len(disc), np.arange(along + 1)
        z = length * stations / along
        self.points = np.column_stack([np.tile(disc, (along + 1, 1)), np.repeat(z, size)])
        a, b, c = (np.sort(flat, axis=1)[None] + size * stations[:-1, None, None]).reshape(-1, 3).T  # each prism's, the least first
        self.cells = np.concatenate([np.column_stack(t) for t in ((a, b, c, c + size), (a, b, b + size, c + size), (a, a + size, b + size, c + size))])
        rim = first[rings] + np.arange(around)
        low, high = np.sort(np.column_stack([rim, np.roll(rim, -1)]), axis=1).T  # the diagonal of each side goes up from its lower number
        turned = high - low > 1  # the last side of the ring, whose lower number comes after the higher one
        corners = np.stack([np.column_stack([low, high, high + size]), np.column_stack([low, high + size, low + size])])
        corners[:, turned] = corners[:, turned][:, :, [0, 2, 1]]
        side = (corners[None] + size * stations[:-1, None, None, None]).reshape(-1, 3)
        self.wall = np.unique(side)  # nodes
        place = np.full(len(self.points), -1)
        place[self.wall] = np.arange(len(self.wall))
        self.triangles = place[side]  # normals out of the blood
        self.place = place  # of each node on the interface, -1 inside
        self.ends = {"inlet": np.arange(size), "outlet": np.arange(size) + size * along}


class Operator:
    """A matrix on arrays of this process' own entries. Of vectors it has two for all times: PETSc keeps those that Python drops."""

    def __init__(self, matrix):
        self.matrix = matrix
        self.given, self.result = matrix.createVecs()

    def __call__(self, values):
        self.given.array[:] = values
        self.apply()
        return self.result.array.copy()

    def apply(self):
        self.matrix.mult(self.given, self.result)


class Inverse(Operator):
    """Of a matrix whose rows and columns `held` [numbers of the whole matrix] are the identity's."""

    def __init__(self, whole, held):
        super().__init__(whole.copy())
        self.held = held.astype(PETSc.IntType)
        self.matrix.setOption(PETSc.Mat.Option.KEEP_NONZERO_PATTERN, True)
        self.matrix.zeroRowsColumns(self.held, diag=1)
        self.solver = PETSc.KSP().create(whole.comm)
        self.solver.setOperators(self.matrix)
        self.solver.setType("preonly")
        self.solver.getPC().setType("lu")
        self.solver.getPC().setFactorSolverType("mumps")

    def renew(self, whole):
        whole.copy(self.matrix, PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
        self.matrix.zeroRowsColumns(self.held, diag=1)

    def apply(self):
        self.solver.solve(self.given, self.result)


# In the order in which tether.Windkessel takes its own.
PARAMETERS = {"density": "g/cm3", "rheology.viscosity": "g/(cm s)", "outlets.outlet.proximal_resistance": "g/(cm4 s)",
              "outlets.outlet.distal_resistance": "g/(cm4 s)", "outlets.outlet.compliance": "cm4 s2/g"}


class Blood:
    program = "dolfinx blood 1"
    observables = [("inlet.flow", "cm3/s"), ("outlet.flow", "cm3/s"), ("inlet.pressure", "g/(cm s2)"), ("outlet.pressure", "g/(cm s2)")]

    def __init__(self, communicator):
        case = tether.case(sys.argv[1])
        swept, fluid = case["mesh"]["swept"], case["fluid"]
        outlet = fluid["outlets"]["outlet"]
        for where, kind, own in (("fluid.rheology", fluid["rheology"]["type"], "newtonian"), ("fluid.outlets.outlet", outlet["type"], "windkessel")):
            if kind != own:
                raise ValueError(f"{where}.type: {kind}: this blood knows {own} only")
        self.numbers = {"density": fluid["density"], "rheology.viscosity": fluid["rheology"]["viscosity"],
                        **{name: outlet[name.rsplit(".", 1)[1]] for name in PARAMETERS if name.startswith("outlets.")}}
        self.parameters = [dict(name=name, value=self.numbers[name], unit=unit, transform="log2", prior_deviation=1, lower=0) for name, unit in PARAMETERS.items()]
        self.distal_pressure, self.flow = outlet["distal_pressure"], tether.Curve(**fluid["inlets"]["inlet"]["flow"])
        lattice = fluid.get("mesh", swept)
        self.tube = Tube(swept["radius"], swept["length"], lattice["around"], lattice["along"])
        self.points, self.triangles = self.tube.points[self.tube.wall], self.tube.triangles
        self.communicator, self.length, self.stored, self.told = communicator, swept["length"], 0.0, [0.0] * 4
        self.state_size = 6 * len(self.tube.points) + 1
        self.set_up_mesh()
        self.set_up_equations()

    def set_up_mesh(self):
        """The tetrahedra over the processes, and the extension of the wall's motion to the inside (harmonic on the mesh at rest). Ends stay
        in their planes."""
        first = self.communicator.rank == 0
        of_first_order = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.Cell("tetrahedron", geometric_dimension=3), 1))
        self.mesh = mesh.create_mesh(self.communicator, self.tube.cells if first else np.zeros((0, 4), dtype=np.int64),
                                     self.tube.points if first else np.zeros((0, 3)), of_first_order)
        self.rest = self.mesh.geometry.x.copy()
        scalars = fem.FunctionSpace(self.mesh, ("Lagrange", 1))
        self.moved, first_row = fem.Function(scalars), scalars.dofmap.index_map.local_range[0]
        self.of_geometry = np.asarray(self.mesh.geometry.input_global_indices)  # numbers of the tube's nodes, which each space has in an order of its own
        self.of_scalars = self.numbers_of(scalars)
        self.geometry_of_scalars, self.motion = places_of(self.of_geometry, self.of_scalars), np.zeros_like(self.rest)
        u, v = ufl.TrialFunction(scalars), ufl.TestFunction(scalars)
        stiffness = petsc.assemble_matrix(fem.form(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx))
        stiffness.assemble()
        self.stiffness = Operator(stiffness)
        ends, own = np.union1d(self.tube.ends["inlet"], self.tube.ends["outlet"]), self.of_scalars[:scalars.dofmap.index_map.size_local]
        held = [np.flatnonzero(np.isin(own, nodes)) for nodes in (self.tube.wall, np.union1d(self.tube.wall, ends))]
        self.extensions = [(rows, Inverse(stiffness, first_row + rows)) for rows in (held[0], held[0], held[1])]  # of x, y and z

    def numbers_of(self, space):
        """Of the tube's nodes at the degrees of freedom of first order, with those that others own."""
        numbers = np.zeros(space.dofmap.index_map.size_local + space.dofmap.index_map.num_ghosts, dtype=np.int64)
        cells = self.mesh.topology.index_map(3)
        for cell in range(cells.size_local + cells.num_ghosts):
            numbers[space.dofmap.cell_dofs(cell)] = self.of_geometry[self.mesh.geometry.dofmap.links(cell)]
        return numbers

    def extended(self, at_wall):
        """The motion of the tube's nodes [nodes of the geometry of this process, 3] from the wall's [nodes of the wall, 3]."""
        motion = np.zeros_like(self.rest)
        for axis, (rows, inverse) in enumerate(self.extensions):
            place = self.tube.place[self.of_scalars[rows]]
            held = np.zeros(len(self.stiffness.given.array))
            held[rows] = np.where(place >= 0, at_wall[place, axis], 0)
            right = -self.stiffness(held)
            right[rows] = held[rows]
            self.moved.x.array[:len(right)] = inverse(right)
            self.moved.x.scatter_forward()
            motion[:, axis] = self.moved.x.array[self.geometry_of_scalars]
        return motion

    def set_up_equations(self):
        both = ufl.MixedElement([ufl.VectorElement("Lagrange", self.mesh.ufl_cell(), 1), ufl.FiniteElement("Lagrange", self.mesh.ufl_cell(), 1)])
        space = fem.FunctionSpace(self.mesh, both)
        velocities, rows = space.sub(0).collapse()
        self.before, self.carrier = fem.Function(velocities), fem.Function(velocities)
        self.local, self.owned = self.numbers_of(velocities), velocities.dofmap.index_map.size_local
        self.geometry_of_velocities = places_of(self.local, self.of_geometry)
        self.rows = np.asarray(rows).reshape(-1, 3)[:self.owned]  # of the velocity, at this process' own nodes
        own = self.local[:self.owned]
        inlet = np.setdiff1d(self.tube.ends["inlet"], self.tube.wall)
        self.at_wall, self.at_inlet = (np.flatnonzero(np.isin(own, nodes)) for nodes in (self.tube.wall, inlet))
        x, y = self.tube.points[own[self.at_inlet], :2].T
        self.profile = 1 - (x**2 + y**2) / (self.tube.points[self.tube.wall[0], :2] ** 2).sum()
        self.held = self.rows[np.concatenate([self.at_wall, self.at_inlet])].ravel()
        self.declare_forms(space)
        self.vector, self.matrix, self.inverse = petsc.create_vector(self.right), petsc.create_matrix(self.left), None
        self.first_row = space.dofmap.index_map.local_range[0]

    def ends(self):
        """The measure of the inlet's (1) and the outlet's triangles (2)."""
        facets = [mesh.locate_entities_boundary(self.mesh, 2, lambda x, z=z: np.isclose(x[2], z)) for z in (0, self.length)]
        tags, facets = np.concatenate([np.full(len(some), tag, dtype=np.int32) for tag, some in enumerate(facets, 1)]), np.concatenate(facets)
        order = np.argsort(facets)
        return ufl.Measure("ds", domain=self.mesh, subdomain_data=mesh.meshtags(self.mesh, 2, facets[order].astype(np.int32), tags[order]))

    def declare_forms(self, space):
        (u, p), (v, q) = ufl.TrialFunctions(space), ufl.TestFunctions(space)
        self.density, self.viscosity, self.dt = (fem.Constant(self.mesh, PETSc.ScalarType(1)) for _ in range(3))
        rho, mu, dt, a, n, ends = self.density, self.viscosity, self.dt, self.carrier, ufl.FacetNormal(self.mesh), self.ends()
        inside = ufl.dx(degree=3)  # tau is no polynomial
        h, speed = ufl.CellDiameter(self.mesh), ufl.sqrt(ufl.inner(a, a))
        tau = ((2 / dt) ** 2 + (2 * speed / h) ** 2 + (12 * mu / (rho * h**2)) ** 2) ** -0.5
        strain = lambda w: ufl.sym(ufl.grad(w))
        along = lambda w: ufl.dot(a, ufl.nabla_grad(w))
        inertia = rho * ((u - self.before) / dt + along(u))
        equations = (ufl.inner(inertia, v) + 2 * mu * ufl.inner(strain(u), strain(v)) - p * ufl.div(v) + q * ufl.div(u)) * inside
        equations += tau / rho * ufl.inner(inertia + ufl.grad(p), rho * along(v) + ufl.grad(q)) * inside
        inward = (ufl.dot(a, n) - abs(ufl.dot(a, n))) / 2
        equations -= rho / 2 * inward * ufl.inner(u, v) * ends(2)  # what flows back in brings no energy (Esmaily Moghadam et al. 2011)
        self.left, self.right = fem.form(ufl.lhs(equations)), fem.form(ufl.rhs(equations))
        self.normal_flow = [fem.form(ufl.dot(v, n) * ends(tag)) for tag in (1, 2)]
        self.inlet_pressure = fem.form(q * ends(1))

    def set_parameters(self, values):
        self.numbers |= values

    def begin_step(self, step, time, dt, predicted):
        density, viscosity, *outlet = (self.numbers[name] for name in PARAMETERS)
        self.density.value, self.viscosity.value, self.dt.value = density, viscosity, dt
        self.windkessel = tether.Windkessel(*outlet, self.distal_pressure, self.stored, dt)
        self.trial_motion = self.extended(predicted)
        self.mesh.geometry.x[:] = self.rest + self.trial_motion
        self.carrier.x.array[:] = self.before.x.array - ((self.trial_motion - self.motion) / dt)[self.geometry_of_velocities].ravel()
        self.matrix.zeroEntries()
        petsc.assemble_matrix(self.matrix, self.left)
        self.matrix.assemble()
        if self.inverse is None:
            self.equations, self.inverse = Operator(self.matrix), Inverse(self.matrix, self.first_row + self.held)
        else:
            self.inverse.renew(self.matrix)
        self.into, self.out, self.given, self.pressure_row = map(self.assembled, (*self.normal_flow, self.right, self.inlet_pressure))
        self.inflow = self.flow(time + dt)
        self.of_unit_pressure = self.solved(-self.out, self.dirichlet(None, 0))

    def evaluate(self, displacement, velocity):
        self.trial, self.pressure = self.answer(self.given, self.dirichlet(velocity, self.inflow), self.windkessel.offset)
        return self.forces(self.equations(self.trial) - self.given + self.pressure * self.out)

    def tangent(self, change):
        answer, pressure = self.answer(0 * self.given, self.dirichlet(change, 0), 0)
        return self.forces(self.equations(answer) + pressure * self.out)

    def answer(self, right, held, offset):
        """Velocities and pressures, and the pressure `offset + slope Q` at the outlet, whose unit alone makes `of_unit_pressure`."""
        free, slope = self.solved(right, held), self.windkessel.slope
        pressure = (offset + slope * self.dot(self.out, free)) / (1 - slope * self.dot(self.out, self.of_unit_pressure))
        return free + pressure * self.of_unit_pressure, pressure

    def dirichlet(self, wall, inflow):
        """Velocities that are held: the wall's [nodes of the wall, 3] (None: at rest), the parabola of an inflow."""
        held = np.zeros_like(self.into)
        held[self.rows[self.at_inlet, 2]] = self.profile
        held *= -inflow / self.dot(self.into, held)
        if wall is not None:
            held[self.rows[self.at_wall]] = wall[self.tube.place[self.local[self.at_wall]]]
        return held

    def solved(self, right, held):
        right = right - self.equations(held)
        right[self.held] = held[self.held]
        return self.inverse(right)

    def dot(self, one, other):
        return self.communicator.allreduce(one @ other)

    def assembled(self, form):
        with self.vector.localForm() as local:
            local.set(0)
        petsc.assemble_vector(self.vector, form)
        self.vector.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
        return self.vector.array.copy()

    def forces(self, missing):
        """Of the blood on the wall, which adds what the equations of its nodes lack."""
        return self.gathered(-missing[self.rows[self.at_wall]], self.tube.place[self.local[self.at_wall]], len(self.points))

    def end_step(self, accepted):
        if accepted:
            flow = self.dot(self.out, self.trial)
            self.before.x.array[:3 * self.owned] = self.trial[self.rows].ravel()
            self.before.x.scatter_forward()
            self.motion, self.stored = self.trial_motion, self.windkessel.stored(flow)
            self.told = [self.inflow, flow, self.dot(self.pressure_row, self.trial) / self.dot(self.pressure_row, np.ones_like(self.trial)), self.pressure]
        return self.told

    def get_state(self):
        parts = [self.gathered(values.reshape(-1, 3), numbers, len(self.tube.points)) for values, numbers in ((self.before.x.array, self.local), (self.motion, self.of_geometry))]
        return None if parts[0] is None else np.append(np.concatenate(parts).ravel(), self.stored)

    def set_state(self, values):
        velocities, motion = values[:-1].reshape(2, -1, 3)
        self.before.x.array[:], self.motion, self.stored = velocities[self.local].ravel(), motion[self.of_geometry], values[-1]

    def gathered(self, values, places, count):
        """Of all processes, at the first one."""
        return tether.gathered(self.communicator, values, places, count)


def places_of(numbers, among):
    """Where each of `numbers` stands among others."""
    order = np.argsort(among)
    return order[np.searchsorted(among[order], numbers)]


if __name__ == "__main__":
    sys.exit(tether.serve("fluid", Blood, together=True))
