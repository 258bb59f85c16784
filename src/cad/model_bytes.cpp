#include "model_bytes.hpp"

#include "../common/byte_arrays.hpp"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace pavior::detail {

namespace {

void add_report(const ImprintReport& report, ByteWriter& writer) {
    writer.add(report.overlaps);
    writer.add(report.gaps);
    std::vector<double> thickness;
    for (const SolidPiece& piece : report.pieces) {
        thickness.push_back(piece.thickness);
    }
    writer.add(thickness);
    for (const SolidPiece& piece : report.pieces) {
        writer.add(piece.solids);
    }
}

void get_report(ByteReader& reader, ImprintReport& report) {
    reader.get(report.overlaps);
    reader.get(report.gaps);
    std::vector<double> thickness;
    reader.get(thickness);
    report.pieces.clear();
    for (const double own : thickness) {
        SolidPiece& piece = report.pieces.emplace_back();
        piece.thickness = own;
        reader.get(piece.solids);
    }
}

/// Calls visit(array) for each array of a surface.
template <class Surface, class Visit>
void for_arrays(Surface& surface, Visit&& visit) {
    visit(surface.mesh.nodes);
    visit(surface.mesh.triangles);
    visit(surface.face_tags);
    visit(surface.edges);
    visit(surface.vertices);
}

}  // namespace

std::string to_bytes(const CadTriangulation& triangulation) {
    const TaggedSurface& surface = triangulation.surface;
    ByteWriter writer;
    for_arrays(surface, [&](const auto& array) { writer.add(array); });
    std::vector<std::int32_t> named;
    for (const auto& [tag, name] : surface.face_names) {
        named.push_back(tag);
    }
    writer.add(named);
    for (const auto& [tag, name] : surface.face_names) {
        writer.add(name);
    }
    writer.add(triangulation.inner_facets);
    writer.add(std::vector<double>{triangulation.chord, triangulation.volume});
    add_report(triangulation.imprint, writer);
    return writer.take();
}

CadTriangulation triangulation_from_bytes(const std::string& bytes) {
    CadTriangulation triangulation;
    TaggedSurface& surface = triangulation.surface;
    ByteReader reader(bytes);
    for_arrays(surface, [&](auto& array) { reader.get(array); });
    std::vector<std::int32_t> named;
    reader.get(named);
    for (const std::int32_t tag : named) {
        reader.get(surface.face_names[tag]);
    }
    reader.get(triangulation.inner_facets);
    std::vector<double> numbers;
    reader.get(numbers);
    triangulation.chord = numbers.at(0);
    triangulation.volume = numbers.at(1);
    get_report(reader, triangulation.imprint);
    return triangulation;
}

std::string imprint_to_bytes(const Topology& topology, const ImprintReport& report) {
    ByteWriter writer;
    for (const auto& entities : topology.file_tags) {
        writer.add(std::vector<std::size_t>{entities.size()});
        for (const std::vector<int>& tags : entities) {
            writer.add(tags);
        }
    }
    for (const FaceData& face : topology.faces) {
        writer.add(face.name);
    }
    for (const SolidData& solid : topology.solids) {
        writer.add(solid.name);
    }
    add_report(report, writer);
    return writer.take();
}

void imprint_from_bytes(const std::string& bytes, Topology& topology, ImprintReport& report) {
    ByteReader reader(bytes);
    for (auto& entities : topology.file_tags) {
        std::vector<std::size_t> count;
        reader.get(count);
        entities.resize(count.at(0));
        for (std::vector<int>& tags : entities) {
            reader.get(tags);
        }
    }
    for (FaceData& face : topology.faces) {
        reader.get(face.name);
    }
    for (SolidData& solid : topology.solids) {
        reader.get(solid.name);
    }
    get_report(reader, report);
}

}  // namespace pavior::detail
