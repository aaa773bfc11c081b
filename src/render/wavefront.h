/// The wavefront on the device: its buffers, its stages, and the order in which they run.
#pragma once

#include "gpu/commands.h"
#include "render/effects.h"
#include "render/scene_tables.h"
#include "render/stages.h"
#include "shared/event_records.h"
#include "stats/error_estimate.h"

#include <optional>

namespace tyndall {

/// What paths go through in a round: one kernel, or one for each thing that may happen to them.
constexpr std::uint32_t STAGES_FUSED = 1, STAGES_APART = 2;

/// How the work is cut up. None of it changes the image. A device may take less than is asked for.
struct Tuning {
    std::uint32_t slots = 0;          ///< Paths in flight; 0: chosen for device and scene.
    std::uint32_t run_length = 0;     ///< Most events per path and dispatch; 0: chosen.
    std::uint32_t workgroup_size = 0; ///< 0: chosen.
    std::uint32_t stages = 0;         ///< Of a round: STAGES_*; 0: chosen.
    std::uint32_t log_capacity = 0;   ///< Events of paths that are kept for a replay.

    bool operator==(const Tuning&) const = default;
};

/// What happened to paths, as far as there was room.
struct EventLog {
    std::vector<shared::EventRecord> events;
    std::uint32_t count = 0; ///< Of events, those included that are not kept.
};

class Wavefront {
  public:
    /// Uploads the tables, allocates state and film, builds the stages that the effects call for.
    /// @param kinds  Must outlive the wavefront.
    Wavefront(const gpu::Context& context, const SceneTables& tables, const Effects& effects,
              const Tuning& tuning, std::span<const StageKind> kinds = stage_kinds());

    /// Cuts the work up in another way from the next epoch on.
    void retune(const Tuning& tuning);
    /// Of the random numbers from the next epoch on; before, it is the scene's.
    void set_seed(std::uint64_t seed);

    /// Forgets paths in flight, so that pieces first_piece ... first_piece + piece_count - 1 of
    /// batches (shared/schedule.h) can be rendered, of which samples first_sample <= s <
    /// end_sample. The film is kept, or zeroed with `clear_film`.
    void begin_epoch(std::uint32_t first_piece, std::uint32_t piece_count,
                     std::uint32_t first_sample, std::uint32_t end_sample, bool clear_film);

    /// Records `rounds` rounds; each advances every path by at least one event. No more than
    /// `fold_limit` pieces of the epoch get into the film. One round is timed: `clock` has one mark
    /// more than there are stages.
    void record_rounds(gpu::Commands& commands, std::uint32_t rounds, std::uint32_t fold_limit,
                       const gpu::Timestamps& clock, std::uint32_t timed_round) const;
    /// Folds pieces that are complete, as rounds do only once they are several, up to
    /// `fold_limit`.
    void fold(std::uint32_t fold_limit) const;
    /// Records the copy of the control block into `to` (host visible).
    void record_readback(gpu::Commands& commands, const gpu::Buffer& to) const;

    /// The control block as it is.
    shared::Control read_control() const;
    /// Copies film texels of the pixels [first, first + count) to the host.
    void read_film(std::uint32_t first, std::uint32_t count, std::vector<glm::vec4>& texels) const;
    /// What the film's error follows from.
    stats::ErrorSums read_error_sums() const;

    /// Events of the present epoch, in the order in which stages ran.
    EventLog read_log() const;

    const Tuning& tuning() const { return tuning_; }
    /// Pieces that are worked on at the same time, at most.
    std::uint32_t window() const { return push_.window; }
    const shared::Features& features() const { return features_; }
    std::vector<std::pair<std::string, std::uint64_t>> memory() const;
    /// In the order in which they run.
    std::vector<const StageKind*> stages() const;

  private:
    struct BuiltStage {
        const StageKind* kind;
        gpu::Stage stage;
    };
    void allocate_paths();
    void build_stages();
    void record_stage(gpu::Commands& commands, const BuiltStage& built) const;
    void record_fold_limits(gpu::Commands& commands, std::uint32_t limit,
                            std::uint32_t least) const;

    const gpu::Context* context_;
    std::span<const StageKind> kinds_;
    shared::Features features_;
    Tuning tuning_;
    shared::PushConstants push_;
    std::vector<std::pair<std::string, std::uint64_t>> table_bytes_;
    gpu::Buffer scene_, paths_, pieces_, film_, voxels_, control_, queues_, log_;
    std::optional<gpu::Descriptors> descriptors_;
    std::vector<BuiltStage> stages_; ///< Those that the effects call for.
    std::size_t schedule_ = 0;       ///< Index of that stage.
};

} // namespace tyndall
