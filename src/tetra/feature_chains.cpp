#include "feature_chains.hpp"

#include "facet_edges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace pavior::detail {

namespace {

struct Feature {
    std::array<Index, 2> nodes{};
    int number = 0;
    std::int32_t tag = 0;  ///< of the edge; 0 where number is 0
};

bool is_sharp(const FacetSource& a, const FacetSource& b, double degrees) {
    const double cosine = a.normal.dot(b.normal) / (a.normal.norm() * b.normal.norm());
    return a.tag != b.tag || cosine < std::cos(degrees * std::numbers::pi / 180.0);
}

std::vector<Feature> features_of(const Problem& problem, double degrees) {
    std::map<std::array<Index, 2>, Feature> found;
    for (std::size_t e = 0; e < problem.surface->edges.size(); ++e) {
        const TaggedEdge& edge = problem.surface->edges[e];
        const std::array<Index, 2> nodes{std::min(edge.nodes[0], edge.nodes[1]),
                                         std::max(edge.nodes[0], edge.nodes[1])};
        found.emplace(nodes, Feature{nodes, first_number + static_cast<int>(e), edge.tag});
    }
    const std::vector<FacetEdge> edges = facet_edges(problem.plc.facets);
    for_each_edge(edges, [&](std::span<const FacetEdge> uses) {
        if (uses.size() != 2 || is_sharp(problem.sources[uses[0].facet], problem.sources[uses[1].facet], degrees)) {
            const std::array<Index, 2> nodes{uses[0].low, uses[0].high};
            found.emplace(nodes, Feature{nodes, 0, 0});
        }
    });
    std::vector<Feature> features;
    for (const auto& [nodes, feature] : found) {
        features.push_back(feature);
    }
    return features;
}

/// Walks along features from end to end.
class Walker {
public:
    Walker(const Problem& problem, std::vector<Feature> features)
        : features_(std::move(features)),
          at_(problem.plc.nodes.size()),
          end_(problem.plc.nodes.size(), 0),
          done_(features_.size(), 0) {
        for (std::size_t f = 0; f < features_.size(); ++f) {
            at_[features_[f].nodes[0]].push_back(f);
            at_[features_[f].nodes[1]].push_back(f);
        }
        for (std::size_t i = 0; i < at_.size(); ++i) {
            end_[i] = static_cast<char>(!at_[i].empty() && !(at_[i].size() == 2 && same(at_[i][0], at_[i][1])));
        }
        for (const TaggedNode& vertex : problem.surface->vertices) {
            end_[vertex.node] = 1;
        }
    }

    std::vector<FeatureChain> run() {
        for (Index i = 0; i < at_.size(); ++i) {
            for (const std::size_t f : at_[i]) {
                if (end_[i] != 0 && done_[f] == 0) {
                    walk(i, f);
                }
            }
        }
        for (std::size_t f = 0; f < features_.size(); ++f) {  // what is left is closed
            if (done_[f] == 0) {
                walk(features_[f].nodes[0], f);
            }
        }
        return std::move(chains_);
    }

private:
    [[nodiscard]] bool same(std::size_t f, std::size_t g) const {
        return features_[f].tag == features_[g].tag && (features_[f].number == 0) == (features_[g].number == 0);
    }

    void walk(Index from, std::size_t f) {
        FeatureChain chain{{from}, features_[f].number};
        while (done_[f] == 0) {
            done_[f] = 1;
            const Index to = features_[f].nodes[features_[f].nodes[0] == from ? 1 : 0];
            chain.nodes.push_back(to);
            if (end_[to] != 0 || to == chain.nodes.front()) {
                break;
            }
            f = at_[to][at_[to][0] == f ? 1 : 0];
            from = to;
        }
        chains_.push_back(std::move(chain));
    }

    std::vector<Feature> features_;
    std::vector<std::vector<std::size_t>> at_;
    std::vector<char> end_;
    std::vector<char> done_;
    std::vector<FeatureChain> chains_;
};

}  // namespace

std::vector<FeatureChain> feature_chains(const Problem& problem, double degrees) {
    return Walker(problem, features_of(problem, degrees)).run();
}

}  // namespace pavior::detail
