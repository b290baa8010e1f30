#!/usr/bin/env python3
"""Proof that a change of the harness lost nothing: collects evidence with a program, and compares evidence before and after.

    scripts/same_results.py collect FOLDER --program MPM_VERIFY [--judge JUDGE] [--root ROOT] [--rows CSV] [--report REPORT]
    scripts/same_results.py compare BEFORE AFTER [--without-texts] [--only PART]... [--most N]

`collect` replaces in FOLDER the parts that its options give:
  program   the list of cases, the plans of all tiers, what is explained of every case, and the help of all commands;
  tables    every table of results, every number in sentences and the summary, as `tables` fills them from the kept rows
            into the pages of ROOT (default: this checkout);
  kept      with --judge, the verdicts on all kept rows and on the rows of every case together;
  made-up   with --judge, the same with every metric of a case given, and changed at random by factors from 1/4 to 4, so
            that checks also fail and say why: the values depend on nothing but the names of run and metric;
  report    with --report, a folder that `verify` has left: plan, records, summary (which has the drift from goldens, the
            verdicts on cases and the captions), figures as CSV, and length and checksum of every CSV file of the runs.
Build JUDGE, which is independent of the command line, by `cargo build --release -p mpm-verify --example judge`. Both sides
need the same kept rows: of the state before, or give --rows. The two folders of goldens must say the same as well.

`compare` ignores the program's version, times, and the machine. Order counts, of verdicts and rows too. --without-texts
leaves out titles, statements, sources, captions and all that is not a number in tables and figures; names stay. The
exit code is 1 if anything differs, and 2 if a part is not in both folders.
"""

import argparse
import csv
import hashlib
import io
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zlib

TIERS = ("quick", "pr", "nightly", "long")
# Keys of records and summaries: who made them, when, and how fast.
IGNORED = {"time", "machine", "version", "cpu_s", "cpu_s (s)", "wall_s", "night"}
TEXTS = {
    "caption", "description", "limits", "meaning", "message", "references", "remark", "source", "statement", "title",
}
NUMBER = re.compile(r"[-−+]?\d[\d,]*(?:\.\d+)?(?:[e×][-−+]?\d+)?")
BLOCK = re.compile(r"^<!-- (?:table )?(\S+) -->\n(.*?)^<!-- end -->$", re.M | re.S)
CITED = re.compile(r"<!--= (.*?)-->(.*?)<!--/-->")


def output(command, **options):
    done = subprocess.run(command, capture_output=True, encoding="utf-8", **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr[-2000:]}")
    return done.stdout


def fresh(folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def collect_program(folder, program):
    """What the program says of its cases and its command line; returns the metrics of every case, with units."""
    folder, metrics = fresh(folder), {}
    (folder / "list.json").write_text(output([program, "list", "--json"]))
    for tier in TIERS:
        (folder / f"plan-{tier}.json").write_text(output([program, "list", "--tier", tier, "--json"]))
    for case in json.loads((folder / "list.json").read_text()):
        text = output([program, "explain", case["case"], "--json"])
        (folder / f"explain-{case['case']}.json").write_text(text)
        metrics[case["case"]] = {metric["name"]: metric["unit"] for metric in json.loads(text)["metrics"]}
    commands = re.findall(r"^  ([a-z]\w*) +[A-Z]", output([program, "--help"]).split("Options:")[0], re.M)
    for command in sorted(commands):
        text = output([program, command, "--help"]).replace(pathlib.Path(program).name, "mpm-verify")
        (folder / f"help-{command}.txt").write_text(text)
    return metrics


def collect_tables(folder, program, root, rows):
    """The tables of the pages as the program fills them, the numbers that sentences cite, and the summary."""
    with tempfile.TemporaryDirectory() as scratch:
        folder, scratch = fresh(folder), pathlib.Path(scratch)
        (scratch / "docs/notes").mkdir(parents=True)
        (scratch / "reports/nightly").mkdir(parents=True)
        shutil.copy(rows, scratch / "reports/nightly/results.csv")
        for page in [root / "README.md", *(root / "docs").glob("*.md"), *(root / "docs/notes").glob("*.md")]:
            shutil.copy(page, scratch / page.relative_to(root))
        output([program, "tables", "--root", scratch])
        for page in sorted(scratch.glob("**/*.md")):
            text = page.read_text()
            for name, table in BLOCK.findall(text):
                (folder / f"{name}.txt").write_text(table)
            cited = [f"{what}: {number}" for what, number in CITED.findall(text)]
            (folder / f"numbers-{page.parent.name}-{page.stem}.txt").write_text("\n".join(cited))
        shutil.copy(scratch / "reports/nightly/summary.md", folder / "summary.txt")


def kept_records(path, metrics):
    """The kept rows as records, as the program reads them; only the first row of a case that has a metric names it."""
    names, records = {}, []
    for row in csv.DictReader(path.read_text().splitlines()):
        known, values = names.setdefault(row["case"], []), {}
        for place, cell in enumerate(row["metrics"].split(";")):
            name, named, value = cell.rpartition("=")
            if named and name not in known:
                known.append(name)
            if cell and (name or known[place]) in metrics[row["case"]]:
                values[name or known[place]] = float(value)
        error, ok = None, row["status"] == "ok"
        if not ok:
            time, kind = re.fullmatch(r"failed at (\S+) s(?:: (.*))?", row["status"]).groups("")
            error = {"kind": kind, "time": float(time), "message": row["status"], "step": 0, "particle": 0, "value": None}
        records.append({
            "schema": 2, "case": row["case"], "scheme": row["scheme"], "solver": "", "level": row["level"],
            "set": row["set"].split(), "perturbed": False, "status": "ok" if ok else "failed", "error": error,
            "parameters": {}, "verdicts": [], "metrics": values,
            "discretisation": {"dim": 0, "h": float(row["h"]), "ppc": 0, "dt": 1e-3, "wall": ""},
            "work": {"nodes": 0, "particle_steps": 0, "projections": 0, "sorts": 0,
                     **{count: int(row[count]) for count in ("particles", "steps", "particle_node_pairs")}},
            "time": {"wall_s": 1.0, "cpu_s": float(row["cpu_s"])},
            "machine": {"os": "", "arch": "", "cores": 1, "threads": 1},
            "version": {"mpm_verify": "", "source": row["program"]},
        })
    return records


def made_up(record, name):
    """A value for a metric of a run: that which is kept, or else one, times a factor from 1/4 to 4."""
    key = "|".join([record["case"], record["scheme"], record["level"], *record["set"], name])
    share = int.from_bytes(hashlib.sha256(key.encode()).digest()[:6], "big") / 2**48
    return record["metrics"].get(name, 1.0) * 4.0 ** (2.0 * share - 1.0)


def collect_verdicts(folder, judge, path, metrics):
    records = kept_records(path, metrics)
    for part, value in [("kept", lambda record, name: record["metrics"].get(name)), ("made-up", made_up)]:
        lines = []
        for record in records:
            own = {name: {"value": value(record, name), "unit": unit} for name, unit in metrics[record["case"]].items()}
            lines.append(json.dumps({**record, "metrics": own}))
        (fresh(folder / part) / "verdicts.jsonl").write_text(output([judge], input="\n".join(lines)))


def collect_report(folder, report):
    folder, marks = fresh(folder), {}
    for path in sorted(report.glob("**/*")):
        own = path.relative_to(report)
        figure = path.suffix == ".csv" and not any((above / "record.json").exists() for above in path.parents)
        if figure or own.name in ("plan.json", "record.json", "summary.json", "study.json"):
            (folder / own).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, folder / own)
        elif path.suffix == ".csv":
            content = path.read_bytes()
            marks[str(own)] = [len(content), zlib.crc32(content)]
    (folder / "marks.json").write_text(json.dumps(marks, indent=0))


def read(path, texts):
    """What a file says, as it is compared."""
    text = path.read_text()
    if path.suffix == ".json":
        return json.loads(text)
    if path.suffix == ".jsonl":
        judged = [json.loads(line) for line in text.splitlines()]
        return {f"{j['case']}/{j['run'] or 'all runs'}": j["verdicts"] for j in judged}
    if path.suffix == ".csv":
        rows = list(csv.reader(io.StringIO(text)))
        gone = IGNORED | (set() if texts else TEXTS | {"chart", "series"})
        keep = [k for k, name in enumerate(rows[0]) if name not in gone]
        return [[row[k] for k in keep if k < len(row)] for row in (rows if texts else rows[1:])]
    if texts:
        return text.splitlines()
    return re.findall(r"--[\w-]+", text) if path.name.startswith("help") else NUMBER.findall(text)


def differences(before, after, texts, where=""):
    """Where two things differ, and how, one line each."""
    if isinstance(before, dict) and isinstance(after, dict):
        gone = IGNORED | (set() if texts else TEXTS)
        for key in [*before, *(key for key in after if key not in before)]:
            if key not in gone and (key not in after or key not in before):
                yield f"{where}/{key}: only {'before' if key in before else 'after'}"
            elif key not in gone:
                yield from differences(before[key], after[key], texts, f"{where}/{key}")
    elif isinstance(before, list) and isinstance(after, list):
        if len(before) != len(after):
            yield f"{where}: {len(before)} before, {len(after)} after"
            said = [[json.dumps(item, ensure_ascii=False) for item in side] for side in (before, after)]
            for name, (own, other) in {"before": said, "after": said[::-1]}.items():
                missing = [item for item in own if item not in set(other)]
                yield from (f"{where}: only {name}: {item[:300]}" for item in missing[:5])
        else:
            for k, (a, b) in enumerate(zip(before, after)):
                known = isinstance(a, dict) and (a.get("check") or a.get("name") or a.get("case"))
                yield from differences(a, b, texts, f"{where}/{k}{f' {known}' if known else ''}")
    elif type(before) is not type(after) or before != after:
        yield f"{where}: {str(before)[:300]!r} → {str(after)[:300]!r}"


def compare(before, after, texts, only, most):
    def parts(folder):
        return {path.name for path in folder.iterdir() if path.is_dir()}
    code = 0
    for part in sorted(set(only) or parts(before) | parts(after)):
        if part not in parts(before) & parts(after):
            print(f"{part}: not in both folders")
            code = 2
            continue
        sides = [{p.relative_to(f / part): p for p in (f / part).glob("**/*") if p.is_file()} for f in (before, after)]
        found = []
        for own in sorted(set(sides[0]) | set(sides[1])):
            if own not in sides[0] or own not in sides[1]:
                found.append(f"{own}: only {'before' if own in sides[0] else 'after'}")
            else:
                found += [f"{own}: {line}" for line in differences(*(read(s[own], texts) for s in sides), texts)]
        print(f"{part}: {len(set(sides[0]) | set(sides[1]))} files, {len(found)} differences")
        for line in found[:most] + ([f"... and {len(found) - most} more"] if len(found) > most else []):
            print(f"  {line}")
        code = code or bool(found)
    return int(code)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    own, both = commands.add_parser("collect"), commands.add_parser("compare")
    own.add_argument("folder", type=pathlib.Path)
    for name in ("--program", "--judge", "--root", "--rows", "--report"):
        own.add_argument(name, type=pathlib.Path, required=name == "--program")
    own.set_defaults(root=pathlib.Path(__file__).parent.parent)
    for name in ("before", "after"):
        both.add_argument(name, type=pathlib.Path)
    both.add_argument("--without-texts", action="store_true")
    both.add_argument("--only", action="append", default=[])
    both.add_argument("--most", type=int, default=20)
    args = parser.parse_args()
    if args.command == "compare":
        return compare(args.before, args.after, not args.without_texts, args.only, args.most)
    root, program = args.root.resolve(), args.program.resolve()
    rows = args.rows or root / "reports/nightly/results.csv"
    metrics = collect_program(args.folder / "program", program)
    collect_tables(args.folder / "tables", program, root, rows)
    if args.judge:
        collect_verdicts(args.folder, args.judge.resolve(), rows, metrics)
    if args.report:
        collect_report(args.folder / "report", args.report)
    return 0


if __name__ == "__main__":
    sys.exit(main())
