// expect: mesh_access<.*>::quad_count
#include <pavior/mesh/mesh_access.hpp>

#include <array>
#include <vector>

struct Cloud {
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<int, 4>> cells;
};

template <>
struct pavior::mesh_access<Cloud> {
    static std::size_t node_count(const Cloud& m) { return m.points.size(); }
    static const std::array<double, 3>& node(const Cloud& m, Index i) { return m.points[i]; }
#ifndef MISUSE
    static std::size_t quad_count(const Cloud& m) { return m.cells.size(); }
#endif
    static const std::array<int, 4>& quad(const Cloud& m, Index q) { return m.cells[q]; }
};

std::size_t count(const Cloud& cloud) { return pavior::quad_count(cloud); }
