#include "render/calibration.h"

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/json_text.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/format.h>
#include <fstream>

namespace tyndall {
namespace {

using nlohmann::json;

constexpr double kTrialSeconds = 0.3; // at least
constexpr int kTrialPixels = 256;     // at most, along an edge
constexpr std::uint32_t kMostSamples = 1u << 20;
/// By how much another tuning must be faster to count as faster: trials are short.
constexpr double kGain = 1.05;
/// Paths that a trial begins for each that it has in flight at a time, at least: with fewer, many
/// slots would seem fast, since of the paths in flight the short ones end first.
constexpr std::uint32_t kPathsPerSlot = 8;

/// One number of a tuning, and where looking for better ones ends.
struct Knob {
    const char* name;
    std::uint32_t Tuning::*value;
    std::uint32_t least, most;
};
constexpr Knob kStages{"stages", &Tuning::stages, STAGES_FUSED, STAGES_APART};
constexpr std::array<Knob, 3> kSizes{{{"slots", &Tuning::slots, 256, 1u << 22},
                                      {"run_length", &Tuning::run_length, 8, 1024},
                                      {"workgroup_size", &Tuning::workgroup_size, 16, 1024}}};
constexpr std::array<Knob, 4> kKnobs{{kStages, kSizes[0], kSizes[1], kSizes[2]}};

/// A renderer, and how much of a picture it renders in a trial.
class Trials {
  public:
    Trials(const gpu::Context& context, const Scene& scene, const Tuning& first,
           const std::function<bool()>& goes_on)
        : renderer_(context, scene, first), goes_on_(goes_on),
          pixels_(std::uint32_t(scene.film.bounds.width() * scene.film.bounds.height())) {
        while (goes_on_() && samples_ < kMostSamples &&
               (!can_judge(tuning().slots) || seconds() < kTrialSeconds))
            samples_ *= 2;
    }
    const Tuning& tuning() const { return renderer_.wavefront().tuning(); }
    /// Goes on with the tuning if that is faster than the present one, two times of three.
    bool adopt_if_faster(const Tuning& next);

  private:
    bool can_judge(std::uint32_t slots) const {
        return samples_ * pixels_ >= double(kPathsPerSlot) * slots;
    }
    double seconds();

    Renderer renderer_;
    const std::function<bool()>& goes_on_;
    double pixels_;
    double samples_ = 1; ///< Per pixel.
};

/// From a third of the samples to all of them, in the midst of a longer render: a long render has
/// little of what comes before, when drivers compile, and after, when all wait for the last paths.
double Trials::seconds() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const std::array<double, 2> goals{samples_ / 3, samples_};
    std::array<double, 2> times{};
    double last_done = 0, last_time = 0;
    renderer_.render(0, 2 * kMostSamples, [&](const Progress& progress) {
        const double time = std::chrono::duration<double>(Clock::now() - start).count();
        for (std::size_t i = 0; i < goals.size(); ++i)
            if (last_done < goals[i] && goals[i] <= progress.done)
                times[i] = last_time + (time - last_time) * (goals[i] - last_done) /
                                           (progress.done - last_done);
        last_done = progress.done;
        last_time = time;
        return last_done < samples_ && goes_on_();
    });
    return times[1] - times[0];
}

bool Trials::adopt_if_faster(const Tuning& next) {
    const Tuning before = tuning();
    if (!goes_on_() || !can_judge(next.slots)) return false;
    int wins = 0, losses = 0;
    while (wins < 2 && losses < 2) {
        renderer_.retune(before);
        const double seconds_before = seconds();
        // A device may not allow what was asked for, or lack the memory.
        try {
            renderer_.retune(next);
        } catch (const Error&) {
            losses = 2;
            break;
        }
        if (tuning() == before) return false;
        const double seconds_next = seconds();
        if (!goes_on_()) losses = 2; // the trials were cut short
        ++(kGain * seconds_next < seconds_before ? wins : losses);
    }
    if (losses >= 2) renderer_.retune(before);
    return losses < 2;
}

/// Goes on by the factor as long as that is faster. False if it is not even once.
bool walk(Trials& trials, const Knob& knob, double factor) {
    bool has_moved = false;
    for (;;) {
        Tuning next = trials.tuning();
        next.*knob.value = static_cast<std::uint32_t>(factor * next.*knob.value);
        if (next.*knob.value < knob.least || next.*knob.value > knob.most ||
            !trials.adopt_if_faster(next))
            return has_moved;
        has_moved = true;
    }
}

/// The middle of an interval, cut to a length.
void cut(int& first, int& end, int most) {
    const int excess = std::max(end - first - most, 0);
    first += excess / 2;
    end -= excess - excess / 2;
}

json read(const std::filesystem::path& file) {
    std::ifstream in(file);
    const json all = json::parse(in, nullptr, false);
    return all.is_object() ? all : json::object();
}

} // namespace

Tuning calibrate(const gpu::Context& context, Scene scene, const Tuning& fixed,
                 const std::function<bool()>& goes_on) {
    cut(scene.film.bounds.x0, scene.film.bounds.x1, kTrialPixels);
    cut(scene.film.bounds.y0, scene.film.bounds.y1, kTrialPixels);
    Trials trials(context, scene, fixed, goes_on);
    if (fixed.stages == 0) { // with sizes that suit it
        Tuning fused = fixed;
        fused.stages = STAGES_FUSED;
        trials.adopt_if_faster(fused);
    }
    for (const Knob& knob : kSizes)
        if (fixed.*knob.value == 0 && !walk(trials, knob, 2)) walk(trials, knob, 0.5);
    return trials.tuning();
}

std::string tuning_key(const shared::Features& scene) {
    std::string key;
#define TYNDALL_FEATURE_TEXT(id, name, value) key += fmt::format("{} ", scene.name);
    TYNDALL_FEATURES(TYNDALL_FEATURE_TEXT)
#undef TYNDALL_FEATURE_TEXT
    return key;
}

TuningFile::TuningFile(const std::filesystem::path& folder, const gpu::DeviceInfo& device)
    : file_(folder.empty() ? folder : folder / "tunings.json"),
      device_(device.name + ", " + device.driver) {}

std::optional<Tuning> TuningFile::find(const std::string& key) const {
    if (file_.empty()) return std::nullopt;
    const json all = read(file_);
    if (!all.contains(device_) || !all[device_].is_object()) return std::nullopt;
    const json entry = all[device_].value(key, json());
    Tuning tuning;
    for (const Knob& knob : kKnobs) {
        if (!entry.is_object() || !entry.contains(knob.name)) return std::nullopt;
        const json& value = entry[knob.name];
        if (!value.is_number_unsigned() || value < knob.least || value > knob.most)
            return std::nullopt;
        tuning.*knob.value = value;
    }
    return tuning;
}

void TuningFile::store(const std::string& key, const Tuning& tuning) const {
    if (file_.empty()) return;
    json all = read(file_);
    if (!all[device_].is_object()) all[device_] = json::object();
    json& entry = all[device_][key] = json::object();
    for (const Knob& knob : kKnobs)
        entry[knob.name] = tuning.*knob.value;
    try {
        std::filesystem::create_directories(file_.parent_path());
        AtomicFile out(file_);
        std::fputs(json_text(all, 1).c_str(), out.stream());
        out.commit();
    } catch (const std::exception&) {
        // A home that cannot be written to costs the next run its speed, and nothing else.
    }
}

} // namespace tyndall
