#include "render/calibration.h"

#include "core/atomic_file.h"
#include "core/json_text.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/format.h>
#include <fstream>

namespace tyndall {
namespace {

using nlohmann::json;

constexpr double kTrialSeconds = 0.1;
constexpr int kTrialPixels = 256; // at most, along an edge
/// By how much another tuning must be faster, each time, to count as faster: trials are short.
constexpr double kGain = 1.02;

/// One number of a tuning, and where looking for better ones ends.
struct Knob {
    const char* name;
    std::uint32_t Tuning::*value;
    std::uint32_t least, most;
};
constexpr std::array<Knob, 3> kKnobs{{{"slots", &Tuning::slots, 256, 1u << 22},
                                      {"run_length", &Tuning::run_length, 8, 4096},
                                      {"workgroup_size", &Tuning::workgroup_size, 16, 1024}}};

/// A renderer, and how much of a picture it renders in a trial.
class Trials {
  public:
    Trials(const gpu::Context& context, const Scene& scene, const Tuning& tuning)
        : renderer_(context, scene, tuning) {
        while (seconds() < kTrialSeconds && samples_ < 1u << 20)
            samples_ *= 2;
    }
    const Tuning& tuning() const { return renderer_.wavefront().tuning(); }
    /// Goes on with the tuning if that is faster than the present one, in two turns.
    bool adopt_if_faster(const Tuning& tuning);

  private:
    /// That a trial takes; not what a driver compiles only once it is needed.
    double seconds() {
        renderer_.render(0, 1);
        const auto start = std::chrono::steady_clock::now();
        renderer_.render(0, samples_);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    Renderer renderer_;
    std::uint32_t samples_ = 1;
};

bool Trials::adopt_if_faster(const Tuning& next) {
    const Tuning before = tuning();
    for (int turn = 0; turn < 2; ++turn) {
        renderer_.retune(before);
        const double seconds_before = seconds();
        renderer_.retune(next);
        // A device may not allow what was asked for.
        if (tuning() == before || kGain * seconds() > seconds_before) {
            renderer_.retune(before);
            return false;
        }
    }
    return true;
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

Tuning calibrate(const gpu::Context& context, Scene scene, const Tuning& fixed) {
    cut(scene.film.bounds.x0, scene.film.bounds.x1, kTrialPixels);
    cut(scene.film.bounds.y0, scene.film.bounds.y1, kTrialPixels);
    Trials trials(context, scene, fixed);
    for (const Knob& knob : kKnobs)
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
    for (const Knob& knob : kKnobs)
        all[device_][key][knob.name] = tuning.*knob.value;
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
