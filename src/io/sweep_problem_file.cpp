#include <pavior/io/sweep_problem_file.hpp>

#include <pavior/core/error.hpp>
#include <pavior/mesh/boundary_loops.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

namespace pavior {

namespace {

using Json = nlohmann::json;

/// What is wrong with a value; the reader of the key adds where.
struct Malformed {
    std::string what;
};

double number(const Json& value) {
    if (value.is_number()) {
        return value.get<double>();
    }
    if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        if (text == "nan") {
            return std::numeric_limits<double>::quiet_NaN();
        }
        if (text == "inf" || text == "-inf") {
            return text == "inf" ? HUGE_VAL : -HUGE_VAL;
        }
    }
    throw Malformed{"a number expected, not " + value.dump().substr(0, 40)};
}

Index node_id(const Json& value) {
    if (value.is_number_unsigned()) {
        return static_cast<Index>(std::min<std::uint64_t>(value.get<std::uint64_t>(), no_index));
    }
    if (value.is_number_integer()) {
        return no_index;
    }
    throw Malformed{"a node id expected, not " + value.dump().substr(0, 40)};
}

const Json& list(const Json& value) {
    if (!value.is_array()) {
        throw Malformed{"a list expected, not " + value.dump().substr(0, 40)};
    }
    return value;
}

const Json& list_of(const Json& value, std::size_t size) {
    if (list(value).size() != size) {
        throw Malformed{std::to_string(size) + " entries expected, not " + value.dump().substr(0, 60)};
    }
    return value;
}

std::vector<Vec3> points(const Json& value) {
    std::vector<Vec3> result;
    for (const Json& p : list(value)) {
        list_of(p, 3);
        result.emplace_back(number(p[0]), number(p[1]), number(p[2]));
    }
    return result;
}

std::vector<QuadCorners> quads(const Json& value) {
    std::vector<QuadCorners> result;
    for (const Json& q : list(value)) {
        list_of(q, 4);
        result.push_back({node_id(q[0]), node_id(q[1]), node_id(q[2]), node_id(q[3])});
    }
    return result;
}

Loops loops(const Json& value) {
    Loops result;
    for (const Json& loop : list(value)) {
        std::vector<Index> nodes;
        for (const Json& node : list(loop)) {
            nodes.push_back(node_id(node));
        }
        result.add(nodes);
    }
    return result;
}

std::vector<std::vector<Vec3>> levels(const Json& value) {
    std::vector<std::vector<Vec3>> result;
    for (const Json& level : list(value)) {
        result.push_back(points(level));
    }
    return result;
}

Json parse(const std::string& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) {
        throw FileError(file, "is a directory");
    }
    std::ifstream in(file);
    if (!in) {
        throw FileError(file, "cannot be opened");
    }
    try {
        Json json = Json::parse(in);
        if (!json.is_object()) {
            throw FileError(file, "holds no JSON object");
        }
        return json;
    } catch (const Json::exception& problem) {
        throw FileError(file, std::string("is no JSON: ") + problem.what());
    }
}

}  // namespace

SweepProblem read_sweep_problem(const std::string& file) {
    const Json json = parse(file);
    const auto read = [&](const char* key, const auto& reader) {
        const auto at = json.find(key);
        if (at == json.end()) {
            throw FileError(file, std::string("has no key \"") + key + "\"");
        }
        try {
            return reader(*at);
        } catch (const Malformed& problem) {
            throw FileError(file, std::string("\"") + key + "\": " + problem.what);
        }
    };
    const QuadMesh source{read("source_nodes", points), read("quads", quads)};
    const std::vector<Vec3> target = read("target_nodes", points);
    const Loops given = json.contains("loops") ? read("loops", loops) : boundary_loops(source);
    const std::vector<std::vector<Vec3>> boundary = read("boundary_levels", levels);
    if (json.contains("layers")) {
        const double layers = read("layers", number);
        if (layers + 1 != static_cast<double>(boundary.size())) {
            throw InputError(ErrorCode::size_mismatch,
                             "\"layers\" does not go with " + std::to_string(boundary.size()) + " boundary levels");
        }
    }
    return make_sweep_problem(source, target, given, boundary);
}

}  // namespace pavior
