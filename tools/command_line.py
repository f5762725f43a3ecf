"""What the commands of this folder share: arguments, the choice of a line, and how they fail."""
import argparse
import sys

from atlas_file import AtlasError

LINE_AXES = ["damping_ratio", "friction", "unbalance", "thickness", "direction"]


def parser(description, source="ATLAS.h5", line=True):
    """Parser with the file to read, `-o`, and (where a line is drawn) one option per axis that picks it."""
    result = argparse.ArgumentParser(description=description.strip().splitlines()[0],
                                     epilog="\n".join(description.strip().splitlines()[1:]),
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    result.add_argument("source", metavar=source)
    result.add_argument("-o", "--output", required=True, metavar="PICTURE.png")
    result.add_argument("--dpi", type=float, default=150.0, help="resolution (default: 150)")
    if line:
        group = result.add_argument_group("which line (default: the scene's own values)")
        for axis in LINE_AXES:
            group.add_argument(f"--{axis}", metavar="up|down" if axis == "direction" else "VALUE")
        group.add_argument("--at", action="append", default=[], metavar="NAME=VALUE",
                           help="a value on any other axis of the atlas, such as ring_stiffness=1e4; may be repeated")
    return result


def wanted(options, axes):
    """The axes that the user has named, as arguments of `AtlasFile.line`."""
    named = {axis: getattr(options, axis) for axis in LINE_AXES if getattr(options, axis, None) is not None}
    for choice in getattr(options, "at", []):
        name, equals, value = choice.partition("=")
        if not equals:
            raise AtlasError(f"--at {choice}: not of the form NAME=VALUE")
        named[name] = value
    try:
        return {axis: value if axis == "direction" else float(value) for axis, value in named.items()}
    except ValueError as error:
        raise AtlasError(f"{error}; a line is picked by numbers on {', '.join(axes)}") from None


def run(draw, options):
    """Draws; a mistake is one sentence on stderr and exit code 2, never a traceback."""
    try:
        draw(options)
    except AtlasError as error:
        print(f"{sys.argv[0].rsplit('/', 1)[-1]}: {error}", file=sys.stderr)
        sys.exit(2)
    print(options.output)
