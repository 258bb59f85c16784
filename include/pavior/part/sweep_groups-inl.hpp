#pragma once

#include <pavior/brep/touching_solids.hpp>
#include <pavior/core/disjoint_sets.hpp>
#include <pavior/many_to_many/extrusion.hpp>
#include <pavior/part/sweep_groups.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Chooses a direction for each solid.
class DirectionChooser {
public:
    DirectionChooser(const AnyModel& b, std::span<const SolidId> solids)
        : b_(b), solids_(solids.begin(), solids.end()), ways_(solids.size()) {
        for (std::size_t s = 0; s < solids.size(); ++s) {
            for (Extrusion& extrusion : recognise_extrusions(b, solids.subspan(s, 1))) {
                if (extrusion.possible()) {
                    const std::size_t direction = direction_of(extrusion.direction);
                    ways_[s].push_back({direction, std::move(extrusion.roles)});
                }
            }
            if (ways_[s].empty()) {
                ways_[s].push_back({no_position, {}});
            }
        }
        find_contacts();
    }

    [[nodiscard]] std::vector<SweepGroups> run(std::size_t most) const {
        std::set<Choice> seen;
        std::vector<SweepGroups> found;
        const auto take = [&](const Choice& choice) {
            if (seen.insert(choice).second) {
                found.push_back(groups_of(choice));
            }
        };
        for (std::size_t d = 0; d <= directions_.size(); ++d) {  // the last one: each solid its own first
            Choice choice(solids_.size(), 0);
            for (std::size_t s = 0; s < solids_.size(); ++s) {
                const auto at =
                    std::find_if(ways_[s].begin(), ways_[s].end(), [&](const Way& way) { return way.direction == d; });
                choice[s] = at == ways_[s].end() ? 0 : static_cast<std::size_t>(at - ways_[s].begin());
            }
            take(descend(choice));
            take(choice);
        }
        std::stable_sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.cost < y.cost; });
        found.resize(std::min(found.size(), most));
        return found;
    }

private:
    using Choice = std::vector<std::size_t>;  ///< a way of each solid

    struct Way {
        std::size_t direction;             ///< no_position: a path that is not straight
        std::vector<ExtrusionRole> roles;  ///< by face
    };
    /// Two solids that touch, and the faces that they share.
    struct Contact {
        std::array<std::size_t, 2> solids;
        std::vector<FaceId> faces;
    };

    std::size_t direction_of(const Vec3& d) {
        const auto at = std::find_if(directions_.begin(), directions_.end(),
                                     [&](const Vec3& e) { return e.cross(d).norm() < 1e-6; });
        const auto position = static_cast<std::size_t>(at - directions_.begin());
        if (at == directions_.end()) {
            directions_.push_back(d);
        }
        return position;
    }

    void find_contacts() {
        for (std::size_t i = 0; i < solids_.size(); ++i) {
            for (std::size_t k = i + 1; k < solids_.size(); ++k) {
                if (touching_solids(b_, std::array{solids_[i], solids_[k]}).size() > 1) {
                    continue;
                }
                Contact contact{{i, k}, {}};
                for (const OrientedFace& f : b_.solid_faces(solids_[i])) {
                    const auto others = b_.solid_faces(solids_[k]);
                    if (std::any_of(others.begin(), others.end(), [&](auto& g) { return g.face == f.face; })) {
                        contact.faces.push_back(f.face);
                    }
                }
                contacts_.push_back(std::move(contact));
            }
        }
    }

    [[nodiscard]] const Way& way(const Choice& choice, std::size_t s) const { return ways_[s][choice[s]]; }

    [[nodiscard]] bool together(const Choice& choice, const Contact& contact) const {
        return way(choice, contact.solids[0]).direction == way(choice, contact.solids[1]).direction;
    }

    /// 0: a path that is not straight, so that it is not known; 1: a side, 2: a cap.
    [[nodiscard]] int kind(const Choice& choice, std::size_t s, FaceId f) const {
        const Way& own = way(choice, s);
        return own.direction == no_position ? 0 : own.roles[f.index()] == ExtrusionRole::side ? 1 : 2;
    }

    [[nodiscard]] double cost(const Choice& choice) const {
        DisjointSets<std::size_t> sets(solids_.size());
        double result = static_cast<double>(solids_.size());
        for (const Contact& contact : contacts_) {
            if (together(choice, contact)) {
                result -= sets.root(contact.solids[0]) != sets.root(contact.solids[1]) ? 1.0 : 0.0;
                sets.unite(contact.solids[0], contact.solids[1]);
                continue;
            }
            for (const FaceId f : contact.faces) {
                const int low = kind(choice, contact.solids[0], f), high = kind(choice, contact.solids[1], f);
                const bool holes = b_.face_loops(f).size() > 1;
                result += low == 1 && high == 1 ? 0.1 : low + high == 3 && holes ? 3.0 : 0.3;
            }
        }
        for (std::size_t s = 0; s < solids_.size(); ++s) {
            result += 0.01 * static_cast<double>(choice[s]);
        }
        return result;
    }

    /// Changes the way of one solid after the other as long as that costs less.
    [[nodiscard]] Choice descend(Choice choice) const {
        double least = cost(choice);
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t s = 0; s < solids_.size(); ++s) {
                for (std::size_t w = 0; w < ways_[s].size(); ++w) {
                    Choice other = choice;
                    other[s] = w;
                    if (const double own = cost(other); own < least - 1e-9) {
                        least = own;
                        choice = std::move(other);
                        changed = true;
                    }
                }
            }
        }
        return choice;
    }

    [[nodiscard]] SweepGroups groups_of(const Choice& choice) const {
        DisjointSets<std::size_t> sets(solids_.size());
        for (const Contact& contact : contacts_) {
            if (together(choice, contact)) {
                sets.unite(contact.solids[0], contact.solids[1]);
            }
        }
        std::vector<int> later(solids_.size(), 0);  // by root: caps that are sides of others
        for (const Contact& contact : contacts_) {
            for (const FaceId f : contact.faces) {
                for (std::size_t k = 0; k < 2; ++k) {
                    const bool cap = kind(choice, contact.solids[k], f) == 2;
                    later[sets.root(contact.solids[k])] += cap && kind(choice, contact.solids[1 - k], f) == 1 ? 1 : 0;
                }
            }
        }
        std::vector<std::pair<int, std::vector<SolidId>>> groups(solids_.size());
        for (std::size_t s = 0; s < solids_.size(); ++s) {
            groups[sets.root(s)].first = later[sets.root(s)];
            groups[sets.root(s)].second.push_back(solids_[s]);
        }
        std::erase_if(groups, [](const auto& group) { return group.second.empty(); });
        std::stable_sort(groups.begin(), groups.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
        SweepGroups result{{}, cost(choice)};
        for (auto& [rank, group] : groups) {
            result.groups.push_back(std::move(group));
        }
        return result;
    }

    const AnyModel& b_;
    std::vector<SolidId> solids_;
    std::vector<Vec3> directions_;
    std::vector<std::vector<Way>> ways_;  ///< of each solid, best first
    std::vector<Contact> contacts_;
};

}  // namespace detail

PAVIOR_INLINE std::vector<SweepGroups> sweep_groups(const AnyModel& b, std::span<const SolidId> solids,
                                                    std::size_t most) {
    return detail::DirectionChooser(b, solids).run(most);
}

}  // namespace pavior
