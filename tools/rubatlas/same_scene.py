"""Whether two files are of the same scene. Every tool that draws two files together checks this first."""
import numpy as np

from rubatlas.atlas_file import EDGES, PENDING, AtlasError, counted, reading

# Keys that do not influence the motions of an atlas.
WORDS = ("title", "reference", "creator", "license")
# Keys that choose the points, and what is kept of them.
POINTS = ("grid", "sweep", "initial", "protocol", "spectrum", "observables", "accuracy")
# Sections of every scene; all other sections are effects.
MACHINE = ("rotor", "blades", "ring", "contact", "validity")


def differences(one, other, pointer=""):
    """(pointer, value here, value there) of all differences; None for a missing value."""
    if isinstance(one, dict) and isinstance(other, dict):
        return [found for key in sorted({*one, *other})
                for found in differences(one.get(key), other.get(key), f"{pointer}/{key.replace('/', '~1')}")]
    return [] if one == other else [(pointer, one, other)]


def shown(value):
    """A value in a few words."""
    if value is None:
        return "absent"
    if isinstance(value, dict):
        return "there"
    if isinstance(value, list) and len(value) > 4:
        return f"{len(value)} values from {value[0]} to {value[-1]}"
    return str(value)


def refuse(path, other_path, found):
    pointer, one, other = found[0]
    raise AtlasError(f"{other_path} was not made from the scene of {path}: {pointer} is {shown(one)} here and "
                     f"{shown(other)} there")


def without(scene, keys):
    return {key: part for key, part in scene.items() if key not in keys}


def require_same(path, scene, other_path, other_scene):
    """The two files are of one scene; title and reference may differ."""
    found = differences(without(scene, WORDS), without(other_scene, WORDS))
    if found:
        refuse(path, other_path, found)


def require_finished(atlas, path, attributes, made_by):
    """A file that was made of an atlas knows of every point that the atlas has finished by now."""
    finished = np.count_nonzero(atlas.dataset("status")[...] != PENDING)
    known = attributes.get("points_finished", finished)  # what lacks it is another kind of file
    if finished != known:
        raise AtlasError(f"{atlas.path} has {counted(finished, 'points')} finished, and {path} was made of {known}: "
                         f"`{made_by} -o {path} --overwrite` makes it anew")


def require_maps_of(atlas, maps):
    """The maps are of the atlas: of its scene, and of all points that it has finished."""
    require_same(atlas.path, atlas.scene, maps.path, maps.scene)
    require_finished(atlas, maps.path, maps.file.attrs, f"rubatlas analyse {atlas.path}")


def require_edges_of(atlas, path):
    """The edges are of all points that the atlas has finished."""
    with reading(path, EDGES, "edges") as file:
        attributes = dict(file["edges"].attrs)
    require_finished(atlas, path, attributes, f"rubatlas edges {atlas.path}")


def require_same_machine(path, scene, other_path, other_scene):
    """The two files are of one rotor in one ring; their points may differ."""
    left_out = (*WORDS, *POINTS)
    found = differences(without(scene, left_out), without(other_scene, left_out))
    if found:
        refuse(path, other_path, found)


def require_without_effect(path, scene, other_path, other_scene):
    """The other scene is this one without one or more of its effects."""
    known = (*MACHINE, *POINTS, *WORDS)
    effects = [name for name in scene if name not in known and name not in other_scene]

    def of_effect(pointer):  # its section, its axes on the grid, and observables that only it has
        axes = [f"/grid/{name}" for name in effects] + [f"/grid/~1{name}~1" for name in effects]
        return pointer[1:].split("/")[0] in effects or pointer.startswith(tuple(axes)) or pointer == "/observables"

    if not effects:
        raise AtlasError(f"{other_path} has every effect of {path}: nothing is left out")
    found = [one for one in differences(without(scene, WORDS), without(other_scene, WORDS)) if not of_effect(one[0])]
    if found:
        refuse(path, other_path, found)
