#!/usr/bin/env python3
"""The score of the mutants that were tried, with its interval, into docs/notes/mutants.md.

    scripts/mutation_score.py TABLE FOLDER...     the table's name there, and folders that hold mutants.out of cargo-mutants

The score is the caught share of viable mutants (those that build): a unit test or, for the core, a test of behaviour
fails, or runs without end. The interval is Wilson's of 95 %, for a sample of them all.
"""

import json
import math
import pathlib
import sys

PAGE = pathlib.Path(__file__).parent.parent / "docs/notes/mutants.md"
BEGIN, END = "<!--score {}-->", "<!--end of score-->"
Z = 1.959964


def outcomes(folders):
    """Part and fate of every mutant; one that several runs tried is caught if one of them caught it."""
    found = {}
    for folder in folders:
        for path in sorted(pathlib.Path(folder).glob("**/outcomes.json")):
            for outcome in json.loads(path.read_text())["outcomes"]:
                if outcome["scenario"] == "Baseline":
                    continue
                mutant = outcome["scenario"]["Mutant"]
                caught = outcome["summary"] in ("CaughtMutant", "Timeout")
                if caught or mutant["name"] not in found:
                    found[mutant["name"]] = (part(mutant["file"]), "caught" if caught else outcome["summary"])
    return list(found.values())


def part(file):
    package, _, *rest = file.split("/")
    return f"{package}: {rest[0].removesuffix('.rs')}"


def wilson(caught, count):
    share = caught / count
    spread = Z * math.sqrt(share * (1 - share) / count + (Z / (2 * count)) ** 2)
    middle = share + Z * Z / (2 * count)
    return [(middle + sign * spread) / (1 + Z * Z / count) for sign in (-1, 1)]


def row(name, fates):
    caught, survive, unviable = (fates.count(fate) for fate in ("caught", "MissedMutant", "Unviable"))
    viable = caught + survive
    score = "–"
    if viable:
        low, high = wilson(caught, viable)
        score = f"{100 * caught / viable:.0f} % ({100 * max(low, 0):.0f}–{100 * high:.0f} %)"
    return f"| {name} | {len(fates)} | {unviable} | {caught} | {survive} | {score} |"


def main(table, *folders):
    tried, begin = outcomes(folders), BEGIN.format(table)
    head = ["part", "tried", "don't build", "caught", "survive", "caught of viable (95 %)"]
    lines = [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    for name in sorted({name for name, _ in tried}):
        lines.append(row(name, [fate for part, fate in tried if part == name]))
    lines.append(row("**all**", [fate for _, fate in tried]))
    text = PAGE.read_text()
    before, rest = text.split(begin)
    _, after = rest.split(END, 1)
    PAGE.write_text(f"{before}{begin}\n\n" + "\n".join(lines) + f"\n\n{END}{after}")


main(*sys.argv[1:])
