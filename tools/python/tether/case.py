"""A case file as a code of one's own reads it: merged with the case that it builds on."""

import pathlib


def case(file):
    """The sections of a case file as dicts, lists, numbers and texts; what it says wins over its `base`, an entry without a value removes
    the base's (docs/case-file.md). A text that is a number is one ("4e6", which YAML 1.1 takes for a text); one with a unit stays a text.
    What stands under `file` is a path from the folder of the file that says it, and comes whole. Needs PyYAML. Raises OSError,
    yaml.YAMLError."""
    import yaml

    path = pathlib.Path(file)
    own = _read(yaml.safe_load(path.read_text(encoding="utf-8")) or {}, path.absolute().parent)
    base = own.pop("base", None)
    return _merged(case(path.parent / base), own) if base is not None else own


def _merged(under, over):
    if not isinstance(under, dict) or not isinstance(over, dict):
        return over
    merged = dict(under)
    for key, value in over.items():
        if value is None:
            merged.pop(key, None)
        else:
            merged[key] = _merged(merged.get(key), value)
    return merged


def _read(value, folder):
    if isinstance(value, dict):
        return {key: str(folder / item) if key == "file" and isinstance(item, str) else _read(item, folder) for key, item in value.items()}
    if isinstance(value, list):
        return [_read(item, folder) for item in value]
    if isinstance(value, str):
        try:
            return float(value)
        except ValueError:
            return value
    return value
