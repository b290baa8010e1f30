#!/usr/bin/env python3
"""Fills the tables of results of the pages in docs/ from the reports of a night and of long runs:
`python3 scripts/tables.py NIGHT [LONG...]`, each the folder of a report.

A table stands between `<!-- table NAME -->` and `<!-- end -->`; NAME is a function of this file.
Standard library only.
"""

import json
import math
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
REMEDIES = ["none", "fbar-recursive", "fbar-total", "fbar-rate", "fbar-consistent"]
BASES = ["gimp", "bspline2", "bspline3"]
EXACT = 2 + math.pi


class Runs:
    """The runs of a case, ordered by scheme, level and what they change."""

    def __init__(self, summary, case):
        found = [c for c in summary["cases"] if c["case"] == case]
        self.records = found[0]["records"] if found else []
        self.records.sort(
            key=lambda r: (
                ["linear", *BASES].index(r["basis"]),
                REMEDIES.index(r["remedy"]),
                r["transfer"] != "flip",
                r["transfer"],
                -r["discretisation"]["h"],
                r["set"],
            )
        )

    def where(self, **wanted):
        def agrees(record):
            return all(record[key] == value for key, value in wanted.items())

        return [r for r in self.records if agrees(r)]

    def one(self, **wanted):
        found = self.where(**wanted)
        return found[0] if found else None


def metric(record, name):
    value = record and record["metrics"].get(name, {}).get("value")
    return math.nan if value is None else value


def number(value, form="{:.3f}"):
    if value is None or math.isnan(value):
        return "–"
    return form.format(value).replace("-", "−")


def percent(value, decimals=1):
    return number(100 * value, f"{{:+.{decimals}f}} %")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def cell(level):
    return f"B/{level[1:]}"


def changes(record):
    words = {
        "contact=barrier": "barrier",
        "ppc_per_direction=4": "4 × 4",
        "rough=false": "smooth",
        "domain_width=3": "3B × 3B",
        "domain_depth=3": "",
        "penetration=0.0025": "to 0.0025",
    }
    return ", ".join(w for w in (words.get(s, s) for s in record["set"]) if w)


def scheme(record):
    transfer = "" if record["transfer"] == "flip" else f" {record['transfer']}"
    return f"{record['basis']} {record['remedy']}{transfer}"


def footing_results(summary):
    rows = []
    for r in Runs(summary, "footing").records:
        skipped = any(s.startswith(("penetration_rate", "undrained")) for s in r["set"])
        if skipped or r["status"] != "ok":
            continue
        own = "barrier" not in changes(r)
        effective = metric(r, "nc_effective") if own else math.nan
        rows.append(
            [
                scheme(r),
                cell(r["level"]),
                changes(r),
                number(metric(r, "nc_b")),
                number(metric(r, "nc_b_plus_h")),
                number(effective),
                percent(effective / EXACT - 1),
                percent(metric(r, "plateau_rise")),
                number(metric(r, "mechanism_width"), "{:.2f}"),
                number(metric(r, "heave"), "{:.2f}"),
                number(metric(r, "checkerboard_ratio"), "{:.2f}"),
                number(1e4 * (metric(r, "log_jacobian_gap") or math.nan), "{:.1f}"),
                number(r["time"]["cpu_s"], "{:.0f}"),
            ]
        )
    head = "scheme, h, changed, N_c by B, by B + h, by its own width, from 2 + π, rise per 10⁻³, mechanism (B), heave, checkerboard, ln(J/J̄) rms (10⁻⁴), CPU (s)"
    return table(head.split(", "), rows)


def footing_mean_stress(summary):
    runs = Runs(summary, "footing")
    points = ["0.25_0.25", "0.25_0.5", "0.75_0.25", "1_0.25", "0.25_1"]
    known = json.loads((ROOT / "mpm-verify/references/footing.json").read_text())
    reference = {f"{p['x']:g}_{-p['y']:g}": p for p in known["extrapolated"]["mean_stress"]}

    def elements(point):
        return f"{number(reference[point]['value'], '{:.2f}')} ± {reference[point]['uncertainty']:.2f}"

    rows = [["finite elements", ""] + [elements(p) for p in points]]
    for level in ["b20", "b40"]:
        for r in runs.where(level=level, set=[]):
            values = [number(metric(r, f"mean_stress_{p}"), "{:.2f}") for p in points]
            rows.append([scheme(r), cell(level)] + values)
    head = ["scheme", "h"] + [f"({p.replace('_', ', ')}) B" for p in points]
    return table(head, rows)


def footing_rates(summary):
    runs = Runs(summary, "footing")
    sets = [["penetration_rate=4e-3"], [], ["penetration_rate=1e-3"]]
    rows = []
    for basis in BASES[:2]:
        for remedy in ["fbar-recursive", "fbar-consistent"]:
            three = [runs.one(basis=basis, remedy=remedy, level="b10", set=s) for s in sets]
            loads = [number(metric(r, "nc_b")) for r in three]
            off = ", ".join(percent(metric(r, "force_imbalance")) for r in three)
            rows.append([f"{basis} {remedy}"] + loads + [off])
    head = "scheme, B/10; 4·10⁻³ m/s; 2·10⁻³ m/s; 1·10⁻³ m/s; imbalance of forces at 4, 2, 1·10⁻³"
    return table(head.split("; "), rows)


def footing_slopes(summary):
    rows = []
    for r in Runs(summary, "footing").where(set=["undrained_strength=1e6"]):
        check = [v for v in r["verdicts"] if v["check"] == "elastic-slope"]
        found, expected = (metric(r, "elastic_slope"), check[0]["reference"])
        # The finite elements' slope is that of E/s_u = 10⁴.
        scale = 1e4 * r["parameters"]["undrained_strength"] / r["parameters"]["young_modulus"]
        rows.append(
            [
                scheme(r),
                cell(r["level"]),
                number(found * scale, "{:.0f}"),
                number(expected * scale, "{:.0f}"),
                percent(found / expected - 1),
            ]
        )
    head = "scheme, h, slope d(q/s_u)/d(s/B), finite elements that act as wide, difference"
    return table(head.split(", "), rows)


def footing_orders(summary):
    found = [c for c in summary["cases"] if c["case"] == "footing"][0]
    rows = []
    runs = Runs(summary, "footing")
    orders = {
        (c["scheme"]["basis"], c["scheme"]["remedy"]): c["order"]
        for c in found["convergence"]
        if c["metric"] == "prandtl_error" and c["set"] == [] and c["scheme"]["transfer"] == "flip"
    }

    def order(basis, remedy):
        # Errors on splines with F̄ are too small to fall with an order.
        found = orders.get((basis, remedy)) if basis == "gimp" else None
        if not found:
            return "–"
        local = ", ".join(number(p, "{:.2f}") for p in found["local"])
        return f"{number(found['order'], '{:.2f}')} ± {number(found['uncertainty'], '{:.2f}')} ({local})"

    for basis in BASES[:2]:
        for remedy in REMEDIES[1:]:
            levels = [runs.one(basis=basis, remedy=remedy, level=l, set=[]) for l in ["b10", "b20", "b40"]]
            if levels[0] is None:
                continue
            errors = [percent(metric(r, "prandtl_error")) for r in levels]
            rows.append([f"{basis} {remedy}"] + errors + [order(basis, remedy)])
    return table(["scheme", "B/10", "B/20", "B/40", "order (between levels)"], rows)


def dam_break_flow(summary):
    rows = []
    for r in Runs(summary, "dam-break").records:
        if r["set"] != ["cfl=0.3"]:
            continue
        if r["status"] != "ok":
            rows.append([scheme(r), f"{r['level'][1:]} m", f"breaks down at {r['error']['time']:.2f} s"] + [""] * 9)
            continue
        rows.append(
            [
                scheme(r),
                f"{r['level'][1:]} m",
                number(metric(r, "front_x_0.4s"), "{:.2f}"),
                number(metric(r, "front_rms_error"), "{:.2f}"),
                number(1e3 * metric(r, "arrival_error"), "{:.0f}"),
                number(1e-3 * metric(r, "pressure_rms"), "{:.1f}"),
                number(1e-3 * metric(r, "checkerboard_rms"), "{:.1f}"),
                number(100 * metric(r, "tension_share"), "{:.0f} %"),
                number(metric(r, "motion_ratio_2s"), "{:.3f}"),
                number(metric(r, "energy_ratio_2s"), "{:.3f}"),
                f"{number(metric(r, 'jacobian_min'), '{:.2f}')} … {number(metric(r, 'jacobian_max'), '{:.2f}')}",
                number(r["time"]["cpu_s"], "{:.0f}"),
            ]
        )
    head = "scheme, h, front at 0.4 s (m), rms error (m), arrival off by (ms), p rms (kPa), p − Πp (kPa), in tension, K + P at 2 s, with stress work, J, CPU (s)"
    return table(head.split(", "), rows)


def dam_break_sums(summary):
    rows = []
    for r in Runs(summary, "dam-break").records:
        if r["status"] != "ok" or metric(r, "wall_impulse") != metric(r, "wall_impulse"):
            continue
        if r["set"] == [] and r["remedy"] != "fbar-consistent" or r["set"] == ["duration=0.6"]:
            continue
        changed = ", ".join(s.replace("_", " ") for s in r["set"])
        rows.append(
            [
                scheme(r),
                f"{r['level'][1:]} m",
                changed,
                number(1e-3 * metric(r, "wall_impulse"), "{:.2f}"),
                number(metric(r, "centre_x_mean")),
                number(metric(r, "centre_y_mean")),
                number(metric(r, "motion_ratio_2s")),
            ]
        )
    head = "scheme, h, changed, impulse on the wall (kN s/m), mean x (m), mean y (m), K + P at 2 s"
    return table(head.split(", "), rows)


def dam_break_start(summary):
    rows = []
    for r in Runs(summary, "dam-break").records:
        sets = [[], ["start=gravity-stage"], ["cfl=0.3"]]
        if r["status"] != "ok" or r["transfer"] != "flip" or r["set"] not in sets:
            continue
        rows.append(
            [
                scheme(r),
                f"{r['level'][1:]} m",
                "gravity stage" if r["set"] == sets[1] else "exact",
                "0.3" if r["set"] == sets[2] else "0.057",
                percent(metric(r, "base_reaction_ratio") - 1, 2),
                percent(metric(r, "gate_force") / 19570.95 - 1, 2),
                percent(metric(r, "base_pressure") / 19570.95 - 1, 2),
                percent(metric(r, "pressure_profile_error"), 2),
            ]
        )
    head = "scheme, h, start, CFL, force on the floor, on the gate, pressure at the floor, profile rms"
    return table(head.split(", "), rows)


def lost(r):
    fallen = metric(r, "fallen_energy")
    if not metric(r, "failed_share_end") > 0.1:
        return "–"
    return number(-100 * metric(r, "unaccounted_energy") / fallen, "{:.0f} %")


def bands(r):
    count, rear = metric(r, "shear_bands_end"), metric(r, "rearmost_band_end")
    where = "" if math.isnan(rear) else f" ({number(rear, '{:.1f}')})"
    return number(count, "{:.0f}") + where


def landslide_2d(summary):
    rows = []
    for r in Runs(summary, "landslide-2d").where(set=[], transfer="flip", status="ok"):
        rows.append(
            [
                scheme(r),
                f"{r['level'][1:]} m",
                number(metric(r, "runout_2.5s"), "{:.2f}"),
                number(metric(r, "runout_end"), "{:.2f}"),
                number(metric(r, "bulk_runout_end"), "{:.2f}"),
                number(metric(r, "settlement_end"), "{:.2f}"),
                number(100 * metric(r, "failed_share_end"), "{:.0f} %"),
                number(metric(r, "failure_time"), "{:.2f}"),
                number(metric(r, "retrogression_end"), "{:.1f}"),
                bands(r),
                number(metric(r, "checkerboard_at_rest")),
                number(metric(r, "checkerboard_2.5s")),
                f"{number(metric(r, 'jacobian_min'), '{:.2f}')} … {number(metric(r, 'jacobian_max'), '{:.2f}')}",
                number(metric(r, "log_jacobian_gap"), "{:.2f}"),
                lost(r),
                number(r["time"]["cpu_s"], "{:.0f}"),
            ]
        )
    head = "scheme; h; run-out at 2.5 s (m); at 5.5 s (m); of the bulk (m); settlement (m); failed; fails at (s); retrogression (m); bands (rearmost, m); σ_m − Πσ_m at rest (γH); at 2.5 s; J; ln(J/J̄) rms; lost; CPU (s)"
    return table(head.split("; "), rows)


def landslide_studies(summary):
    runs = Runs(summary, "landslide-2d")
    sets = [["reduction=1", "duration=2.5"], [], ["cfl=0.175"], ["damping=0.7"], ["release=2"], ["reduction=1.8"], ["reduction=2"]]

    def cell(r):
        if r is None or r["status"] != "ok":
            return "breaks down" if r else ""
        time = metric(r, "failure_time")
        if math.isnan(time):
            return "–"
        return f"{number(metric(r, 'runout_2.5s'), '{:.2f}')} ({time:.2f} s)"

    rows = []
    for basis in BASES[:2]:
        for remedy in ["none", "fbar-recursive", "fbar-consistent"]:
            for level in ["h0.4", "h0.2", "h0.1", "h0.05"]:
                found = [runs.one(basis=basis, remedy=remedy, transfer="flip", level=level, set=s) for s in sets]
                if any(found):
                    rows.append([f"{basis} {remedy}", f"{level[1:]} m"] + [cell(r) for r in found])
    head = "scheme; h; no reduction; 1.65; half the step; damped; over 2 s; 1.8; 2"
    return table(head.split("; "), rows)


def landslide_3d(summary):
    rows = []
    for r in Runs(summary, "landslide").where(status="ok"):
        changed = ", ".join(r["set"])
        rows.append(
            [
                scheme(r),
                r["level"].replace("slice-", "slice, ").replace("h", "") + " m",
                changed,
                f"{r['work']['particles']:,}",
                number(metric(r, "runout_2.5s"), "{:.2f}"),
                number(metric(r, "runout_end"), "{:.2f}"),
                number(metric(r, "off_plane_strain_end"), "{:+.2f}"),
                number(metric(r, "failure_time"), "{:.2f}"),
                percent(metric(r, "off_plane_strain_at_rest"), 3),
                percent(metric(r, "off_plane_strain_0.5s"), 3),
                number(metric(r, "width_spread_at_rest"), "{:.0e}"),
                number(metric(r, "width_spread_0.5s"), "{:.0e}"),
                number(metric(r, "width_spread_end"), "{:.0e}"),
                number(r["time"]["cpu_s"], "{:.0f}"),
            ]
        )
    head = "scheme; level; changed; particles; run-out at 2.5 s (m); at the end (m); against plane strain (m); fails at (s); off plane strain at rest; at 0.5 s; spread at rest; at 0.5 s; at the end; CPU (s)"
    return table(head.split("; "), rows)


def slope_stability(summary):
    runs = Runs(summary, "slope-stability")
    rows = []
    for basis in BASES[:2]:
        for remedy in ["none", "fbar-recursive", "fbar-consistent"]:
            cells = []
            for level in ["h0.4", "h0.2", "h0.1"]:
                r = runs.one(basis=basis, remedy=remedy, level=level, set=[])
                if r is None:
                    cells.append("")
                elif math.isnan(metric(r, "fails_at")):
                    cells.append(f"stands at {metric(r, 'stands_at'):.0f}")
                else:
                    bounds = f"{metric(r, 'stands_at'):.3f} … {metric(r, 'fails_at'):.3f}"
                    cells.append(f"{metric(r, 'strength_reduction_factor'):.3f} ({bounds})")
            rows.append([f"{basis} {remedy}"] + cells)
    return table(["scheme", "h = 0.4 m", "0.2 m", "0.1 m"], rows)


OTHERS = [
    ("flip", []),
    ("apic", []),
    ("xpic2", []),
    ("flip", ["ppc_per_direction=3"]),
    ("flip", ["ppc_per_direction=4"]),
]


def other_transfers(summary, case, levels, cell, others=OTHERS):
    """What each transfer and number of particles comes to at the levels where there is more than FLIP."""
    runs = Runs(summary, case)
    rows = []
    for basis in BASES[:2]:
        for remedy in ["none", "fbar-consistent"]:
            for level, name in levels.items():
                like = {"basis": basis, "remedy": remedy, "level": level}
                found = [runs.one(transfer=transfer, set=changed, **like) for transfer, changed in others]
                if any(found[1:]):
                    rows.append([f"{basis} {remedy}", name] + [cell(r) if r else "–" for r in found])
    heads = {"apic": "APIC", "xpic2": "XPIC(2)"}
    per_direction = [f"{s[0][-1]} per direction" if s else heads.get(t, "FLIP, 2 per direction") for t, s in others]
    return table(["scheme", "h", *per_direction], rows)


def cook_transfers(summary):
    def cell(r):
        return percent(metric(r, "fem_mid_edge_error"), 2)

    return other_transfers(summary, "cook", {"h2": "2 m", "h1": "1 m", "h0.5": "½ m"}, cell)


def footing_transfers(summary):
    def cell(r):
        return percent(metric(r, "nc_effective") / EXACT - 1, 2)

    without_three = [other for other in OTHERS if other[1] != ["ppc_per_direction=3"]]
    return other_transfers(summary, "footing", {"b10": "B/10", "b20": "B/20"}, cell, without_three)


def landslide_transfers(summary):
    def cell(r):
        return number(metric(r, "runout_2.5s"), "{:.2f} m")

    return other_transfers(summary, "landslide-2d", {"h0.4": "0.4 m", "h0.2": "0.2 m"}, cell)


def transfers_and_particles(summary):
    """The error of u on 32 cells (16 in three dimensions), and by what factor another transfer or number of particles changes it."""
    cases = [c["case"] for c in summary["cases"] if c["case"].startswith("mms-")]
    rows = []
    for case in cases:
        runs = Runs(summary, case)
        for basis in BASES[:2]:
            for remedy in ["none", "fbar-consistent"]:
                level = "n16" if case == "mms-swirl" else "n32"
                like = {"basis": basis, "remedy": remedy, "level": level}
                own = metric(runs.one(transfer="flip", set=[], **like), "displacement_l2")
                factors = [
                    metric(runs.one(transfer=transfer, set=changed, **like), "displacement_l2") / own
                    for transfer, changed in OTHERS[1:]
                ]
                form = "{:,.0f}" if own >= 1e-3 else "{:.3g}"
                cells = [number(1e6 * own, form)] + [number(f, "{:.2f}") for f in factors]
                rows.append([case.removeprefix("mms-"), f"{basis} {remedy}"] + cells)
    head = "case; scheme; FLIP, 2 per direction (µm); APIC ×; XPIC(2) ×; 3 per direction ×; 4 ×"
    return table(head.split("; "), rows)


def fill(page, summary):
    text = page.read_text()

    def one(found):
        made = globals()[found[1].replace("-", "_")](summary)
        return f"<!-- table {found[1]} -->\n{made}\n<!-- end -->"

    filled = re.sub(r"<!-- table ([\w-]+) -->\n.*?<!-- end -->", one, text, flags=re.S)
    if filled != text:
        page.write_text(filled)
        print(page.relative_to(ROOT))


def named(scheme):
    basis, *remedy, transfer = scheme.split("-")
    return {"basis": basis, "remedy": "-".join(remedy), "transfer": transfer}


def read(folder):
    summary = json.loads((Path(folder) / "summary.json").read_text())
    for case in summary["cases"]:
        for record in case["records"]:
            record.update(named(record["scheme"]))
        for found in case["convergence"]:
            found["scheme"] = named(found["scheme"])
    return summary


def with_long(night, long):
    """The night with the long runs; of a run that both have, the night's, so that times in a table are of one machine."""

    def run(record):
        return [record[key] for key in ["scheme", "level", "set", "perturbed"]]

    cases = []
    for case in night["cases"]:
        known = [run(r) for r in case["records"]]
        more = [r for r in Runs(long, case["case"]).records if run(r) not in known]
        cases.append({**case, "records": case["records"] + more})
    return {"cases": cases}


def main():
    if len(sys.argv) < 2:
        sys.exit("which folders? the report of a night, then those of long runs")
    summary = read(sys.argv[1])
    for folder in sys.argv[2:]:
        summary = with_long(summary, read(folder))
    for page in sorted((ROOT / "docs").glob("*.md")):
        fill(page, summary)


if __name__ == "__main__":
    main()
