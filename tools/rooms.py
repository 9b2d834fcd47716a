"""The rooms of the house, as tools/rooms.txt lists them."""

import pathlib


def read_rooms(root):
    """{room: the rooms that it may include}, from the ground up. Raises ValueError where a room includes one that is not below it."""
    rooms = {}
    for line in (pathlib.Path(root) / "tools" / "rooms.txt").read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            room, below = line.split(":")
            if unknown := [other for other in below.split() if other not in rooms]:
                raise ValueError(f"tools/rooms.txt: {room} includes {', '.join(unknown)}, which is not above it in the list")
            rooms[room] = below.split()
    return rooms


def room_of(path, rooms):
    """The innermost room that a source belongs to; None for tests and benchmarks, which may include anything."""
    parts = pathlib.PurePosixPath(path).parts
    for depth in range(len(parts) - 1, 0, -1):
        if "/".join(parts[:depth]) in rooms:
            return "/".join(parts[:depth])
    return None
