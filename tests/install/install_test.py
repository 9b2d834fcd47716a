"""`cmake --install` into an empty prefix: programs, cases, find_package(Tether), Python."""

import unittest

from installed import BUILD, Installed, run

PROJECT = """cmake_minimum_required(VERSION 3.25)
project(mine C)
find_package(Tether 0.1 REQUIRED)
find_package(MPI REQUIRED COMPONENTS C)
add_executable(my_solid {docs}/examples/spring_solid.c)
target_link_libraries(my_solid Tether::client m)
add_executable(my_fluid {docs}/examples/linear_fluid.c)
target_link_libraries(my_fluid Tether::client MPI::MPI_C m)
"""


class Install(Installed):
    def setUp(self):
        super().setUp()
        self.prefix = self.root / "prefix"
        run(["cmake", "--install", BUILD, "--prefix", self.prefix], self.root)
        self.docs = self.prefix / "share/doc/tether/docs"

    def conform(self, *program, **environment):
        report = run([self.prefix / "bin/tether", "conform", *program], self.work, **environment)
        self.assertIn("PASS  stops when told", report)
        self.assertNotIn("FAIL", report)

    def test_programs_find_each_other_and_cases_run(self):
        self.runs_cases(self.prefix)

    def test_codes_in_c_are_built_against_the_package(self):
        (self.work / "CMakeLists.txt").write_text(PROJECT.format(docs=self.docs))
        run(["cmake", "-S", ".", "-B", "build", f"-DCMAKE_PREFIX_PATH={self.prefix}"], self.work)
        run(["cmake", "--build", "build"], self.work)
        self.conform(self.work / "build/my_solid")
        self.conform(self.work / "build/my_fluid")

    def test_codes_in_python_find_the_library(self):
        python = str(self.prefix / "lib/python3/dist-packages")
        self.conform(self.docs / "examples/spring_solid.py", PYTHONPATH=python, PYTHONDONTWRITEBYTECODE="1")


if __name__ == "__main__":
    unittest.main()
