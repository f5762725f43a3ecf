"""What everybody who reads an atlas may rely on, checked: names, shapes, types, scales, attributes, and what rows hold.

    departures(path) -> one sentence for each departure, none when the atlas is as it should be
"""
import json
import zlib

import h5py
import numpy as np

GRID_AXES = ["thickness", "unbalance", "friction", "damping_ratio", "speed_ratio"]
ROOT_ATTRIBUTES = ["Conventions", "schema_version", "software", "software_version", "git_commit", "compiler",
                   "title", "creator", "license", "identifier"]
ALWAYS = {"status": ([], "|u1"), "status_detail": ([], "|u1"), "restarted": ([], "|u1"),
          "failed_revolution": ([], "<i4"),
          "row_checksum": ([], "<u4"),
          "final_state": (["component"], "<f8")}
IF_ASKED = {"poincare": ["section", "component"], "poincare_blade_passing": ["passing", "component"],
            "max_displacement": [], "spectrum": ["order"], "touchdowns_per_revolution": [], "max_contact_force": [],
            "contact_fraction": [], "max_root_strain": [], "clearance_growth": [],
            "full_spectrum": ["whirl_order"], "friction_power": [], "viscous_power": [], "deformation_power": [],
            "drive_torque": [],
            "touchdowns_of_blades": ["blade"], "contact_fraction_of_blades": ["blade"], "impulse_of_blades": ["blade"],
            "max_contact_force_of_blades": ["blade"], "approach_speed": [], "max_root_stress": []}
# What effects remember from point to point, where they act:
# the quantity whose zero is its absence, dataset and inner axis of each.
MEMORIES = {"wear": ("rate", "final_state_wear", "blade"),
            "ring_body": ("compliance", "final_state_ring_body", "component")}
PENDING, DONE, FAILED = 0, 1, (2, 3)


def computed_checksum(atlas, place):
    """CRC-32 of all that a row of an open atlas stores, as /row_checksum has it."""
    stored = atlas["row_checksum"].attrs["order"].split()
    return zlib.crc32(b"".join(np.asarray(atlas[name][place]).tobytes() for name in stored))


def departures(path):
    found = []

    def need(holds, sentence):
        if not holds:
            found.append(sentence)

    with h5py.File(path, "r") as atlas:
        for name in ROOT_ATTRIBUTES:
            need(isinstance(atlas.attrs.get(name), str), f"the root has no text {name}")
        scene = json.loads(atlas["scene_resolved"].asstr()[()])
        json.loads(atlas["scene"].asstr()[()])
        # Quantities that the grid names by their pointers: /ring/stiffness is the axis ring_stiffness.
        swept = {key[1:].replace("/", "_"): values for key, values in scene["grid"].items() if key.startswith("/")}
        axes = (["direction"] if scene["sweep"] == "both" else []) + sorted(swept) + GRID_AXES
        on_grid = {**scene["grid"], **swept}
        shape = tuple(atlas[axis].size for axis in axes)
        for axis in axes:
            scale = atlas[axis]
            need(scale.dtype.str == "<f8" and scale.ndim == 1, f"/{axis} is no row of float64")
            need((np.diff(scale[...]) > 0).all(), f"/{axis} does not ascend")
            # A scene without unbalance has no such axis; the atlas then has its one value, zero.
            need(axis == "direction" or on_grid.get(axis, [0.0]) == list(scale[...]), f"/{axis} is not the scene's")

        asked = scene["observables"]
        need(set(asked) <= set(IF_ASKED), "the scene asks for something unknown")
        for name in IF_ASKED:
            need((name in atlas) == (name in asked), f"/{name} is there and not asked for, or the reverse")
        rows = {**ALWAYS, **{name: (IF_ASKED[name], "<f8") for name in asked}}
        cut = scene.get("pieces") is not None
        need(("seam" in atlas) == cut, "/seam is there without pieces, or the reverse")
        if cut:
            rows["seam"] = ([], "|u1")
        for effect, (strength, name, axis) in MEMORIES.items():
            acts = scene.get(effect, {}).get(strength, 0.0) != 0.0 or any(key.startswith(f"{effect}_") for key in swept)
            need((name in atlas) == acts, f"/{name} is there without its effect, or the reverse")
            if acts:
                rows[name] = ([axis], "<f8")
        status = atlas["status"][...]
        for name, (inner, kind) in rows.items():
            dataset = atlas[name]
            need(dataset.dtype.str == kind, f"/{name} is {dataset.dtype.str}, not {kind}")
            need(dataset.shape == shape + tuple(atlas[axis].size for axis in inner),
                 f"/{name} has shape {dataset.shape}")
            need("long_name" in dataset.attrs and (kind != "<f8" or "units" in dataset.attrs),
                 f"/{name} says too little")
            for place, axis in enumerate(axes + inner):
                scales = [scale.name for scale in dataset.dims[place].values()]
                need(scales == [f"/{axis}"], f"axis {place} of /{name} runs along {scales}, not along /{axis}")
            if kind == "<f8":
                values = dataset[...]
                need(np.isfinite(values[status == DONE]).all(), f"/{name} is not finite in a row that is done")
                need(np.isnan(values[np.isin(status, FAILED)]).all(), f"/{name} has numbers in a row that failed")

        for axis in {axis for inner, _ in rows.values() for axis in inner} | set(axes):
            need(h5py.h5ds.is_scale(atlas[axis].id), f"/{axis} is no dimension scale")
            need({"units", "long_name"} <= set(atlas[axis].attrs), f"/{axis} says too little")
        need([word.decode() for word in atlas["component"][...]] == ["x", "y", "vx", "vy"],
             "/component has other words")
        if "section" in atlas:
            protocol = scene["protocol"]
            first, count = protocol["transient_revolutions"] + 1, protocol["sampled_revolutions"]
            need(atlas["section"].dtype.str == "<i4" and list(atlas["section"]) == list(range(first, first + count)),
                 "/section does not count the sampled revolutions")
        if "order" in atlas:
            sampled, highest = scene["protocol"]["sampled_revolutions"], scene["spectrum"]["max_order"]
            expected = np.arange(highest * sampled + 1) / sampled
            need(np.allclose(atlas["order"], expected, rtol=1e-15), "/order is not 0, 1/S, ... max_order")

        need(np.isin(status, (PENDING, DONE, *FAILED)).all(), "/status has an unknown code")
        flags = atlas["status"].attrs
        need(np.asarray(flags.get("flag_values")).dtype == np.uint8, "the values of /status are not declared")
        need(len(flags.get("flag_meanings", "").split()) == 4, "the meanings of /status are not declared")
        failure = atlas["failed_revolution"][...]
        need((failure[~np.isin(status, FAILED)] == -1).all(), "/failed_revolution counts where nothing failed")
        need((failure[np.isin(status, FAILED)] >= 0).all(), "/failed_revolution does not count where a point failed")
        detail = atlas["status_detail"]
        named = detail.attrs.get("flag_values")
        need(len(named) == len(detail.attrs.get("flag_meanings", "").split()),
             "the meanings of /status_detail are not declared")
        need(np.isin(detail[...], named).all(), "/status_detail has an unknown code")
        need((np.asarray(detail[...] != 0) == np.isin(status, FAILED)).all(), "/status_detail does not go with /status")
        finished = status != PENDING
        need(np.isin(atlas["restarted"][...][finished], (0, 1)).all(), "/restarted is neither 0 nor 1")
        checksums = atlas["row_checksum"]
        for place in zip(*np.nonzero(finished)):
            need(checksums[place] == computed_checksum(atlas, place), f"the row at {place} does not have its checksum")
    return found
