#include <pavior/model/intervals.hpp>
#include <pavior/model/recognition.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <chrono>
#include <iostream>
#include <random>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("wip") {
    TestBrep b;
    std::vector<SweepTopology> sweeps;
    // grid of boxes sharing faces
    const int N = 4;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> step(0.6, 3.0);
    std::vector<std::vector<double>> x(3, std::vector<double>(N + 1, 0.0));
    for (auto& c : x) for (int i = 0; i < N; ++i) c[i + 1] = c[i] + step(random);
    std::vector<VertexId> v;
    std::uniform_real_distribution<double> jit(-0.2, 0.2);
    for (int k = 0; k <= N; ++k) for (int j = 0; j <= N; ++j) for (int i = 0; i <= N; ++i) v.push_back(b.vertex({x[0][i]+jit(random), x[1][j]+jit(random), x[2][k]+jit(random)}));
    auto at = [&](int i, int j, int k) { return v[i + (N + 1) * (j + (N + 1) * k)]; };
    std::map<std::array<int,4>, FaceId> faces;
    auto face = [&](int d, int i, int j, int k) {
        auto [it, isnew] = faces.emplace(std::array{d, i, j, k}, FaceId{});
        if (isnew) {
            if (d == 0) it->second = b.flat_polygon({at(i,j,k), at(i,j+1,k), at(i,j+1,k+1), at(i,j,k+1)});
            if (d == 1) it->second = b.flat_polygon({at(i,j,k), at(i,j,k+1), at(i+1,j,k+1), at(i+1,j,k)});
            if (d == 2) it->second = b.flat_polygon({at(i,j,k), at(i+1,j,k), at(i+1,j+1,k), at(i,j+1,k)});
        }
        return it->second;
    };
    for (int k = 0; k < N; ++k) for (int j = 0; j < N; ++j) for (int i = 0; i < N; ++i) {
        const SolidId s = b.solid({{face(0,i,j,k), false}, {face(0,i+1,j,k), true}, {face(1,i,j,k), false}, {face(1,i,j+1,k), true}, {face(2,i,j,k), false}, {face(2,i,j,k+1), true}});
        sweeps.push_back(recognise_sweeps(b, s).candidates[(i * 7 + j * 3 + k) % 3]);
    }
    const auto t0 = std::chrono::steady_clock::now();
    IntervalOptions o;
    o.size = 0.4;
    const auto r = assign_intervals(b, sweeps, o);
    std::cout << b.edge_count() << " edges " << r.objective << " mean " << r.mean_ratio << " worst " << r.worst_ratio << " optimal " << r.optimal << " s "
              << std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count() << "\n";
}
