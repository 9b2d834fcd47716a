"""docs/diagnosis-validation.md in parts, each written by what measures it; the others stay as they are."""
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/diagnosis-validation.md"
FIRST, THIRTY, CALIBRATION = "", "Thirty more", "Probabilities said, and how often it was so"  # titles in their order


def put(title, text):
    """text: without its title."""
    words = re.split(f"\n## ({THIRTY}|{CALIBRATION})\n", PAGE.read_text())
    parts = {FIRST: words[0], **dict(zip(words[1::2], words[2::2])), title: text}
    PAGE.write_text(parts[FIRST] + "".join(f"\n## {t}\n{parts[t]}" for t in (THIRTY, CALIBRATION) if t in parts))
