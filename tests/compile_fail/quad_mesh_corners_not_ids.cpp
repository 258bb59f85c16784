// expect: quad\(m, q\).*satisfy|satisfy .corner_list.
#include <pavior/mesh/mesh_access.hpp>

#include <array>
#include <string>
#include <vector>

#ifdef MISUSE
using Corner = std::string;
#else
using Corner = int;
#endif

struct Cells {
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<Corner, 4>> cells;
};

template <>
struct pavior::mesh_access<Cells> {
    static std::size_t node_count(const Cells& m) { return m.points.size(); }
    static const std::array<double, 3>& node(const Cells& m, Index i) { return m.points[i]; }
    static std::size_t quad_count(const Cells& m) { return m.cells.size(); }
    static const std::array<Corner, 4>& quad(const Cells& m, Index q) { return m.cells[q]; }
};

pavior::QuadCorners first(const Cells& mesh) { return pavior::quad(mesh, 0); }
