#include "made_mesh.hpp"
#include "progress_bar.hpp"

#include <pavior/cad/cut_model.hpp>
#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/part/mesh_file.hpp>

#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <span>
#include <utility>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;

constexpr double default_seconds = 60;  // for reading, and a solid

std::string plain(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

/// "refused (0.01 s): not_submappable: ... [faces 3, 4]"
std::string line_of(const MethodTry& attempt, bool taken) {
    std::string text(to_string(attempt.method));
    text.append(attempt.method == PartMethod::split ? ": last resort, " : ": ");
    if (attempt.outcome == TryOutcome::not_tried) {
        return text.append(attempt.reason);
    }
    if (attempt.has_mesh()) {
        text.append(attempt.outcome == TryOutcome::mesh ? "valid mesh" : "INVALID mesh");
        text.append(taken ? ", taken" : ", not taken");
    } else if (attempt.outcome == TryOutcome::timed_out) {
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

/// "solid 3" or "solids 1, 2".
std::string solids_text(const GmshBrep& model, std::span<const SolidId> solids) {
    std::string text = solids.size() == 1 ? "solid " : "solids ";
    for (std::size_t i = 0; i < solids.size(); ++i) {
        text.append(i == 0 ? "" : ", ").append(std::to_string(model.tag(3, solids[i].index())));
    }
    return text;
}

void print_tree(std::ostream& out, const GmshBrep& model, const MeshCommand& command,
                std::span<const PartDecision> decisions) {
    out << command.input << "\n";
    for (std::size_t d = 0; d < decisions.size(); ++d) {
        const PartDecision& decision = decisions[d];
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

Json to_json(const GmshBrep& model, const PartDecision& decision) {
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
                   {"details", attempt.report.empty() ? Json::object() : Json::parse(attempt.report)}};
        entry["scaled_jacobian"] = attempt.has_mesh() ? Json(attempt.min_jacobian) : Json();
        json["tries"].push_back(std::move(entry));
    }
    return json;
}

Json report_of(const MeshCommand& command, const GmshBrep& model, const PartMesh& part) {
    Json json{{"input", command.input}, {"output", Json()}, {"decisions", Json::array()}};
    json["options"] = {{"size", command.size > 0 ? command.size : model.diagonal() / 12},
                       {"method", command.method ? Json(to_string(*command.method)) : Json("auto")},
                       {"last_resort", !command.method && command.last_resort},
                       {"decompose", !command.method && command.decompose},
                       {"max_angle", command.max_angle},
                       {"imprint_tolerance", command.imprint_tolerance},
                       {"timeout", command.timeout ? Json(*command.timeout) : Json()},
                       {"local_sizes", lengths_json(command.local)}};
    json["warnings"] = part.warnings;
    for (const PartDecision& decision : part.decisions) {
        json["decisions"].push_back(to_json(model, decision));
        if (decision.taken) {
            for (const std::string& warning : decision.tries[*decision.taken].warnings) {
                json["warnings"].push_back(warning);
            }
        }
    }
    return json;
}

/// All lines but the first moved to the right.
std::string indented(std::string text) {
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) {
        text.insert(at + 1, "    ");
    }
    return text;
}

/// Why there is no mesh, solid by solid, method by method.
ExitCode refuse(const MeshCommand& command, const GmshBrep& model, const PartMesh& part, Json json, double seconds,
                OutputFiles& files) {
    json["seconds"] = seconds;
    json["exit_code"] = static_cast<int>(exit_not_meshable);
    files.write_report(command.report, json);
    files.commit();
    for (const PartDecision& decision : part.decisions) {
        if (decision.taken) {
            continue;
        }
        std::cerr << "pavior: not meshable: " << solids_text(model, decision.solids);
        if (decision.out_of_time) {
            std::cerr << " within the time limit of " << command.timeout.value_or(default_seconds)
                      << (command.timeout ? " s" : " s a solid");
        }
        std::cerr << "\n";
        for (const MethodTry& attempt : decision.tries) {
            std::cerr << "  " << to_string(attempt.method) << ": " << indented(attempt.reason) << "\n";
        }
    }
    return exit_not_meshable;
}

MadeMesh made_of(const GmshBrep& model, PartMesh part, Json json) {
    MadeMesh made;
    for (const PartDecision& decision : part.decisions) {
        if (!decision.valid()) {
            made.faults += (made.faults.empty() ? "" : "\n") + solids_text(model, decision.solids) + ": " +
                           decision.tries[*decision.taken].reason;
        }
    }
    made.valid = part.valid();
    if (made.faults.empty()) {
        made.faults = part.check.verify.text();
    }
    made.counts = counts_of(part.check);
    made.data = std::move(part.data);
    made.check = std::move(part.check);
    made.deviation = part.deviation;
    made.warnings = json["warnings"].get<std::vector<std::string>>();
    made.json = std::move(json);
    return made;
}

/// Writes the pieces of the first group of solids that was cut; a note on what was written.
std::string save_pieces(const MeshCommand& command, const GmshBrep& model, std::span<const PartDecision> decisions,
                        OutputFiles& files) {
    std::size_t cut = 0;
    for (const PartDecision& decision : decisions) {
        const auto* taken = decision.taken ? &decision.tries[*decision.taken] : nullptr;
        if (taken == nullptr || taken->cuts.empty()) {
            continue;
        }
        if (++cut == 1) {
            const GmshCutter cutter(model);
            files.write(command.save_pieces, [&](const std::string& file) { cutter.save(taken->cuts, file); });
        }
    }
    if (cut == 0) {
        return "no solid was cut: there are no pieces for " + command.save_pieces;
    }
    return cut == 1 ? std::string()
                    : command.save_pieces + " holds the pieces of the first of " + std::to_string(cut) +
                          " groups of solids that were cut";
}

}  // namespace

ExitCode run_mesh(const MeshCommand& command, Guard& guard) {
    if (!can_read_cad(command.input)) {
        throw FileError(command.input, "unknown input format; known are .step .stp .iges .igs .brep");
    }
    static_cast<void>(mesh_format(command.output, command.format));  // refuses what cannot be written
    if (!command.save_pieces.empty() && std::filesystem::path(command.save_pieces).extension() != ".brep") {
        throw FileError(command.save_pieces, "pieces are written as .brep");
    }
    OutputFiles files(command.input, {command.output, command.report, command.save_pieces});
    const Stopwatch watch;
    const OutputUnit unit(command.input, command.unit);
    ProgressBar bar(command.quiet);
    guard.set_limit(command.timeout.value_or(default_seconds), late_report(command));
    PartOptions options;
    options.size = command.size;
    options.local = command.local;
    options.max_angle = command.max_angle;
    options.allow_slices = command.allow_slices;
    options.imprint_tolerance = command.imprint_tolerance;
    options.max_hexahedra = command.max_hexahedra;
    options.node_entities = false;  // no format of ours holds them
    options.execution = Execution{command.threads, guard.stop()};
    options.progress = bar.sink();
    options.last_resort = command.last_resort;
    options.decompose = command.decompose;
    if (command.method) {
        options.methods = {*command.method};
    }
    report(options.progress, "reading", 0);
    CadOptions reading = cad_options(command, guard);
    reading.imprint_tolerance = command.imprint_tolerance;
    const GmshBrep model = GmshBrep::load(command.input, reading);
    if (command.timeout) {
        options.seconds = 0;
        options.call_seconds = 0.9 * guard.seconds_left();  // what is left is for the file
    } else {
        options.seconds = default_seconds;
        guard.set_limit(watch.total() + default_seconds * static_cast<double>(model.solid_count() + 1),
                        late_report(command));
    }
    PartMesh part = mesh_model(model, options);
    check_stop(guard.stop());
    guard.lift_limit();
    if (command.explain) {
        print_tree(std::cout, model, command, part.decisions);
    }
    if (!command.save_pieces.empty()) {
        if (std::string note = save_pieces(command, model, part.decisions, files); !note.empty()) {
            part.warnings.push_back(std::move(note));
        }
    }
    Json json = report_of(command, model, part);
    if (!part.complete()) {
        json["unit"] = unit.json();
        return refuse(command, model, part, std::move(json), watch.total(), files);
    }
    return deliver(command, unit, made_of(model, std::move(part), std::move(json)), watch.total(), files);
}

}  // namespace pavior::cli
