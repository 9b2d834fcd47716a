"""The blood of configs/external_dolfinx_blood beside ours: dolfinx_blood_test.py TETHER SOURCES."""

import sys

from beside_ours import BesideOurs, run_with

TWO_PROCESSES = """base: {case}
name: two_processes
coupling: {{ranks: {{fluid: 2}}, programs: {{fluid: {blood}}}}}
"""


class DolfinxBlood(BesideOurs):
    @property
    def case(self):
        return self.sources / "configs/external_dolfinx_blood/case.yaml"

    @property
    def blood(self):
        return self.case.parent / "blood.py"

    def test_keeps_the_contract(self):
        self.assert_keeps_the_contract(self.blood, self.case, "solid")

    def test_moves_as_ours_over_a_beat(self):
        self.assert_moves_as_ours(self.case, {"fluid.inlet.pressure": 0.005, "fluid.outlet.pressure": 0.002, "fluid.outlet.flow": 0.003,
                                              "interface.max_displacement": 0.003, "point.spine.displacement_length": 0.002})

    def test_goes_on_to_the_same_bits(self):
        self.assert_goes_on_to_the_same_bits(self.case)

    def test_two_processes_give_what_one_gives(self):
        self.assert_moves_as_one_process(self.case, self.write("two.yaml", TWO_PROCESSES.format(case=self.case, blood=self.blood)))

    def test_identifies_the_spring_that_data_of_ours_hide(self):
        self.assert_identifies_the_spring(self.case, "fluid: {mesh: {around: 18, along: 12}}\n")


if __name__ == "__main__":
    run_with(sys.argv)
