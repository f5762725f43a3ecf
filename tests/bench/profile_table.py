"""Table of a callgrind profile: profile_table.py CALLGRIND_ANNOTATE_TEXT DEFAULT_POINT_TEXT REVOLUTIONS."""
import collections
import os
import re
import sys

LONGEST_NAME = 100
LINES = 15


def read_profile(path):
    """Instructions by (file, function), as callgrind_annotate lists them: `1,234  path/file.hpp:function [object]`."""
    costs = collections.Counter()
    for line in open(path, encoding="utf-8"):
        found = re.match(r"\s*([\d,]+)\s+(\S+?):(?!:)(\S.*?)(?: \[\S+\])?$", line)
        if found and not found[2].endswith("TOTALS"):
            # A compiler's clones ('2, .constprop, .isra) are the function that they were made from.
            costs[os.path.basename(found[2]), re.sub(r"'\d+$", "", found[3])] += int(found[1].replace(",", ""))
    return costs


def short(function):
    """Without namespaces, which fill a line and say little."""
    function = re.sub(r"Eigen::Array<double, (\d), 1, 0, \d, 1>", r"Array\1", function)
    function = re.sub(r"rubatlas::|Eigen::internal::|std::|"
                      r"\b(?:assembly|modes|motion|point|rotor|contact|integrate|effects|observables|blade)::",
                      "", function)
    return function if len(function) <= LONGEST_NAME else function[: LONGEST_NAME - 1] + "…"


def print_costliest(title, costs, total):
    print(f"\n{'instructions':>14}  share  {title}")
    for name, cost in costs.most_common(LINES):
        print(f"{cost:14,} {100 * cost / total:5.1f}%  {name}")


def main():
    costs = read_profile(sys.argv[1])
    work = dict(line.split() for line in open(sys.argv[2], encoding="utf-8"))
    revolutions = int(sys.argv[3])
    total = sum(costs.values())
    right_hand_sides = int(work["right_hand_sides"])
    print(f"\ninstructions {total:,}: {total / revolutions:,.0f} a revolution")
    if right_hand_sides:
        print(f"{total / right_hand_sides:,.0f} a right-hand side, {total / int(work['touchdowns']):,.0f} a touch-down")
        print(f"right-hand sides: {right_hand_sides / revolutions:.1f} a revolution, "
              f"{right_hand_sides / int(work['touchdowns']):.1f} a touch-down")
    functions, files, places = collections.Counter(), collections.Counter(), collections.Counter()
    for (file, function), cost in costs.items():
        functions[short(function)] += cost
        files[file] += cost
        places[f"{file}: {short(function)}"] += cost
    print_costliest("function, with what is inlined into it", functions, total)
    print_costliest("file that the code comes from", files, total)
    print_costliest("file: function", places, total)


if __name__ == "__main__":
    main()
