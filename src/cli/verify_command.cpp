#include "cli/engine.h"
#include "cli/interrupt.h"
#include "cli/progress_line.h"
#include "core/error.h"
#include "core/json_text.h"
#include "stats/agreement.h"
#include "stats/compare.h"

#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tyndall::cli {
namespace {

using nlohmann::json;

/// Renders the samples in equal batches; each is an independent estimate.
std::vector<stats::PixelSums> render_batches(Engine& engine, const VerifyOptions& options,
                                             std::uint32_t samples, const char* what) {
    ProgressLine line(options.quiet);
    std::vector<stats::PixelSums> batches;
    for (std::uint32_t i = 0; i < options.batches; ++i) {
        const auto first = static_cast<std::uint32_t>(std::uint64_t{samples} * i / options.batches);
        const auto end =
            static_cast<std::uint32_t>(std::uint64_t{samples} * (i + 1) / options.batches);
        engine.render(first, end, [](const Progress&) { return !was_interrupted(); });
        if (was_interrupted()) throw Error(ExitStatus::interrupted, "interrupted");
        batches.push_back(engine.read_sums());
        if (line.is_due())
            line.print(fmt::format("{}: {} of {} batches", what, i + 1, options.batches));
    }
    return batches;
}

/// The control: a device whose radiance is off by a fraction.
void corrupt(std::vector<stats::PixelSums>& batches, double fraction) {
    for (stats::PixelSums& batch : batches)
        for (glm::dvec4& pixel : batch)
            pixel = glm::dvec4(glm::dvec3(pixel) * (1 + fraction), pixel.w);
}

json to_json(const stats::Agreement& a) {
    return {{"agrees", a.agrees},
            {"p_value", a.p_value},
            {"p_means", a.p_means},
            {"p_blocks", a.p_blocks},
            {"mean_device", a.mean_a},
            {"mean_reference", a.mean_b},
            {"mean_t", a.mean_t},
            {"worst_block",
             {{"x", a.worst_x},
              {"y", a.worst_y},
              {"channel", a.worst_channel},
              {"t", a.worst_t},
              {"p", a.worst_p}}},
            {"tests", a.tests}};
}

void print(const stats::Agreement& a, const VerifyOptions& options, const std::string& device,
           std::uint32_t samples) {
    std::printf("%s against the reference: %u spp in %u batches\n", device.c_str(), samples,
                options.batches);
    for (int c = 0; c < 3; ++c)
        std::printf("  mean %c  %.6f  reference %.6f  t = %+.2f\n", "RGB"[c], a.mean_a[c],
                    a.mean_b[c], a.mean_t[c]);
    std::printf("  worst of %d blocks: (%d, %d) %c, t = %+.2f\n", a.tests, a.worst_x, a.worst_y,
                "RGB"[a.worst_channel], a.worst_t);
    std::printf("%s (p = %.3g, corrected for all tests)\n", a.agrees ? "equal" : "DIFFERENT",
                a.p_value);
}

} // namespace

int run_verify(const VerifyOptions& options) {
    if (options.device.device == "reference")
        throw Error(ExitStatus::bad_input,
                    "verify compares a device with the reference: name a device");
    const Scene scene = load_scene(options.scene, options.quiet);
    const auto samples = static_cast<std::uint32_t>(scene.samples_per_pixel);
    if (samples < options.batches)
        throw Error(
            ExitStatus::bad_input,
            fmt::format("verify splits the samples into {} batches: ask for --spp {} at least",
                        options.batches, options.batches));
    watch_interrupts();
    const std::unique_ptr<Engine> device = make_engine(scene, options.device);
    std::vector<stats::PixelSums> a = render_batches(*device, options, samples, "device");
    const std::unique_ptr<Engine> reference = make_engine(scene, {.device = "reference"});
    const std::vector<stats::PixelSums> b =
        render_batches(*reference, options, samples, "reference");
    corrupt(a, options.corrupt);
    const stats::Agreement agreement = stats::test_agreement(a, b, scene.film.bounds.width());
    if (options.json)
        std::printf("%s\n", json_text(to_json(agreement), 2).c_str());
    else
        print(agreement, options, device->device_text(), samples);
    if (device->validation_messages() > 0)
        throw Error(ExitStatus::failed, "the validation layer had messages");
    return static_cast<int>(agreement.agrees ? ExitStatus::done : ExitStatus::failed);
}

int run_compare(const CompareOptions& options) {
    if (!options.difference.empty()) check_image_extension(options.difference);
    const Image a = read_image(options.a), b = read_image(options.b);
    const stats::Comparison comparison = stats::compare(a, b);
    if (!options.difference.empty()) write_image(options.difference, comparison.difference);
    const auto measures = [](const stats::ErrorMeasures& m) {
        return json{{"mse", m.mse},       {"rmse", m.rmse},     {"relmse", m.relmse},
                    {"mean_a", m.mean_a}, {"mean_b", m.mean_b}, {"mean_ratio", m.mean_ratio}};
    };
    json result{{"all", measures(comparison.all)}};
    for (int c = 0; c < 3; ++c)
        result["channels"][std::string(1, "RGB"[c])] = measures(comparison.channels[c]);
    if (comparison.test) {
        const stats::SignificanceTest& t = *comparison.test;
        result["test"] = {{"mean_z", t.mean_z},
                          {"worst_block_z", t.worst_block_z},
                          {"worst_block", {t.worst_x, t.worst_y, t.worst_channel}},
                          {"blocks_beyond_3", t.blocks_beyond_3},
                          {"p_means", t.p_means},
                          {"p_blocks", t.p_blocks}};
    }
    if (options.json) {
        std::printf("%s\n", json_text(result, 2).c_str());
        return 0;
    }
    std::printf("channel  rmse        relmse      mean a      mean b      ratio\n");
    const auto row = [](const char* name, const stats::ErrorMeasures& m) {
        std::printf("%-7s  %-10.4g  %-10.4g  %-10.6f  %-10.6f  %.6f\n", name, m.rmse, m.relmse,
                    m.mean_a, m.mean_b, m.mean_ratio);
    };
    row("all", comparison.all);
    for (int c = 0; c < 3; ++c)
        row(std::string(1, "RGB"[c]).c_str(), comparison.channels[c]);
    if (comparison.test) {
        const stats::SignificanceTest& t = *comparison.test;
        std::printf("means: z = %+.2f %+.2f %+.2f (p = %.3g)\n", t.mean_z[0], t.mean_z[1],
                    t.mean_z[2], t.p_means);
        std::printf("8 x 8 blocks: worst z = %+.2f at (%d, %d) %c (p = %.3g), %.2f %% beyond 3\n",
                    t.worst_block_z, t.worst_x, t.worst_y, "RGB"[t.worst_channel], t.p_blocks,
                    100 * t.blocks_beyond_3);
    }
    return 0;
}

} // namespace tyndall::cli
