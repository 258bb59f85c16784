#include "meshed.hpp"

#include <pavior/core/stopwatch.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ostream>
#include <utility>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;
using Outcome = MethodTry::Outcome;

constexpr double sufficient_jacobian = 0.2;
constexpr std::array<MeshMethod, 5> all_methods{MeshMethod::submap, MeshMethod::sweep, MeshMethod::multi_sweep,
                                                MeshMethod::mixed, MeshMethod::block};

/// A valid mesh is better than an invalid one, then the least scaled Jacobian counts.
bool better(const MethodTry& a, const MethodTry& b) {
    return std::pair(a.outcome == Outcome::mesh, a.min_jacobian) >
           std::pair(b.outcome == Outcome::mesh, b.min_jacobian);
}

/// Takes the last mesh if it is better than the one taken so far; the other is dropped.
void take_better(MeshDecision& decision) {
    MethodTry& last = decision.tries.back();
    if (!last.has_mesh()) {
        return;
    }
    if (decision.taken && !better(last, decision.tries[*decision.taken])) {
        last.data = {};
        return;
    }
    if (decision.taken) {
        decision.tries[*decision.taken].data = {};
    }
    decision.taken = decision.tries.size() - 1;
}

std::string plain(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

/// "refused (0.01 s): not_submappable: ... [faces 3, 4]"
std::string line_of(const MethodTry& attempt, bool taken) {
    std::string text(to_string(attempt.method));
    text.append(": ");
    if (attempt.outcome == Outcome::not_tried) {
        return text.append(attempt.reason);
    }
    if (attempt.has_mesh()) {
        text.append(attempt.outcome == Outcome::mesh ? "valid mesh" : "INVALID mesh");
        text.append(taken ? ", taken" : ", not taken");
    } else if (attempt.outcome == Outcome::timed_out) {
        text.append("stopped");
    } else {
        text.append(to_string(attempt.outcome));
    }
    text.append(" (").append(plain(attempt.seconds)).append(" s)");
    if (attempt.has_mesh()) {
        text.append(": ").append(std::to_string(attempt.hexahedra));
        text.append(" hexahedra, least scaled Jacobian ").append(plain(attempt.min_jacobian));
    }
    if (!attempt.reason.empty()) {
        text.append(attempt.has_mesh() ? "; " : ": ").append(attempt.reason);
    }
    for (std::size_t i = 0; i < attempt.faces.size(); ++i) {
        text.append(i == 0 ? " [faces " : ", ").append(std::to_string(attempt.faces[i]));
    }
    return text.append(attempt.faces.empty() ? "" : "]");
}

/// A text of several lines below a branch.
void print_lines(std::ostream& out, const std::string& first, const std::string& others, const std::string& text) {
    std::size_t at = 0;
    for (bool head = true; at != std::string::npos; head = false) {
        const std::size_t end = text.find('\n', at);
        out << (head ? first : others) << text.substr(at, end == std::string::npos ? end : end - at) << "\n";
        at = end == std::string::npos ? end : end + 1;
    }
}

}  // namespace

MeshDecision decide(const GmshBrep& model, std::vector<SolidId> solids, const MeshCommand& command) {
    MeshDecision result;
    result.solids = std::move(solids);
    const double limit = command.timeout * static_cast<double>(result.solids.size());
    const Stopwatch watch;
    for (const MeshMethod method : all_methods) {
        MethodTry attempt;
        attempt.method = method;
        const bool enough = result.valid() && result.tries[*result.taken].min_jacobian >= sufficient_jacobian;
        const double left = limit - watch.total();
        if (command.method && *command.method != method) {
            continue;
        }
        if (method == MeshMethod::mixed && result.solids.size() == 1 && !command.method) {
            continue;
        }
        if (enough) {
            attempt.reason = "not needed";
        } else if (limit > 0 && left <= 0) {
            attempt.reason = "no time left";
            result.out_of_time = true;
        } else {
            const bool last = method == all_methods.back() || command.method.has_value();
            attempt = try_method_in_child(method, model, result.solids, command, limit > 0 ? left / (last ? 1 : 2) : 0);
            result.out_of_time = result.out_of_time || attempt.outcome == Outcome::timed_out;
        }
        result.tries.push_back(std::move(attempt));
        take_better(result);
    }
    return result;
}

std::string solids_text(const GmshBrep& model, std::span<const SolidId> solids) {
    std::string text = solids.size() == 1 ? "solid " : "solids ";
    for (std::size_t i = 0; i < solids.size(); ++i) {
        text.append(i == 0 ? "" : ", ").append(std::to_string(model.tag(3, solids[i].index())));
    }
    return text;
}

void print_tree(std::ostream& out, const GmshBrep& model, const MeshCommand& command,
                std::span<const MeshDecision> decisions) {
    out << command.input << "\n";
    for (std::size_t d = 0; d < decisions.size(); ++d) {
        const MeshDecision& decision = decisions[d];
        const std::string trunk = d + 1 < decisions.size() ? "|  " : "   ";
        out << (d + 1 < decisions.size() ? "|- " : "`- ") << solids_text(model, decision.solids) << ": "
            << (decision.taken ? std::string(to_string(decision.tries[*decision.taken].method)) : "not meshable")
            << "\n";
        for (std::size_t t = 0; t < decision.tries.size(); ++t) {
            const MethodTry& attempt = decision.tries[t];
            const bool last = t + 1 == decision.tries.size();
            const std::string below = trunk + (last ? "   " : "|  ");
            print_lines(out, trunk + (last ? "`- " : "|- "), below, line_of(attempt, decision.taken == t));
            for (std::size_t n = 0; n < attempt.notes.size(); ++n) {
                const bool end = n + 1 == attempt.notes.size();
                print_lines(out, below + (end ? "`- " : "|- "), below + (end ? "   " : "|  "), attempt.notes[n]);
            }
        }
    }
}

Json to_json(const GmshBrep& model, const MeshDecision& decision) {
    Json json{{"solids", Json::array()}, {"out_of_time", decision.out_of_time}, {"tries", Json::array()}};
    for (const SolidId solid : decision.solids) {
        json["solids"].push_back(model.tag(3, solid.index()));
    }
    json["method"] = decision.taken ? Json(to_string(decision.tries[*decision.taken].method)) : Json();
    for (const MethodTry& attempt : decision.tries) {
        Json entry{{"method", to_string(attempt.method)},
                   {"outcome", to_string(attempt.outcome)},
                   {"reason", attempt.reason},
                   {"faces", attempt.faces},
                   {"seconds", attempt.seconds},
                   {"notes", attempt.notes},
                   {"warnings", attempt.warnings},
                   {"hexahedra", attempt.hexahedra},
                   {"details", attempt.details}};
        entry["scaled_jacobian"] = attempt.has_mesh() ? Json(attempt.min_jacobian) : Json();
        json["tries"].push_back(std::move(entry));
    }
    return json;
}

}  // namespace pavior::cli
