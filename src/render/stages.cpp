#include "render/stages.h"

#include "gpu/specialize.h"
#include "spirv/cross_interface.h"
#include "spirv/fused_paths.h"
#include "spirv/march_medium.h"
#include "spirv/next_sample.h"
#include "spirv/schedule.h"
#include "spirv/shade_conductor.h"
#include "spirv/shade_dielectric.h"
#include "spirv/shade_emitter.h"
#include "spirv/shade_segment.h"
#include "spirv/shade_surface.h"
#include "spirv/shade_volume.h"
#include "spirv/trace_segment.h"
#include "spirv/trace_shadow.h"
#include "spirv/track_medium.h"
#include "spirv/update_film.h"
#include "spirv/walk_region.h"

#include <array>

namespace tyndall {
namespace {

using namespace shared;

bool always(const Features&) {
    return true;
}
bool has_hierarchy(const Features& f) {
    return f.geometry == GEOMETRY_BVH;
}
bool has_no_hierarchy(const Features& f) {
    return !has_hierarchy(f);
}
bool tracks_media(const Features& f) {
    return has_hierarchy(f) && !f.march && f.densities & DENSITY_BITS_TRACKED;
}
bool marches_media(const Features& f) {
    return f.march != MARCH_NONE;
}
bool collides_in_media(const Features& f) {
    return has_hierarchy(f) && !f.march && (f.has_scattering || f.is_analog);
}
/// Marching looks for light from the environment, too.
bool casts_shadows(const Features& f) {
    return has_hierarchy(f) && (f.lights || (f.march && f.has_scattering && f.has_environment));
}
bool sees_emitters(const Features& f) {
    return has_hierarchy(f) && f.has_emitters;
}
bool looks_in_passing(const Features& f) {
    return has_hierarchy(f) && f.has_equiangular;
}
template<std::uint32_t queue>
bool has_surface(const Features& f) {
    return has_hierarchy(f) && f.surface_queues >> queue & 1u;
}

constexpr StageInput slots = StageInput::slots, queue = StageInput::queue;

const StageKind kSchedule{"schedule", schedule_spirv, StageInput::once, 0, always};
const StageKind kUpdateFilm{"update_film", update_film_spirv, StageInput::folds, 0, always};

/// This list is the renderer.
const std::array<StageKind, 17> kStages{{
    {"walk_region", walk_region_spirv, slots, 0, has_no_hierarchy},

    {"trace_segment", trace_segment_spirv, slots, 0, has_hierarchy},
    {"shade_emitter", shade_emitter_spirv, queue, QUEUE_EMITTER, sees_emitters},
    {"shade_segment", shade_segment_spirv, queue, QUEUE_PASSING, looks_in_passing},
    {"track_medium", track_medium_spirv, queue, QUEUE_TRACK, tracks_media},
    {"march_medium", march_medium_spirv, queue, QUEUE_TRACK, marches_media},
    {"shade_volume", shade_volume_spirv, queue, QUEUE_VOLUME, collides_in_media},
    {"shade_surface", shade_surface_spirv, queue, QUEUE_SURFACE, has_surface<QUEUE_SURFACE>},
    {"shade_dielectric", shade_dielectric_spirv, queue, QUEUE_DIELECTRIC,
     has_surface<QUEUE_DIELECTRIC>, false},
    {"shade_rough_dielectric", shade_dielectric_spirv, queue, QUEUE_ROUGH_DIELECTRIC,
     has_surface<QUEUE_ROUGH_DIELECTRIC>},
    {"shade_conductor", shade_conductor_spirv, queue, QUEUE_CONDUCTOR, has_surface<QUEUE_CONDUCTOR>,
     false},
    {"shade_rough_conductor", shade_conductor_spirv, queue, QUEUE_ROUGH_CONDUCTOR,
     has_surface<QUEUE_ROUGH_CONDUCTOR>},
    {"cross_interface", cross_interface_spirv, queue, QUEUE_INTERFACE,
     has_surface<QUEUE_INTERFACE>},
    {"trace_shadow", trace_shadow_spirv, queue, QUEUE_SHADOW, casts_shadows},
    {"next_sample", next_sample_spirv, queue, QUEUE_ENDED, has_hierarchy},

    kSchedule,
    kUpdateFilm,
}};

const std::array<StageKind, 3> kFusedStages{
    {{"fused_paths", fused_paths_spirv, slots, 0, has_hierarchy}, kSchedule, kUpdateFilm}};

} // namespace

std::span<const StageKind> stage_kinds() {
    return kStages;
}

std::span<const StageKind> fused_stage_kinds() {
    return kFusedStages;
}

std::uint32_t path_texels(const Features& features) {
    if (casts_shadows(features)) return PATH_GROUPS;
    if (tracks_media(features) || marches_media(features)) return PATH_TRACK + 1;
    if (has_hierarchy(features)) return PATH_HIT + 1;
    return features.is_chromatic ? PATH_SPECTRAL + 1 : PATH_SPECTRAL;
}

std::vector<std::pair<std::string, std::size_t>>
count_stage_instructions(const Features& features) {
    std::vector<std::pair<std::string, std::size_t>> counts;
    for (const StageKind& kind : stage_kinds())
        if (kind.is_called_for(features))
            counts.emplace_back(kind.name, gpu::count_instructions(gpu::specialize(
                                               kind.spirv, kind.features(features), kind.name)));
    return counts;
}

} // namespace tyndall
