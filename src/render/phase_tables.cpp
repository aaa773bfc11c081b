#include "render/phase_tables.h"

#include "core/error.h"

#include <algorithm>
#include <bit>

namespace tyndall {

using namespace shared;

namespace {

std::uint32_t bits(double x) {
    return std::bit_cast<std::uint32_t>(static_cast<float>(x));
}

std::vector<glm::uvec4> table_texels(const PhaseTable& table) {
    const std::size_t count = table.complement.size();
    std::vector<glm::uvec4> texels{{static_cast<std::uint32_t>(count), 0, 0, 0}};
    for (std::size_t i = 0; i < count; ++i) {
        const double c = table.complement[i];
        texels.emplace_back(bits(c <= 1 ? c : c - 2), bits(table.value[0][i]),
                            bits(table.value[1][i]), bits(table.value[2][i]));
    }
    for (std::size_t i = 0; i < count; ++i)
        texels.emplace_back(bits(table.cdf[0][i]), bits(table.cdf[1][i]), bits(table.cdf[2][i]), 0);
    return texels;
}

} // namespace

std::uint32_t phase_kind(PhaseFunction::Kind kind) {
    switch (kind) {
    case PhaseFunction::Kind::schlick:
        return PHASE_SCHLICK;
    case PhaseFunction::Kind::rayleigh:
        return PHASE_RAYLEIGH;
    case PhaseFunction::Kind::mie:
        return PHASE_TABLE;
    default:
        return PHASE_HENYEY_GREENSTEIN;
    }
}

bool is_chromatic(const std::vector<PhaseFunction>& mixture) {
    return std::any_of(mixture.begin(), mixture.end(), [](const PhaseFunction& phase) {
        return phase.table && phase.table->is_chromatic();
    });
}

bool has_delta(const std::vector<PhaseFunction>& mixture) {
    return std::any_of(mixture.begin(), mixture.end(), [](const PhaseFunction& phase) {
        using Kind = PhaseFunction::Kind;
        const double parameter = phase.kind == Kind::schlick             ? phase.k
                                 : phase.kind == Kind::henyey_greenstein ? phase.g
                                                                         : 0;
        return 1.0F - std::abs(static_cast<float>(parameter)) < 1e-6F;
    });
}

std::uint32_t PhasePacker::append(const std::vector<glm::uvec4>& texels) {
    const std::uint32_t texel = append_(texels, "phase functions");
    if (texel > PHASE_TEXEL_MASK)
        throw Error(ExitStatus::failed,
                    "the scene is too large: its phase functions lie beyond 2^29 texels");
    return texel;
}

PhaseWords PhasePacker::pack_single(const PhaseFunction& phase) {
    const std::uint32_t kind = phase_kind(phase.kind) << PHASE_KIND_SHIFT;
    switch (phase.kind) {
    case PhaseFunction::Kind::schlick:
        return {static_cast<float>(phase.k), kind};
    case PhaseFunction::Kind::rayleigh:
        return {0, kind};
    case PhaseFunction::Kind::mie: {
        const auto [at, is_new] = tables_.try_emplace(phase.table.get(), 0);
        if (is_new) at->second = append(table_texels(*phase.table));
        return {0, kind | at->second};
    }
    default:
        return {static_cast<float>(phase.g), kind};
    }
}

PhaseWords PhasePacker::pack(const std::vector<PhaseFunction>& mixture) {
    if (mixture.size() == 1) return pack_single(mixture.front());
    std::vector<glm::uvec4> components;
    double rest = 1;
    for (const PhaseFunction& phase : mixture) {
        const bool is_last = components.size() + 1 == mixture.size();
        const PhaseWords words = pack_single(phase);
        // Before the last the share is below 1, whatever it is rounded to.
        const float share = std::min(static_cast<float>(phase.weight / rest), 1 - 0x1p-24F);
        components.emplace_back(bits(phase.weight),
                                is_last ? bits(1) : std::bit_cast<std::uint32_t>(share),
                                std::bit_cast<std::uint32_t>(words.parameter), words.phase);
        rest -= phase.weight;
    }
    return {0, PHASE_MIXTURE << PHASE_KIND_SHIFT | append(components)};
}

} // namespace tyndall
