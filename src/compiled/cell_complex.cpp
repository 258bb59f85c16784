#include <pavior/dual/cell_complex.hpp>

namespace pavior {

template TetTopology tet_topology<ReferenceMesh>(const ReferenceMesh&, Execution);
template EntityClasses classify<ReferenceMesh>(const ReferenceMesh&, const TetTopology&, Execution);
template CellComplex cell_complex<ReferenceMesh>(const ReferenceMesh&, const TetTopology&, const EntityClasses&,
                                                 Execution);

}  // namespace pavior
