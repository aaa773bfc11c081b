/// What a path tells besides its radiance.
#pragma once

#include "scene/path_event.h"
#include "shared/health.h"

namespace tyndall::reference {

struct PathReport {
    std::uint32_t mishaps = 0; ///< Bits by kind (shared/health.h).
    double majorant_ratio = 0; ///< Largest extinction over majorant, where that was exceeded.
    Rgb lost{0};               ///< Throughput of what the event limit ended.
    Replay* replay = nullptr;  ///< Where to tell what happens; null: nowhere.

    void note(int kind, bool happens) {
        if (happens) mishaps |= 1u << kind;
    }
    void tell(const PathEvent& event) {
        if (++replay->event_count <= kMostEvents) replay->events.push_back(event);
    }
    void note_majorant(const Rgb& extinction_over_majorant);
    /// The path counts as black.
    bool is_dropped() const;
};

} // namespace tyndall::reference
