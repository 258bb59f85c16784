#pragma once
// What is to be removed if the program ends before it is finished.

#include <mutex>
#include <string>
#include <vector>

namespace pavior::detail {

/// Files and folders that exist or may.
struct Unfinished {
    std::mutex mutex;
    std::vector<std::string> places;
    bool closed = false;  ///< nothing gets into place any more
};

inline Unfinished& unfinished() {
    static Unfinished all;
    return all;
}

inline void add_unfinished(const std::string& place) {
    const std::scoped_lock lock(unfinished().mutex);
    unfinished().places.push_back(place);
}

}  // namespace pavior::detail
