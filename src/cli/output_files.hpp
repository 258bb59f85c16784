#pragma once

#include <pavior/io/atomic_file.hpp>

#include <nlohmann/json.hpp>

#include <functional>
#include <list>
#include <string>
#include <vector>

namespace pavior::cli {

/// What one run writes: all of it or nothing.
class OutputFiles {
public:
    /// Before any work: each of \p outputs (empty ones count for nothing) can be written, and is neither \p input nor
    /// another one of them, by whatever name. \throws FileError
    OutputFiles(const std::string& input, const std::vector<std::string>& outputs);

    /// Writes \p file under another name for now. \throws FileError
    void write(const std::string& file, const std::function<void(const std::string& temporary)>& write);
    /// The same for a report in JSON; nothing if \p file is empty.
    void write_report(const std::string& file, const nlohmann::json& json);
    /// Puts all in place, the last written first. \throws FileError
    void commit();

private:
    std::list<AtomicFile> files_;
};

}  // namespace pavior::cli
