"""How fine the study is."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Mesh:
    edges: str  # as tether build-model has them; the left carotid, 7 mm wide, bears no edges beyond 4 mm
    layers: int  # of the wall
    step: float  # of a run [s]


@dataclasses.dataclass(frozen=True)
class Size:
    truth: Mesh
    model: Mesh
    voxel: tuple  # of the images [mm]
    seeds: tuple  # of the data's errors; the first is that of all figures, the wide prior of figure 11 is tried on all


SIZES = {
    "smallest": Size(Mesh("{per_radius: 0.45, shortest: 2.8 mm, longest: 5 mm}", 2, 6e-3), Mesh("{per_radius: 0.55, shortest: 3.5 mm, longest: 7.5 mm}", 1, 1e-2), (1, 1, 1.5), (1,)),
    "coarse": Size(Mesh("{longest: 4 mm}", 2, 4e-3), Mesh("{per_radius: 0.5, shortest: 3 mm, longest: 6 mm}", 1, 6e-3), (1, 1, 1.5), (1, 2, 3, 4, 5)),
    "paper": Size(Mesh("{longest: 1.7 mm}", 3, 1e-3), Mesh("{longest: 2 mm}", 2, 1e-3), (0.6, 0.6, 1), (1, 2, 3, 4, 5)),
}
