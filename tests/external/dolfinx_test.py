"""The wall of configs/external_dolfinx beside ours: dolfinx_test.py TETHER SOURCES."""

import sys

from beside_ours import BesideOurs, run_with

ONE_PROCESS = """base: {case}
name: one_process
coupling: {{ranks: {{solid: 1}}, programs: {{solid: {wall}}}}}
output: {{checkpoint_every: 10}}
"""
COARSE_WALL = "  mesh: {{around: 16, along: 6}}\ncoupling: {{ranks: {{solid: 1}}, programs: {{solid: {wall}}}}}\n"


class DolfinxWall(BesideOurs):
    @property
    def case(self):
        return self.sources / "configs/external_dolfinx/case.yaml"

    @property
    def wall(self):
        return self.case.parent / "wall.py"

    def test_keeps_the_contract(self):
        self.assert_keeps_the_contract(self.wall, self.case, "fluid")

    def test_moves_as_ours_over_a_beat(self):
        """What is left is the meshes' difference."""
        self.assert_moves_as_ours(self.case, {"fluid.outlet.pressure": 0.008, "fluid.outlet.flow": 0.007, "interface.max_displacement": 0.009,
                                              "point.spine.displacement_length": 0.014})

    def test_goes_on_to_the_same_bits(self):
        self.assert_goes_on_to_the_same_bits(self.write("one_process.yaml", ONE_PROCESS.format(case=self.case, wall=self.wall)))

    def test_identifies_the_spring_that_data_of_ours_hide(self):
        self.assert_identifies_the_spring(self.case, COARSE_WALL.format(wall=self.wall))


if __name__ == "__main__":
    run_with(sys.argv)
