"""Couple a Python code to Tether as its fluid or solid (docs/protocol.md).

Write a class with a method for each request that your code answers, and serve it:

    class Spring:
        program = "my solid 1"
        points, triangles = ...    # of the interface: (n, 3) floats, (m, 3) ints; normals out of the fluid
        def begin_step(self, step, time, dt, predicted): ...
        def evaluate(self, load): return displacement, velocity
        def end_step(self, accepted): ...

    sys.exit(tether.serve("solid", Spring))

Arrays of vectors have the shape (nodes, 3). What the class can do is announced by the methods it has:

    role     request                     method                                     returns
    both     SetParameters               set_parameters({name: value})              with a list `parameters`
             GetState, SetState          get_state(), set_state(values)             one vector; `state_size`
             BeginStep                   begin_step(step, time, dt, predicted)
             EndStep                     end_step(accepted)                         values of the list `observables`
             Write                       write(step, time)
    fluid    FluidEvaluate               evaluate(displacement, velocity)           forces
             FluidTangent                tangent(velocity_change)                   change of forces
             GetVelocity                 velocity(points)                           velocities there, NaN outside
    solid    SolidEvaluate               evaluate(load)                             displacement, velocity
             SolidTangent                tangent(load_change)                       changes of both
             SolidResidual               residual(correction, load)                 residual, displacement, velocity
             SolidProduct                product(direction)                         vector; `unknowns`
             SolidPrecondition           precondition(residual)                     vector

`parameters`: dicts with name, value and optionally meaning, unit, transform, absent, lower, upper, prior_deviation, scale.
`observables`: pairs (name, unit). An exception that a method raises is reported by the master. MPI: the library
starts it, or give the mpi4py communicator of your processes, of which only rank 0 is asked.
"""

import ctypes
import math
import os
import pathlib
import signal
import sys
import threading
import time
import traceback

import numpy

_double = ctypes.POINTER(ctypes.c_double)
_int = ctypes.POINTER(ctypes.c_int64)


def _fields(text):
    kinds = dict(s=ctypes.c_char_p, d=ctypes.c_double, i=ctypes.c_int, l=ctypes.c_int64, D=_double, L=_int)
    return [(word[2:], kinds[word[0]]) for word in text.split()]


class _Parameter(ctypes.Structure):
    _fields_ = _fields("s_name s_meaning s_unit s_transform d_value d_absent d_lower d_upper d_prior_deviation d_scale")


class _Observable(ctypes.Structure):
    _fields_ = _fields("s_name s_unit")


class _Description(ctypes.Structure):
    _fields_ = (
        _fields("s_program i_has_tangent i_has_operators i_has_state i_has_velocity l_state_size l_unknowns")
        + _fields("l_parameter_count l_observable_count")
        + [("parameters", ctypes.POINTER(_Parameter)), ("observables", ctypes.POINTER(_Observable))]
        + _fields("l_node_count l_triangle_count D_points L_triangles l_region_count")
        + [("region_names", ctypes.POINTER(ctypes.c_char_p))]
        + _fields("L_regions s_effective_case")
    )


class _Array(ctypes.Structure):
    _fields_ = _fields("D_data l_size")

    def numpy(self):
        return numpy.ctypeslib.as_array(self.data, (self.size,)).copy() if self.size else numpy.zeros(0)


class _Request(ctypes.Structure):
    _fields_ = (
        _fields("i_kind i_accepted l_step d_time d_dt")
        + [("names", ctypes.POINTER(ctypes.c_char_p))]
        + [(name, _Array) for name in ("values", "displacement", "velocity", "load")]
    )


def _load_library():
    name = "libtether_client.so"
    above = pathlib.Path(__file__).resolve().parents[3]  # the sources, or lib of a place of installation
    beside = [str(path) for path in (above / "build" / "lib" / name, above / name) if path.exists()]
    library = ctypes.CDLL(os.environ.get("TETHER_CLIENT") or (beside[0] if beside else name))
    library.tether_connect.restype = ctypes.c_void_p
    library.tether_connect.argtypes = [ctypes.c_char_p, ctypes.c_int]
    library.tether_output.restype = library.tether_error.restype = ctypes.c_char_p
    for call in "is_leader output introduce refuse next reply fail end".split():
        getattr(library, "tether_" + call).argtypes = [ctypes.c_void_p]
    library.tether_communicator.argtypes = [ctypes.c_void_p]
    library.tether_introduce.argtypes += [ctypes.POINTER(_Description)]
    library.tether_next.argtypes += [ctypes.POINTER(_Request)]
    library.tether_reply.argtypes += [ctypes.POINTER(_Array), ctypes.c_int]
    library.tether_refuse.argtypes += [ctypes.c_char_p]
    library.tether_fail.argtypes += [ctypes.c_char_p]
    return library


def _doubles(values):
    return numpy.ascontiguousarray(values, dtype=numpy.float64).ravel()


def _vectors(array):
    return array.numpy().reshape(-1, 3)


def _parameter(entry):
    if "name" not in entry or "value" not in entry:
        raise ValueError(f"parameters: {entry}: needs a name and a value")
    text = [str(entry.get(key, "")).encode() for key in ("name", "meaning", "unit")]
    numbers = dict(value=None, absent=math.nan, lower=-math.inf, upper=math.inf, prior_deviation=math.nan, scale=math.nan)
    for key in numbers:
        try:
            numbers[key] = float(entry.get(key, numbers[key]))
        except (TypeError, ValueError):
            raise ValueError(f"parameter {entry['name']}: {key}: {entry[key]!r} is no number") from None
    return _Parameter(*text, entry.get("transform", "linear").encode(), *numbers.values())


def _triangles(values):
    numbers = numpy.asarray(values)
    if numbers.ndim != 2 or numbers.shape[1] != 3 or not numpy.issubdtype(numbers.dtype, numpy.integer):
        raise ValueError(f"triangles: an array of shape {numbers.shape} and kind {numbers.dtype}: whole numbers of shape (m, 3) are due")
    return numpy.ascontiguousarray(numbers, dtype=numpy.int64).ravel()


def _points(values):
    if numpy.ndim(values) != 2 or numpy.shape(values)[1] != 3:
        raise ValueError(f"points: an array of shape {numpy.shape(values)}: (n, 3) is due")
    return _doubles(values)


class _Introduction:
    """The C description of a code, and the arrays that it points to."""

    def __init__(self, code):
        can = lambda *names: int(all(hasattr(code, name) for name in names))
        self.points, self.triangles = _points(code.points), _triangles(code.triangles)
        parameters = [_parameter(entry) for entry in getattr(code, "parameters", [])]
        observables = [_Observable(name.encode(), unit.encode()) for name, unit in getattr(code, "observables", [])]
        self.description = _Description(
            program=str(code.program).encode(), has_tangent=can("tangent"),
            has_operators=can("residual", "product", "precondition"), has_state=can("get_state", "set_state"),
            has_velocity=can("velocity"),
            state_size=getattr(code, "state_size", 0), unknowns=getattr(code, "unknowns", 0),
            parameter_count=len(parameters), parameters=(_Parameter * len(parameters))(*parameters),
            observable_count=len(observables), observables=(_Observable * len(observables))(*observables),
            node_count=len(self.points) // 3, points=self.points.ctypes.data_as(_double),
            triangle_count=len(self.triangles) // 3, triangles=self.triangles.ctypes.data_as(_int))


def _several(result):
    return list(result) if isinstance(result, tuple) else [result]


_METHODS = {2: "set_parameters", 3: "get_state", 4: "set_state", 5: "begin_step", 6: "end_step", 7: "write", 9: "evaluate",
            10: "tangent", 11: "evaluate", 12: "tangent", 13: "residual", 14: "product", 15: "precondition", 21: "velocity"}


def _call_of(r):
    """The method that answers request `r`, and its arguments."""
    arguments = {
        2: lambda: ({r.names[i].decode(): value for i, value in enumerate(r.values.numpy())},),
        3: lambda: (),
        4: lambda: (r.values.numpy(),),
        5: lambda: (r.step, r.time, r.dt, _vectors(r.displacement)),
        6: lambda: (bool(r.accepted),),
        7: lambda: (r.step, r.time),
        9: lambda: (_vectors(r.displacement), _vectors(r.velocity)),
        10: lambda: (_vectors(r.velocity),),
        11: lambda: (_vectors(r.load),),
        12: lambda: (_vectors(r.load),),
        13: lambda: (r.values.numpy(), _vectors(r.load)),
        14: lambda: (r.values.numpy(),),
        15: lambda: (r.values.numpy(),),
        21: lambda: (_vectors(r.values),),
    }
    return _METHODS[r.kind], arguments[r.kind]()


def _answer(code, method, arguments):
    """The arrays of the reply."""
    if method == "write" and not hasattr(code, "write"):
        return []
    result = getattr(code, method)(*arguments)
    if method in ("set_parameters", "set_state", "begin_step", "write"):
        return []
    return [[] if result is None else result] if method == "end_step" else _several(result)


_VECTORS_DUE = {9: 1, 10: 1, 11: 2, 12: 2}  # arrays [nodes, 3] in the reply to a request


def _checked(kind, answer, nodes):
    """The reply's arrays; ValueError that says what came instead of those that are due."""
    due = _VECTORS_DUE.get(kind)
    if due is None:
        return answer
    shapes = ["nothing" if one is None else f"an array of shape {numpy.shape(one)}" for one in answer]
    if len(answer) != due or any(one is None or numpy.shape(one) not in ((nodes, 3), (3 * nodes,)) for one in answer):
        raise ValueError(f"{_METHODS[kind]} returned {' and '.join(shapes)}: {due} of shape ({nodes}, 3) are due")
    return answer


def gathered(communicator, values, places, count):
    """Rows of an array [count, ...] that processes have in parts: each its `values`, and which rows they are. At the first process; None
    at the others."""
    parts = communicator.gather((numpy.asarray(places), numpy.asarray(values)))
    if parts is None:
        return None
    whole = numpy.zeros((count, *parts[0][1].shape[1:]))
    for some, of_them in parts:
        whole[some] = of_them
    return whole


class _Alone:
    """The leader answers, and sees to other processes, if there are any."""

    def make(self, make):
        return make()

    def answer(self, code, method, arguments):
        return _answer(code, method, arguments)

    def end(self):
        pass


class _Together:
    """All processes of a code make it and call its methods at once, with the same arguments."""

    def __init__(self, library, partner):
        from mpi4py import MPI

        self.own = MPI.Comm.f2py(library.tether_communicator(partner))
        self.communicator = self.own.Dup()  # what the code sends is not taken for a call

    def make(self, make):
        return self._agreed(lambda: make(self.own))

    def answer(self, code, method, arguments):
        for rank in range(1, self.communicator.size):
            self.communicator.send((method, arguments), rank)
        return self._agreed(lambda: _answer(code, method, arguments))

    def end(self):
        for rank in range(1, self.communicator.size):
            self.communicator.send(None, rank)

    def follow(self, make):
        """The life of a process that is not the leader."""
        try:
            code = self.make(make)
        except Exception:  # the leader tells it
            code = None
        while (call := self._received()) is not None:
            method, arguments = call
            try:
                self._agreed(lambda: getattr(code, method)(*arguments) if hasattr(code, method) else None)
            except Exception:
                pass

    def _received(self):
        nap = 1e-4
        while not self.communicator.Iprobe(source=0):  # a receive would take a whole processor while it waits
            time.sleep(nap)
            nap = min(1.5 * nap, 2e-3)
        return self.communicator.recv(source=0)

    def _agreed(self, call):
        """The result of a call; the exception of the first process that has one, in all of them."""
        result = error = None
        try:
            result = call()
        except Exception as raised:
            error = raised
        failed = [text for text in self.communicator.allgather(None if error is None else _in_words(error)) if text]
        if error is not None:
            raise error
        if failed:
            raise RuntimeError(failed[0])
        return result


def _in_words(error):
    """What an exception says, and where the program raised it, or called what did; of one of this library, no place."""
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename != __file__]
    own = [frame for frame in frames if frame.filename == sys.argv[0]] or frames
    place = f" ({os.path.basename(own[-1].filename)}:{own[-1].lineno})" if own else ""
    return f"{type(error).__name__}: {error}{place}"


def _converse(library, partner, code, group, nodes):
    """Answers requests until the job is over."""
    request = _Request()
    while library.tether_next(partner, ctypes.byref(request)) == 1:
        try:
            arrays = [_doubles(values) for values in _checked(request.kind, group.answer(code, *_call_of(request)), nodes)]
        except Exception as error:
            library.tether_fail(partner, _in_words(error).encode())
            continue
        views = (_Array * len(arrays))(*[_Array(a.ctypes.data_as(_double), a.size) for a in arrays])
        if library.tether_reply(partner, views, len(arrays)) != 0:
            library.tether_fail(partner, library.tether_error())


def _handle(communicator):
    """What tether_connect takes for an mpi4py communicator or None."""
    if communicator is None:
        return -1
    return -2 if communicator.Get_name() == "MPI_COMM_WORLD" else communicator.py2f()


def _end_when_interrupted():
    """An interrupt (SIGINT) ends this process as it ends a program in C, and the master tells of it: an exception in
    the midst of MPI would leave other processes waiting. What a code handles itself stays."""
    if threading.current_thread() is threading.main_thread() and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def serve(role, make, communicator=None, together=False):
    """Connects as `role` ("fluid" or "solid"), calls make() for the code and lets it answer until the job is over.

    make: a class or function without arguments; it finds the case file in sys.argv. communicator: mpi4py
    communicator of this code's processes, all of which call serve; COMM_WORLD means those of this program, also on
    an mpirun line that has others. together: all processes of this program call make(communicator), with the one that
    holds just them, and each method, at once and with the same arguments; what the leader's return is sent. One that
    raises where others wait for it in MPI leaves them waiting. Returns the exit code.
    """
    _end_when_interrupted()
    library = _load_library()
    partner = library.tether_connect(role.encode(), -2 if together else _handle(communicator))
    if not partner:
        raise RuntimeError(library.tether_error().decode())
    group = _Together(library, partner) if together else _Alone()
    if not library.tether_is_leader(partner):
        if isinstance(group, _Together):
            group.follow(make)
        return library.tether_end(partner)
    try:
        code = group.make(make)
        introduction = _Introduction(code)
    except Exception as error:
        library.tether_refuse(partner, _in_words(error).encode())
    else:
        library.tether_introduce(partner, ctypes.byref(introduction.description))
        _converse(library, partner, code, group, len(introduction.points) // 3)
    group.end()
    return library.tether_end(partner)
