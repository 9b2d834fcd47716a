"""Hexahedra in a tube along z, as OpenFOAM has a mesh: points, faces with their owners and neighbours, patches."""
import numpy as np

CORE, ROUND = 0.55, 0.6  # of the square in the middle: its corners [radius]; its sides (0: straight, 1: a circle)
SIDES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))  # of a hexahedron: low, high, then around; normals outward


class Tube:
    """points: [points, 3], discs one after the other; cells: corners [cells, 8].

    faces: corners [faces, 4], those between two cells first, then those of `patches` = {"wall": range, "inlet": range, "outlet": range},
    normals out of the owner; owner: [faces]; neighbour: [faces between cells]."""

    def __init__(self, radius, length, around, along, rings):
        """around: cells of each ring, a multiple of four; rings: of cells between the square in the middle and the wall."""
        flat, cells = disc(radius, around, rings)
        size = len(flat)
        stations = np.arange(along + 1)
        self.points = np.column_stack([np.tile(flat, (along + 1, 1)), np.repeat(length * stations / along, size)])
        low = (cells + size * stations[:-1, None, None]).reshape(-1, 4)
        self.cells = np.hstack([low, low + size])
        ends = {"inlet": np.arange(size), "outlet": np.arange(size) + size * along}
        rim = np.arange(size - around, size)
        self.set_up_faces({"wall": (rim + size * stations[:, None]).ravel(), **ends})

    def set_up_faces(self, nodes):
        """nodes: of each patch, which has the outer faces that lie between them."""
        faces = self.cells[:, SIDES].reshape(-1, 4)  # each inner one twice
        of_cell = np.repeat(np.arange(len(self.cells)), len(SIDES))
        _, first, number = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_inverse=True)
        last = np.zeros_like(first)
        last[number] = np.arange(len(faces))  # the greatest one stays
        inner = np.flatnonzero(first != last)
        inner = inner[np.lexsort((of_cell[last[inner]], of_cell[first[inner]]))]  # OpenFOAM's order
        outer = np.flatnonzero(first == last)
        parts = [first[inner]] + [first[outer][np.isin(faces[first[outer]], some).all(axis=1)] for some in nodes.values()]
        order, ends = np.concatenate(parts), np.cumsum([len(part) for part in parts])
        self.faces, self.owner, self.neighbour = faces[order], of_cell[order], of_cell[last[inner]]
        self.patches = {name: range(*ends[k:k + 2]) for k, name in enumerate(nodes)}

    def nodes(self, patch):
        """Points of a patch, ascending."""
        return np.unique(self.faces[self.patches[patch]])

    def is_sound(self, points):
        """Whether no cell is turned inside out in its middle, with points elsewhere than at rest [points, 3]."""
        low, high, front, right, back, left = (points[self.cells[:, side]].mean(axis=1) for side in SIDES)
        return np.all(np.einsum("ci,ci->c", np.cross(right - left, back - front), high - low) > 0)


def disc(radius, around, rings):
    """A rounded square, and rings of cells around it: points [points, 2], the rim's last, and quadrilaterals [cells, 4] that turn left."""
    side = around // 4
    if around != 4 * side:
        raise ValueError(f"around: {around}: the rings of this mesh have multiples of four cells")
    turn = 2 * np.pi * np.arange(around) / around
    circle = radius * np.column_stack([np.cos(turn), np.sin(turn)])
    inside, lattice = square(side, CORE * radius)
    loop = np.concatenate([lattice[:-1, 0], lattice[-1, :-1], lattice[:0:-1, -1], lattice[0, :0:-1]])
    shares = np.arange(1, rings + 1)[:, None, None] / rings
    points = np.concatenate([inside, ((1 - shares) * inside[loop] + shares * circle).reshape(-1, 2)])
    ring = np.vstack([loop, len(inside) + np.arange(rings * around).reshape(rings, around)]).T
    return points, np.concatenate([quadrilaterals(lattice), quadrilaterals(np.vstack([ring, ring[:1]])[::-1])])


def square(side, reach):
    """Points [(side + 1)^2, 2] of a rounded square whose corners lie `reach` from the middle, the first on +x, and their lattice
    [side + 1, side + 1] of numbers: a square drawn to a disc by ellipses (Fong 2015), ROUND of the way."""
    u = np.linspace(-1, 1, side + 1)
    v, w = np.meshgrid(u, u, indexing="ij")
    x, y = v * np.sqrt(1 - ROUND * w**2 / 2), w * np.sqrt(1 - ROUND * v**2 / 2)
    turned = np.stack([-x - y, x - y], axis=-1) / 2  # the corner (-1, -1) to +x
    return reach / np.sqrt(1 - ROUND / 2) * turned.reshape(-1, 2), np.arange((side + 1) ** 2).reshape(side + 1, side + 1)


def quadrilaterals(lattice):
    """[cells, 4] between the points of a lattice [rows, columns]."""
    return np.stack([lattice[:-1, :-1], lattice[1:, :-1], lattice[1:, 1:], lattice[:-1, 1:]], axis=-1).reshape(-1, 4)
