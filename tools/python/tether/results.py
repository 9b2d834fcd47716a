"""Results of Tether as Python objects.

What a file holds is what its schema says (docs/schema): an object has an attribute for each field, a list of objects is
a Table, numbers in lists or packed are numpy arrays. A folder of results is loaded by `load`.
"""

import base64
import json
import pathlib

import numpy

_files = ("explain.json", "diagnosis.json", "estimate.json", "comparison.json", "score.json", "noise.json", "summary.json")


class Record:
    """An object of a file: its fields are attributes; `fields()` lists them."""

    def __init__(self, values):
        self._values = {name: _wrapped(value) for name, value in values.items()}

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self._values[name]
        except KeyError:
            raise AttributeError(f"no field {name!r}; there are: {', '.join(self._values)}") from None

    def __getitem__(self, name):
        return self._values[name]

    def __contains__(self, name):
        return name in self._values

    def __dir__(self):
        return [*super().__dir__(), *self._values]

    def __repr__(self):
        shown = ", ".join(f"{name}={value!r}" for name, value in self._values.items() if isinstance(value, (str, int, float, bool)))
        return f"<{shown}>"

    def fields(self):
        return list(self._values)


class Table(list):
    """A list of records, or an empty list."""

    def frame(self):
        """As a pandas DataFrame (where pandas is installed: python3-pandas); objects within a record become columns like amplitude.value."""
        import pandas

        return pandas.json_normalize([_plain(record) for record in self])


def _wrapped(value):
    if isinstance(value, dict):
        return _unpacked(value) if set(value) == {"shape", "float32"} else Record(value)
    if isinstance(value, list):
        if value and _are_numbers(value):
            return numpy.array(value)
        items = [_wrapped(item) for item in value]
        return Table(items) if all(isinstance(item, Record) for item in items) else items
    return value


def _are_numbers(value):
    """A list of numbers, or of lists of equally many."""
    rows = [row if isinstance(row, list) else [row] for row in value]
    return (len({(isinstance(row, list), len(full)) for row, full in zip(value, rows)}) == 1 and
            all(type(number) in (int, float) for row in rows for number in row))


def _of(things, kind, wanted, name_of):
    """The one with this name or number. Raises KeyError with what there is."""
    names = [name_of(thing) for thing in things]
    if wanted in names:
        return things[names.index(wanted)]
    raise KeyError(f"no {kind} {wanted!r}; there {'are: ' + ', '.join(map(str, names)) if names else 'is none'}")


def _plain(value):
    if isinstance(value, Record):
        return {name: _plain(item) for name, item in value._values.items()}
    if isinstance(value, numpy.ndarray):
        return value.tolist()
    return [_plain(item) for item in value] if isinstance(value, list) else value


def _unpacked(value):
    return numpy.frombuffer(base64.b64decode(value["float32"]), dtype="<f4").reshape(value["shape"]).astype(float)


def read(file):
    """A file of results, any of docs/schema."""
    return _wrapped(json.loads(pathlib.Path(file).read_text()))


class Result(Record):
    """A folder of results: the fields of its main file, and what is beside it.

    folder    pathlib.Path
    file      its main file: explain.json, else diagnosis.json, estimate.json, comparison.json
    """

    def __init__(self, folder):
        self._folder = pathlib.Path(folder)
        found = [name for name in _files if (self._folder / name).is_file()]
        if not found:
            raise FileNotFoundError(f"{folder}: holds none of {', '.join(_files)}")
        self._file = found[0]
        super().__init__(json.loads((self._folder / self._file).read_text()))

    @property
    def folder(self):
        return self._folder

    @property
    def file(self):
        return self._file

    def run(self, model=None):
        """The results of a compared run: of an explanation that of its best model, or of the model with this number."""
        if self._file != "explain.json":
            return self
        number = self["best"] if model is None else model
        return Result(self._folder / _of(self["models"], "model", number, lambda m: m["number"])["run"])

    def comparison(self, model=None):
        """comparison.json of the run."""
        return read(self.run(model).folder / "comparison.json")

    def wall(self, model=None):
        """wall.json of the run: the moving lumen and its distance to the measurements at every node."""
        return read(self.run(model).folder / "wall.json")

    def distances(self, region=None, frame=0, source=0, model=None):
        """Signed distances of a region's nodes to the data at a moment [the case's length]: positive where the data lie
        outside the model, NaN where nothing was measured.

        region    its name; None: the whole wall
        frame     number of the moment among those of the source, in the order of time
        source    number or name of the source of measurements

        Raises KeyError if there is no such region, frame or source.
        """
        wall = self.wall(model)
        sources = list(enumerate(wall["sources"]))
        name_of = (lambda s: s[0]) if isinstance(source, int) else (lambda s: s[1]["name"])
        moments = list(enumerate(_of(sources, "source", source, name_of)[1]["moments"]))
        values = _of(moments, "frame", frame, lambda m: m[0])[1]["distances"].ravel()
        if region is None:
            return values
        if region not in wall["regions"]:
            raise KeyError(f"no region {region!r}; there are: {', '.join(wall['regions'])}")
        return values[wall["region"] == wall["regions"].index(region)]


def load(folder):
    """The results in a folder: of tether explain, diagnose, identify, compare or simulate."""
    return Result(folder)
