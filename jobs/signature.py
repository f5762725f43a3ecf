#!/usr/bin/python3
"""How early, how often not, and how often falsely signs in the spectrum announce that the displacement passes a limit.

    ./jobs/signature.py [--limit "0.5 mm" ...] [--keep DIRECTORY] [SCENE.json ...]

Runs each scene (without names the maps of damping, friction, unbalance, thickness, and the rig), analyses its atlas
for each limit, and prints a row of a table for each: lines; lines that pass the limit; and of each sign of the
spectrum, of the earliest of them, and of the displacement itself by the same rule: by how many per cent of the limit's
speed it comes earlier (least … median … most), at how many of the lines that pass the limit it does not come, and how
many false ones there are at all lines. --keep: where atlases are looked for, and stay.
"""
import argparse
import pathlib
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools"))
import rubatlas  # noqa: E402

SCENES = ("quick", "damping", "friction", "unbalance", "thickness", "rig")
SIGNS = ("passing_line", "broad_band", "subharmonic", "announced", "displacement")


def table_of(atlas, maps, limit):
    """The maps' table of signs, without lines that are beyond the limit from their first speed on."""
    rubatlas.command("analyse", atlas, output=maps, limit=limit, overwrite=True)
    with h5py.File(maps) as file:
        if "signature" not in file:
            sys.exit(f"{atlas}: not both max_displacement and a spectrum that shows signs")
        table = {name: column[...] for name, column in file["signature"].items() if name[:3] != "at_"}
        inside = table["limit_speed_ratio"] != file["speed_ratio"][0]
    return {name: column[inside] for name, column in table.items()}


def cell(table, sign):
    """How early a sign comes at the lines that pass the limit, how often it does not, and its false ones."""
    passes = np.isfinite(table["limit_speed_ratio"])
    earlier = 100.0 * (1.0 - table[f"{sign}_speed_ratio"] / table["limit_speed_ratio"])[passes]
    missed = np.isnan(earlier).sum()
    quantiles = np.quantile(earlier[np.isfinite(earlier)], [0.0, 0.5, 1.0]) if missed < len(earlier) else []
    parts = [" … ".join(dict.fromkeys(f"{value:.1f}" for value in quantiles))] if len(quantiles) else []
    parts += [f"{missed} missed"] if missed else []
    false = table.get(f"{sign}_false", np.zeros(1)).sum()
    return ", ".join(parts + ([f"{false} false"] if false else []))


def row(name, limit, table):
    passes = np.isfinite(table["limit_speed_ratio"]).sum()
    return " | ".join([f"| {name}", limit, f"{len(table['limit'])}", f"{passes}",
                       *(cell(table, sign) for sign in SIGNS)]) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path,
                        default=[ROOT / f"jobs/{name}.json" for name in SCENES])
    parser.add_argument("--limit", action="append", help="may be repeated (default: 0.1, 0.5 and 1 clearances)")
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="rubatlas_signature_") as scratch:
        folder = options.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        print("| scene | limit | lines | pass it | n× line | broad band | sub-harmonic | earliest | displacement |")
        print("|---|---|--:|--:|---|---|---|---|---|")
        tables = {limit: [] for limit in options.limit or ["0.1 clearances", "0.5 clearances", "1 clearances"]}
        for scene in options.scenes:
            atlas = folder / f"{scene.stem}.h5"
            rubatlas.command("run", scene, output=atlas, resume=True, progress="off")
            for limit, found in tables.items():
                found.append(table_of(atlas, folder / f"{scene.stem}_maps.h5", limit))
                print(row(f"`{scene.stem}`", limit, found[-1]), flush=True)
        for limit, found in tables.items():
            print(row("all", limit, {name: np.concatenate([table[name] for table in found]) for name in found[0]}))


if __name__ == "__main__":
    main()
