#!/usr/bin/env python3
"""Two tables of docs: what Cook's error is made of (docs/notes/cook.md), and the width that a footing acts with (docs/notes/averages.md).

usage: causes.py PROGRAM

One run at a time, some ten minutes of CPU time. Every number is a run of the program or a difference of two.
"""

import json
import math
import subprocess
import sys

PRANDTL = 2 + math.pi
SMALL_STRAIN = ["domain_width=3", "domain_depth=3", "undrained_strength=10", "penetration=0.00025", "penetration_rate=2e-4"]


def metric(program, name, case, scheme, level, *changed):
    sets = [part for value in changed for part in ("--set", value)]
    command = [program, "run", case, "--scheme", scheme, "--level", level, "--threads", "1", "--json", *sets]
    return json.loads(subprocess.run(command, capture_output=True, text=True).stdout)["metrics"][name]["value"]


def cook(program):
    """Parts of the mid-edge error of GIMP with fbar-consistent, in per cent of the reference."""

    def error(scheme, level, *changed):
        return 100 * metric(program, "fem_mid_edge_error", "cook", scheme, level, *changed)

    static, explicit = "quasi-static-gimp-fbar-consistent", "gimp-fbar-consistent-flip"
    print("| h | element and quadrature | place of the load | soft rim | rest and path | explicit |\n|---|---|---|---|---|---|")
    for level in ["h2", "h1", "h0.5"]:
        edge, held = (error(static, level, "ghost=1e-3", f"load_at={at}") for at in ("edge", "column"))
        free, whole = error(static, level, "ghost=0"), error(explicit, level)
        parts = [edge, held - edge, free - held, whole - free, whole]
        print(f"| {level} | {' | '.join(f'{part:+.2f}'.replace('-', '−') for part in parts)} |", flush=True)


def footing(program):
    """N_c by B at small strain and the width B + w h that Prandtl's load makes of it."""
    print("\n| average | h | N_c by B | w |\n|---|---|---|---|")
    for remedy in ["bbar-cells", "bbar"]:
        for level, cells in [("b10", 10), ("b20", 20)]:
            load = metric(program, "nc_b", "footing", f"gimp-{remedy}-flip", level, *SMALL_STRAIN)
            print(f"| `{remedy}` | {level} | {load:.3f} | {(load / PRANDTL - 1) * cells:.2f} |", flush=True)


if __name__ == "__main__":
    cook(sys.argv[1])
    footing(sys.argv[1])
