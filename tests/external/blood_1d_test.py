"""The blood of configs/external_blood_1d beside ours: blood_1d_test.py TETHER SOURCES."""

import sys

from beside_ours import BesideOurs, run_with


class OneDimensionalBlood(BesideOurs):
    @property
    def case(self):
        return self.sources / "configs/external_blood_1d/case.yaml"

    def test_keeps_the_contract(self):
        self.assert_keeps_the_contract(self.case.parent / "blood.py", self.case, "solid")

    def test_moves_as_ours_over_a_beat(self):
        self.assert_moves_as_ours(self.case, {"fluid.inlet.pressure": 0.006, "fluid.outlet.pressure": 0.008, "fluid.outlet.flow": 0.007,
                                              "interface.max_displacement": 0.008, "point.spine.displacement_length": 0.009})

    def test_goes_on_to_the_same_bits(self):
        self.assert_goes_on_to_the_same_bits(self.case)

    def test_identifies_the_spring_that_data_of_ours_hide(self):
        self.assert_identifies_the_spring(self.case)


if __name__ == "__main__":
    run_with(sys.argv)
