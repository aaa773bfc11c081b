#include "cli/options.h"
#include "cli/phase_report.h"
#include "core/json_text.h"
#include "gpu/buffer.h"
#include "render/effect_costs.h"
#include "render/stages.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace tyndall::cli {
namespace {

using nlohmann::json;

/// What a scene calls for, and what that costs.
struct SceneInfo {
    explicit SceneInfo(const Scene& scene)
        : effects(compute_effects(scene)), tables(make_scene_tables(scene, effects)),
          features(tables.features(effects.features)), costs(price_effects(effects, tables)),
          stages(count_stage_instructions(features)) {
        if (!tables.voxels.bytes.empty() && features.densities & shared::DENSITY_BIT_GRID)
            tables.bytes.emplace_back("voxels", tables.voxels.bytes.size());
    }

    Effects effects;
    SceneTables tables;
    shared::Features features;
    std::vector<std::optional<EffectCost>> costs; ///< Of effects.list.
    std::vector<std::pair<std::string, std::size_t>> stages;
};

std::string text_of(const EffectCost& cost) {
    std::vector<std::string> parts;
    if (!cost.stages.empty()) parts.push_back(fmt::format("{}", fmt::join(cost.stages, ", ")));
    if (cost.instructions != 0) parts.push_back(fmt::format("{} instr.", cost.instructions));
    if (cost.bytes > 0) parts.push_back(gpu::format_bytes(cost.bytes));
    if (cost.path_bytes > 0) parts.push_back(fmt::format("{} B a path", cost.path_bytes));
    return fmt::format("{}", fmt::join(parts, "; "));
}

void print_effects(const SceneInfo& info) {
    std::size_t name_width = 0, by_width = 0;
    for (const Effect& e : info.effects.list) {
        name_width = std::max(name_width, e.name.size());
        by_width = std::max(by_width, e.called_for.size());
    }
    fmt::print("  {:<{}}  {:<17}  {:<{}}  costs\n", "effect", name_width, "", "called for by",
               by_width);
    for (std::size_t i = 0; i < info.costs.size(); ++i) {
        const Effect& e = info.effects.list[i];
        const std::string line =
            fmt::format("  {:<{}}  {:<17}  {:<{}}  {}", e.name, name_width,
                        e.value == "no" ? "not simulated" : e.value, e.called_for, by_width,
                        info.costs[i] ? text_of(*info.costs[i]) : "");
        fmt::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
    }
}

void print_rest(const SceneInfo& info) {
    fmt::print("\n  {:<24}{:>12}\n", "stage", "instructions");
    for (const auto& [name, instructions] : info.stages)
        fmt::print("  {:<24}{:>12}\n", name, instructions);
    fmt::print("\n  {:<24}{:>12}\n", "table", "bytes");
    for (const auto& [name, bytes] : info.tables.bytes)
        fmt::print("  {:<24}{:>12}\n", name, bytes);
    fmt::print("  {:<24}{:>12}\n", "a path in flight", 16 * path_texels(info.features));
}

json effects_json(const SceneInfo& info) {
    json list = json::array();
    for (std::size_t i = 0; i < info.costs.size(); ++i) {
        const Effect& e = info.effects.list[i];
        list.push_back({{"effect", e.name}, {"value", e.value}, {"called_for_by", e.called_for}});
        if (const auto& cost = info.costs[i])
            list.back()["costs"] = {{"stages", cost->stages},
                                    {"instructions", cost->instructions},
                                    {"bytes", cost->bytes},
                                    {"bytes_per_path", cost->path_bytes}};
    }
    return list;
}

void print_json(const Scene& scene, const SceneInfo& info, bool with_phases) {
    json stages = json::array(), memory = json::object();
    for (const auto& [name, instructions] : info.stages)
        stages.push_back({{"name", name}, {"instructions", instructions}});
    for (const auto& [name, bytes] : info.tables.bytes)
        memory[name] = bytes;
    json result{{"scene", scene.filename},
                {"width", scene.film.bounds.width()},
                {"height", scene.film.bounds.height()},
                {"spp", scene.samples_per_pixel},
                {"effects", effects_json(info)},
                {"stages", stages},
                {"memory_bytes", memory},
                {"bytes_per_path", 16 * path_texels(info.features)}};
    if (with_phases) result["phases"] = describe_phases(scene);
    fmt::print("{}\n", json_text(result, 2));
}

} // namespace

int run_info(const InfoOptions& options) {
    const Scene scene = load_scene(options.scene, options.json);
    const SceneInfo info(scene);
    if (!options.phase_plot.empty()) plot_phases(scene, options.phase_plot);
    if (options.json) {
        print_json(scene, info, options.phase);
        return 0;
    }
    fmt::print("{}: {} x {}, {} spp\n", scene.filename, scene.film.bounds.width(),
               scene.film.bounds.height(), scene.samples_per_pixel);
    print_effects(info);
    print_rest(info);
    if (options.phase) print_phases(scene);
    return 0;
}

} // namespace tyndall::cli
