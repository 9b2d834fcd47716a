"""The demonstration of docs/guide.md from an empty prefix."""

import json
import unittest

from installed import BUILD, Installed, run


class Demo(Installed):
    def test_names_the_hidden_support(self):
        prefix = self.root / "prefix"
        run(["cmake", "--install", BUILD, "--prefix", prefix], self.root)
        tether, cases = prefix / "bin/tether", prefix / "share/tether/configs"
        run([tether, "twin", cases / "hidden_effect/case.yaml"], self.work)
        run([tether, "explain", "out/hidden_effect_twin/case.yaml"], self.work)
        (explained,) = (self.work / "out").rglob("explain.json")
        found = json.loads(explained.read_text())
        self.assertEqual(found["verdict"], "missing")
        first = found["effects"][0]
        self.assertEqual((first["name"], first["where"]), ("visco_elastic", "spine"))
        self.assertTrue(explained.with_name("report.html").is_file())


if __name__ == "__main__":
    unittest.main()
