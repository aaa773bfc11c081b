/// Progressive rendering on the device.
#pragma once

#include "image/image.h"
#include "render/batch_range.h"
#include "render/health_counts.h"
#include "render/stage_times.h"
#include "render/wavefront.h"
#include "stats/sample_tail.h"

#include <array>
#include <chrono>
#include <functional>

namespace tyndall {

/// What a render looks like while it goes on.
struct Progress {
    std::uint32_t samples = 0;     ///< Per pixel, in the film.
    std::uint32_t end_samples = 0; ///< Per pixel, asked for.
    double begun = 0,
           done = 0; ///< Samples per pixel; those of a batch once the pixel has them all.
    /// Of the film at the last look (BatchRange::next_look), none before or if it cannot be told.
    std::optional<stats::ErrorEstimate> error;
    /// Whether this is a look: the film has `batches` batches, and waits. Looks come at the same
    /// batches in every run, so that who stops at one by `error` gets the same film.
    bool is_look = false;
    std::uint32_t batches = 0;   ///< In the film.
    bool has_heavy_tail = false; ///< Of the samples (stats::kHeavyTailShare).
};

/// Called every now and then and at each look; false asks to stop, which happens once the film has
/// a batch at least.
using KeepGoing = std::function<bool(const Progress&)>;

using shared::Health;
using shared::kHealthNames;

class Renderer {
  public:
    Renderer(const gpu::Context& context, const Scene& scene, const Tuning& tuning = {});
    /// With the effects of the scene, or with more; with all stages, or others that make paths.
    Renderer(const gpu::Context& context, const Scene& scene, Effects effects, const Tuning& tuning,
             std::span<const StageKind> kinds = stage_kinds());

    /// Seed of the renders that follow, in place of the scene's.
    void set_seed(std::uint64_t seed) { wavefront_.set_seed(seed); }

    /// Renders samples first_sample <= s < end_sample of every pixel, into an empty film. Returns
    /// how many samples the film has in the end: fewer than asked for if told to stop, and then
    /// whole batches.
    /// @throws Error if the device fails.
    std::uint32_t render(std::uint32_t first_sample, std::uint32_t end_sample,
                         const KeepGoing& keep_going = {});

    /// Cuts the work up in another way from the next render on.
    void retune(const Tuning& tuning) {
        wavefront_.retune(tuning);
        rounds_ = 1;
    }

    /// The film as it is; may be called from KeepGoing. Channels R G B variance.R variance.G
    /// variance.B; the variance is that of the mean, 0 while there are fewer than two batches, and
    /// the largest float where it is beyond that.
    Image read_film();
    /// Per pixel: sum of filter weight * radiance (xyz) and of filter weights (w).
    std::vector<glm::dvec4> read_sums();

    /// Samples per pixel in the film.
    std::uint32_t samples() const { return batches_.samples_before(folded_batches_); }
    /// How wrong the film still is, as of the last look, read_film or end of render.
    const std::optional<stats::ErrorEstimate>& error() const { return error_; }
    /// stats::tail_share of the samples of the first four batches.
    std::optional<double> tail_share() const { return stats::tail_share(histogram_); }
    const Effects& effects() const { return effects_; }
    const Wavefront& wavefront() const { return wavefront_; }
    /// What went wrong so far.
    const Health& health() const { return health_.health(); }
    const std::vector<StageTime>& stage_times() const { return stage_times_.list(); }
    /// Seconds that packing the scene and building its hierarchy took, and compiling the stages.
    double build_seconds() const { return build_seconds_; }
    double compile_seconds() const { return compile_seconds_; }

  private:
    struct Flight;

    bool run_epoch(std::uint32_t batch_count, const KeepGoing& keep_going);
    bool ask(std::uint32_t batch_count, const KeepGoing& keep_going);
    double samples_begun(std::uint32_t batch_count) const;
    std::uint32_t fold_limit() const;
    void submit(Flight& flight);
    void land(Flight& flight);
    void take_in(const shared::Control& control);
    void fold();
    void measure_error();
    void each_film_pixel(const std::function<void(std::size_t, const glm::vec4*)>& visit);

    const gpu::Context* context_;
    Effects effects_;
    SceneTables tables_;
    double build_seconds_;
    Wavefront wavefront_;
    double compile_seconds_;
    BatchRange batches_;
    std::uint32_t epoch_batch_ = 0;    ///< First batch of the present epoch,
    std::uint32_t epoch_piece_ = 0;    ///< its first piece, and the end of those
    std::uint32_t folded_pieces_ = 0;  ///< that are in the film.
    std::uint32_t folded_batches_ = 0; ///< End of the batches in the film that are whole.
    std::uint32_t look_batch_ = 0;     ///< No more are folded before the next look.
    double epoch_share_ = 0;           ///< Of the epoch's tickets that were taken.
    double samples_done_ = 0;          ///< Per pixel, those of batches in part included.
    HealthCounts health_;
    stats::BatchContrasts contrasts_;
    std::uint32_t contrasted_batches_ = 0; ///< End of the batches in contrasts_.
    std::optional<stats::ErrorEstimate> error_;
    stats::SampleHistogram histogram_{};
    StageTimes stage_times_;
    double timed_share_ = 0;   ///< Of the rounds of a submission, those before the one timed.
    std::uint32_t rounds_ = 1; ///< Per submission, so that one takes about kSubmitSeconds.
};

} // namespace tyndall
