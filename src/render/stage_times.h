/// Where the time of a render goes, stage by stage.
#pragma once

#include "render/stages.h"

#include <array>

namespace tyndall {

/// What a stage did so far.
struct StageTime {
    std::string name;
    std::uint64_t dispatches = 0;
    double seconds = 0;      ///< Of the device; estimated from the rounds that were timed.
    std::uint64_t paths = 0; ///< That it was given, over all dispatches: the sum of its queues, or
                             ///< of all slots. 0 for stages that do not work on paths.
};

/// Sums over the submissions of a render.
class StageTimes {
  public:
    StageTimes() = default;
    /// @param stages  in the order in which they run.
    StageTimes(std::vector<const StageKind*> stages, std::uint32_t slots);

    /// The device starts again from zero.
    void restart() {
        seen_queues_ = {};
        seen_rounds_ = 0;
    }
    /// Takes in a submission of so many rounds, of which one took so long by stage.
    void add(const std::vector<double>& seconds, std::uint32_t rounds);
    /// Takes in the control block of a submission, whose counters wrap at 2^32.
    void take_in(const shared::Control& control);

    const std::vector<StageTime>& list() const { return list_; }

  private:
    std::vector<const StageKind*> stages_;
    std::uint32_t slots_ = 0;
    std::vector<StageTime> list_;
    std::array<std::uint32_t, shared::QUEUE_COUNT> seen_queues_{}; ///< Of Control::queue_total.
    std::uint32_t seen_rounds_ = 0;                                ///< Of Control::slot_rounds.
};

} // namespace tyndall
