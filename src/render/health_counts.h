/// What goes wrong in a render, as the counters of the device tell it while it goes on.
#pragma once

#include "shared/records.h"

namespace tyndall {

/// The device counts in words of 32 bits, which wrap where 2^32 paths go wrong; here they are
/// carried on in 64 bits.
class HealthCounts {
  public:
    /// The device starts again from zero.
    void restart() { seen_ = {}; }
    /// Takes in the counters, of which none may have grown by 2^32 or more since the last time.
    void take_in(const shared::Control& control);

    const shared::Health& health() const { return health_; }

  private:
    shared::Health health_;
    shared::Control seen_{}; ///< As of the last time.
};

} // namespace tyndall
