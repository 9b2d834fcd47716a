"""Changed sources lead to the translation units that compile them, alone or several together."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))

from translation_units import units  # noqa: E402


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
        self.assertEqual(units(self.database, None), sorted([self.unity, "/room/main.cpp"]))

    def test_of_several_sources(self):
        self.assertEqual(units(self.database, {"/room/b.cpp"}), [self.unity])

    def test_of_one_source(self):
        self.assertEqual(units(self.database, {"/room/main.cpp"}), ["/room/main.cpp"])

    def test_of_none(self):
        self.assertEqual(units(self.database, {"/other/x.cpp"}), [])


if __name__ == "__main__":
    unittest.main()
