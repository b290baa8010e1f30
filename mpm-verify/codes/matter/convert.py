"""The cantilever in Matter (github.com/larsblatny/matter, commit bf948b6), from what `mpm-verify export` writes to what `score` reads.

    mpm-verify export cantilever --level h0.1 --out cantilever
    python convert.py cantilever result CHECKOUT/src [share of FLIP: 0] [seconds: 60] [cfl_elastic: 0.5]

The driver below stands for Matter's own src/mpm.cpp; g++ 12 -O3 -fopenmp, Eigen 3.4, tinyply.h of its main branch in deps/;
double, two dimensions, quadratic splines as src/tools.hpp has them. The weight grows over the first sixth of the time, then the beam
comes to rest by the losses of PIC. Matter tests where a node would move to, so the plate stands at h/4, not at 0: nodes at x <= 0 are held.
"""
import json, resource, subprocess, sys
from pathlib import Path
import numpy as np

source, out, src = Path(sys.argv[1]), Path(sys.argv[2]).absolute(), Path(sys.argv[3])
flip, seconds, cfl = (sys.argv[4:] + ["0", "60", "0.5"][len(sys.argv[4:]):])[:3]
told = json.loads((source / "problem.json").read_text())
h, value = told["cell_size_m"], {p["name"]: p["value"] for p in told["parameters"]}
head = (source / "start.csv").read_text().splitlines()[0].split(",")
start = dict(zip(head, np.loadtxt(source / "start.csv", delimiter=",", skiprows=1).T))
X = np.column_stack([start["x (m)"], start["y (m)"]])
volume = start["reference_volume (m²)"][0]
density = start["mass (kg/m)"][0] / volume
out.mkdir(parents=True, exist_ok=True)
np.savetxt(out / "start.txt", X, "%.17g")
driver = out.parent / "driver"
(out.parent / "driver.cpp").write_text("""
#include "tools.hpp"
#include "simulation/simulation.hpp"
#include "objects/object_plate.hpp"
int main(int, char** a) {  // folder, h, E, nu, density, gravity, particles, volume, flip, seconds, cfl
    auto number = [&](int i) { return std::stod(a[i]); };
    std::string folder = a[1];
    Simulation sim;
    sim.initialize(false, folder + "/", "run");
    sim.reduce_verbose = true; sim.n_threads = 1;
    sim.elastic_model = ElasticModel::Hencky; sim.plastic_model = PlasticModel::NoPlasticity;
    sim.dx = number(2); sim.E = number(3); sim.nu = number(4); sim.rho = number(5);
    sim.gravity = TV::Zero(); sim.gravity[1] = -number(6);
    sim.Np = number(7); sim.particle_volume = number(8); sim.particle_mass = number(8) * sim.rho;
    sim.flip_ratio = number(9); sim.end_frame = 1; sim.fps = 1 / number(10);
    sim.cfl_elastic = number(11); sim.gravity_special = true; sim.gravity_time = number(10) / 6;
    sim.particles = Particles(sim.Np);
    std::ifstream in(folder + "/start.txt");
    for (auto& x : sim.particles.x) in >> x(0) >> x(1);
    sim.grid_reference_point = TV::Zero();
    sim.plates.push_back(std::make_unique<ObjectPlate>(sim.dx / 4, PlateType::left, BC::NoSlip));
    sim.simulate();
    std::ofstream f(folder + "/end.txt"); f.precision(12);
    for (unsigned p = 0; p < sim.Np; p++)  // tau is the Kirchhoff stress
        f << sim.particles.x[p](0) << " " << sim.particles.x[p](1) << " " << sim.particles.tau[p](0, 0) / sim.particles.F[p].determinant()
          << " " << sim.particles.v[p].norm() << "\\n";
}
""")
if not driver.exists():
    subprocess.run(["g++", "-std=c++17", "-O3", "-fopenmp", f"-I{src}", "-I/usr/include/eigen3", f'-DSRC_DIR="{src}"', f'-DINCLUDE_DIR="{src}"',
                    f"{driver}.cpp", *sorted(src.glob("simulation/*.cpp")), "-o", driver], check=True)
told_ = [h, value["young_modulus"], value["poisson_ratio"], density, value["weight"] / density, len(X), volume, flip, seconds, cfl]
begun = resource.getrusage(resource.RUSAGE_CHILDREN)
with open(out / "log.txt", "w") as log:
    subprocess.run([driver, out, *map(str, told_)], stdout=log, stderr=log, check=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
cost = used.ru_utime + used.ru_stime - begun.ru_utime - begun.ru_stime
rows = np.loadtxt(out / "end.txt")
steps = round(float(seconds) / (float(cfl) * h / np.sqrt(value["young_modulus"] / density)))
print(f"{cost:.2f} s CPU, {steps} steps, largest speed at the end {rows[:, 3].max():.3g} m/s")
np.savetxt(out / "particles.csv", np.column_stack([X, rows[:, :2] - X, rows[:, 2]]), "%.9g", ",",
           header="reference_x (m),reference_y (m),ux (m),uy (m),stress_xx (Pa)", comments="")
(out / "score.json").write_text(json.dumps({"cell_size_m": told["cell_size_m"], 
    "schema": 1, "code": {"name": "Matter", "version": "bf948b6", "url": "https://github.com/larsblatny/matter"}, "case": "cantilever",
    "scheme": f"quadratic B-splines, explicit, {'PIC' if flip == '0' else 'flip_ratio ' + flip}, to rest, Hencky, cfl_elastic {cfl}", "level": told["level"],
    "particles": "particles.csv", "cost": {"cpu_s": cost, "threads": 1, "steps": steps}}, indent=1))
