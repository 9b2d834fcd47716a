"""A case of OpenFOAM in a folder of its own: mesh and fields are written and read in binary form, a program runs one time step of it."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile

import numpy as np

HEADER = """FoamFile
{{
    version 2.0;
    format  binary;
    arch    "LSB;label=32;scalar=64";
    class   {kind};
    location "{where}";
    object  {name};
}}
"""
VALUES = re.compile(rb"(?P<block>\w+)\s*\{|(?P<key>internalField|value)\s+"
                    rb"(?:nonuniform List<(?P<kind>scalar|vector)>\s*(?P<count>\d+)\s*\(|uniform (?P<uniform>[^;]+);)")
DEBIAN = {"WM_PROJECT_DIR": "/usr/share/openfoam"}  # where its package has OpenFOAM's own settings


class Case:
    """The files of `template`, a mesh, and a start of a step at time 0, which `program` goes on from."""

    def __init__(self, program, template, tube):
        if shutil.which(program) is None:
            raise FileNotFoundError(f"{program}: not found (Debian's package openfoam)")
        self.program = program
        self.folder, self.keeper = folder_for_now()
        shutil.copytree(template, self.folder, dirs_exist_ok=True)
        self.write_mesh(tube)

    def write_mesh(self, tube):
        mesh, corners = "constant/polyMesh", 4 * np.arange(len(tube.faces) + 1)
        self.write(mesh, "points", "vectorField", counted(tube.points, float))
        self.write(mesh, "faces", "faceCompactList", counted(corners, np.int32) + counted(tube.faces.ravel(), np.int32))
        self.write(mesh, "owner", "labelList", counted(tube.owner, np.int32))
        self.write(mesh, "neighbour", "labelList", counted(tube.neighbour, np.int32))
        patches = [f"{name} {{ type {'wall' if name == 'wall' else 'patch'}; nFaces {len(part)}; startFace {part.start}; }}" for name, part in tube.patches.items()]
        self.write(mesh, "boundary", "polyBoundaryMesh", "\n".join([str(len(patches)), "(", *patches, ")"]).encode())

    def write(self, where, name, kind, text):
        folder = self.folder / where
        folder.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(HEADER.format(kind=kind, where=where, name=name).encode() + text)

    def write_points(self, points):
        """[points, 3]: where they are as the step begins."""
        self.write("0/polyMesh", "points", "vectorField", counted(points, float))

    def write_field(self, name, kind, dimensions, inside, patches):
        """inside: one or three numbers, or an array of them for cells, points or inner faces; patches: {name: what is said of each}, where a
        value may be an array."""
        blocks = [name.encode() + b"\n{\n" + b"".join(entry(*said) for said in patch.items()) + b"}\n" for name, patch in patches.items()]
        self.write("0", name, kind, b"".join([entry("dimensions", dimensions), entry("internalField", inside), b"boundaryField\n{\n", *blocks, b"}\n"]))

    def step(self, dt, **numbers):
        """Runs one step from time 0; `numbers` are what the template's files read. Returns the folder with its end."""
        for old in self.ends():
            shutil.rmtree(old)
        numbers |= {"deltaT": dt, "endTime": dt}
        (self.folder / "numbers").write_text("".join(f"{name} {float(value)!r};\n" for name, value in numbers.items()))
        done = subprocess.run([self.program], cwd=self.folder, env=DEBIAN | os.environ | {"PWD": str(self.folder)}, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        ends = self.ends()
        if done.returncode != 0 or len(ends) != 1:
            raise RuntimeError(f"{self.program} {how_ended(done.returncode)}: {last_words(done.stdout)}")
        return ends[0]

    def ends(self):
        """Folders of times after 0."""
        return [path for path in self.folder.iterdir() if path.name[0].isdigit() and path.name != "0"]


class Field:
    """Of a file that OpenFOAM wrote."""

    def __init__(self, path, patches):
        self.parts, self.patches = parts_of(path.read_bytes()), patches

    def inside(self, count):
        """At cells, points or inner faces: [count] or [count, 3]."""
        return everywhere(self.parts["internalField"], count)

    def at(self, patch):
        """[faces] or [faces, 3]."""
        return everywhere(self.parts[patch], len(self.patches[patch]))

    def whole(self, count):
        """Inside, then at the faces of all patches."""
        return np.concatenate([self.inside(count), *map(self.at, self.patches)])


def everywhere(values, count):
    return np.broadcast_to(values, (count, *values.shape[1:]))


def folder_for_now():
    """A new folder, and a shell that removes it once this process is gone, however it went: its input ends then. It has nothing of the job's
    environment, by which Tether finds what an interrupted job has left running."""
    folder = tempfile.mkdtemp(prefix="tether_openfoam_")
    keeper = subprocess.Popen(["/bin/sh", "-c", 'cat; sleep 1; rm -rf "$0"', folder], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, start_new_session=True, env={"PATH": os.defpath})
    return pathlib.Path(folder), keeper


def how_ended(code):
    return f"ended with {code}" if code >= 0 else f"was ended by {signal.Signals(-code).name}"


def last_words(log):
    """What OpenFOAM says is wrong, else the end of what it says, before a stack of calls."""
    log = log.partition("\n#0 ")[0]
    _, fatal, error = log.rpartition("FOAM FATAL")
    return " ".join((error if fatal else log[-200:]).split())


def counted(values, kind):
    """A list in binary form."""
    values = np.ascontiguousarray(values, dtype=kind)
    return b"%d\n(" % len(values) + values.tobytes() + b")\n"


def entry(key, value):
    """Of a dictionary: a text, or numbers of a field."""
    if isinstance(value, np.ndarray):
        kind = b"vector" if value.ndim == 2 else b"scalar"
        return key.encode() + b" nonuniform List<" + kind + b">\n" + counted(value, float) + b";\n"
    return f"{key} {value};\n".encode()


def parts_of(data):
    """Of a field's file: {"internalField": values, patch: its `value`}, each [entries] or [entries, 3]; what is the same everywhere has one
    entry."""
    parts, position, block = {}, 0, None
    while found := VALUES.search(data, position):
        position = found.end()
        if found["block"]:
            block = found["block"].decode()
            continue
        name = "internalField" if found["key"] == b"internalField" else block
        if found["uniform"]:
            parts[name] = one_for_all(found["uniform"])
            continue
        components = 3 if found["kind"] == b"vector" else 1
        values = np.frombuffer(data, float, components * int(found["count"]), position)
        parts[name], position = values.reshape(-1, 3) if components == 3 else values, position + values.nbytes
    return parts


def one_for_all(text):
    """[1] or [1, 3] of `5` or `(0 0 5)`."""
    values = np.array(text.strip(b"()").split(), dtype=float)
    return values if len(values) == 1 else values[None]
