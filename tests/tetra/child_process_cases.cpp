#include "common/byte_arrays.hpp"
#include "common/child_process.hpp"

#include "support/catch.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace pavior;
using detail::ChildAnswer;
using End = detail::ChildAnswer::End;

namespace {

using Task = std::function<std::string()>;

}  // namespace

TEST_CASE("Whatever foreign code does in its process comes back as an answer") {
    const auto check = [](const Task& task, End end, const std::string& text) {
        const ChildAnswer answer = detail::run_in_child(task, {.seconds = 0.5});
        CHECK(answer.end == end);
        CHECK((answer.end == End::answered ? answer.bytes : answer.reason) == text);
    };
    const Task fault = []() -> std::string {
        std::raise(SIGSEGV);
        return "went on";
    };
    const Task loop = []() -> std::string {
        for (;;) {
            std::this_thread::yield();
        }
    };
    const Task chatter = [] {
        std::printf("chatter\n");
        return std::string();
    };
    check([] { return std::string("done"); }, End::answered, "done");
    check(chatter, End::answered, "");
    check([]() -> std::string { std::abort(); }, End::died, "crashed (signal 6)");
    check(fault, End::died, "crashed (signal 11)");
    check([]() -> std::string { std::exit(0); }, End::died, "ended itself (status 3)");
    check([]() -> std::string { throw 3; }, End::threw, "something unknown was thrown");
    check([]() -> std::string { throw std::runtime_error("no"); }, End::threw, "no");
    check(loop, End::timed_out, "");
}

TEST_CASE("A child without a time limit may take its time") {
    const Task slow = [] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        return std::string("late");
    };
    CHECK(detail::run_in_child(slow, {}).bytes == "late");
}

TEST_CASE("Large arrays travel between processes, from several threads at once") {
    const std::vector<double> nodes(300000, 0.5);
    const std::vector<Vec3> points(1000, Vec3(1, 2, 3));
    const Task task = [&] {
        detail::ByteWriter writer;
        writer.add(nodes);
        writer.add(std::vector<int>());
        writer.add(points);
        return writer.take();
    };
    std::vector<ChildAnswer> answers(4);
    std::vector<std::thread> threads;
    for (ChildAnswer& answer : answers) {
        threads.emplace_back([&] { answer = detail::run_in_child(task, {.seconds = 60}); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const ChildAnswer& answer : answers) {
        REQUIRE(answer.end == End::answered);
        detail::ByteReader reader(answer.bytes);
        std::vector<double> some;
        std::vector<int> none{1};
        std::vector<Vec3> more;
        reader.get(some);
        reader.get(none);
        reader.get(more);
        CHECK((some == nodes && none.empty() && more == points));
    }
}

TEST_CASE("What a child prints can be heard, and can end it") {
    const Task chatter = [] {
        std::printf("one\n");
        std::fprintf(stderr, "two\n");
        return std::string("done");
    };
    const auto never = [](const std::string&) { return false; };
    const ChildAnswer heard = detail::run_in_child(chatter, {.seconds = 5, .heard_enough = never});
    CHECK(heard.end == End::answered);
    CHECK(heard.bytes == "done");
    CHECK(heard.said.find("one\n") != std::string::npos);
    CHECK(heard.said.find("two\n") != std::string::npos);

    const Task stuck = []() -> std::string {
        std::fprintf(stderr, "syntax error\n");
        for (;;) {
            std::this_thread::yield();
        }
    };
    const auto enough = [](const std::string& said) { return said.find("syntax") != std::string::npos; };
    const auto begin = std::chrono::steady_clock::now();
    const ChildAnswer ended = detail::run_in_child(stuck, {.seconds = 20, .heard_enough = enough});
    CHECK(ended.end == End::heard);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(5));

    const Task flood = [] {
        for (int i = 0; i < 100000; ++i) {
            std::printf("a line that fills the pipe\n");
        }
        return std::string("done");
    };
    CHECK(detail::run_in_child(flood, {.seconds = 20, .heard_enough = never}).bytes == "done");
}
