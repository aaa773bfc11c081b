/// How work is best cut up on a device for a kind of scene: found by trying, and kept.
#pragma once

#include "render/renderer.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace tyndall {

/// Tries stages, slots, run lengths and workgroup sizes on the middle of the picture, each for
/// tenths of a second or more in the midst of a render, and returns the fastest.
/// @param fixed    What is not 0 stays.
/// @param goes_on  Asked often: false ends the trials, and what was found by then counts.
Tuning calibrate(const gpu::Context& context, Scene scene, const Tuning& fixed,
                 const std::function<bool()>& goes_on);

/// Scenes that the same tuning serves: those with the same effects.
std::string tuning_key(const shared::Features& scene);

/// Tunings by device and key, in a file of JSON. A file that is missing or damaged counts as empty;
/// one that cannot be written is not.
class TuningFile {
  public:
    /// @param folder  made by the first store(); empty: nothing is found or stored.
    TuningFile(const std::filesystem::path& folder, const gpu::DeviceInfo& device);

    std::optional<Tuning> find(const std::string& key) const;
    void store(const std::string& key, const Tuning& tuning) const;

  private:
    std::filesystem::path file_;
    std::string device_; ///< Name and driver, for both decide.
};

} // namespace tyndall
