#pragma once

#include <pavior/mesh/verify_report.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>

namespace pavior {

PAVIOR_INLINE std::string VerifyReport::text() const {
    std::string lines;
    for (const Finding& finding : findings_) {
        lines += lines.empty() ? "" : "\n";
        lines += std::to_string(finding.count) + " " + std::string(to_string(finding.fault));
        for (std::size_t i = 0; i < finding.ids.size(); ++i) {
            lines += i == 0 ? ": " : i % finding.ids_per_item == 0 ? ", " : " ";
            lines += std::to_string(finding.ids[i]);
        }
        lines += finding.ids.size() < finding.count * finding.ids_per_item && !finding.ids.empty() ? " ..." : "";
    }
    return lines;
}

PAVIOR_INLINE void VerifyReport::add(MeshFault fault, std::initializer_list<std::int64_t> ids) {
    Finding& finding = slot(fault, ids.size());
    if (finding.count++ < cap_) {
        finding.ids.insert(finding.ids.end(), ids.begin(), ids.end());
    }
}

PAVIOR_INLINE void VerifyReport::append(const VerifyReport& other) {
    for (const Finding& more : other.findings_) {
        Finding& finding = slot(more.fault, more.ids_per_item);
        finding.count += more.count;
        const std::size_t room = cap_ * finding.ids_per_item - finding.ids.size();
        const auto taken = static_cast<std::ptrdiff_t>(std::min(room, more.ids.size()));
        finding.ids.insert(finding.ids.end(), more.ids.begin(), more.ids.begin() + taken);
    }
}

PAVIOR_INLINE std::size_t VerifyReport::position(MeshFault fault) const {
    std::size_t at = 0;
    while (at < findings_.size() && findings_[at].fault < fault) {
        ++at;
    }
    return at;
}

PAVIOR_INLINE Finding& VerifyReport::slot(MeshFault fault, std::size_t ids_per_item) {
    const std::size_t at = position(fault);
    if (at == findings_.size() || findings_[at].fault != fault) {
        findings_.insert(findings_.begin() + static_cast<std::ptrdiff_t>(at),
                         Finding{fault, 0, std::max<std::size_t>(ids_per_item, 1), {}});
    }
    return findings_[at];
}

}  // namespace pavior
