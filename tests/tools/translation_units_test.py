"""Sources lead to the translation units that compile them, alone or several together."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))

from translation_units import is_of_room, units  # noqa: E402


class TranslationUnits(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        unity = pathlib.Path(holder.name) / "Unity/unity_0_cxx.cxx"
        unity.parent.mkdir()
        unity.write_text('#include "/room/a.cpp"\n#include "/room/b.cpp"\n')
        self.unity = str(unity)
        self.database = [{"file": self.unity}, {"file": "/room/main.cpp"}, {"file": "/room/example.c"}]

    def test_all(self):
        self.assertEqual(units(self.database, lambda source: True), sorted([self.unity, "/room/main.cpp"]))

    def test_of_several_sources(self):
        self.assertEqual(units(self.database, {"/room/b.cpp"}.__contains__), [self.unity])

    def test_of_one_source(self):
        self.assertEqual(units(self.database, {"/room/main.cpp"}.__contains__), ["/room/main.cpp"])

    def test_of_none(self):
        self.assertEqual(units(self.database, {"/other/x.cpp"}.__contains__), [])

    def test_not_those_for_gcc_only(self):
        with tempfile.NamedTemporaryFile("w", suffix=".cpp") as source:
            source.write("#include <itkImage.h>\n")
            source.flush()
            self.assertEqual(units(self.database + [{"file": source.name}], lambda _: True), units(self.database, lambda _: True))

    def test_of_rooms(self):
        rooms, root = {"solid": [], "diagnosis/search": []}, pathlib.Path("/house")
        for source, expected in (
            ("/house/solid/case.cpp", True),
            ("/house/diagnosis/search/x.cpp", True),
            ("/house/tests/solid/case_test.cpp", False),
            ("/usr/include/x.cpp", False),
        ):
            self.assertEqual(is_of_room(source, rooms, root), expected, source)


if __name__ == "__main__":
    unittest.main()
