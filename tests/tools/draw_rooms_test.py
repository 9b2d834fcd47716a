"""The drawing of the rooms is that of tools/rooms.txt; each box and line of it stands for an entry."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import draw_rooms  # noqa: E402

ROOMS = {"base": [], "mesh": ["base"], "fluid": ["base", "mesh"], "solid": ["base"]}


class DrawRooms(unittest.TestCase):
    def test_picture_is_up_to_date(self):
        subprocess.run([sys.executable, ROOT / "tools/draw_rooms.py", "--check"], check=True)

    def test_only_what_no_other_room_brings_along_is_a_line(self):
        self.assertEqual(draw_rooms.needed(ROOMS), {"base": [], "mesh": ["base"], "fluid": ["mesh"], "solid": ["base"]})

    def test_a_room_stands_above_what_it_includes(self):
        self.assertEqual(draw_rooms.layers_of(ROOMS), [["base"], ["mesh", "solid"], ["fluid"]])

    def test_a_box_for_each_room_and_a_line_for_each_need(self):
        text = draw_rooms.drawing(ROOMS)
        self.assertEqual((text.count("<path "), text.count("<text ")), (3, 4))

    def test_an_old_picture_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "tools").mkdir()
            (root / "docs/figures").mkdir(parents=True)
            (root / "tools/rooms.txt").write_text("base:\n")
            draw_rooms.main(folder)
            draw_rooms.main("--check", folder)
            (root / "tools/rooms.txt").write_text("base:\nmesh: base\n")
            with self.assertRaises(SystemExit):
                draw_rooms.main("--check", folder)


if __name__ == "__main__":
    unittest.main()
