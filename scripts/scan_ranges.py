#!/usr/bin/env python3
"""Runs every case at the ends of its parameters' ranges and at random pairs of values, and lists false alarms.

usage: scan_ranges.py PROGRAM [CASE...] [--pairs N] [--seconds S] [--seed K]

A run may be right, wrong as known or not judged, or be refused with a message that names a parameter. Listed are runs
that fail (exit 1), break down where no limit knows it (exit 4), or are refused without the name. Runs that take longer
than S seconds are counted and left out.
"""

import argparse
import json
import random
import re
import subprocess

GOOD, WRONG, INPUT = 0, 1, 2


def output(command, seconds):
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return None, ""
    return done.returncode, done.stdout + done.stderr


def values(parameter):
    """The ends of a range, or all choices."""
    allowed = parameter["allowed"]
    ends = re.search(r"([-+.0-9e]+) to (below )?([-+.0-9e]+)$", allowed)
    if not ends:
        return [choice.strip() for choice in allowed.split(",")]
    low, below, high = ends.groups()
    return [low, f"{0.999 * float(high):g}" if below else high]


def trials(case, pairs, rng):
    schemes = case["schemes"]
    single = [(p["name"], value) for p in case["parameters"] for value in values(p)]
    for one in single:
        yield rng.choice(schemes), [one]
    for _ in range(pairs):
        if len(single) > 1:
            (a, x), (b, y) = rng.sample(single, 2)
            if a != b:
                yield rng.choice(schemes), [(a, x), (b, y)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("cases", nargs="*")
    parser.add_argument("--pairs", type=int, default=10)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    rng = random.Random(given.seed)
    listed = output([given.program, "list"], 60)[1].splitlines()
    names = given.cases or [line.split()[0] for line in listed[1:] if re.match(r"[a-z]", line)]
    tried, slow, alarms = 0, 0, 0
    for name in names:
        case = json.loads(output([given.program, "explain", name, "--json"], 60)[1])
        for scheme, assigned in trials(case, given.pairs, rng):
            command = [given.program, "run", name, "--scheme", scheme, "--level", case["levels"][0]["name"]]
            for key, value in assigned:
                command += ["--set", f"{key}={value}"]
            code, said = output(command, given.seconds)
            tried += 1
            slow += not isinstance(code, int)
            named = code == INPUT and any(key in said for key, _ in assigned)
            if code in (GOOD, None) or named:
                continue
            alarms += 1
            last = [line for line in said.splitlines() if line.strip()][-1:]
            print(f"exit {code}: {' '.join(command[2:])}: {''.join(last)}", flush=True)
    print(f"{tried} runs tried, {slow} took longer than {given.seconds:g} s, {alarms} alarms")


if __name__ == "__main__":
    main()
