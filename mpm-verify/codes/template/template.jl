# Solves an exported problem with a code of your own and writes what `mpm-verify score` and `board` read.
#
#     mpm-verify export cook --level h2 --out cook-h2
#     julia template.jl cook-h2 && mpm-verify score cook-h2
#
# Only `run_code` is yours. Needs the package JSON.
using DelimitedFiles, JSON

# Places at the start (m), displacements (m) and stresses xx, yy, zz, xy (Pa, tension positive), a row a particle: here
# nothing moves. `problem` is problem.json, `start` has the columns of start.csv by name.
function run_code(problem, start)
    X = hcat(start["reference_x (m)"], start["reference_y (m)"])
    return X, zeros(size(X, 1), 2), zeros(size(X, 1), 4)
end

folder = ARGS[1]
problem = JSON.parsefile(joinpath(folder, "problem.json"))
table, head = readdlm(joinpath(folder, "start.csv"), ','; header = true)
start = Dict(name => Float64.(table[:, k]) for (k, name) in enumerate(vec(head)))
cpu = @elapsed (X, u, stress) = run_code(problem, start)
open(joinpath(folder, "particles.csv"), "w") do file
    println(file, "reference_x (m),reference_y (m),ux (m),uy (m),mean_stress (Pa),stress_xx (Pa)")
    mean = sum(stress[:, 1:3]; dims = 2) ./ 3
    writedlm(file, hcat(X, u, mean, stress[:, 1]), ',')
end
form = JSON.parsefile(joinpath(folder, "score.json"))
delete!(form, "series")
merge!(form, Dict("code" => Dict("name" => "my code"), "scheme" => "nothing moves", "particles" => "particles.csv",
    "cell_size_m" => problem["cell_size_m"], "cost" => Dict("cpu_s" => max(cpu, 1e-3), "threads" => 1)))
open(file -> JSON.print(file, form, 2), joinpath(folder, "score.json"), "w")
