#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"
#include "support/voxel_cutter.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/part/decompose_solids.hpp>
#include <pavior/part/detail/hex_jacobian.hpp>
#include <pavior/part/mesh_part.hpp>
#include <pavior/part/try_method.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

constexpr auto endless = [] { return false; };

/// A stair of two steps, a block on its foot.
Voxels stair_and_block() {
    Voxels voxels(2, 1, 2);
    voxels.fill({0, 0, 0}, {2, 1, 2}, 1);
    voxels.fill({1, 0, 1}, {2, 1, 2}, 2);
    return voxels;
}

Vec3 middle_of(const TestBrep& b, FaceId f) {
    Vec3 low = b.edge_point(b.face_loops(f)[0][0].edge, 0);
    Vec3 high = low;
    for (const OrientedEdge& use : b.face_loops(f)[0]) {
        const Vec3 x = b.vertex_point(b.edge_vertices(use.edge)[0]);
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    return 0.5 * (low + high);
}

Vec3 normal_of(const TestBrep& b, FaceId f) {
    const auto [du, dv] = b.face_derivatives(f, Vec2::Zero());
    return du.cross(dv).normalized();
}

/// Whether \p x, the middle of a face of boxes with normals along \p n, is in a face: by counting sides of its loops.
bool holds(const TestBrep& b, FaceId f, const Vec3& x, const Vec3& n) {
    const Vec3 own = normal_of(b, f);
    if (own.cross(n).norm() > 1e-9 || std::abs((x - b.face_point(f, Vec2::Zero())).dot(own)) > 1e-9) {
        return false;
    }
    const Vec3 u = own.unitOrthogonal();
    const Vec3 v = own.cross(u);
    bool inside = false;
    for (const EdgeLoop& loop : b.face_loops(f)) {
        for (const OrientedEdge& use : loop) {
            const Vec3 p = b.edge_point(use.edge, 0) - x, q = b.edge_point(use.edge, 1) - x;
            const double a = p.dot(v), c = q.dot(v);
            if ((a < 0) != (c < 0) && p.dot(u) - a * (q.dot(u) - p.dot(u)) / (c - a) > 0) {
                inside = !inside;
            }
        }
    }
    return inside;
}

/// A brep whose faces and solids are given tags later.
class Tagged : public archetype::Brep<TestBrep> {
public:
    using Brep::Brep;
    [[nodiscard]] int tag(int dim, std::size_t index) const {
        const auto& given = dim == 3 ? solids : faces;
        return dim < 2 || given.empty() ? Brep::tag(dim, index) : given.at(index);
    }
    std::vector<int> faces, solids;
};

/// Solids of boxes as a model that can be cut by the planes of their lattice.
class Cuttable {
public:
    explicit Cuttable(const Voxels& voxels, bool flipped = false) : whole_(voxels, flipped), cutter_(voxels) {
        cutter_.flipped = !flipped;  // faces of pieces are turned against those of the model
    }
    [[nodiscard]] const TestBrep& brep() const { return whole_.brep(); }
    [[nodiscard]] std::size_t calls() const { return cutter_.calls; }

    std::optional<ModelPieces> operator()(std::span<const SolidCut> cuts) {
        std::optional<VoxelPieces> made = cutter_(cuts);
        if (!made) {
            return std::nullopt;
        }
        const auto kept = std::make_shared<Kept>(std::move(*made));
        return ModelPieces{std::shared_ptr<const AnyModel>(kept, &kept->any), kept->pieces.solid,
                           GridCap<TestBrep>{&*kept->pieces.model}, [this, kept] { return identify(*kept); }};
    }

private:
    struct Kept {
        VoxelPieces pieces;
        Tagged tagged;
        AnyModel any;
        explicit Kept(VoxelPieces p) : pieces(std::move(p)), tagged(*pieces.model), any(tagged) {}
    };

    std::vector<FaceId> identify(Kept& kept) const {
        const TestBrep& b = *kept.pieces.model;
        std::vector<FaceId> faces(b.face_count());
        kept.tagged.faces.clear();
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const FaceId piece{static_cast<std::int32_t>(f)};
            for (std::size_t w = 0; w < brep().face_count(); ++w) {
                const FaceId whole{static_cast<std::int32_t>(w)};
                if (holds(brep(), whole, middle_of(b, piece), normal_of(b, piece))) {
                    faces[f] = whole;
                }
            }
            const std::size_t fresh = brep().face_count() + f;
            kept.tagged.faces.push_back(brep().tag(2, faces[f].valid() ? faces[f].index() : fresh));
        }
        kept.tagged.solids.clear();
        for (const SolidId s : kept.pieces.solid) {
            kept.tagged.solids.push_back(brep().tag(3, s.index()));
        }
        return faces;
    }

    VoxelBrep whole_;
    VoxelCutter cutter_;
};

Kernels kernels(Cuttable& model) {
    const auto no_tetrahedra = [](SolidId, double, const FeatureOptions&) -> BlockReference {
        throw UnmeshableError(ErrorCode::tetrahedra_failed, "no tetrahedra here");
    };
    Kernels result{imprint, GlpkSolver{}, GmshRegionMesher{}, GridCap<TestBrep>{&model.brep()}, no_tetrahedra};
    result.cut = std::ref(model);
    return result;
}

/// By try_method(), and with a note of what was asked.
struct Mesher {
    const Kernels& own;
    std::vector<PartMethod> asked = {};

    MethodTry operator()(PartMethod method, const ModelPieces& pieces, std::span<const SolidId> solids) {
        asked.push_back(method);
        Kernels with_caps = own;
        with_caps.caps = pieces.caps;
        PartOptions options;
        options.size = 0.5;
        return try_method(method, *pieces.model, solids, options, with_caps, {.out_of_time = endless});
    }
};

DecomposedSolids decomposed(Cuttable& model, const std::vector<SolidId>& solids, const PieceMesher& mesh,
                            const std::function<bool()>& out_of_time = endless, const CutSearchOptions& options = {}) {
    const AnyModel any(model.brep());
    return decompose_solids(any, solids, std::ref(model), GlpkSolver{}, mesh, out_of_time, options);
}

/// The normal of a face that leaves the first of its solids.
Vec3 outward_of(const TestBrep& b, FaceId face) {
    for (const SolidId s : all_solids(b)) {
        for (const OrientedFace& f : b.solid_faces(s)) {
            if (f.face == face) {
                return (f.outward ? 1 : -1) * normal_of(b, face);
            }
        }
    }
    return Vec3::Zero();
}

/// Hexahedra and quads belong to solids and faces of the model, quads are those of its faces alone, and look outward.
template <class Mesh>
void check_told(const TestBrep& b, const std::vector<SolidId>& solids, const Mesh& mesh) {
    const HexMeshData& data = mesh.data;
    REQUIRE(mesh.hex_solid.size() == data.mesh.hexes.size());
    for (std::size_t h = 0; h < mesh.hex_solid.size(); ++h) {
        CHECK(std::find(solids.begin(), solids.end(), mesh.hex_solid[h]) != solids.end());
        CHECK(data.hex_groups[h] == b.tag(3, mesh.hex_solid[h].index()));
    }
    REQUIRE(data.quads.size() == mesh.quad_face.size());
    REQUIRE(data.quads.size() == data.quad_groups.size());
    std::set<FaceId> wanted, found;
    for (const SolidId s : solids) {
        for (const OrientedFace& f : b.solid_faces(s)) {
            wanted.insert(f.face);
        }
    }
    for (std::size_t q = 0; q < data.quads.size(); ++q) {
        const FaceId f = mesh.quad_face[q];
        REQUIRE(f.valid());
        REQUIRE(f.index() < b.face_count());
        found.insert(f);
        CHECK(data.quad_groups[q] == b.tag(2, f.index()));
        const auto& x = data.mesh.nodes;
        const Vec3 n = (x[data.quads[q][2]] - x[data.quads[q][0]]).cross(x[data.quads[q][3]] - x[data.quads[q][1]]);
        CHECK(n.normalized().dot(outward_of(b, f)) == Approx(1));
        for (const Index i : data.quads[q]) {
            CHECK(std::abs((x[i] - b.face_point(f, Vec2::Zero())).dot(normal_of(b, f))) < 1e-9);
        }
    }
    CHECK(found == wanted);
    for (const MeshGroup& group : data.groups) {
        CHECK(group.number > 0);
        CHECK(group.number <= static_cast<int>(group.dimension == 3 ? b.solid_count() : b.face_count()));
    }
}

}  // namespace

TEST_CASE("Pieces are meshed together, and the mesh is told of the solids and faces that it was cut from") {
    for (const bool flipped : {false, true}) {
        Cuttable model(star(), flipped);
        const std::vector<SolidId> solids{SolidId{0}};
        const Kernels own = kernels(model);
        Mesher mesher{own};
        const DecomposedSolids found = decomposed(model, solids, std::ref(mesher));
        REQUIRE(found.mesh.outcome == TryOutcome::mesh);
        CHECK(found.search.quality == found.mesh.min_jacobian);
        CHECK(found.search.quality >= 0.2);
        CHECK(detail::least_scaled_jacobian(found.mesh.data.mesh) == found.search.quality);
        CHECK(found.search.tried == model.calls());
        CHECK_FALSE(found.search.cuts.empty());
        const std::optional<ModelPieces> pieces = model(found.search.cuts);
        REQUIRE(pieces);
        CHECK(found.methods.size() == pieces->solid.size());
        CHECK(pieces->solid.size() > 1);
        check_told(model.brep(), solids, found.mesh);
        const HexReport check = verify_hexes(found.mesh.data.mesh);
        CHECK(check.ok());
        CHECK(check.volume == Approx(7));
        CHECK(check.boundary_quads == found.mesh.data.quads.size());
        for (const PartMethod method : mesher.asked) {
            CHECK((method == PartMethod::submap || method == PartMethod::sweep || method == PartMethod::multi_sweep ||
                   method == PartMethod::mixed));
        }
        CHECK(std::find(mesher.asked.begin(), mesher.asked.end(), found.mesh.method) != mesher.asked.end());
    }
}

TEST_CASE("Solids that touch keep the face between them, and each its own") {
    Cuttable model(stair_and_block());
    const std::vector<SolidId> solids{SolidId{0}, SolidId{1}};
    const Kernels own = kernels(model);
    Mesher mesher{own};
    const DecomposedSolids found = decomposed(model, solids, std::ref(mesher));
    REQUIRE(found.mesh.outcome == TryOutcome::mesh);
    check_told(model.brep(), solids, found.mesh);
    CHECK(std::count(found.mesh.hex_solid.begin(), found.mesh.hex_solid.end(), SolidId{1}) > 0);
    CHECK(verify_hexes(found.mesh.data.mesh).volume == Approx(4));
}

TEST_CASE("What is refused for all cuts has no mesh") {
    Cuttable model(star());
    std::size_t asked = 0;
    const DecomposedSolids none =
        decomposed(model, {SolidId{0}}, [&](PartMethod method, const ModelPieces&, std::span<const SolidId>) {
            ++asked;
            MethodTry result;
            result.method = method;
            result.outcome = TryOutcome::refused;
            return result;
        });
    CHECK(asked > 0);
    CHECK(none.search.cuts.empty());
    CHECK(none.search.quality < 0);
    CHECK(none.mesh.outcome != TryOutcome::mesh);
    CHECK(none.mesh.data.mesh.hexes.empty());
}

TEST_CASE("A mesh that is not valid counts for nothing") {
    Cuttable model(star());
    const Kernels own = kernels(model);
    Mesher mesher{own};
    const DecomposedSolids none = decomposed(
        model, {SolidId{0}}, [&](PartMethod method, const ModelPieces& pieces, std::span<const SolidId> solids) {
            MethodTry result = mesher(method, pieces, solids);
            result.outcome = TryOutcome::invalid;
            return result;
        });
    CHECK_FALSE(mesher.asked.empty());
    CHECK(none.mesh.outcome != TryOutcome::mesh);
    CHECK(none.search.quality < 0);
}

TEST_CASE("Of several poor meshes the best is kept, with its cuts") {
    Cuttable model(star());
    const Kernels own = kernels(model);
    Mesher mesher{own};
    std::vector<double> made;
    CutSearchOptions options;
    options.sufficient = 2;
    options.max_meshes = 4;
    const DecomposedSolids found = decomposed(
        model, {SolidId{0}},
        [&](PartMethod method, const ModelPieces& pieces, std::span<const SolidId> solids) {
            MethodTry result = mesher(method, pieces, solids);
            if (result.outcome == TryOutcome::mesh && solids.size() == pieces.solid.size()) {  // all together
                result.min_jacobian = 0.05 + 0.01 * static_cast<double>(7 * made.size() % 5);
                made.push_back(result.min_jacobian);
            }
            return result;
        },
        endless, options);
    REQUIRE(made.size() > 1);
    CHECK(found.search.meshed <= 4);
    CHECK(found.mesh.min_jacobian == *std::max_element(made.begin(), made.end()));
    CHECK(found.search.quality == found.mesh.min_jacobian);
    CHECK(model(found.search.cuts)->solid.size() == found.methods.size());
    CHECK(verify_hexes(found.mesh.data.mesh).volume == Approx(7));
}

TEST_CASE("Nothing is meshed once the time is over, and a stop is heeded") {
    Cuttable model(star());
    const Kernels own = kernels(model);
    Mesher mesher{own};
    const DecomposedSolids late = decomposed(model, {SolidId{0}}, std::ref(mesher), [] { return true; });
    CHECK(mesher.asked.empty());
    CHECK(late.mesh.outcome != TryOutcome::mesh);
    std::stop_source source;
    source.request_stop();
    CutSearchOptions options;
    options.stop = source.get_token();
    CHECK_THROWS_AS(decomposed(model, {SolidId{0}}, std::ref(mesher), endless, options), Stopped);
}

TEST_CASE("The method by itself: cuts are data of the try and stand in its notes") {
    Cuttable model(star());
    PartOptions options;
    options.size = 0.5;
    options.methods = {PartMethod::decompose};
    const PartMesh part = mesh_part(model.brep(), options, kernels(model));
    INFO(reason_of(part));
    REQUIRE(part.valid());
    const MethodTry& taken = part.decisions[0].tries[0];
    CHECK(taken.method == PartMethod::decompose);
    REQUIRE_FALSE(taken.cuts.empty());
    REQUIRE(taken.notes.size() > taken.cuts.size());
    CHECK_THAT(taken.notes[0], Catch::Contains("plane through ("));
    CHECK_THAT(taken.notes[taken.cuts.size()], Catch::Contains(" pieces, by "));
    CHECK(part.check.verify.volume == Approx(7));
    CHECK(part.entities.distance < 1e-9);
    check_told(model.brep(), {SolidId{0}}, part);
    const std::optional<ModelPieces> pieces = model(taken.cuts);
    REQUIRE(pieces);
    CHECK(taken.notes[taken.cuts.size()].find(std::to_string(pieces->solid.size()).append(" pieces")) == 0);

    const PartMesh again = mesh_part(model.brep(), options, kernels(model));
    CHECK(again.data.mesh.nodes == part.data.mesh.nodes);
    CHECK(again.data.mesh.hexes == part.data.mesh.hexes);
    options.execution.threads = 2;
    const PartMesh two = mesh_part(model.brep(), options, kernels(model));
    CHECK(two.data.mesh.nodes == part.data.mesh.nodes);
    CHECK(two.data.quads == part.data.quads);
}

TEST_CASE("Without a cutter nothing is cut: the method died, and is not tried among others") {
    Cuttable model(star());
    Kernels none = kernels(model);
    none.cut = nullptr;
    PartOptions options;
    options.size = 0.5;
    options.methods = {PartMethod::decompose};
    const PartMesh part = mesh_part(model.brep(), options, none);
    CHECK_FALSE(part.complete());
    CHECK(part.decisions[0].tries[0].outcome == TryOutcome::died);
    CHECK_THAT(part.decisions[0].tries[0].reason, Catch::Contains("cut"));
    options.methods = {};
    const auto tries_of = [&](const Kernels& own) {
        std::set<PartMethod> methods;
        const PartMesh mesh = mesh_part(model.brep(), options, own);
        for (const MethodTry& one : mesh.decisions[0].tries) {
            methods.insert(one.method);
        }
        return methods;
    };
    CHECK_FALSE(tries_of(none).contains(PartMethod::decompose));
    CHECK(tries_of(kernels(model)).contains(PartMethod::decompose));
    options.decompose = false;
    CHECK_FALSE(tries_of(kernels(model)).contains(PartMethod::decompose));
}

TEST_CASE("A solid that nothing cuts is refused, and told how much was tried") {
    Voxels voxels(1, 1, 1);
    voxels.fill({0, 0, 0}, {1, 1, 1}, 1);
    Cuttable model(voxels);
    PartOptions options;
    options.methods = {PartMethod::decompose};
    const PartMesh part = mesh_part(model.brep(), options, kernels(model));
    CHECK_FALSE(part.complete());
    const MethodTry& refused = part.decisions[0].tries[0];
    CHECK(refused.outcome == TryOutcome::refused);
    CHECK_THAT(refused.reason, Catch::Contains("no cuts were found"));
    CHECK(refused.cuts.empty());
    CHECK(refused.data.mesh.hexes.empty());
}
