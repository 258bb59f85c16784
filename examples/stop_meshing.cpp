// Stops a long call after 100 ms from another thread: stop_meshing PART.step
#include <pavior/core/stop.hpp>
#include <pavior/part/mesh_file.hpp>

#include <chrono>
#include <cstdio>
#include <stop_token>
#include <thread>

int main(int, char** argv) {
    using namespace std::chrono_literals;
    std::stop_source source;
    const std::jthread clock([&] {
        std::this_thread::sleep_for(100ms);
        source.request_stop();
    });
    try {
        (void)pavior::mesh_file(argv[1], {.size = 0.1, .execution = {1, source.get_token()}});
        std::puts("done before 100 ms were over");
    } catch (const pavior::Stopped& stopped) {
        std::puts(stopped.what());
    }
}
