#include "support/catch.hpp"

#include <pavior/mesh/verify_report.hpp>

#include <set>
#include <string>

using namespace pavior;

TEST_CASE("a sound mesh has an empty report") {
    const VerifyReport report;
    CHECK(report.ok());
    CHECK(report.first() == nullptr);
    CHECK(report.find(MeshFault::inverted) == nullptr);
    CHECK(report.count(MeshFault::inverted) == 0);
    CHECK(report.text().empty());
    CHECK_NOTHROW(report.throw_if_bad());
}

TEST_CASE("findings come in the order of their kinds, with exact counts and capped ids") {
    VerifyReport report(2);
    report.add(MeshFault::unused_node, {5});
    report.add(MeshFault::same_sense, {1, 2});
    report.add(MeshFault::unused_node, {6});
    report.add(MeshFault::unused_node, {7});
    REQUIRE(report.findings().size() == 2);
    CHECK(*report.first() == Finding{MeshFault::same_sense, 1, 2, {1, 2}});
    CHECK(*report.find(MeshFault::unused_node) == Finding{MeshFault::unused_node, 3, 1, {5, 6}});
    CHECK(report.text() == "1 edges or faces used twice in the same sense: 1 2\n3 nodes of no cell: 5, 6 ...");
    try {
        report.throw_if_bad();
        FAIL("did not throw");
    } catch (const InputError& error) {
        CHECK(error.code() == ErrorCode::bad_orientation);
        CHECK(error.ids() == Error::Ids{1, 2});
        CHECK(std::string(error.what()) == "bad_orientation: " + report.text());
    }
}

TEST_CASE("reports of pieces join in order") {
    VerifyReport first(3);
    VerifyReport second(3);
    first.add(MeshFault::inverted, {1});
    first.add(MeshFault::inverted, {2});
    second.add(MeshFault::inverted, {8});
    second.add(MeshFault::inverted, {9});
    second.add(MeshFault::empty, {});
    first.append(second);
    CHECK(first.first()->fault == MeshFault::empty);
    CHECK(*first.find(MeshFault::inverted) == Finding{MeshFault::inverted, 4, 1, {1, 2, 8}});
}

TEST_CASE("every fault has a phrase and an error of its own or shared") {
    std::set<std::string_view> phrases;
    for (int i = 0; i <= static_cast<int>(MeshFault::disconnected); ++i) {
        phrases.insert(to_string(static_cast<MeshFault>(i)));
    }
    CHECK(phrases.size() == 16);
    CHECK(phrases.count("unknown") == 0);
    CHECK(error_code(MeshFault::not_finite) == ErrorCode::not_finite);
    CHECK(error_code(MeshFault::inverted) == ErrorCode::inverted_cell);
    CHECK(error_code(MeshFault::boundary_extra) == ErrorCode::inconsistent_boundary);
}
