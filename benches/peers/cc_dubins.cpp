// Compares joins with the paths of Banzhaf's steering_functions: CC-Dubins, arcs, lines and clothoids of one sharpness.
//
//     cargo bench --bench joins -- clothoid > joins.csv
//     g++ -O3 -std=c++17 -ISTEERING/include -I/usr/include/eigen3 benches/peers/cc_dubins.cpp \
//         STEERING/src/{dubins_state_space,hc_cc_state_space,utilities}/*.cpp STEERING/src/filter/ekf.cpp -o cc_dubins
//     ./cc_dubins SHARPNESS < joins.csv
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "steering_functions/dubins_state_space/dubins_state_space.hpp"
#include "steering_functions/hc_cc_state_space/cc_dubins_state_space.hpp"

static double length(const std::vector<steering::Control> &controls) {
    double sum = 0;
    for (const auto &control : controls) sum += std::fabs(control.delta_s);
    return sum;
}

static void told(const char *name, std::vector<double> all, double unit = 1) {
    std::sort(all.begin(), all.end());
    const auto at = [&](double share) { return unit * all[static_cast<std::size_t>(share * (all.size() - 1))]; };
    std::printf("%-24s median %.4f, 10 %% %.4f, 90 %% %.4f, 99 %% %.4f\n", name, at(.5), at(.1), at(.9), at(.99));
}

int main(int, char **arguments) {
    const double sharpness = std::atof(arguments[1]);
    const steering::CC_Dubins_State_Space cc(1.0, sharpness, 0.05);
    const steering::Dubins_State_Space dubins(1.0, 0.05);
    std::vector<double> ratios, above, ours_above, times, ours_times, off;
    int rows = 0, shorter = 0;
    std::string line;
    std::getline(std::cin, line);
    while (std::getline(std::cin, line)) {
        std::stringstream cells(line);
        std::vector<double> row;
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell.empty() ? NAN : std::stod(cell));
        const steering::State from{row[0], row[1], row[2], row[3], 1}, to{row[4], row[5], row[6], row[7], 1};
        double seconds = 1e9;
        std::vector<steering::Control> controls;
        for (int i = 0; i < 3; i++) {
            const auto start = std::chrono::steady_clock::now();
            controls = cc.get_controls(from, to);
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
            seconds = std::min(seconds, took.count());
        }
        const auto end = cc.integrate(from, controls).back();
        off.push_back(std::hypot(end.x - to.x, end.y - to.y));
        const double theirs = length(controls), least = length(dubins.get_controls(from, to));
        times.push_back(seconds), above.push_back(theirs / least), rows++;
        if (std::isnan(row[8])) continue;
        ratios.push_back(row[8] / theirs), ours_above.push_back(row[8] / least), ours_times.push_back(row[11]);
        shorter += row[8] < theirs * (1 - 1e-9);
    }
    std::printf("%d pairs, %zu joined, %d of them shorter than CC-Dubins of sharpness %g\n", rows, ratios.size(),
                shorter, sharpness);
    told("join / CC-Dubins", ratios);
    told("join / Dubins", ours_above);
    told("CC-Dubins / Dubins", above);
    told("join, us", ours_times, 1e6);
    told("CC-Dubins, us", times, 1e6);
    std::printf("CC-Dubins' ends are off by at most %.1e\n", *std::max_element(off.begin(), off.end()));
}
