#include "render/wavefront.h"

#include "core/error.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <fmt/format.h>
#include <future>

namespace tyndall {
namespace {

using namespace shared;

/// Bytes before the records of the event log.
constexpr std::uint64_t kLogHeader = 16;

/// Pieces in flight at once: enough work for every path, bounded memory. A power of two.
std::uint32_t piece_window(std::uint32_t pixels) {
    constexpr std::uint32_t wanted_items = 1u << 21;
    return std::clamp<std::uint32_t>(std::bit_floor(wanted_items / pixels), 2, PIECE_WINDOW_MAX);
}

bool has_queues(const Features& features, const Tuning& tuning) {
    return features.geometry == GEOMETRY_BVH && tuning.stages == STAGES_APART;
}

Tuning choose_tuning(const gpu::Context& context, const shared::Features& features, Tuning tuning) {
    const bool is_cpu = context.info().type == "cpu";
    const bool has_hierarchy = features.geometry == GEOMETRY_BVH;
    if (tuning.workgroup_size == 0) tuning.workgroup_size = 64;
    if (tuning.run_length == 0) tuning.run_length = has_hierarchy ? 64 : 256;
    // SwiftShader takes gigabytes for kernels with several walks through a hierarchy.
    const bool can_fuse = has_hierarchy && features.march == MARCH_NONE &&
                          !context.info().driver.starts_with("SwiftShader");
    if (tuning.stages == 0 || !can_fuse) tuning.stages = STAGES_APART;
    if (tuning.slots == 0)
        tuning.slots = is_cpu ? (has_queues(features, tuning) ? 16384 : 4096) : 1u << 18;
    // Lavapipe breaks off loops in silence (wavefront/volume.glsl), be they inside of runs: of a
    // fused kernel, whose walks are all in one, runs must be short.
    if (is_cpu)
        tuning.run_length =
            std::min(tuning.run_length, tuning.stages == STAGES_FUSED ? 32u : 1024u);
    tuning.workgroup_size =
        std::min(tuning.workgroup_size, context.limits().maxComputeWorkGroupInvocations);
    // The state of paths is written as storage (shared/bindings.h).
    const VkPhysicalDeviceLimits& limits = context.limits();
    const std::uint64_t most = std::min<std::uint64_t>(
        std::uint64_t{limits.maxComputeWorkGroupCount[0]} * tuning.workgroup_size,
        limits.maxStorageBufferRange / (16 * PATH_GROUPS));
    tuning.slots = static_cast<std::uint32_t>(std::min<std::uint64_t>(tuning.slots, most));
    return tuning;
}

} // namespace

Wavefront::Wavefront(const gpu::Context& context, const SceneTables& tables, const Effects& effects,
                     const Tuning& tuning, std::span<const StageKind> kinds)
    : context_(&context), kinds_(kinds), features_(tables.features(effects.features)),
      tuning_(choose_tuning(context, effects.features, tuning)), push_(tables.push),
      table_bytes_(tables.bytes) {
    push_.window = piece_window(push_.pixel_count);
    const std::uint64_t pixels = push_.pixel_count;
    const gpu::Buffer::Options texels{.texels = true};
    scene_ = {context, "scene", tables.texels.size() * 16, texels};
    pieces_ = {context, "pieces", pixels * push_.window * 16, texels};
    film_ = {context, "film",
             (pixels * FILM_TEXELS + fold_lanes(push_.pixel_count) * ERROR_TEXELS) * 16, texels};
    control_ = {context, "control", sizeof(Control), {.indirect = true}};
    const VkFormat voxel_format =
        tables.voxels.is_half ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
    voxels_ = {context,
               "voxels",
               tables.voxels.bytes.size(),
               {.texels = true, .texel_format = voxel_format}};
    log_ = {context,
            "event log",
            kLogHeader + std::uint64_t{tuning_.log_capacity} * sizeof(EventRecord),
            {}};
    gpu::upload(context, scene_, std::as_bytes(std::span(tables.texels)));
    gpu::upload(context, voxels_, tables.voxels.bytes);

    features_.log_capacity = tuning_.log_capacity;
    features_.loops_test_first = context.info().driver.starts_with("SwiftShader");
    allocate_paths();
    build_stages();
}

/// What depends on the tuning: state of paths, and with it the descriptors of everything.
void Wavefront::allocate_paths() {
    push_.slot_count = tuning_.slots;
    push_.run_length = tuning_.run_length;
    const std::uint64_t slots = tuning_.slots;
    const std::uint32_t texels =
        tuning_.stages == STAGES_FUSED ? PATH_GROUPS : path_texels(features_);
    paths_ = {*context_, "paths", slots * texels * 16, {.texels = true}};
    const bool queues = has_queues(features_, tuning_);
    queues_ = {*context_, "queues", queues ? slots * QUEUE_COUNT * 4 : 16, {}};
    descriptors_.emplace(
        *context_,
        gpu::Bindings{{&scene_, &paths_, &pieces_, &film_, &voxels_}, &control_, &queues_, &log_},
        static_cast<std::uint32_t>(sizeof(push_)));
    features_.workgroup_size = tuning_.workgroup_size;
    features_.storage_fallback = descriptors_->storage_fallback();
    features_.texel_stores = descriptors_->texel_stores();
}

void Wavefront::retune(const Tuning& tuning) {
    const shared::Features before = features_;
    const std::uint32_t stages_before = tuning_.stages;
    tuning_ = choose_tuning(*context_, features_, tuning);
    tuning_.log_capacity = features_.log_capacity; // of a log that is kept
    allocate_paths();
    if (features_ != before || tuning_.stages != stages_before) build_stages();
}

/// All at once: drivers take long for each, even out of a cache.
void Wavefront::build_stages() {
    std::vector<std::future<BuiltStage>> building;
    for (const StageKind& kind : tuning_.stages == STAGES_FUSED ? fused_stage_kinds() : kinds_)
        if (kind.is_called_for(features_))
            building.push_back(std::async(std::launch::async, [this, &kind] {
                return BuiltStage{&kind, gpu::Stage(*context_, *descriptors_, kind.name, kind.spirv,
                                                    kind.features(features_))};
            }));
    stages_.clear();
    for (std::future<BuiltStage>& stage : building) {
        stages_.push_back(stage.get());
        if (stages_.back().kind->input == StageInput::once) schedule_ = stages_.size() - 1;
    }
}

void Wavefront::set_seed(std::uint64_t seed) {
    push_.seed = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
}

void Wavefront::begin_epoch(std::uint32_t first_piece, std::uint32_t piece_count,
                            std::uint32_t first_sample, std::uint32_t end_sample, bool clear_film) {
    push_.first_piece = first_piece;
    push_.piece_count = piece_count;
    push_.first_sample = first_sample;
    push_.end_sample = end_sample;
    gpu::Commands commands(*context_);
    commands.begin();
    commands.fill_zero(paths_);
    commands.fill_zero(control_);
    commands.fill_zero(log_);
    if (clear_film) commands.fill_zero(film_);
    commands.barrier();
    commands.bind(*descriptors_, std::as_bytes(std::span(&push_, 1)));
    commands.dispatch(stages_[schedule_].stage, 1); // makes the first tickets due
    commands.barrier();
    commands.submit();
    commands.wait();
}

void Wavefront::record_stage(gpu::Commands& commands, const BuiltStage& built) const {
    const StageKind& kind = *built.kind;
    const auto indirect = [&](std::size_t offset) {
        commands.dispatch_indirect(built.stage, control_, offset);
    };
    switch (kind.input) {
    case StageInput::slots:
        indirect(offsetof(Control, slot_dispatch));
        break;
    case StageInput::queue:
        indirect(offsetof(Control, queue_dispatch) + kind.queue * sizeof(DispatchSize));
        break;
    case StageInput::once:
        commands.dispatch(built.stage, 1);
        break;
    case StageInput::folds:
        indirect(offsetof(Control, fold_dispatch));
        break;
    }
    commands.barrier();
}

void Wavefront::record_fold_limits(gpu::Commands& commands, std::uint32_t limit,
                                   std::uint32_t least) const {
    commands.bind(*descriptors_, std::as_bytes(std::span(&push_, 1)));
    commands.write(control_, offsetof(Control, fold_limit), limit);
    commands.write(control_, offsetof(Control, fold_least), least);
    commands.barrier();
}

void Wavefront::record_rounds(gpu::Commands& commands, std::uint32_t rounds,
                              std::uint32_t fold_limit, const gpu::Timestamps& clock,
                              std::uint32_t timed_round) const {
    // Each fold reads and writes the whole film, so several pieces at once; but the rest of the
    // window must be work enough meanwhile.
    record_fold_limits(commands, fold_limit, std::max(push_.window / 4, 1u));
    commands.reset(clock);
    for (std::uint32_t round = 0; round < rounds; ++round) {
        std::uint32_t mark = 0;
        if (round == timed_round) commands.mark(clock, mark);
        for (const BuiltStage& built : stages_) {
            record_stage(commands, built);
            if (round == timed_round) commands.mark(clock, ++mark);
        }
    }
}

void Wavefront::fold(std::uint32_t fold_limit) const {
    gpu::Commands commands(*context_);
    commands.begin();
    record_fold_limits(commands, fold_limit, 1);
    record_stage(commands, stages_[schedule_]);
    record_stage(commands, stages_[schedule_ + 1]); // update_film
    commands.submit();
    commands.wait();
}

void Wavefront::record_readback(gpu::Commands& commands, const gpu::Buffer& to) const {
    commands.copy(control_, 0, to, 0, sizeof(Control));
    commands.barrier();
}

Control Wavefront::read_control() const {
    Control control;
    gpu::download(*context_, control_, 0, std::as_writable_bytes(std::span(&control, 1)));
    return control;
}

void Wavefront::read_film(std::uint32_t first, std::uint32_t count,
                          std::vector<glm::vec4>& texels) const {
    texels.resize(std::size_t{count} * FILM_TEXELS);
    gpu::download(*context_, film_, std::uint64_t{first} * FILM_TEXELS * 16,
                  std::as_writable_bytes(std::span(texels)));
}

stats::ErrorSums Wavefront::read_error_sums() const {
    std::vector<glm::vec4> texels(std::size_t{fold_lanes(push_.pixel_count)} * ERROR_TEXELS);
    gpu::download(*context_, film_, std::uint64_t{push_.pixel_count} * FILM_TEXELS * 16,
                  std::as_writable_bytes(std::span(texels)));
    stats::ErrorSums sums;
    for (std::size_t i = 0; i < texels.size(); i += ERROR_TEXELS) {
        const glm::dvec4 variances(texels[i + ERROR_VARIANCES]);
        const glm::dvec4 covariances(texels[i + ERROR_COVARIANCES]);
        const glm::dvec4 pixels(texels[i + ERROR_PIXELS]);
        sums.variances += glm::dvec3(variances);
        sums.covariances += glm::dvec3(covariances);
        sums.squares += variances.w * variances.w;
        sums.pair_squares += covariances.w * covariances.w;
        sums.mean_squares += pixels.x;
        sums.mean_residuals += pixels.y * pixels.y;
        sums.weighted_squares += pixels.z * pixels.z;
        sums.pair_residual_squares += pixels.w * pixels.w;
    }
    return sums;
}

EventLog Wavefront::read_log() const {
    EventLog log;
    gpu::download(*context_, log_, 0, std::as_writable_bytes(std::span(&log.count, 1)));
    log.events.resize(std::min(log.count, tuning_.log_capacity));
    if (!log.events.empty())
        gpu::download(*context_, log_, kLogHeader, std::as_writable_bytes(std::span(log.events)));
    return log;
}

std::vector<std::pair<std::string, std::uint64_t>> Wavefront::memory() const {
    auto bytes = table_bytes_;
    if (features_.densities & DENSITY_BIT_GRID) bytes.emplace_back("voxels", voxels_.bytes());
    bytes.emplace_back("paths in flight", paths_.bytes());
    bytes.emplace_back("pieces in flight", pieces_.bytes());
    bytes.emplace_back("film", film_.bytes());
    bytes.emplace_back("queues", queues_.bytes());
    return bytes;
}

std::vector<const StageKind*> Wavefront::stages() const {
    std::vector<const StageKind*> kinds;
    for (const BuiltStage& built : stages_)
        kinds.push_back(built.kind);
    return kinds;
}

} // namespace tyndall
