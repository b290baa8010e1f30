#!/usr/bin/env python3
"""The score of the mutants that were tried, with its interval, into docs/mutants.md.

    scripts/mutation_score.py FOLDER...     folders that hold mutants.out of cargo-mutants, shards of one program

Of viable mutants, those that build, a share is caught: a test fails, or runs without end. The interval is Wilson's of
95 % for a sample of them all.
"""

import json
import math
import pathlib
import sys

PAGE = pathlib.Path(__file__).parent.parent / "docs/mutants.md"
BEGIN, END = "<!--score-->", "<!--end of score-->"
Z = 1.959964


def outcomes(folders):
    found = {}
    for folder in folders:
        for path in sorted(pathlib.Path(folder).glob("**/outcomes.json")):
            for outcome in json.loads(path.read_text())["outcomes"]:
                if outcome["scenario"] != "Baseline":
                    mutant = outcome["scenario"]["Mutant"]
                    found[mutant["name"]] = (part(mutant["file"]), outcome["summary"])
    return list(found.values())


def part(file):
    package, _, *rest = file.split("/")
    return f"{package}: {rest[0].removesuffix('.rs')}"


def wilson(caught, count):
    share = caught / count
    spread = Z * math.sqrt(share * (1 - share) / count + (Z / (2 * count)) ** 2)
    middle = share + Z * Z / (2 * count)
    return [(middle + sign * spread) / (1 + Z * Z / count) for sign in (-1, 1)]


def row(name, summaries):
    count = {s: summaries.count(s) for s in ("CaughtMutant", "Timeout", "MissedMutant", "Unviable")}
    caught = count["CaughtMutant"] + count["Timeout"]
    viable = caught + count["MissedMutant"]
    score = "–"
    if viable:
        low, high = wilson(caught, viable)
        score = f"{100 * caught / viable:.0f} % ({100 * low:.0f}–{100 * high:.0f} %)"
    return f"| {name} | {len(summaries)} | {count['Unviable']} | {caught} | {count['MissedMutant']} | {score} |"


def main(folders):
    tried = outcomes(folders)
    lines = ["| part | tried | don't build | caught | survive | caught of viable (95 %) |", "|---|---|---|---|---|---|"]
    for name in sorted({name for name, _ in tried}):
        lines.append(row(name, [summary for part, summary in tried if part == name]))
    lines.append(row("**all**", [summary for _, summary in tried]))
    text = PAGE.read_text()
    before, rest = text.split(BEGIN)
    _, after = rest.split(END)
    PAGE.write_text(f"{before}{BEGIN}\n\n" + "\n".join(lines) + f"\n\n{END}{after}")


main(sys.argv[1:])
