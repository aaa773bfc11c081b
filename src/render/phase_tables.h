/// Phase functions as the device reads them.
#pragma once

#include "scene/scene.h"
#include "shared/phase_records.h"

#include <functional>
#include <map>
#include <vector>

namespace tyndall {

/// Appends a table to the scene buffer under a name for statistics; returns the texel at which it
/// starts.
using AppendTable = std::function<std::uint32_t(const std::vector<glm::uvec4>&, const char*)>;

/// What a MediumRecord or a PhaseComponentRecord holds of a phase function.
struct PhaseWords {
    float parameter = 0;
    std::uint32_t phase = 0;
};

/// Packs phase functions; each table once.
class PhasePacker {
  public:
    explicit PhasePacker(AppendTable append) : append_(std::move(append)) {}

    /// @throws Error  if the scene buffer is too large for a phase function to refer to its end.
    PhaseWords pack(const std::vector<PhaseFunction>& mixture);

  private:
    PhaseWords pack_single(const PhaseFunction& phase);
    std::uint32_t append(const std::vector<glm::uvec4>& texels);

    AppendTable append_;
    std::map<const PhaseTable*, std::uint32_t> tables_; ///< Packed already: where.
};

/// shared::PHASE_* of a kind.
std::uint32_t phase_kind(PhaseFunction::Kind kind);

/// Some phase function is a delta as far as float32 can tell (is_delta in lib/phase.glsl).
bool has_delta(const std::vector<PhaseFunction>& mixture);

/// Some phase function differs between channels.
bool is_chromatic(const std::vector<PhaseFunction>& mixture);

} // namespace tyndall
