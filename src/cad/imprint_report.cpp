#include <pavior/cad/imprint_report.hpp>

#include <pavior/core/error.hpp>

#include <sstream>

namespace pavior {

std::vector<std::string> warnings_of(const ImprintReport& report) {
    std::vector<std::string> warnings;
    for (const SolidOverlap& overlap : report.overlaps) {
        std::ostringstream text;
        const auto [a, b] = overlap.solids;
        switch (overlap.kind) {
            case OverlapKind::overlap: text << "solids " << a << " and " << b << " overlap"; break;
            case OverlapKind::nested: text << "solid " << b << " lies inside solid " << a; break;
            case OverlapKind::duplicate: text << "solids " << a << " and " << b << " are the same"; break;
        }
        text << ", the volume in both is " << overlap.volume << ": it is meshed once";
        warnings.push_back(text.str());
    }
    for (const SolidGap& gap : report.gaps) {
        std::ostringstream text;
        text << "solids " << gap.solids[0] << " and " << gap.solids[1] << " are " << gap.distance
             << " apart and are meshed apart; an imprint tolerance above that closes the gap";
        warnings.push_back(text.str());
    }
    return warnings;
}

void refuse_slices(const ImprintReport& report, double size) {
    if (report.pieces.empty() || !(report.pieces.front().thickness < size / 100)) {
        return;
    }
    const SolidPiece& slice = report.pieces.front();
    std::ostringstream text;
    for (std::size_t i = 0; i < slice.solids.size(); ++i) {
        text << (i == 0 ? (slice.solids.size() == 1 ? "solid " : "solids ") : ", ") << slice.solids[i];
    }
    text << ": where solids cut each other a slice of thickness " << slice.thickness
         << " is left, less than a hundredth of the size " << size
         << "; an imprint tolerance above that joins its sides, or slices must be allowed";
    throw UnmeshableError(ErrorCode::cad_failure, text.str(), Error::Ids(slice.solids.begin(), slice.solids.end()));
}

}  // namespace pavior
