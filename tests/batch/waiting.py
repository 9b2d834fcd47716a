"""Waiting, for tests of what others do."""

import os
import time

PATIENCE = float(os.environ.get("TETHER_PATIENCE", 1))  # so many times as long: programs under sanitizers are slow


def wait(is_so, seconds, what, told=lambda: ""):
    """Until it is so; TimeoutError with what is waited for, and what `told` says then. It is asked less often the longer it takes, since an
    answer may take a program."""
    begin = time.monotonic()
    while not is_so():
        waited = time.monotonic() - begin
        if waited > PATIENCE * seconds:
            raise TimeoutError(f"{what}: not within {PATIENCE * seconds:g} s\n{told()}")
        time.sleep(min(max(0.05, waited / 20), 0.5))
