#include <pavior/tetra/check_surface.hpp>

#include <algorithm>
#include <utility>

namespace pavior {

std::string_view to_string(SurfaceFault fault) noexcept {
    switch (fault) {
        case SurfaceFault::empty: return "surface without triangles";
        case SurfaceFault::not_finite: return "triangles with coordinates that are not finite";
        case SurfaceFault::id_out_of_range: return "triangles with node ids out of range";
        case SurfaceFault::repeated_node: return "triangles that repeat a node";
        case SurfaceFault::unused_node: return "nodes of no triangle";
        case SurfaceFault::degenerate: return "triangles without area";
        case SurfaceFault::duplicate: return "triangles on the same nodes";
        case SurfaceFault::coincident_nodes: return "pairs of nodes in one place (shells touch there, or weld them)";
        case SurfaceFault::open_edge: return "edges where the surface is open";
        case SurfaceFault::overused_edge: return "edges of more than two triangles";
        case SurfaceFault::same_sense: return "edges whose triangles see different sides";
        case SurfaceFault::touching_node: return "nodes where two parts of the surface touch";
        case SurfaceFault::intersection: return "pairs of triangles that intersect";
        case SurfaceFault::inside_out: return "shells turned inside out";
    }
    return "unknown";
}

ErrorCode error_code(SurfaceFault fault) noexcept {
    switch (fault) {
        case SurfaceFault::empty: return ErrorCode::empty_input;
        case SurfaceFault::not_finite: return ErrorCode::not_finite;
        case SurfaceFault::id_out_of_range:
        case SurfaceFault::repeated_node: return ErrorCode::bad_index;
        case SurfaceFault::unused_node: return ErrorCode::unused_node;
        case SurfaceFault::degenerate: return ErrorCode::degenerate_triangle;
        case SurfaceFault::coincident_nodes: return ErrorCode::duplicate_node;
        case SurfaceFault::open_edge: return ErrorCode::open_surface;
        case SurfaceFault::same_sense:
        case SurfaceFault::inside_out: return ErrorCode::bad_orientation;
        case SurfaceFault::intersection: return ErrorCode::self_intersection;
        case SurfaceFault::duplicate:
        case SurfaceFault::overused_edge:
        case SurfaceFault::touching_node: return ErrorCode::non_manifold;
    }
    return ErrorCode::non_manifold;
}

namespace {

constexpr std::size_t most_items = 16;

std::string joined(const std::vector<Index>& ids) {
    std::string text;
    for (const Index id : ids) {
        text += (text.empty() ? "" : " ") + std::to_string(id);
    }
    return text;
}

std::string text_of(const SurfaceFinding::Item& item) {
    const std::string triangles =
        item.triangles.empty() ? ""
                               : (item.triangles.size() == 1 ? "triangle " : "triangles ") + joined(item.triangles);
    if (item.nodes.empty()) {
        return triangles;
    }
    const std::string nodes = (item.nodes.size() == 1 ? "node " : "nodes ") + joined(item.nodes);
    return triangles.empty() ? nodes : nodes + " (" + triangles + ")";
}

}  // namespace

const SurfaceFinding* SurfaceReport::find(SurfaceFault fault) const {
    const auto at = std::find_if(findings_.begin(), findings_.end(),
                                 [&](const SurfaceFinding& finding) { return finding.fault == fault; });
    return at == findings_.end() ? nullptr : &*at;
}

std::size_t SurfaceReport::count(SurfaceFault fault) const {
    const SurfaceFinding* finding = find(fault);
    return finding == nullptr ? 0 : finding->count;
}

std::string SurfaceReport::text() const {
    std::string lines;
    for (const SurfaceFinding& finding : findings_) {
        lines +=
            (lines.empty() ? "" : "\n") + std::to_string(finding.count) + " " + std::string(to_string(finding.fault));
        for (std::size_t i = 0; i < finding.items.size(); ++i) {
            lines += (i == 0 ? ": " : ", ") + text_of(finding.items[i]);
        }
        lines += finding.items.size() < finding.count ? " ..." : "";
    }
    return lines;
}

void SurfaceReport::throw_if_bad() const {
    if (ok()) {
        return;
    }
    Error::Ids triangles;
    Error::Ids nodes;
    for (const SurfaceFinding::Item& item : findings_.front().items) {
        triangles.insert(triangles.end(), item.triangles.begin(), item.triangles.end());
        nodes.insert(nodes.end(), item.nodes.begin(), item.nodes.end());
    }
    Error::Ids& ids = triangles.empty() ? nodes : triangles;
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    throw InputError(error_code(findings_.front().fault), text(), ids);
}

void SurfaceReport::add(SurfaceFault fault, SurfaceFinding::Item item) {
    auto at = std::find_if(findings_.begin(), findings_.end(),
                           [&](const SurfaceFinding& finding) { return finding.fault >= fault; });
    if (at == findings_.end() || at->fault != fault) {
        at = findings_.insert(at, SurfaceFinding{fault, 0, {}});
    }
    if (at->count++ < most_items) {
        at->items.push_back(std::move(item));
    }
}

}  // namespace pavior
