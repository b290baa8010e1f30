// Solves an exported problem with a code of your own and writes the table that `mpm-verify score` and `board` read.
//
//     mpm-verify export cook --level h2 --out cook-h2
//     g++ -O2 -std=c++17 template.cpp -o template && ./template cook-h2 2.0 && mpm-verify score cook-h2
//
// Only `run` is yours. Its second argument is the cell size (m); other numbers of problem.json are read as you like.
#include <array>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>
#include <vector>

using Columns = std::map<std::string, std::vector<double>>;
struct Particle { std::array<double, 2> start, moved; std::array<double, 4> stress; };  // m, m, Pa: xx, yy, zz, xy

// Tension is positive. Here nothing moves.
std::vector<Particle> run(double /*cell*/, const Columns& start) {
    std::vector<Particle> all;
    for (size_t k = 0; k < start.at("mass (kg/m)").size(); ++k)
        all.push_back({{start.at("reference_x (m)")[k], start.at("reference_y (m)")[k]}, {0, 0}, {0, 0, 0, 0}});
    return all;
}

int main(int, char** told) {
    const std::string folder = told[1];
    std::ifstream file(folder + "/start.csv");
    std::string line, cell;
    std::vector<std::string> names;
    std::getline(file, line);
    for (std::stringstream head(line); std::getline(head, cell, ',');) names.push_back(cell);
    Columns start;
    while (std::getline(file, line)) {
        std::stringstream row(line);
        for (const auto& name : names) { std::getline(row, cell, ','); start[name].push_back(std::stod(cell)); }
    }
    std::ofstream table(folder + "/particles.csv");
    table << std::setprecision(10) << "reference_x (m),reference_y (m),ux (m),uy (m),mean_stress (Pa),stress_xx (Pa)\n";
    for (const auto& p : run(std::stod(told[2]), start))
        table << p.start[0] << ',' << p.start[1] << ',' << p.moved[0] << ',' << p.moved[1] << ','
              << (p.stress[0] + p.stress[1] + p.stress[2]) / 3 << ',' << p.stress[0] << '\n';
    std::ofstream(folder + "/score.json") << R"({"schema": 1, "code": {"name": "my code"}, "case": "cook", "level": "h2",
 "cell_size_m": 2.0, "particles": "particles.csv", "scheme": "nothing moves"})";
}
