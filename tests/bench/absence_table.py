"""Table of absence.sh: absence_table.py BUILD EFFECT..."""
import json
import pathlib
import re
import sys

MOST = 0.01  # of the instructions


def measured(build, name):
    """Instructions of the solver, right-hand sides, revolutions and the atlas' bytes of one run."""
    profile = (build / f"{name}.callgrind").read_text(encoding="utf-8")
    instructions = int(re.search(r"^(?:summary|totals): (\d+)", profile, re.M)[1])
    record = json.loads((build / f"{name}.out/atlas.h5.run.json").read_text(encoding="utf-8"))
    run = record["runs"][-1]
    scene = json.loads((build / "scene.json").read_text(encoding="utf-8"))
    revolutions = run["points_computed"] * sum(scene["protocol"].values())
    if not instructions or not run["right_hand_sides"]:
        sys.exit(f"absence: {name}: nothing was counted; has the solver another name?")
    return instructions, run["right_hand_sides"], revolutions, (build / f"{name}.out/atlas.h5").read_bytes()


def main():
    build = pathlib.Path(sys.argv[1])
    whole = measured(build, "whole")
    print("| left out of the build | instructions a right-hand side | a revolution "
          "| the program with all, a right-hand side | apart | atlas |\n|---|---|---|---|---|---|")
    apart = []
    for effect in sys.argv[2:]:
        without = measured(build, f"without_{effect}")
        ratio = whole[0] / whole[1] / (without[0] / without[1]) - 1
        apart.append(abs(ratio))
        print(f"| {effect.replace('_', ' ')} | {without[0] / without[1]:,.1f} | {without[0] / without[2]:,.0f} "
              f"| {whole[0] / whole[1]:,.1f} | {100 * ratio:+.3f} % "
              f"| {'equal byte by byte' if without[3] == whole[3] else 'DIFFERS'} |")
        if without[3] != whole[3]:
            apart.append(1)
    sys.exit(0 if max(apart) <= MOST else "absence: an effect that is absent costs something, or shows in the atlas")


if __name__ == "__main__":
    main()
