#include "support/catch.hpp"

#include <pavior/mesh/eigen_access.hpp>

#include <cstdint>
#include <type_traits>

using namespace pavior;

TEST_CASE("V and F as a quad mesh: any scalar, storage and size") {
    Eigen::MatrixXd v(4, 3);
    v << 0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0;
    Eigen::MatrixXi f(1, 4);
    f << 3, 2, 1, 0;
    const EigenQuadMesh mesh(v, f);
    static_assert(quad_mesh<decltype(mesh)> && !hex_mesh<decltype(mesh)>);
    CHECK(node_count(mesh) == 4);
    CHECK(node(mesh, 2) == Vec3(1, 1, 0.5));
    CHECK(quad_count(mesh) == 1);
    CHECK(quad(mesh, 0) == QuadCorners{3, 2, 1, 0});
    v(2, 2) = 7;  // by reference
    CHECK(node(mesh, 2) == Vec3(1, 1, 7));

    const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> vf = v.cast<float>();
    const Eigen::Array<std::int64_t, Eigen::Dynamic, 4, Eigen::RowMajor> fl = f.cast<std::int64_t>().array();
    const EigenQuadMesh other(vf, fl);
    CHECK(node(other, 2) == Vec3(1, 1, 7));
    CHECK(quad(other, 0) == QuadCorners{3, 2, 1, 0});

    const Eigen::Map<const Eigen::MatrixXd> map(v.data(), 4, 3);
    CHECK(node(EigenQuadMesh(map, f), 3) == Vec3(0, 1, 0));
    const Eigen::Ref<const Eigen::MatrixXi> ref(f);
    CHECK(quad(EigenQuadMesh(map, ref), 0) == QuadCorners{3, 2, 1, 0});
}

TEST_CASE("plane nodes have z = 0") {
    const Eigen::MatrixX2d v = Eigen::MatrixX2d::Ones(4, 2);
    Eigen::MatrixX4i f(1, 4);
    f << 0, 1, 2, 3;
    CHECK(node(EigenQuadMesh(v, f), 3) == Vec3(1, 1, 0));
}

TEST_CASE("hexahedra") {
    const Eigen::MatrixXd v = Eigen::MatrixXd::Random(8, 3);
    Eigen::Matrix<unsigned, Eigen::Dynamic, 8> h(2, 8);
    h << 0, 1, 2, 3, 4, 5, 6, 7, 7, 6, 5, 4, 3, 2, 1, 0;
    const EigenHexMesh mesh(v, h);
    static_assert(hex_mesh<decltype(mesh)> && !quad_mesh<decltype(mesh)>);
    CHECK(hex_count(mesh) == 2);
    CHECK(hex(mesh, 1) == HexCorners{7, 6, 5, 4, 3, 2, 1, 0});
}

TEST_CASE("ids that Index cannot hold stay out of range") {
    const Eigen::MatrixXd v = Eigen::MatrixXd::Zero(4, 3);
    Eigen::Matrix<std::int64_t, Eigen::Dynamic, 4> f(1, 4);
    f << -1, 4294967296, 4294967297, 2;
    CHECK(quad(EigenQuadMesh(v, f), 0) == QuadCorners{4294967295U, 4294967295U, 4294967295U, 2});
}

TEST_CASE("wrong numbers of columns") {
    const Eigen::MatrixXd v = Eigen::MatrixXd::Zero(4, 3);
    const Eigen::MatrixXd four = Eigen::MatrixXd::Zero(4, 4);
    const Eigen::MatrixXi f = Eigen::MatrixXi::Zero(1, 4);
    const Eigen::MatrixXi triangles = Eigen::MatrixXi::Zero(1, 3);
    CHECK_THROWS_AS(EigenQuadMesh(four, f), InputError);
    CHECK_THROWS_AS(EigenQuadMesh(v, triangles), InputError);
    CHECK_THROWS_AS(EigenHexMesh(v, f), InputError);
    using Mesh = EigenQuadMesh<Eigen::MatrixXd, Eigen::MatrixXi>;
    static_assert(std::is_constructible_v<Mesh, const Eigen::MatrixXd&, const Eigen::MatrixXi&>);
    static_assert(!std::is_constructible_v<Mesh, Eigen::MatrixXd&&, const Eigen::MatrixXi&>);
    static_assert(!std::is_constructible_v<Mesh, const Eigen::MatrixXd&, Eigen::MatrixXi&&>);
}
