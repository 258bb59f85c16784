#pragma once
// Options of Gmsh for a while. Internal to the cad component.

#include <gmsh.h>

#include <string>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Sets options of Gmsh and puts the old values back.
class GmshOptions {
public:
    GmshOptions() = default;
    GmshOptions(const GmshOptions&) = delete;
    GmshOptions& operator=(const GmshOptions&) = delete;
    ~GmshOptions() {
        for (const auto& [name, value] : old_) {
            try {
                gmsh::option::setNumber(name, value);
            } catch (...) {  // it could be read, so it can be set
            }
        }
    }
    void set(const std::string& name, double value) {
        double old = 0;
        gmsh::option::getNumber(name, old);
        old_.emplace_back(name, old);
        gmsh::option::setNumber(name, value);
    }

private:
    std::vector<std::pair<std::string, double>> old_;
};

}  // namespace pavior::detail
