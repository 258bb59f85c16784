#include "support/catch.hpp"

#include <pavior/core/stop.hpp>
#include <pavior/part/decide.hpp>

#include <algorithm>
#include <chrono>
#include <map>
#include <stop_token>
#include <thread>
#include <vector>

using namespace pavior;

namespace {

/// Outcomes by method; what is not named is refused.
struct Script {
    std::map<PartMethod, std::pair<TryOutcome, double>> outcomes;
    std::vector<PartMethod> asked = {};
    std::vector<double> seconds = {};

    MethodTry operator()(PartMethod method, double limit) {
        asked.push_back(method);
        seconds.push_back(limit);
        MethodTry result;
        result.method = method;
        result.outcome = TryOutcome::refused;
        if (const auto at = outcomes.find(method); at != outcomes.end()) {
            result.outcome = at->second.first;
            result.min_jacobian = at->second.second;
            result.data.mesh.nodes.resize(1);
        }
        return result;
    }
};

PartDecision run(Script& script, const PartOptions& options, std::size_t solids = 2) {
    return decide(std::vector<SolidId>(solids, SolidId{0}), options, std::ref(script));
}

}  // namespace

TEST_CASE("The first good mesh ends the search, what follows is not needed") {
    Script script{{{PartMethod::sweep, {TryOutcome::mesh, 0.4}}}};
    const PartDecision decision = run(script, {});
    CHECK(script.asked == std::vector{PartMethod::submap, PartMethod::sweep});
    CHECK(decision.tries.size() == 7);
    CHECK(decision.taken == 1);
    CHECK(decision.valid());
    CHECK(decision.tries[4].method == PartMethod::decompose);
    CHECK(decision.tries[4].reason == "not needed");
    CHECK(decision.tries[5].method == PartMethod::block);
    CHECK(decision.tries[6].method == PartMethod::split);
    CHECK(decision.tries[6].reason == "not needed");
}

TEST_CASE("Of poor meshes the best is taken and the others are dropped; an invalid one only for want of a valid one") {
    Script script{{{PartMethod::submap, {TryOutcome::invalid, 0.9}},
                   {PartMethod::sweep, {TryOutcome::mesh, 0.1}},
                   {PartMethod::multi_sweep, {TryOutcome::mesh, 0.15}},
                   {PartMethod::block, {TryOutcome::mesh, 0.05}}}};
    const PartDecision decision = run(script, {});
    CHECK(decision.taken == 2);
    for (std::size_t i = 0; i < decision.tries.size(); ++i) {
        CHECK(decision.tries[i].data.mesh.nodes.size() == (i == 2 ? 1U : 0U));
    }
    Script only{{{PartMethod::sweep, {TryOutcome::invalid, -0.2}}}};
    const PartDecision poor = run(only, {});
    CHECK(poor.taken == 1);
    CHECK_FALSE(poor.valid());
    Script equal{{{PartMethod::sweep, {TryOutcome::mesh, 0.1}}, {PartMethod::block, {TryOutcome::mesh, 0.1}}}};
    CHECK(run(equal, {}).taken == 1);
}

TEST_CASE("What is sufficient, and which methods are tried in which order, can be chosen") {
    Script script{{{PartMethod::sweep, {TryOutcome::mesh, 0.4}}, {PartMethod::block, {TryOutcome::mesh, 0.6}}}};
    PartOptions options;
    options.sufficient = 0.5;
    options.methods = {PartMethod::block, PartMethod::sweep};
    const PartDecision decision = run(script, options);
    CHECK(script.asked == std::vector{PartMethod::block});
    CHECK(decision.taken == 0);
}

TEST_CASE("Mixed is for several solids, unless it is asked for by itself") {
    Script script;
    CHECK(run(script, {}, 1).tries.size() == 6);
    PartOptions options;
    options.methods = {PartMethod::mixed};
    Script alone;
    (void)run(alone, options, 1);
    CHECK(alone.asked == options.methods);
}

TEST_CASE("Solids are cut after what takes them whole has failed, before blocks; or not at all") {
    const std::vector whole{PartMethod::submap, PartMethod::sweep, PartMethod::multi_sweep, PartMethod::mixed};
    std::vector expected = whole;
    expected.push_back(PartMethod::decompose);
    Script script{{{PartMethod::decompose, {TryOutcome::mesh, 0.4}}, {PartMethod::block, {TryOutcome::mesh, 0.6}}}};
    PartOptions options;
    const PartDecision decision = run(script, options);
    CHECK(script.asked == expected);
    REQUIRE(decision.taken);
    CHECK(decision.tries[*decision.taken].method == PartMethod::decompose);
    options.decompose = false;
    Script without{script.outcomes};
    const PartDecision blocks = run(without, options);
    CHECK(std::count(without.asked.begin(), without.asked.end(), PartMethod::decompose) == 0);
    CHECK(std::none_of(blocks.tries.begin(), blocks.tries.end(),
                       [](const MethodTry& t) { return t.method == PartMethod::decompose; }));
    CHECK(blocks.tries[*blocks.taken].method == PartMethod::block);
    options.methods = {PartMethod::decompose};  // asked for by itself
    Script named{script.outcomes};
    CHECK(run(named, options, 1).taken == 0);
    CHECK(named.asked == options.methods);
}

TEST_CASE("A method that others follow gets half of what is left, the last one all") {
    Script script;
    PartOptions options;
    options.seconds = 50;
    options.methods = {PartMethod::submap, PartMethod::block};
    (void)run(script, options);  // two solids
    CHECK(script.seconds[0] == Approx(50).epsilon(0.01));
    CHECK(script.seconds[1] == Approx(100).epsilon(0.01));
    Script endless;
    options.seconds = 0;
    (void)run(endless, options);
    CHECK(endless.seconds == std::vector{0.0, 0.0});
}

TEST_CASE("The last resort is tried where nothing is valid, with a part of the time kept for it; or not at all") {
    Script script{
        {{PartMethod::multi_sweep, {TryOutcome::invalid, -0.1}}, {PartMethod::split, {TryOutcome::mesh, 0.15}}}};
    PartOptions options;
    options.seconds = 50;
    const PartDecision decision = run(script, options, 1);
    CHECK(decision.valid());
    CHECK(decision.tries[*decision.taken].method == PartMethod::split);
    REQUIRE(script.asked.size() == 6);
    const double kept = 50 - script.seconds[4];
    CHECK(kept >= 10 - 0.1);
    CHECK(kept <= 20);
    CHECK(script.seconds[0] == Approx(0.5 * (50 - kept)).epsilon(0.01));
    CHECK(script.seconds[3] == Approx(0.5 * (50 - kept)).epsilon(0.01));
    CHECK(script.seconds[5] == Approx(50).epsilon(0.01));
    options.last_resort = false;
    Script without;
    CHECK_FALSE(run(without, options, 1).taken);
    CHECK(without.asked.back() == PartMethod::block);
    CHECK(without.seconds.back() == Approx(50).epsilon(0.01));
    options.methods = {PartMethod::split, PartMethod::submap};
    Script named{{{PartMethod::split, {TryOutcome::mesh, 0.15}}}};
    CHECK(run(named, options, 1).taken == 0);
    CHECK(named.asked == options.methods);
}

TEST_CASE("The last resort comes in the place of a poor mesh only if it is sufficient") {
    for (const double quality : {0.19, 0.21}) {
        Script script{{{PartMethod::block, {TryOutcome::mesh, 0.1}}, {PartMethod::split, {TryOutcome::mesh, quality}}}};
        const PartDecision decision = run(script, {}, 1);
        CHECK(script.asked.back() == PartMethod::split);
        REQUIRE(decision.taken);
        CHECK(decision.tries[*decision.taken].method == (quality < 0.2 ? PartMethod::block : PartMethod::split));
        CHECK(decision.tries.back().data.mesh.nodes.size() == (quality < 0.2 ? 0U : 1U));
    }
}

TEST_CASE("Beside a mesh that is good for nothing the last resort need not be sufficient") {
    Script script{{{PartMethod::block, {TryOutcome::mesh, 0.04}}, {PartMethod::split, {TryOutcome::mesh, 0.19}}}};
    const PartDecision decision = run(script, {}, 1);
    REQUIRE(decision.taken);
    CHECK(decision.tries[*decision.taken].method == PartMethod::split);
}

TEST_CASE("What others use up of the time, the last resort has nevertheless") {
    PartOptions options;
    options.seconds = 0.02;
    double given = 0;
    const PartDecision decision = decide({SolidId{0}}, options, [&](PartMethod method, double seconds) {
        MethodTry result;
        result.method = method;
        result.outcome = TryOutcome::timed_out;
        if (method == PartMethod::split) {
            given = seconds;
            result.outcome = TryOutcome::mesh;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        return result;
    });
    CHECK(decision.valid());
    CHECK(decision.out_of_time);
    CHECK(given >= 0.002);
    CHECK(given <= 0.004);
    CHECK(decision.tries.size() == 6);
}

TEST_CASE("When the time is over nothing more is tried, and the decision says so") {
    PartOptions options;
    options.seconds = 1e-3;
    options.last_resort = false;
    std::size_t asked = 0;
    const PartDecision decision = decide({SolidId{0}}, options, [&](PartMethod, double) {
        ++asked;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return MethodTry{};
    });
    CHECK(asked == 1);
    CHECK(decision.out_of_time);
    CHECK(decision.tries.back().reason == "no time left");
}

TEST_CASE("A stop that is asked for ends the search between two tries") {
    std::stop_source source;
    PartOptions options;
    options.execution = {1, source.get_token()};
    std::size_t asked = 0;
    CHECK_THROWS_AS(decide({SolidId{0}}, options,
                           [&](PartMethod, double) {
                               ++asked;
                               source.request_stop();
                               return MethodTry{};
                           }),
                    Stopped);
    CHECK(asked == 1);
}
