"""The command `rubatlas-plot KIND FILE ... -o PICTURE`."""
import importlib
import sys

import matplotlib

from rubatlas.command_line import end_with_the_reader
from rubatlas.plots import KINDS


def usage():
    width = max(map(len, KINDS))
    kinds = "\n".join(f"  {kind:{width}}  {what}" for kind, what in KINDS.items())
    return (f"usage: rubatlas-plot KIND FILE ... -o PICTURE\n\nkinds:\n{kinds}\n\n"
            "rubatlas-plot KIND --help describes the options of a kind.")


def main():
    """Draws what the command line asks for; exit code 2 for a wrong call, 3 where the disk refuses."""
    end_with_the_reader()
    kind = sys.argv[1] if len(sys.argv) > 1 else None
    if kind in ("--help", "-h"):
        print(usage())
        return
    if kind not in KINDS:
        found = "no kind of picture is named" if kind is None else f"{kind}: no kind of picture"
        print(f"rubatlas-plot: {found}; allowed: {', '.join(KINDS)}", file=sys.stderr)
        sys.exit(2)
    sys.argv[0] = f"rubatlas-plot {kind}"  # for messages
    matplotlib.use("Agg")  # pictures go to files; no display is needed
    importlib.import_module(f"rubatlas.plots.{kind}").main(sys.argv[2:])
