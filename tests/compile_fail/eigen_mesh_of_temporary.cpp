// expect: deleted
// The view of Eigen matrices does not own them: a temporary would dangle.
#include <pavior/mesh/eigen_access.hpp>

std::size_t quads(const Eigen::MatrixXd& V, const Eigen::MatrixXi& F) {
#ifdef MISUSE
    const pavior::EigenQuadMesh mesh(V, Eigen::MatrixXi(F));
#else
    const pavior::EigenQuadMesh mesh(V, F);
#endif
    return pavior::quad_count(mesh);
}
