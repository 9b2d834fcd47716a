"""Waiting, for tests of what others do."""

import time


def wait(is_so, seconds, what, told=lambda: ""):
    """Until it is so; TimeoutError with what is waited for, and what `told` says then."""
    end = time.monotonic() + seconds
    while not is_so():
        if time.monotonic() > end:
            raise TimeoutError(f"{what}: not within {seconds} s\n{told()}")
        time.sleep(0.05)
