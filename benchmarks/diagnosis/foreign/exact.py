"""What an exact test of a known pattern sees of it, beside nuisances of any size."""
import numpy as np

NUGGET = 0.15  # of the variance, not alike even between neighbours
SHAPES = {"exponential": lambda r: np.exp(-r), "gaussian": lambda r: np.exp(-r * r / 2)}


def covariance(places, shape, deviation, length):
    """Of the errors of a frame's nodes [n x n]."""
    apart = np.linalg.norm(places[:, None] - places[None], axis=2)
    return deviation**2 * ((1 - NUGGET) * SHAPES[shape](apart / length) + NUGGET * np.eye(len(places)))


def rest(patterns, nuisances, factor):
    """What nuisances of any size leave of a frame's patterns, in deviations [n x k]. factor: lower, of the covariance."""
    white = np.linalg.solve(factor, np.c_[nuisances, patterns])
    columns = np.linalg.qr(white[:, : nuisances.shape[1]])[0]
    of_patterns = white[:, nuisances.shape[1] :]
    return of_patterns - columns @ (columns.T @ of_patterns)


def left(pattern, nuisances, factor):
    """z^2 of a frame's pattern beside nuisances of any size."""
    return np.sum(rest(pattern, nuisances, factor) ** 2)


def of_frames(normal, along):
    """A shift across the tube, an offset and a slope along it [n x 4]: no normal has a part along the tube."""
    return np.c_[normal[:, :2], np.ones(len(along)), along]
