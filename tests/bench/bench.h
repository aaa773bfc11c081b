/// What the benchmarks share: CPU time, a device, scenes.
///
/// Every figure is CPU seconds of the whole process (a CPU driver's threads included), which other
/// load on the machine disturbs less than wall time.
#pragma once

#include "render/renderer.h"

#include <string>

namespace tyndall::bench {

/// Of this process so far, all threads.
double cpu_seconds();

/// CPU seconds of what `work` does.
template<typename Work>
double cpu_of(const Work& work) {
    const double start = cpu_seconds();
    work();
    return cpu_seconds() - start;
}

/// The first usable device; made by the first call.
gpu::Context& context();

/// @param path  in tests/, without its extension.
Scene read_bench_scene(const std::string& path, int size);

} // namespace tyndall::bench
