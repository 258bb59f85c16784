#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/marking/judge_marking.hpp>

using namespace pavior;

TEST_CASE("a marking is judged by the cells that it makes") {
    const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(2, 1, 1));
    SheetReport report;
    report.sheets = {{SheetKind::given, {}, 7}};
    report.layer_sheets.assign(mesh.layers.size(), 0);
    judge_marking(mesh, cell_snapshot(mesh), {}, report);
    CHECK(report.valid);
    CHECK(report.blocks == 16);
    CHECK(report.nodes == 3 * 3 * 5);
    CHECK(report.sheets[0].faces == mesh.layers.size());
    CHECK(report.quality == Approx(1.0));
    MarkingOptions options;
    options.quality = [](const ReferenceMesh&) { return 0.25; };
    judge_marking(mesh, cell_snapshot(mesh), options, report);
    CHECK(report.quality == 0.25);
}

TEST_CASE("valid comes first, then positive blocks, then their quality, then fewer of them") {
    SheetReport bad;
    bad.violations.resize(2);
    SheetReport worse = bad;
    worse.violations.resize(3);
    SheetReport inverted;
    inverted.valid = true;
    inverted.quality = -0.1;
    SheetReport thin = inverted;
    thin.quality = 0.1;
    SheetReport good = inverted;
    good.quality = 0.3;
    good.blocks = 20;
    SheetReport fewer = good;
    fewer.quality = 0.25;
    fewer.blocks = 10;
    CHECK(better_marking(bad, worse));
    CHECK(better_marking(inverted, bad));
    CHECK(better_marking(thin, inverted));
    CHECK(better_marking(good, thin));
    CHECK(better_marking(fewer, good));
    CHECK_FALSE(better_marking(good, good));
}
