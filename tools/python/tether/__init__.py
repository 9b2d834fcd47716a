"""Tether for Python: read results, and couple a code of one's own.

    import tether
    found = tether.load("out/hidden_effect_blind_explain")
    found.verdict                       # "missing"
    found.effects[0].name               # "visco_elastic"; a table: found.effects.frame() (pandas)
    found.distances("spine", 3)         # at the nodes of a region, at the source's fourth moment (numpy)

Results are as docs/schema has them (tether.results). A code is coupled by tether.serve (tether.coupling), and
reads its case by tether.case, its inflow by tether.Curve; tether.Windkessel is its outlet over one step.
"""

from tether.case import case
from tether.curve import Curve
from tether.results import Result, load
from tether.windkessel import Windkessel


def serve(role, make, communicator=None, together=False):
    """Serves a fluid or solid written in Python; see tether.coupling."""
    from tether import coupling

    return coupling.serve(role, make, communicator, together)


def gathered(communicator, values, places, count):
    """Rows of an array that the processes of a code have in parts; see tether.coupling."""
    from tether import coupling

    return coupling.gathered(communicator, values, places, count)


__all__ = ["Curve", "Result", "Windkessel", "case", "gathered", "load", "serve"]
