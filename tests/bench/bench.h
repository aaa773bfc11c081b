/// What the benchmarks share: clocks, a device, scenes.
#pragma once

#include "render/renderer.h"

#include <string>

namespace tyndall::bench {

/// CPU seconds of this process so far, all threads.
double cpu_seconds();
/// A clock for what the device does: where it is the CPU, its driver's threads are this process's,
/// and other load on the machine disturbs CPU time less than elapsed time, which is for the others.
double device_seconds();

template<typename Work>
double cpu_of(const Work& work) {
    const double start = cpu_seconds();
    work();
    return cpu_seconds() - start;
}

/// What work costs that waits for the device.
template<typename Work>
double cost_of(const Work& work) {
    const double start = device_seconds();
    work();
    return device_seconds() - start;
}

/// The film by a seed; `seconds` becomes what it cost, if that is less.
Image render_timed(Renderer& renderer, std::uint64_t seed, std::uint32_t samples, double& seconds);

/// The first usable device; made by the first call.
gpu::Context& context();

/// @param path  in tests/, without its extension.
Scene read_bench_scene(const std::string& path, int size);

} // namespace tyndall::bench
