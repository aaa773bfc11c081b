// Records of phase functions. See records.h for how records lie in texels.
#ifndef TYNDALL_PHASE_RECORDS_H
#define TYNDALL_PHASE_RECORDS_H

#include "records.h"

TYNDALL_SHARED_BEGIN

// MediumRecord::phase and PhaseComponentRecord::phase: a kind above PHASE_KIND_SHIFT, a texel
// below.
TYNDALL_CONSTANT uint PHASE_KIND_SHIFT = 29u;
TYNDALL_CONSTANT uint PHASE_TEXEL_MASK = 0x1FFFFFFFu;
TYNDALL_CONSTANT uint PHASE_HENYEY_GREENSTEIN = 0u; // parameter: g
TYNDALL_CONSTANT uint PHASE_SCHLICK = 1u;           // parameter: k
TYNDALL_CONSTANT uint PHASE_RAYLEIGH = 2u;
TYNDALL_CONSTANT uint PHASE_TABLE = 3u;   // texel of a PhaseTableRecord
TYNDALL_CONSTANT uint PHASE_MIXTURE = 4u; // texel of its first PhaseComponentRecord

/// One of the phase functions of a mixture. The last has a share of 1.
struct PhaseComponentRecord {
    float weight; ///< Of the mixture; they sum to 1.
    float share;  ///< weight over the sum of this weight and those that follow.
    float parameter;
    uint phase; ///< PHASE_*, not a mixture.
};

/// A table (phase/phase_table.h), followed by its nodes, from forward to backward, and by the CDF
/// at them: node: place, value rgb [1/sr]; place is 1 - mu up to 1, and from there -(1 + mu), so
/// that both ends keep their digits CDF: probability, by channel, of scattering by less than the
/// angle of the node | unused
struct PhaseTableRecord {
    uint node_count;
    uint pad0;
    uint pad1;
    uint pad2;
};

TYNDALL_SHARED_END

#endif
