#include "bench/bench.h"

#include "scene/reader.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <sys/resource.h>

namespace tyndall::bench {

double cpu_seconds() {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return double(t.tv_sec) + double(t.tv_usec) * 1e-6;
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double device_seconds() {
    if (context().info().type == "cpu") return cpu_seconds();
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

Image render_timed(Renderer& renderer, std::uint64_t seed, std::uint32_t samples, double& seconds) {
    renderer.set_seed(seed);
    seconds = std::min(seconds, cost_of([&] { renderer.render(0, samples); }));
    return renderer.read_film();
}

gpu::Context& context() {
    static gpu::Context instance({});
    return instance;
}

Scene read_bench_scene(const std::string& path, int size) {
    Scene scene = read_scene(std::string(TYNDALL_TEST_SOURCES) + "/" + path + ".pbrt");
    scene.film.width = scene.film.height = size;
    scene.film.bounds = {0, size, 0, size};
    fit_screen_window(scene);
    return scene;
}

} // namespace tyndall::bench

BENCHMARK_MAIN();
