#include "check.hpp"
#include "commands.hpp"
#include "output_files.hpp"

#include <pavior/io/mesh_file.hpp>

#include <iostream>

namespace pavior::cli {

ExitCode run_quality(const QualityCommand& command) {
    OutputFiles files(command.mesh, {command.report});
    const HexMeshData data = read_mesh(command.mesh);
    const MeshCheck check = check_mesh(data.mesh, Execution{command.threads});
    std::cout << command.mesh << "\n";
    print_check(std::cout, data, check);
    nlohmann::json json = detail::to_json(data, check);
    json["mesh"] = command.mesh;
    files.write_report(command.report, json);
    files.commit();
    return check.valid() ? exit_valid : exit_invalid;
}

}  // namespace pavior::cli
