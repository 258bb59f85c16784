#include <pavior/lattice/signed_axis.hpp>

#include "support/catch.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <set>

using namespace pavior;

namespace {

Eigen::Vector3i vector(SignedAxis a) {
    Eigen::Vector3i result = Eigen::Vector3i::Zero();
    result[static_cast<Eigen::Index>(a.axis())] = a.sign();
    return result;
}

std::vector<SignedAxis> all() {
    std::vector<SignedAxis> result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        result.push_back(signed_axis(axis, 1));
        result.push_back(signed_axis(axis, -1));
    }
    return result;
}

}  // namespace

TEST_CASE("the product of directions is the vector product") {
    for (const SignedAxis a : all()) {
        for (const SignedAxis b : all()) {
            const Eigen::Vector3i wanted = vector(a).cross(vector(b));
            const SignedAxis found = cross(a, b);
            CHECK(found.valid() == (wanted.norm() != 0));
            CHECK((!found.valid() || vector(found) == wanted));
        }
        CHECK(vector(-a) == -vector(a));
    }
}

TEST_CASE("four quarter turns lead back, one is the product with the axis") {
    for (const SignedAxis about : all()) {
        for (const SignedAxis d : all()) {
            CHECK(turned(d, about, 0) == d);
            CHECK(turned(d, about, -3) == turned(d, about, 1));
            CHECK(turned(turned(d, about, 3), about, 1) == d);
            CHECK((d.axis() == about.axis() || turned(d, about, 1) == cross(about, d)));
            CHECK((d.axis() == about.axis() || turned(d, about, 2) == -d));
        }
    }
}

TEST_CASE("the turns of the cube are 24 and keep the hand") {
    std::set<std::array<SignedAxis, 3>> seen;
    for (const CubeTurn& turn : cube_turns()) {
        seen.insert(turn.image);
        for (const SignedAxis a : all()) {
            for (const SignedAxis b : all()) {
                const SignedAxis c = cross(a, b);
                CHECK((!c.valid() || turn(c) == cross(turn(a), turn(b))));
            }
        }
    }
    CHECK(seen.size() == 24);
    CHECK(cube_turns().front().image == CubeTurn{}.image);
}
