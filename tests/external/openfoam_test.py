"""The blood of configs/external_openfoam beside ours: openfoam_test.py TETHER SOURCES."""

import os
import re
import subprocess
import sys

from beside_ours import BesideOurs, run_with


class OpenfoamBlood(BesideOurs):
    @property
    def case(self):
        return self.sources / "configs/external_openfoam/case.yaml"

    def test_flows_that_are_known(self):
        environment = os.environ | {"PYTHONPATH": str(self.sources / "tools/python")}
        told = subprocess.run([self.case.parent / "verify.py", self.case], env=environment, capture_output=True, text=True, check=True).stdout
        off = [abs(float(number)) for number in re.findall(r"(\S+) %$", told, re.MULTILINE)]
        for found, allowed in zip(off, (2.3, 1.2, 0.2, 1e-7), strict=True):  # %, as the README tells
            self.assertLess(found, allowed, told)

    def test_keeps_the_contract(self):
        self.assert_keeps_the_contract(self.case.parent / "blood.py", self.case, "solid")

    def test_moves_as_ours_over_a_beat(self):
        self.assert_moves_as_ours(self.case, {"fluid.inlet.pressure": 0.003, "fluid.outlet.pressure": 0.001, "fluid.outlet.flow": 0.002,
                                              "interface.max_displacement": 0.002, "point.spine.displacement_length": 0.001})

    def test_goes_on_to_the_same_bits(self):
        self.assert_goes_on_to_the_same_bits(self.case)

    def test_identifies_the_spring_that_data_of_ours_hide(self):
        self.assert_identifies_the_spring(self.case, "fluid: {mesh: {around: 16, along: 12, rings: 4}}\n")


if __name__ == "__main__":
    run_with(sys.argv)
