"""What the commands of this folder share: arguments, the choice of a line, the rule for outputs, and exit codes."""
import argparse
import contextlib
import io
import math
import os
import pathlib
import re
import signal
import sys
import tempfile

from rubatlas.atlas_file import AtlasError, AtlasFile, UnreadableFile, beside
from rubatlas.same_scene import require_maps_of

LINE_AXES = ["damping_ratio", "friction", "unbalance", "thickness", "direction"]

# The first bytes of a picture of each kind. An SVG is recognised by the word in its first lines.
PICTURES = {".png": (b"\x89PNG\r\n",), ".pdf": (b"%PDF-",), ".svg": (b"<?xml", b"<svg")}


def positive(kind, least=sys.float_info.min, most=sys.float_info.max):
    """The type of an option that is a finite number above zero, or one between two limits."""
    def read(word):
        try:
            value = kind(word)
        except ValueError:
            value = 0
        if not least <= value <= most:
            number = "whole number" if kind is int else "finite number"
            limits = f"from {least} to {most}" if most < sys.float_info.max else "above 0"
            raise argparse.ArgumentTypeError(f"{word} is no {number} {limits}")
        return value
    return read


LENGTHS = {"mm": 1.0, "cm": 10.0, "in": 25.4}  # [mm]


def width(word):
    """The type of a length with its unit, in inches: a picture is between 60 mm and 600 mm wide."""
    found = re.fullmatch(r"([0-9.]+) ?(mm|cm|in)", word)
    try:
        millimetres = float(found[1]) * LENGTHS[found[2]]  # type: ignore[index]
    except (TypeError, ValueError):
        millimetres = math.nan
    if not 60.0 <= millimetres <= 600.0:
        raise argparse.ArgumentTypeError(f"{word} is no width from 60mm to 600mm, in mm, cm or in, such as 85mm")
    return millimetres / 25.4


def add_size(arguments):
    """The options of a picture's size."""
    arguments.add_argument("--width", type=width, help="width in print, such as 85mm, the column of a journal: letters "
                                                       "and legends are arranged for it")
    arguments.add_argument("--dpi", type=positive(float, 10, 2400),
                           help="resolution (default: 150, with --width 300)")


def resolution(options):
    """Pixels per inch."""
    return options.dpi or (150.0 if options.width is None else 300.0)


class Arguments(argparse.ArgumentParser):
    """The arguments of a command, which the text of its module describes; a mistake in them is one sentence."""

    def __init__(self, description, **more):
        first, *rest = description.strip().splitlines()
        super().__init__(description=first, epilog="\n".join(rest),
                         formatter_class=argparse.RawDescriptionHelpFormatter, **more)

    def error(self, message):
        self.exit(2, f"{self.prog}: {message}\n")


def parser(description, source="ATLAS.h5", line=True):
    """Parser with the file to read, `-o`, and (where a line is drawn) one option per axis that picks it."""
    result = Arguments(description)
    result.add_argument("source", metavar=source)
    result.add_argument("-o", "--output", required=True, metavar="PICTURE.png", help="PNG, SVG or PDF, by its ending")
    add_size(result)
    if line:
        group = result.add_argument_group("which line (default: the scene's own values)")
        for axis in LINE_AXES:
            group.add_argument(f"--{axis}", metavar="up|down" if axis == "direction" else "VALUE")
        group.add_argument("--at", action="append", default=[], metavar="NAME=VALUE",
                           help="a value on any other axis of the atlas, such as ring_stiffness=1e4; may be repeated")
    return result


def add_maps(arguments, what):
    """The option that names the maps of the atlas."""
    arguments.add_argument("--maps", metavar="MAPS.h5", help=f"maps of the atlas (`rubatlas analyse`), {what}; "
                                                             "default: ATLAS_maps.h5 beside the atlas, if it is there")


def maps_of(options, required=False):
    """Path of the maps: as named, else beside the atlas; None where there are none, unless they are required."""
    path = options.maps or beside(options.source, "maps")
    if path is None and required:
        raise AtlasError(f"{options.source}: no maps beside it; `rubatlas analyse` makes them, and --maps names them")
    return path


@contextlib.contextmanager
def atlas_with_maps(options, wants_maps=True):
    """The atlas, and its maps or None; both of one scene."""
    with contextlib.ExitStack() as files:
        atlas = files.enter_context(AtlasFile(options.source))
        path = maps_of(options) if wants_maps else None
        maps = files.enter_context(AtlasFile(path)) if path else None
        if maps:
            require_maps_of(atlas, maps)
        yield atlas, maps


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


# --- what is written ---

def is_picture(path):
    """True where a file's content, not its name, is that of a picture."""
    with open(path, "rb") as file:
        begin = file.read(512)
    kinds = [start for starts in PICTURES.values() for start in starts if begin.startswith(start)]
    return bool(kinds) and (kinds[0] != b"<?xml" or b"<svg" in begin or b"DOCTYPE svg" in begin)


def inputs(options):
    """Every file that the options name besides the output."""
    given = [value for name, value in vars(options).items() if name != "output"]
    files = [one for value in given for one in (value if isinstance(value, list) else [value])]
    return [one for one in files if isinstance(one, (str, pathlib.Path)) and os.path.exists(one)]


def require_picture_place(path, options):
    """A picture may be written to `path`: its ending names a kind, its folder is there, it replaces only a picture."""
    path = pathlib.Path(path)
    if path.suffix.lower() not in PICTURES:
        raise AtlasError(f"-o {path}: a picture ends in {', '.join(PICTURES)}, not in "
                         f"{repr(path.suffix) if path.suffix else 'nothing'}")
    if not path.parent.is_dir():
        raise AtlasError(f"-o {path}: there is no folder {path.parent}")
    if not path.exists():
        return
    for source in inputs(options):
        if os.path.samefile(path, source):
            raise AtlasError(f"-o {path}: the picture would replace {source}, which it is made from")
    if not path.is_file():
        raise AtlasError(f"-o {path}: this is no file that a picture could replace")
    try:
        replaceable = is_picture(path)
    except OSError as error:
        raise AtlasError(f"-o {path}: {error.strerror}") from None
    if not replaceable:
        raise AtlasError(f"-o {path}: this file is there and is no picture; a picture replaces pictures only")


def write_complete(path, content):
    """Bytes as a file, complete or not at all."""
    with tempfile.NamedTemporaryFile(dir=path.parent, prefix=f".{path.name}.", delete=False) as file:
        try:
            file.write(content)
            file.flush()
            mask = os.umask(0)
            os.umask(mask)
            os.chmod(file.name, 0o666 & ~mask)
            os.replace(file.name, path)
        except BaseException:
            os.unlink(file.name)
            raise


def write_picture(figure, options):
    """The figure as a file of the kind that the ending names, complete or not at all; the same data give the same
    bytes."""
    path = pathlib.Path(options.output)
    require_picture_place(path, options)
    undated = {".png": {"Software": None}, ".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
    kind = path.suffix.lower()
    content = io.BytesIO()
    figure.savefig(content, format=kind[1:], dpi=resolution(options), metadata=undated[kind])
    write_complete(path, content.getvalue())


# --- how a command ends ---

def end_with_the_reader():
    """Where nobody reads any more what a command prints, as `| head` does not, it ends without a word."""
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)


def end_on_mistakes(work):
    """Runs `work`; a mistake is a sentence on stderr and exit code 2, a missing or damaged file or a refusal by the
    system 3, as of the program, never a traceback."""
    name = pathlib.Path(sys.argv[0]).name
    try:
        work()
    except AtlasError as error:
        print(f"{name}: {error}", file=sys.stderr)
        sys.exit(3 if isinstance(error, UnreadableFile) else 2)
    except OSError as error:
        print(f"{name}: {error.filename or ''}: {error.strerror or error}".replace(": :", ":"), file=sys.stderr)
        sys.exit(3)


def run(draw, options):
    """Draws, and says where the picture is."""
    def work():
        require_picture_place(options.output, options)  # before the work, which may take a while
        draw(options)
    end_on_mistakes(work)
    print(options.output)
