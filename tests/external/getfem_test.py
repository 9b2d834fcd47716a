"""The wall of configs/external_getfem beside ours: getfem_test.py TETHER SOURCES."""

import sys

from beside_ours import BesideOurs, run_with

COARSE_WALL = "  mesh: {around: 16, along: 6}\n"


class GetfemWall(BesideOurs):
    @property
    def case(self):
        return self.sources / "configs/external_getfem/case.yaml"

    def test_keeps_the_contract(self):
        self.assert_keeps_the_contract(self.case.parent / "wall.py", self.case, "fluid")

    def test_moves_as_ours_over_a_beat(self):
        """What is left is the meshes' difference."""
        self.assert_moves_as_ours(self.case, {"fluid.outlet.pressure": 0.004, "fluid.outlet.flow": 0.003, "interface.max_displacement": 0.005,
                                              "point.spine.displacement_length": 0.025})

    def test_goes_on_to_the_same_bits(self):
        self.assert_goes_on_to_the_same_bits(self.case)

    def test_identifies_the_spring_that_data_of_ours_hide(self):
        self.assert_identifies_the_spring(self.case, COARSE_WALL)


if __name__ == "__main__":
    run_with(sys.argv)
