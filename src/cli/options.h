/// The command line, as values. See DESIGN: scripts depend on names and meanings.
#pragma once

#include "render/wavefront.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace tyndall::cli {

/// A word as a shell takes it: in quotes if it needs them.
std::string in_shell_quotes(const std::string& word);

/// What `render`, `verify` and `info` have in common: a scene, and changes to it.
struct SceneOptions {
    std::string scene;
    std::optional<std::uint32_t> spp;
    std::optional<std::uint64_t> seed;
    std::optional<std::string> size; ///< WxH
    std::optional<std::string> crop; ///< X0,X1,Y0,Y1, each 0..1
    std::optional<int> max_depth;
    std::optional<std::string> integrator;
};

struct DeviceOptions {
    std::string device; ///< Name, index, or "reference".
    bool validate = false;
    Tuning tuning;
    bool calibrate = false; ///< Look for a faster tuning first, and keep it.
};

struct RenderOptions {
    SceneOptions scene;
    DeviceOptions device;
    std::vector<std::string> outputs;
    std::vector<std::string> aovs;           ///< "orders"
    std::optional<double> time;              ///< Seconds.
    std::optional<std::string> target_error; ///< "0.005" or "0.5%"
    std::optional<double> write_interval;    ///< Seconds.
    std::string stats;
    std::string replay; ///< X,Y,SAMPLE of a path to tell about instead, or "".
    bool strict = false;
    bool quiet = false;
};

struct VerifyOptions {
    SceneOptions scene;
    DeviceOptions device;
    std::uint32_t batches = 16;
    double corrupt = 0;
    bool json = false;
    bool quiet = false;
};

struct StudyOptions {
    SceneOptions scene;
    DeviceOptions device;
    std::string folder;
    std::vector<std::string> techniques; ///< Names or patterns; none: all.
    double budget = 120;                 ///< Seconds.
    std::string reference;               ///< Image file, or "".
    std::string command_line;            ///< As it was given.
    bool quiet = false;
};

struct InfoOptions {
    SceneOptions scene;
    bool json = false;
    bool phase = false;     ///< Tell of phase functions.
    std::string phase_plot; ///< File for their plots, or "".
};

struct CompareOptions {
    std::string a, b;
    std::string difference; ///< File for the difference image, or "".
    bool json = false;
};

struct DevicesOptions {
    bool json = false;
};

struct SelftestOptions {
    DeviceOptions device;
    double corrupt = 0;
    bool json = false;
};

/// Each command's work; returns the exit status. Throws Error.
int run_render(const RenderOptions& options);
int run_replay(const RenderOptions& options);
int run_verify(const VerifyOptions& options);
int run_study(const StudyOptions& options);
int run_info(const InfoOptions& options);
int run_compare(const CompareOptions& options);
int run_devices(const DevicesOptions& options);
int run_selftest(const SelftestOptions& options);

/// Parses the command line and runs what it asks for.
int run(int argc, char** argv);

/// Reads the scene, prints its warnings, and applies the changes. Unless `quiet` it tells which
/// file it is at, if that takes time. Throws Error (bad usage: bad_input).
Scene load_scene(const SceneOptions& options, bool quiet);

/// Gives the picture another size; a crop window stays the same part of it.
void resize_film(Scene& scene, int width, int height);

} // namespace tyndall::cli
