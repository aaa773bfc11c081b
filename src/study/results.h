/// What a study found, as values: results.json and results.csv hold all of it, and the report is
/// made from nothing else but this and the pictures.
#pragma once

#include "study/error_split.h"
#include "study/techniques.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tyndall::study {

/// A technique after so many samples of each pixel, seen in kRuns independent runs.
struct Level {
    std::uint32_t samples = 0;
    /// Of a render of so many samples, without loading and compiling. On a CPU device: processor
    /// time over the number of processors, which is what the clock shows where nothing else runs,
    /// and hardly depends on what does run. Else: by the clock.
    double seconds = 0;
    double clock_seconds = 0;    ///< Of a run, by the clock.
    Estimate error, noise, bias; ///< Squared and relative, see ErrorSplit.
    /// Of the samples after those of the level before alone: independent of it, which fits need.
    std::uint32_t slice_samples = 0;
    Estimate slice_noise;
};

/// A picture for the eye, after the same time for every technique.
struct EqualTime {
    std::uint32_t samples = 0;
    double seconds = 0;
};

struct TechniqueResult {
    std::string name, title, family, series;
    double parameter = 0;
    bool is_unbiased = false;
    std::string problem; ///< Why there are no levels, or "".
    double build_seconds = 0, compile_seconds = 0;
    double first_seconds = 0; ///< One sample, with what drivers compile late.
    double spent_seconds = 0; ///< All of it.
    /// Of Level::seconds: what a render takes in any case, since its last paths have the device for
    /// themselves, and what each sample of each pixel adds.
    double seconds_per_render = 0, seconds_per_sample = 0;
    std::vector<Level> levels;
    Estimate brightness; ///< brightness_error at the last level.
    EqualTime equal_time;
    std::map<std::string, std::uint64_t> health; ///< Dropped contributions, by kind, if any.

    bool is_measured() const { return !levels.empty(); }
    const Level& last() const { return levels.back(); }
};

struct ReferenceResult {
    std::string file; ///< Given by the user, or "".
    std::uint32_t samples = 0;
    double seconds = 0;
    Estimate error; ///< Squared and relative.
};

struct Results {
    std::string version, scene, sha256, device, driver, command, date;
    std::uint64_t seed = 0;
    int width = 0, height = 0;             ///< Of what was rendered.
    std::string part;                      ///< Of which picture that is which pixels.
    int scene_width = 0, scene_height = 0; ///< Of what the scene asks for.
    int max_depth = 0;
    double budget_seconds = 0, scene_seconds = 0;
    double equal_time_seconds = 0;    ///< What EqualTime pictures get.
    int processors = 0;               ///< That seconds are shared among; 0: they are the clock's.
    bool is_complete = false;         ///< Every technique was measured that was asked for.
    std::vector<std::string> effects; ///< "name: value", those that the scene calls for.
    ReferenceResult reference;
    std::vector<TechniqueResult> techniques;

    const TechniqueResult* find(const std::string& name) const;
};

std::string family_name(Family family);

/// @throws Error failed: a file cannot be written.
void write_results(const Results& results, const std::filesystem::path& folder);

/// None if the folder holds no results.json.
/// @throws Error bad_input: results.json is not one of this program's.
std::optional<Results> read_results(const std::filesystem::path& folder);

} // namespace tyndall::study
