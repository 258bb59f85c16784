#include "commands.hpp"

#include <pavior/core/error.hpp>

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>

namespace pavior::cli {

namespace {

/// "edge:12=0.5" into the map of its kind.
void add_local_size(const std::string& text, SweepCommand& command) {
    const std::size_t colon = text.find(':');
    const std::size_t equals = text.find('=');
    const std::string kind = text.substr(0, colon);
    std::map<int, double>* sizes = kind == "edge"    ? &command.edge_size
                                   : kind == "face"  ? &command.face_size
                                   : kind == "solid" ? &command.solid_size
                                                     : nullptr;
    try {
        if (sizes != nullptr && colon != std::string::npos && equals != std::string::npos && colon < equals) {
            std::size_t tag_end = 0;
            std::size_t size_end = 0;
            const std::string tag_text = text.substr(colon + 1, equals - colon - 1);
            const std::string size_text = text.substr(equals + 1);
            const int tag = std::stoi(tag_text, &tag_end);
            const double size = std::stod(size_text, &size_end);
            if (tag_end == tag_text.size() && size_end == size_text.size() && size > 0) {
                (*sizes)[tag] = size;
                return;
            }
        }
    } catch (const std::logic_error&) {  // not a number: said below
    }
    throw InputError(ErrorCode::bad_option, "--local-size " + text + ": KIND:TAG=H expected, KIND edge, face or solid");
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

void add_max_angle(CLI::App& app, double& degrees) {
    app.add_option("--max-angle", degrees,
                   "curved edges turn by at most so many degrees a mesh edge, whatever the size; 1 to 90, default 30")
        ->check(CLI::Range(1.0, 90.0));
}

void add_imprint(CLI::App& app, double& tolerance, bool& allow_slices) {
    app.add_option("--imprint-tolerance", tolerance,
                   "solids closer than this are made to touch; default 0: what the file itself takes for touching")
        ->check(CLI::NonNegativeNumber);
    app.add_flag("--allow-slices", allow_slices,
                 "mesh slices thinner than a hundredth of the size that are left where solids cut each other");
}

void add_unit(CLI::App& app, std::string& unit) {
    app.add_option("--unit", unit,
                   "unit of the mesh written; default: that of the model as read (mm for STEP and IGES), which is the "
                   "unit of all sizes and reports in any case")
        ->check(CLI::IsMember({"um", "mm", "cm", "dm", "m", "km", "mil", "inch", "foot"}));
}

void add_sweep(CLI::App& app, SweepCommand& command, std::vector<std::string>& local_sizes) {
    app.add_option("input", command.input, "CAD model (.step .stp .iges .igs .brep) or sweep problem (.json)")
        ->required();
    app.add_option("-o,--output", command.output, "mesh to write (.vtu .vtk .msh .inp)")->required();
    app.add_option("--size", command.size, "length of mesh edges; default: a twelfth of the model's diagonal")
        ->check(CLI::PositiveNumber);
    add_max_angle(app, command.max_angle);
    add_imprint(app, command.imprint_tolerance, command.allow_slices);
    app.add_option("--local-size", local_sizes, "other length for one entity: edge:12=0.5, face:3=1, solid:1=2");
    app.add_option("--layers", command.layers, "number of layers in every solid")->check(CLI::Range(1, 1000000));
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
    app.add_option("--source", command.source, "tag of the source face");
    app.add_option("--target", command.target, "tag of the target face");
    app.add_option("--threads", command.threads, "threads, 0: one a core; the mesh does not depend on it");
    add_unit(app, command.unit);
    app.add_option("--report", command.report, "write a report in JSON");
    app.add_flag("--quiet", command.quiet, "print nothing but errors and warnings");
    app.add_flag("--keep-invalid", command.keep_invalid, "write the mesh even if it is not valid (exit code 1)");
}

void add_block(CLI::App& app, BlockCommand& command) {
    app.add_option(
           "input", command.input,
           "closed surface (.stl .obj .off .ply), CAD model (.step .stp .iges .igs .brep) or tetrahedra (.vtk .vtu "
           ".msh)")
        ->required();
    app.add_option("-o,--output", command.output, "mesh to write (.vtu .vtk .msh .inp)")->required();
    app.add_option("--size", command.size,
                   "write a fine mesh on the geometry with edges of this length; default: the blocks themselves")
        ->check(CLI::PositiveNumber);
    add_max_angle(app, command.max_angle);
    add_choice(
        app, "--marking", command.marking, {{"sheets", Marking::sheets}, {"published", Marking::published}},
        "implicit sheets that cut the tetrahedra (sheets, default), or existing faces, Algorithm 5.12 (published)");
    add_choice(app, "--propagation", command.propagation, {{"full", Propagation::full}, {"stop", Propagation::stop}},
               "sheets run on to the boundary (full, default) or to existing curves (stop: fewer blocks)");
    add_choice(app, "--dualization", command.dualization,
               {{"complex", Dualization::complex}, {"contributions", Dualization::contributions}},
               "blocks from the cell complex (complex, default) or, as published, from the local dual contributions "
               "(contributions): the same bytes");
    app.add_option("--mu", command.mu, "where --dual draws the dual surfaces, between 0 and 1/4; default 0.1");
    app.add_option("--feature-angles", command.feature_angles,
                   "interior dihedral angles in degrees: end below, corner from, reversal from; default 135,225,315")
        ->delimiter(',')
        ->expected(3);
    app.add_option("--dual", command.dual, "write dual surfaces and regions to look at (.vtu .vtk)");
    app.add_option("--threads", command.threads, "threads, 0: one a core; the blocks do not depend on it");
    add_unit(app, command.unit);
    app.add_option("--report", command.report, "write a report in JSON");
    app.add_flag("--quiet", command.quiet, "print nothing but errors and warnings");
    app.add_flag("--keep-invalid", command.keep_invalid, "write the mesh even if it is not valid (exit code 1)");
}

void add_mesh(CLI::App& app, MeshCommand& command) {
    app.add_option("input", command.input, "CAD model (.step .stp .iges .igs .brep)")->required();
    app.add_option("-o,--output", command.output, "mesh to write (.vtu .vtk .msh .inp)")->required();
    app.add_option("--size", command.size, "length of mesh edges; default: a twelfth of the model's diagonal")
        ->check(CLI::PositiveNumber);
    add_max_angle(app, command.max_angle);
    add_imprint(app, command.imprint_tolerance, command.allow_slices);
    const std::map<std::string, std::optional<PartMethod>> methods{
        {"auto", std::nullopt},       {"submap", PartMethod::submap},
        {"sweep", PartMethod::sweep}, {"multi-sweep", PartMethod::multi_sweep},
        {"mixed", PartMethod::mixed}, {"block", PartMethod::block}};
    add_choice(
        app, "--method", command.method, methods,
        "auto (default): submapping, one-to-one sweep, many-to-many sweep, mixed (touching solids each by "
        "its own method), blocks, until one gives a valid mesh with scaled Jacobians of 0.2 or more, else the best "
        "of them");
    app.add_option("--timeout", command.timeout,
                   "seconds a solid, default 60; 0: no limit. A method that others follow may use half of what is left")
        ->check(CLI::NonNegativeNumber);
    app.add_flag("--explain", command.explain, "print what was tried, and why it was taken or refused, as a tree");
    app.add_option("--threads", command.threads, "threads, 0: one a core; the mesh does not depend on it");
    add_unit(app, command.unit);
    app.add_option("--report", command.report, "write a report in JSON");
    app.add_flag("--quiet", command.quiet, "print nothing but errors, warnings and the tree of --explain");
    app.add_flag("--keep-invalid", command.keep_invalid, "write the mesh even if it is not valid (exit code 1)");
}

ExitCode run(int argc, char** argv) {
    CLI::App app(
        "pavior fills solids with hexahedra.\n"
        "Exit codes: 0 valid mesh; 1 mesh made but not valid; 2 bad input or options; 3 not meshable");
    app.require_subcommand(1);
    MeshCommand mesh;
    add_mesh(*app.add_subcommand("mesh", "hexahedra for CAD solids, by the method that fits"), mesh);
    SweepCommand sweep;
    std::vector<std::string> local_sizes;
    CLI::App& sweep_app = *app.add_subcommand("sweep", "hexahedra for one-to-one sweepable solids");
    add_sweep(sweep_app, sweep, local_sizes);
    BlockCommand block;
    CLI::App& block_app = *app.add_subcommand("block", "hexahedral blocks of a solid, or a fine mesh inside them");
    add_block(block_app, block);
    QualityCommand quality;
    CLI::App& quality_app = *app.add_subcommand("quality", "quality and conformity of a hexahedral mesh");
    quality_app.add_option("mesh", quality.mesh, "mesh (.vtu .vtk .msh .inp)")->required();
    quality_app.add_option("--report", quality.report, "write a report in JSON");
    quality_app.add_option("--threads", quality.threads, "threads, 0: one a core");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_valid : exit_bad_input;
    }
    if (app.got_subcommand("mesh")) {
        return run_mesh(mesh);
    }
    if (quality_app.parsed()) {
        return run_quality(quality);
    }
    if (block_app.parsed()) {
        return run_block(block);
    }
    for (const std::string& text : local_sizes) {
        add_local_size(text, sweep);
    }
    return run_sweep(sweep);
}

}  // namespace

}  // namespace pavior::cli

int main(int argc, char** argv) {
    using namespace pavior;
    try {
        return cli::run(argc, argv);
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
