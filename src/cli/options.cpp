#include "cli/options.h"

#include "core/error.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace tyndall::cli {
namespace {

void add_picture_options(CLI::App& app, SceneOptions& o) {
    app.add_option("scene", o.scene, "Scene file (.pbrt, .pbrt.gz)")->required();
    app.add_option("--seed", o.seed, "Seed of the random numbers");
    app.add_option("--size", o.size, "Picture size WxH in pixels");
    app.add_option("--crop", o.crop, "Part to render: X0,X1,Y0,Y1, each 0..1");
    app.add_option("--maxdepth", o.max_depth, "Most scattering events of a path")
        ->check(CLI::NonNegativeNumber);
}

/// CLI::PositiveNumber lets NaN pass.
const CLI::Validator finite_positive(
    [](const std::string& text) {
        const double value = std::strtod(text.c_str(), nullptr);
        const bool is_good = std::isfinite(value) && value > 0;
        return is_good ? std::string() : text + " is not a positive number";
    },
    "POSITIVE");

void add_scene_options(CLI::App& app, SceneOptions& o) {
    add_picture_options(app, o);
    app.add_option("--spp", o.spp, "Samples per pixel")->check(CLI::Range(1u, 0x7FFFFFFFu));
    app.add_option("--integrator", o.integrator, "volpath, path or singlescatter")
        ->check(CLI::IsMember({"volpath", "path", "singlescatter"}));
}

void add_device_choice(CLI::App& app, DeviceOptions& o) {
    app.add_option("--device", o.device,
                   "Device name or index (see `tyndall devices`), or reference");
    app.add_flag("--validate", o.validate, "Run with the Vulkan validation layer");
}

void add_device_options(CLI::App& app, DeviceOptions& o) {
    add_device_choice(app, o);
    app.add_option("--slots", o.tuning.slots, "Paths in flight (does not change the image)");
    app.add_option("--run-length", o.tuning.run_length,
                   "Most events per path and dispatch (does not change the image)");
    app.add_option("--workgroup", o.tuning.workgroup_size,
                   "Invocations per workgroup (does not change the image)");
    app.add_option("--stages", o.tuning.stages,
                   "What paths go through in a round: one kernel or many (does not change the "
                   "image)")
        ->transform(CLI::CheckedTransformer(std::map<std::string, std::uint32_t>{
                                                {"fused", STAGES_FUSED}, {"apart", STAGES_APART}})
                        .description("fused or apart"));
}

void add_render(CLI::App& app, RenderOptions& o, int& status) {
    CLI::App* command = app.add_subcommand("render", "Render a scene");
    add_scene_options(*command, o.scene);
    add_device_options(*command, o.device);
    command
        ->add_option("-o,--output", o.outputs,
                     "Image file by extension: .exr .png .hdr .tif (repeatable)")
        ->allow_extra_args(false);
    command->add_option("--aov", o.aovs, "More layers in .exr outputs: orders")
        ->delimiter(',')
        ->check(CLI::IsMember({"orders"}));
    command->add_option("--time", o.time, "End after this many seconds")->check(finite_positive);
    command->add_option("--target-error", o.target_error,
                        "End when the image's relative error is surely below: 0.005 or 0.5%");
    command
        ->add_option("--write-interval", o.write_interval,
                     "Write the image so far every so many seconds")
        ->check(finite_positive);
    command->add_flag("--calibrate", o.device.calibrate,
                      "First try, for seconds, how the device is fastest with such scenes; later "
                      "renders use what was found");
    command->add_option("--stats", o.stats, "Write statistics as JSON");
    command->add_option("--replay", o.replay,
                        "Instead: trace one path, X,Y,SAMPLE, on the device and on the reference, "
                        "and print both event by event");
    command->add_flag("--strict", o.strict, "Fail if anything went wrong with any path");
    command->add_flag("--quiet", o.quiet, "No progress");
    command->callback([&] { status = o.replay.empty() ? run_render(o) : run_replay(o); });
}

void add_verify(CLI::App& app, VerifyOptions& o, int& status) {
    CLI::App* command = app.add_subcommand(
        "verify", "Test the device's image of a scene against the reference renderer");
    add_scene_options(*command, o.scene);
    add_device_options(*command, o.device);
    command
        ->add_option("--batches", o.batches, "Independent batches that the samples are split into")
        ->check(CLI::Range(4, 256));
    command->add_option(
        "--corrupt", o.corrupt,
        "Control: perturb the device's image by this fraction; it must be rejected");
    command->add_flag("--json", o.json, "Print the result as JSON");
    command->add_flag("--quiet", o.quiet, "No progress");
    command->callback([&] { status = run_verify(o); });
}

void add_study(CLI::App& app, StudyOptions& o, int& status) {
    CLI::App* command =
        app.add_subcommand("study", "Compare techniques: accuracy against time, as a report");
    add_picture_options(*command, o.scene);
    command->add_option("-o,--output", o.folder, "Folder for the report")->required();
    command
        ->add_option("--technique", o.techniques,
                     "Technique to measure, * for any characters (repeatable; default: all)")
        ->allow_extra_args(false);
    command->add_option("--budget", o.budget, "Seconds for everything")
        ->check(finite_positive)
        ->capture_default_str();
    command->add_option("--reference", o.reference,
                        "Image to measure errors from (default: one is made)");
    command->add_option("--device", o.device.device,
                        "Device name or index (see `tyndall devices`)");
    command->add_flag("--validate", o.device.validate, "Run with the Vulkan validation layer");
    command->add_flag("--quiet", o.quiet, "No progress");
    command->callback([&] { status = run_study(o); });
}

void add_rest(CLI::App& app, InfoOptions& info, CompareOptions& compare, DevicesOptions& devices,
              int& status) {
    CLI::App* command = app.add_subcommand("info", "Tell what a scene calls for; renders nothing");
    add_scene_options(*command, info.scene);
    command->add_flag("--json", info.json, "Print as JSON");
    command->add_flag("--phase", info.phase,
                      "Tell mean cosines of phase functions, and efficiencies of spheres");
    command->add_option("--phase-plot", info.phase_plot,
                        "Write polar plots of phase functions and of their samples (SVG)");
    command->callback([&] { status = run_info(info); });

    command = app.add_subcommand("compare", "Compare two images");
    command->add_option("a", compare.a, "Image")->required();
    command->add_option("b", compare.b, "Image taken as the reference")->required();
    command->add_option("-o,--output", compare.difference, "Write the difference a - b");
    command->add_flag("--json", compare.json, "Print as JSON");
    command->callback([&] { status = run_compare(compare); });

    command = app.add_subcommand("devices", "List what Vulkan offers here");
    command->add_flag("--json", devices.json, "Print as JSON");
    command->callback([&] { status = run_devices(devices); });
}

void add_selftest(CLI::App& app, SelftestOptions& o, int& status) {
    CLI::App* command = app.add_subcommand(
        "selftest", "Test the device: hard arguments, and scenes with known radiance");
    add_device_choice(*command, o.device);
    command->add_option(
        "--corrupt", o.corrupt,
        "Control: make what the device gives wrong by this fraction; every case must fail");
    command->add_flag("--json", o.json, "Print the table as JSON");
    command->callback([&] { status = run_selftest(o); });
}

/// The arguments as a shell would take them.
std::string command_line(int argc, char** argv) {
    std::string text = "tyndall";
    for (int i = 1; i < argc; ++i)
        text += ' ' + in_shell_quotes(argv[i]);
    return text;
}

} // namespace

std::string in_shell_quotes(const std::string& word) {
    if (!word.empty() && word.find_first_of(" \t\n'\"`*?[]{}~#!$&|;<>()\\") == std::string::npos)
        return word;
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

int run(int argc, char** argv) {
    CLI::App app("Tyndall: light in participating media, on any Vulkan device.", "tyndall");
    app.set_version_flag("--version", TYNDALL_VERSION);
    app.require_subcommand(1);
    int status = 0;
    RenderOptions render;
    VerifyOptions verify;
    StudyOptions study{.command_line = command_line(argc, argv)};
    InfoOptions info;
    CompareOptions compare;
    DevicesOptions devices;
    SelftestOptions selftest;
    add_render(app, render, status);
    add_verify(app, verify, status);
    add_study(app, study, status);
    add_rest(app, info, compare, devices, status);
    add_selftest(app, selftest, status);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        const int code = app.exit(e);
        return code == 0 ? 0 : static_cast<int>(ExitStatus::bad_input);
    }
    return status;
}

} // namespace tyndall::cli
