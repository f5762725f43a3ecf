"""Numbers as a report keeps them: typed arrays, zlib and base64, which the page unpacks when it needs them."""
import base64
import zlib

import numpy as np


class Blocks:
    """Blocks by name, as texts."""

    def __init__(self):
        self.texts = {}

    def keep(self, name, content):
        """Bytes that the page unpacks by their name."""
        self.texts[name] = base64.b64encode(zlib.compress(content)).decode("ascii")

    def add(self, name, values):
        """An array, and the entry of the JSON that leads to it."""
        self.keep(name, np.ascontiguousarray(values).tobytes())
        kind = {"f4": "Float32Array", "f8": "Float64Array", "u1": "Uint8Array",
                "u2": "Uint16Array"}[values.dtype.str[1:]]
        return {"block": name, "kind": kind, "shape": list(values.shape)}

    @property
    def size(self):
        return sum(map(len, self.texts.values()))
