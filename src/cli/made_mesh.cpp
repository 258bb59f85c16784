#include "made_mesh.hpp"

namespace pavior::cli {

ExitCode deliver(const MakeCommand& command, const OutputUnit& unit, MadeMesh made, double seconds,
                 OutputFiles& files) {
    const bool written = made.valid || command.keep_invalid;
    const ExitCode code = made.valid ? exit_valid : exit_invalid;
    nlohmann::json& json = made.json;
    json["mesh"] = detail::to_json(made.data, made.check, written_format(command.output, command.format, written));
    if (written) {
        unit.apply(made.data);
        files.write(command.output,
                    [&](const std::string& temporary) { write_mesh(temporary, made.data, {command.format}); });
    }
    json["input"] = command.input;
    json["output"] = written ? nlohmann::json(command.output) : nlohmann::json();
    json["unit"] = unit.json();
    json["seconds"] = seconds;
    if (made.deviation) {
        json["deviation"] = detail::to_json(*made.deviation);
    }
    json["warnings"] = made.warnings;
    json["exit_code"] = static_cast<int>(code);
    files.write_report(command.report, json);
    files.commit();
    print_warnings(made.warnings);
    if (!made.valid) {
        print_invalid(made.what, made.faults, written);
    } else if (!command.quiet) {
        print_summary(command.output + unit.text(), made.counts, made.check, made.deviation, seconds);
    }
    return code;
}

}  // namespace pavior::cli
