#include "check.hpp"

#include "output_files.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <sstream>

namespace pavior::cli {

namespace {

void print_histogram(std::ostream& out, const detail::NamedMetric& metric) {
    constexpr std::size_t width = 50;
    const Statistics& s = *metric.statistics;
    const std::size_t most = *std::max_element(s.histogram.begin(), s.histogram.end());
    out << "\n" << metric.title << "\n";
    for (std::size_t bin = 0; bin < s.histogram.size(); ++bin) {
        const double step = (s.high - s.low) / static_cast<double>(s.histogram.size());
        const double low = s.low + step * static_cast<double>(bin);
        const std::size_t count = s.histogram[bin];
        const std::size_t bar =
            count == 0 ? 0 : std::max<std::size_t>(1, count * width / std::max<std::size_t>(most, 1));
        out << "  " << std::fixed << std::setprecision(2) << std::setw(5) << low << " .. " << std::setw(5) << low + step
            << std::setw(10) << count << "  " << std::string(bar, '#') << "\n";
    }
}

}  // namespace

std::optional<MeshFormat> written_format(const std::string& output, MeshFormat wish, bool written) {
    return written ? std::optional(mesh_format(output, wish)) : std::nullopt;
}

void print_check(std::ostream& out, const HexMeshData& data, const MeshCheck& check) {
    std::ostringstream text;
    text << "nodes        " << check.nodes << "\nhexahedra    " << check.hexahedra << "\nquads        "
         << data.quads.size() << "\ninverted     " << check.quality.inverted << "\nvolume       "
         << std::setprecision(15) << check.verify.volume << "\nconforming   " << (check.verify.ok() ? "yes" : "no")
         << "\n";
    if (!check.verify.ok()) {
        text << "faults:\n" << check.verify.text() << "\n";
    }
    if (check.quality.f_shape.count > 0) {
        text << "\n"
             << std::left << std::setw(28) << "metric" << std::right << std::setw(10) << "min" << std::setw(10)
             << "mean" << std::setw(10) << "max" << std::setw(10) << "stddev"
             << "  worst hexahedron\n";
        for (const detail::NamedMetric& metric : detail::metrics(check.quality)) {
            const Statistics& s = *metric.statistics;
            text << std::left << std::setw(28) << metric.title << std::right << std::fixed << std::setprecision(4)
                 << std::setw(10) << s.min << std::setw(10) << s.mean << std::setw(10) << s.max << std::setw(10)
                 << s.stddev << "  " << s.worst << "\n";
        }
        for (const detail::NamedMetric& metric : detail::metrics(check.quality)) {
            print_histogram(text, metric);
        }
    }
    if (const auto sizes = detail::group_sizes(data); !sizes.empty()) {
        text << "\ngroups\n";
        for (const auto& [group, size] : sizes) {
            text << "  " << (group.first == 3 ? "volume " : "surface") << std::setw(6) << group.second << std::setw(10)
                 << size << "  " << group_name(data, group.first, group.second) << "\n";
        }
    }
    out << text.str();
}

std::string counts_of(const MeshCheck& check) {
    return std::to_string(check.hexahedra) + " hexahedra, " + std::to_string(check.nodes) + " nodes";
}

void print_summary(const std::string& file, const std::string& counts, const MeshCheck& check,
                   const std::optional<CadDeviation>& deviation, double seconds) {
    std::cout << file << ": " << counts << "; scaled Jacobian min " << check.quality.scaled_jacobian.min << ", mean "
              << check.quality.scaled_jacobian.mean << "; " << (deviation ? text_of(*deviation) + "; " : std::string())
              << seconds << " s\n";
}

void print_invalid(const std::string& what, const std::string& faults, bool written) {
    std::cerr << "pavior: " << what << " not valid:\n"
              << faults << "\n"
              << (written ? "written because of --keep-invalid\n" : "nothing was written\n");
}

void append(std::vector<std::string>& warnings, std::vector<std::string> more) {
    warnings.insert(warnings.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) {
        std::cerr << "pavior: warning: " << warning << "\n";
    }
}

std::function<void()> late_report(const MakeCommand& command) {
    return [input = command.input, report = command.report] {
        OutputFiles files(input, {report});
        files.write_report(report, {{"input", input},
                                    {"output", nullptr},
                                    {"out_of_time", true},
                                    {"exit_code", static_cast<int>(exit_not_meshable)}});
        files.commit();
    };
}

CadOptions cad_options(const MakeCommand& command, const Guard& guard) {
    CadOptions options;
    if (const double left = guard.seconds_left(); left > 0) {
        options.trial_seconds = left;
    } else if (command.timeout) {
        options.trial_seconds = 1e8;  // no limit was asked for
    }
    options.stop = guard.stop();
    return options;
}

nlohmann::json lengths_json(const LocalLengths& lengths) {
    nlohmann::json json = nlohmann::json::object();
    const auto add = [&](const char* kind, const std::map<int, double>& sizes) {
        for (const auto& [tag, size] : sizes) {
            json[kind][std::to_string(tag)] = size;
        }
    };
    add("edge", lengths.edge);
    add("face", lengths.face);
    add("solid", lengths.solid);
    for (const auto& [name, size] : lengths.named) {
        json["named"][name] = size;
    }
    return json;
}

}  // namespace pavior::cli
