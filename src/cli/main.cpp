#include "commands.hpp"

#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>

#include <unistd.h>

namespace pavior::cli {

namespace {

/// The number that is all of \p text, or nothing.
std::optional<double> number_in(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return text.empty() || *end != '\0' ? std::nullopt : std::optional(value);
}

/// "edge:12=0.5" or "bolt=0.5" among \p lengths.
void add_local_length(const std::string& text, LocalLengths& lengths) {
    const std::size_t equals = text.rfind('=');
    const std::optional<double> size = equals == std::string::npos ? std::nullopt : number_in(text.substr(equals + 1));
    if (!size || !(*size > 0) || !std::isfinite(*size) || equals == 0) {
        throw CLI::ValidationError("--local-size " + text,
                                   "KIND:TAG=H or NAME=H expected, KIND edge, face or solid, H a positive number");
    }
    const std::string entity = text.substr(0, equals);
    const std::size_t colon = entity.find(':');
    const std::string kind = entity.substr(0, colon);
    std::map<int, double>* by_tag = kind == "edge"    ? &lengths.edge
                                    : kind == "face"  ? &lengths.face
                                    : kind == "solid" ? &lengths.solid
                                                      : nullptr;
    const std::string tag = colon == std::string::npos ? std::string() : entity.substr(colon + 1);
    const bool digits = !tag.empty() && tag.size() < 10 && tag.find_first_not_of("0123456789") == std::string::npos;
    if (by_tag != nullptr && digits) {
        (*by_tag)[std::stoi(tag)] = *size;
    } else {
        lengths.named[entity] = *size;
    }
}

/// Only finite numbers, from \p least on (above it, if \p open) to \p most; \p range says so in words.
CLI::Validator number_from(double least, bool open, const std::string& range, double most = 1e300) {
    const auto check = [=](const std::string& text) {
        const std::optional<double> value = number_in(text);
        const bool fits = value && *value <= most && (open ? *value > least : *value >= least);
        return fits ? std::string() : "\"" + text + "\" is no " + range;
    };
    return CLI::Validator(check, "");
}

CLI::Validator whole_number(long long least, long long most) {
    const std::string range = "whole number from " + std::to_string(least) + " to " + std::to_string(most);
    const auto check = [=](const std::string& text) {
        const std::optional<double> value = number_in(text);
        const bool fits = value && *value == std::floor(*value) && *value >= static_cast<double>(least) &&
                          *value <= static_cast<double>(most) &&
                          text.find_first_not_of("0123456789") == std::string::npos;
        return fits ? std::string() : "\"" + text + "\" is no " + range;
    };
    return CLI::Validator(check, "");
}

/// Half of the memory that this process may use, at 400 bytes a hexahedron while it is meshed and written.
double hexahedra_in_memory() {
    double bytes = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
    double limit = 0;
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> limit && limit > 0) {
        bytes = std::min(bytes, limit);
    }
    return std::floor(bytes / 2 / 400);
}

/// An option that takes one of some names; value is set when the option is given.
template <class T>
void add_choice(CLI::App& app, const std::string& option, T& value, const std::map<std::string, T>& choices,
                const std::string& help) {
    std::string names;
    for (const auto& choice : choices) {
        names += (names.empty() ? "" : "|") + choice.first;
    }
    const auto set = [&value, choices](const std::string& name) { value = choices.at(name); };
    app.add_option_function<std::string>(option, set, help)->check(CLI::IsMember(choices))->type_name(names);
}

void add_make(CLI::App& app, MakeCommand& command, const std::string& input, const std::string& default_size,
              const std::string& default_time) {
    app.add_option("input", command.input, input)->required();
    app.add_option("-o,--output", command.output, "mesh to write (.vtu .vtk .msh .inp)")->required();
    add_choice(app, "--format", command.format,
               {{"msh4", MeshFormat::msh41},
                {"msh4-ascii", MeshFormat::msh41_ascii},
                {"msh2", MeshFormat::msh22},
                {"msh2-ascii", MeshFormat::msh22_ascii}},
               "kind of a .msh file: Gmsh 4.1 (msh4, default) or 2.2, binary or text");
    app.add_option("--size", command.size, "length of mesh edges; default: " + default_size)
        ->check(number_from(0, true, "positive number"));
    app.add_option_function<std::vector<std::string>>(
           "--local-size",
           [&command](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   add_local_length(text, command.local);
               }
           },
           "other length for one entity, by tag or by name: edge:12=0.5, face:3=1, solid:1=2, bolt=0.5")
        ->type_name("ENTITY=H")
        ->allow_extra_args(false);
    app.add_option("--max-angle", command.max_angle,
                   "curved edges turn by at most so many degrees a mesh edge, whatever the size; 1 to 90, default 30")
        ->check(number_from(1, false, "angle from 1 to 90 degrees", 90));
    app.add_option("--unit", command.unit,
                   "unit of the mesh written; default: that of the model as read (mm for STEP and IGES), which is the "
                   "unit of all sizes and reports in any case")
        ->check(CLI::IsMember({"um", "mm", "cm", "dm", "m", "km", "mil", "inch", "foot"}));
    command.max_hexahedra = hexahedra_in_memory();
    app.add_option("--max-hexahedra", command.max_hexahedra,
                   "refuse sizes that would make more hexahedra than this; default: what half of the memory holds; 0: "
                   "no limit")
        ->check(number_from(0, false, "number from 0 on"));
    app.add_option("--timeout", command.timeout, "seconds for the whole program; " + default_time + "; 0: no limit")
        ->check(number_from(0, false, "number of seconds from 0 on"));
    app.add_option("--threads", command.threads, "threads, 0: one a core; the mesh does not depend on it")
        ->check(whole_number(0, 4096));
    app.add_option("--report", command.report, "write a report in JSON");
    app.add_flag("--quiet", command.quiet, "print nothing but errors and warnings");
    app.add_flag("--keep-invalid", command.keep_invalid, "write the mesh even if it is not valid (exit code 1)");
}

void add_solids(CLI::App& app, SolidsCommand& command) {
    app.add_option("--imprint-tolerance", command.imprint_tolerance,
                   "solids closer than this are made to touch; default 0: what the file itself takes for touching")
        ->check(number_from(0, false, "number from 0 on"));
    app.add_flag("--allow-slices", command.allow_slices,
                 "mesh slices thinner than a hundredth of the size that are left where solids cut each other");
}

void add_sweep(CLI::App& app, SweepCommand& command) {
    add_make(app, command, "CAD model (.step .stp .iges .igs .brep) or sweep problem (.json)",
             "a twelfth of the model's diagonal", "default: no limit");
    add_solids(app, command);
    app.add_option("--layers", command.layers, "number of layers in every solid")->check(whole_number(1, 1000000));
    add_choice(app, "--method", command.method,
               {{"constrained", AffineMethod::constrained},
                {"h", AffineMethod::h},
                {"g", AffineMethod::g},
                {"f", AffineMethod::f}},
               "affine map of the inner layers, default constrained");
    add_choice(app, "--strategy", command.strategy,
               {{"direct", SweepStrategy::direct}, {"front", SweepStrategy::front}},
               "levels straight from both caps (direct, default) or from level to level (front)");
    add_choice(app, "--correction", command.correction,
               {{"idw", BoundaryCorrection::idw},
                {"harmonic", BoundaryCorrection::harmonic},
                {"none", BoundaryCorrection::none}},
               "how inner levels and the target cap follow their boundary where no affine map fits it, default idw");
    add_choice(app, "--smooth", command.smooth, {{"auto", true}, {"off", false}},
               "auto (default): move nodes where a cell would be inverted; off: never");
    app.add_option("--source", command.source, "tag of the source face")->check(whole_number(1, 999999999));
    app.add_option("--target", command.target, "tag of the target face")->check(whole_number(1, 999999999));
}

void add_block(CLI::App& app, BlockCommand& command) {
    add_make(app, command,
             "closed surface (.stl .obj .off .ply), CAD model (.step .stp .iges .igs .brep) or tetrahedra (.vtk .vtu "
             ".msh)",
             "none, the blocks themselves are written", "default: no limit");
    add_choice(
        app, "--marking", command.marking, {{"sheets", Marking::sheets}, {"published", Marking::published}},
        "implicit sheets that cut the tetrahedra (sheets, default), or existing faces, Algorithm 5.12 (published)");
    add_choice(app, "--propagation", command.propagation, {{"full", Propagation::full}, {"stop", Propagation::stop}},
               "sheets run on to the boundary (full, default) or to existing curves (stop: fewer blocks)");
    add_choice(app, "--dualization", command.dualization,
               {{"complex", Dualization::complex}, {"contributions", Dualization::contributions}},
               "blocks from the cell complex (complex, default) or, as published, from the local dual contributions "
               "(contributions): the same bytes");
    app.add_option("--mu", command.mu, "where --dual draws the dual surfaces, between 0 and 1/4; default 0.1")
        ->check(number_from(0, true, "number between 0 and 1/4"));
    app.add_option("--feature-angles", command.feature_angles,
                   "interior dihedral angles in degrees: end below, corner from, reversal from; default 135,225,315")
        ->delimiter(',')
        ->expected(3)
        ->check(number_from(0, false, "angle in degrees"));
    app.add_option("--dual", command.dual, "write dual surfaces and regions to look at (.vtu .vtk)");
}

void add_mesh(CLI::App& app, MeshCommand& command) {
    add_make(app, command, "CAD model (.step .stp .iges .igs .brep)", "a twelfth of the model's diagonal",
             "default: 60 for reading and 60 a solid; a method that others follow may use half of what is left");
    add_solids(app, command);
    const std::map<std::string, std::optional<PartMethod>> methods{
        {"auto", std::nullopt},       {"submap", PartMethod::submap},
        {"sweep", PartMethod::sweep}, {"multi-sweep", PartMethod::multi_sweep},
        {"mixed", PartMethod::mixed}, {"block", PartMethod::block},
        {"split", PartMethod::split}, {"decompose", PartMethod::decompose}};
    add_choice(
        app, "--method", command.method, methods,
        "auto (default): submapping, one-to-one sweep, many-to-many sweep, mixed (touching solids each by "
        "its own method), blocks, until one gives a valid mesh with scaled Jacobians of 0.2 or more, else the best "
        "of them; the last resort, where that is below 0.2 or none: tetrahedra, each split in four (split)");
    app.add_flag("!--no-split", command.last_resort, "no last resort: refuse what no other method meshes");
    add_choice(app, "--decompose", command.decompose, {{"on", true}, {"off", false}},
               "cut solids into pieces that the first four methods mesh together, where they fail on the whole (on, "
               "default); off: do not");
    app.add_option("--save-pieces", command.save_pieces,
                   "write the pieces that a mesh by cuts was made of (.brep); nothing where no solid was cut");
    app.add_flag("--explain", command.explain, "print what was tried, and why it was taken or refused, as a tree");
}

/// A word where a command should stand.
void check_command(const CLI::App& app, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') {
        return;
    }
    std::string known;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (command->get_name() == argv[1]) {
            return;
        }
        known += (known.empty() ? "" : ", ") + command->get_name();
    }
    throw InputError(ErrorCode::bad_option, "unknown command '" + std::string(argv[1]) + "'; known are " + known);
}

ExitCode run(int argc, char** argv, Guard& guard) {
    CLI::App app(
        "pavior fills solids with hexahedra.\n"
        "Exit codes: 0 valid mesh; 1 mesh made but not valid; 2 bad input or options; 3 not meshable, or out of time; "
        "128 + n ended by signal n");
    app.set_version_flag("--version", std::string("pavior ") + PAVIOR_VERSION);
    app.require_subcommand(1);
    MeshCommand mesh;
    add_mesh(*app.add_subcommand("mesh", "hexahedra for CAD solids, by the method that fits"), mesh);
    SweepCommand sweep;
    add_sweep(*app.add_subcommand("sweep", "hexahedra for one-to-one sweepable solids"), sweep);
    BlockCommand block;
    add_block(*app.add_subcommand("block", "hexahedral blocks of a solid, or a fine mesh inside them"), block);
    QualityCommand quality;
    CLI::App& quality_app = *app.add_subcommand("quality", "quality and conformity of a hexahedral mesh");
    quality_app.add_option("mesh", quality.mesh, "mesh (.vtu .vtk .msh .inp)")->required();
    quality_app.add_option("--report", quality.report, "write a report in JSON");
    quality_app.add_option("--threads", quality.threads, "threads, 0: one a core")->check(whole_number(0, 4096));
    check_command(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_valid : exit_bad_input;
    }
    return app.got_subcommand("mesh")    ? run_mesh(mesh, guard)
           : app.got_subcommand("sweep") ? run_sweep(sweep, guard)
           : app.got_subcommand("block") ? run_block(block, guard)
                                         : run_quality(quality);
}

}  // namespace

}  // namespace pavior::cli

int main(int argc, char** argv) {
    using namespace pavior;
    cli::Guard guard;
    try {
        return cli::run(argc, argv, guard);
    } catch (const Stopped&) {
        return guard.farewell();
    } catch (const UnmeshableError& error) {
        std::cerr << "pavior: not meshable: " << error.what() << "\n";
        return cli::exit_not_meshable;
    } catch (const Error& error) {
        std::cerr << "pavior: " << error.what() << "\n";
        return error.code() == ErrorCode::cad_failure ? cli::exit_not_meshable : cli::exit_bad_input;
    } catch (const std::bad_alloc&) {
        std::cerr << "pavior: not enough memory\n";
    } catch (const std::exception& error) {
        std::cerr << "pavior: " << error.what() << "\n";
    } catch (...) {
        std::cerr << "pavior: an error of unknown kind in a library\n";
    }
    return cli::exit_bad_input;
}
