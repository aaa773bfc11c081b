#include "study/results.h"

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/json_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

namespace tyndall::study {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Estimate, value, sd)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Level, samples, seconds, clock_seconds, error, noise, bias,
                                   slice_samples, slice_noise)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EqualTime, samples, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TechniqueResult, name, title, family, series, parameter,
                                   is_unbiased, problem, build_seconds, compile_seconds,
                                   first_seconds, spent_seconds, seconds_per_render,
                                   seconds_per_sample, levels, brightness, equal_time, health)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReferenceResult, file, samples, seconds, error)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Results, version, scene, sha256, device, driver, command, date,
                                   seed, width, height, part, scene_width, scene_height, max_depth,
                                   budget_seconds, scene_seconds, equal_time_seconds, is_complete,
                                   processors, effects, reference, techniques)

namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
    AtomicFile out(path);
    std::fwrite(text.data(), 1, text.size(), out.stream());
    out.commit();
}

/// The ends of the 95 % interval of an error whose square was estimated; none below what can be
/// told.
std::string interval(const Estimate& square) {
    const double low = square.value - 1.96 * square.sd, high = square.value + 1.96 * square.sd;
    return fmt::format("{:.6g},{:.6g},{:.6g}", std::sqrt(std::max(0.0, square.value)),
                       std::sqrt(std::max(0.0, low)), std::sqrt(std::max(0.0, high)));
}

std::string csv(const Results& results) {
    std::string text =
        "technique,family,unbiased,samples,seconds,clock_seconds,error,error_low,error_high,noise,"
        "noise_low,noise_high,bias,bias_low,bias_high\n";
    for (const TechniqueResult& t : results.techniques)
        for (const Level& level : t.levels)
            text += fmt::format("{},{},{},{},{:.6g},{:.6g},{},{},{}\n", t.name, t.family,
                                t.is_unbiased ? 1 : 0, level.samples, level.seconds,
                                level.clock_seconds, interval(level.error), interval(level.noise),
                                interval(level.bias));
    return text;
}

} // namespace

const TechniqueResult* Results::find(const std::string& name) const {
    const auto found =
        std::find_if(techniques.begin(), techniques.end(),
                     [&](const TechniqueResult& technique) { return technique.name == name; });
    return found == techniques.end() ? nullptr : &*found;
}

std::string family_name(Family family) {
    switch (family) {
    case Family::estimators:
        return "estimators";
    case Family::marching:
        return "marching";
    case Family::orders:
        return "orders";
    case Family::cells:
        return "cells";
    case Family::phases:
        return "phases";
    case Family::without:
        return "without";
    }
    return "";
}

void write_results(const Results& results, const std::filesystem::path& folder) {
    write_text(folder / "results.json", json_text(results, 1) + '\n');
    write_text(folder / "results.csv", csv(results));
}

std::optional<Results> read_results(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / "results.json";
    std::ifstream in(path);
    if (!in) return std::nullopt;
    try {
        return nlohmann::json::parse(in).get<Results>();
    } catch (const nlohmann::json::exception& e) {
        throw Error(ExitStatus::bad_input,
                    fmt::format("{} is not what a study of this version writes: {}", path.string(),
                                e.what()));
    }
}

} // namespace tyndall::study
