#pragma once

#include <pavior/marking/judge_marking.hpp>

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace pavior {

PAVIOR_INLINE void judge_marking(const ReferenceMesh& mesh, const CellSnapshot& now, const MarkingOptions& options,
                                 SheetReport& report) {
    report.valid = now.report.valid();
    report.violations = now.report.violations;
    report.blocks = now.complex.corners.size();
    report.nodes = now.complex.cell_count();
    for (Sheet& sheet : report.sheets) {
        sheet.faces = 0;
    }
    for (const Index sheet : report.layer_sheets) {
        ++report.sheets[sheet].faces;
    }
    report.quality = -1;
    report.aspect = 0;
    if (report.valid) {
        const CellQuality simple = simple_quality(mesh, now);
        report.quality = options.quality ? options.quality(mesh) : simple.jacobian;
        report.aspect = simple.aspect;
    }
}

PAVIOR_INLINE bool better_marking(const SheetReport& a, const SheetReport& b) {
    const auto key = [](const SheetReport& r) {
        return std::tuple(r.valid, r.valid && r.quality > 0, std::min(r.quality, 0.2),
                          -static_cast<double>(r.violations.size()), -static_cast<double>(r.blocks));
    };
    return key(a) > key(b);
}

}  // namespace pavior
