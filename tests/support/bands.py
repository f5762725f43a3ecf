"""What a band of safe speeds is."""
import numpy as np


def in_bands(safe):
    """Of safe speeds those that have a safe neighbour: one speed alone is no band."""
    padded = np.concatenate([[False], safe, [False]])
    return safe & (padded[:-2] | padded[2:])
