"""The label check finds labels without an equation and equations given twice."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).resolve().parents[2] / "tools" / "check_labels.py"


def check(page, source):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "docs").mkdir()
        (root / "solid").mkdir()
        (root / "tools").mkdir()
        (root / "tools/rooms.txt").write_text("solid:\n")
        (root / "docs/equations.md").write_text(page)
        (root / "solid/a.cpp").write_text(source)
        run = subprocess.run([sys.executable, CHECK, folder], capture_output=True, text=True)
        return run.returncode, run.stdout.strip()


class CheckLabels(unittest.TestCase):
    def test_all_there(self):
        self.assertEqual(check("**(S.1)** F = 1 + G", "x = y;  // (S.1), (S.1)\n"), (0, "2 labels, 1 equations"))

    def test_missing(self):
        self.assertEqual(check("**(S.1)** F = 1 + G, see (S.2)", "\n// (S.2)\n"),
                         (1, "solid/a.cpp:2: (S.2) is not in docs/equations.md"))

    def test_twice(self):
        self.assertEqual(check("**(S.1)** a\n**(S.1)** b", ""), (1, "docs/equations.md: (S.1) is defined 2 times"))


if __name__ == "__main__":
    unittest.main()
