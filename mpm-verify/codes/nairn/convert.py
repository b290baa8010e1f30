"""Cook's membrane in NairnMPM (nairn-mpm-fea), from what `export` writes to what `score` reads.

    python convert.py cook-h2 result PATH/NairnMPM PATH/ExtractMPM [uGIMP|B2SPLINE|...] [seconds] [USL]

Commit 7f47b02, g++ 12 -O3 -fopenmp -std=c++11 with libxerces-c 3.2, by its makefile. USL: strains
last, momenta extrapolated once; otherwise the code's own USAVG with the second extrapolation. It adds a layer of cells to the grid.
"""
import json, os, resource, subprocess, sys
from pathlib import Path
import numpy as np

source, out, program, extract = Path(sys.argv[1]), Path(sys.argv[2]).absolute(), *map(lambda p: str(Path(p).absolute()), sys.argv[3:5])
shape = sys.argv[5] if len(sys.argv) > 5 else "uGIMP"
told = json.loads((source / "problem.json").read_text())
h, value = told["cell_size_m"], {p["name"]: p["value"] for p in told["parameters"]}
head = (source / "start.csv").read_text().splitlines()[0].split(",")
start = dict(zip(head, np.loadtxt(source / "start.csv", delimiter=",", skiprows=1).T))
X = np.column_stack([start["x (m)"], start["y (m)"]])
mass, load = start["mass (kg/m)"], start["load_y (N/m)"]
period = 60 * np.sqrt(70 * value["density"] / value["young_modulus"])
seconds = float(sys.argv[6]) if len(sys.argv) > 6 and sys.argv[6] != "USL" else 1.5 * period
alpha = 12 / period  # about critical for the first mode
edge = X[load != 0]
x0, x1, y0, y1 = -4 * h, 56.0, -4 * h, 68.0
USL = "USL" in sys.argv  # strains last, momenta extrapolated once; otherwise the code's own USAVG with a second time, as in MUSL
out.mkdir(parents=True, exist_ok=True)
fixed = "".join(f"<BCLine x1='{x:g}' x2='{x:g}' y1='{y0:g}' y2='{y1:g}' tolerance='{h/10:g}'>"
                f"<DisBC dir='1' vel='0'/><DisBC dir='2' vel='0'/></BCLine>" for x in (0.0, -h, -2 * h))
points = "\n".join(f"<mp matl='1' angle='0' thick='1'><pt x='{x:.10g}' y='{y:.10g}'/></mp>" for x, y in X)
(out / "cook.xml").write_text(f"""<?xml version='1.0'?>
<!DOCTYPE JANFEAInput SYSTEM "{Path(program).parent}/NairnMPM.dtd">
<JANFEAInput version='3'>
<Header><Description>Cook</Description><Analysis>10</Analysis><ConsistentUnits length='m' mass='kg' time='s'/></Header>
<MPMHeader><MaxTime>{seconds:.9g}</MaxTime><TimeFactor>0.3</TimeFactor><ArchiveTime>{seconds:.9g}</ArchiveTime>
<ArchiveRoot>res/cook.</ArchiveRoot><MPMArchiveOrder>iYYYYNYNNNYYNNNNNN</MPMArchiveOrder>
<GlobalArchiveTime>{period/240:.9g}</GlobalArchiveTime><GlobalArchive type='Kinetic Energy'/><GlobalArchive type='reactiony' material='-11'/>
{'<MPMMethod>3</MPMMethod><SkipPostExtrapolation/>' if USL else ''}<GIMP type='{shape}'/><PDamping>{alpha:.9g}</PDamping></MPMHeader>
<Mesh><Grid xmin='{x0:g}' xmax='{x1:g}' ymin='{y0:g}' ymax='{y1:g}'><Horiz cellsize='{h:g}'/><Vert cellsize='{h:g}'/></Grid></Mesh>
<MaterialPoints><PointList>{points}</PointList></MaterialPoints>
<Material Type='28' Name='rubber'><rho>{value['density']:.9g}</rho><E>{value['young_modulus']:.9g}</E><nu>{value['poisson_ratio']:.9g}</nu>
<UJOption>2</UJOption></Material>
<GridBCs>{fixed.replace("<DisBC", "<DisBC id='-11'")}</GridBCs>
<ParticleBCs><LdRect xmin='{edge[:,0].min()-h/8:g}' xmax='{edge[:,0].max()+h/8:g}' ymin='40' ymax='64'><net/><LoadBC dir='2' style='1' load='{load.sum():.9g}'/></LdRect></ParticleBCs>
</JANFEAInput>
""")
begun = resource.getrusage(resource.RUSAGE_CHILDREN)
with open(out / "log.txt", "w") as log:
    subprocess.run([program, "-r", "-np", "1", "cook.xml"], cwd=out, stdout=log, stderr=log, check=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
used = resource.getrusage(resource.RUSAGE_CHILDREN)
cost = used.ru_utime + used.ru_stime - begun.ru_utime - begun.ru_stime
last = max(out.glob("res/cook.[0-9]*"), key=lambda p: int(p.suffix[1:]))
subprocess.run([extract, "-d", "-o", "last", "-q", "sxx", "-q", "syy", "-q", "szz", str(last)], cwd=out, check=True, stdout=subprocess.DEVNULL)
rows = np.fromfile(out / "last.data").reshape(len(X), 5)  # x, y, stresses; in the order of the deck
steps = int(last.suffix[1:])
mean = rows[:, 2:5].sum(1) / 3
np.savetxt(out / "particles.csv", np.column_stack([X, rows[:, 0:2] - X, mean]), "%.9g", ",",
           header="reference_x (m),reference_y (m),ux (m),uy (m),mean_stress (Pa)", comments="")
table = [[float(x) for x in l.split()] for l in (out / "res/cook.global").read_text().splitlines() if l.strip() and l[0] not in "#"]
np.savetxt(out / "series.csv", table, "%.6g", ",", header="time (s),kinetic_energy (J/m),reaction_y (N/m)", comments="")
(out / "score.json").write_text(json.dumps({"cell_size_m": told["cell_size_m"], 
    "schema": 1, "code": {"name": "NairnMPM", "version": "7f47b02", "url": "https://github.com/nairnj/nairn-mpm-fea"},
    "scheme": f"{shape}, FLIP, {'USL' if USL else 'USAVG, second extrapolation'}, standard MPM", "case": "cook", "level": told["level"], "parameters": {},
    "particles": "particles.csv", "series": "series.csv", "cost": {"cpu_s": cost, "threads": 1, "steps": steps}}, indent=1))
print(f"{cost:.2f} s CPU, {steps} steps, {1e9 * cost / steps / len(X):.0f} ns per particle and step")
