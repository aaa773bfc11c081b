/// Film, camera, filter, sampler, integrator and accelerator from their parameters.
///
/// After an error the value has defaults where its parameters were wrong.
#pragma once

#include "scene/parameters.h"
#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tyndall {

/// Kind, lens and window; the transformation and the medium are the caller's.
Camera read_camera(const std::string& type, Parameters& parameters);

Film read_film(const std::string& type, Parameters& parameters);

PixelFilter read_pixel_filter(const std::string& type, Parameters& parameters);

/// "volpath" (or any other), "path", "singlescatter".
Integrator::Kind integrator_kind(std::string_view name);

Integrator read_integrator(const std::string& type, Parameters& parameters);

/// What is left of a sampler: all of pbrt's but "independent" and "zsobol" become
/// Owen-scrambled Sobol' points.
struct SamplerSettings {
    Sampler sampler = Sampler::independent;
    int samples_per_pixel = 16;
    std::optional<std::uint64_t> seed;
};
SamplerSettings read_sampler(const std::string& type, Parameters& parameters);

/// Checks only: Tyndall has one accelerator.
void read_accelerator(const std::string& type, Parameters& parameters);

} // namespace tyndall
