#include "render/volume_tables.h"

#include "core/error.h"
#include "render/light_table.h"
#include "render/primitives.h"
#include "scene/blackbody.h"
#include "scene/emitting_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <numeric>

namespace tyndall {

using namespace shared;

namespace {

static_assert(sizeof(BrickTableRecord) == BRICK_TABLE_TEXELS * 16);
static_assert(sizeof(GridRecord) == GRID_TEXELS * 16);
static_assert(sizeof(VoxelLightRecord) == VOXEL_LIGHT_TEXELS * 16);
static_assert(sizeof(EmittingVoxelRecord) == 16);
static_assert(sizeof(ExponentialRecord) == EXPONENTIAL_TEXELS * 16);

template<typename Record>
std::vector<glm::uvec4> texels_of(const Record& record) {
    std::vector<glm::uvec4> texels(sizeof(Record) / 16);
    std::memcpy(texels.data(), &record, sizeof(record));
    return texels;
}

/// Every grid that a medium refers to; some may be null.
std::vector<std::shared_ptr<const Grid>> grids_of(const GridDensity& d) {
    std::vector<std::shared_ptr<const Grid>> grids{d.density, d.emission_scale, d.temperature};
    for (const auto* triple : {&d.sigma_a, &d.sigma_s, &d.emission})
        grids.insert(grids.end(), triple->begin(), triple->end());
    return grids;
}

bool are_all_half(const Scene& scene) {
    for (const Medium& medium : scene.media)
        if (const auto* density = std::get_if<GridDensity>(&medium.density))
            for (const auto& grid : grids_of(*density))
                if (grid && !grid->is_half) return false;
    return true;
}

} // namespace

VolumePacker::VolumePacker(const Scene& scene, const glm::dmat4& render_from_world, Append append)
    : scene_(scene), render_from_world_(render_from_world), append_(std::move(append)),
      phases_(append_) {
    voxels_.is_half = are_all_half(scene);
    for (const Medium& medium : scene.media)
        is_uniform_ = is_uniform_ && medium.is_homogeneous();
    append_media(glm::dmat4(1));
}

std::uint32_t VolumePacker::medium_shift(const glm::dmat4& world_from_definition) {
    if (is_uniform_) return 0;
    const auto shift = static_cast<std::uint32_t>(records_.size());
    append_media(world_from_definition);
    return shift;
}

void VolumePacker::append_media(const glm::dmat4& world_from_definition) {
    for (const Medium& medium : scene_.media)
        records_.push_back(make_record(medium, world_from_definition));
    if (records_.size() >= VACUUM)
        throw Error(ExitStatus::failed,
                    fmt::format("more than {} media, copies for instances included", VACUUM - 1));
}

MediumRecord VolumePacker::make_record(const Medium& medium,
                                       const glm::dmat4& world_from_definition) {
    const PhaseWords phase = phases_.pack(medium.phases);
    MediumRecord record{.sigma_a = medium.sigma_a,
                        .phase_parameter = phase.parameter,
                        .sigma_s = medium.sigma_s,
                        .phase = phase.phase,
                        .emission = medium.emission};
    const glm::dmat4 render_from_medium =
        render_from_world_ * world_from_definition * medium.world_from_medium;
    if (const auto* grid = std::get_if<GridDensity>(&medium.density)) {
        record.density_kind = DENSITY_GRID;
        record.density_record = pack_grid_density(*grid, glm::inverse(render_from_medium));
    } else if (const auto* exponential = std::get_if<ExponentialDensity>(&medium.density)) {
        record.density_kind = exponential->is_spherical ? DENSITY_SPHERE : DENSITY_PLANE;
        record.density_record = pack_exponential(*exponential, glm::inverse(render_from_medium));
    }
    return record;
}

std::uint32_t VolumePacker::pack_grid_density(const GridDensity& density,
                                              const glm::dmat4& medium_from_render) {
    const auto triple = [&](const std::array<std::shared_ptr<const Grid>, 3>& grids) {
        return glm::uvec3(pack_grid(grids[0]), pack_grid(grids[1]), pack_grid(grids[2]));
    };
    const MajorantGrid& m = density.majorants;
    const GridRecord record{.index_from_render =
                                make_affine(density.index_from_medium * medium_from_render),
                            .lower = density.lower,
                            .density = pack_grid(density.density),
                            .upper = density.upper,
                            .temperature = pack_grid(density.temperature),
                            .majorant_lower = m.lower,
                            .majorants = pack_majorants(m),
                            .majorant_count = m.count,
                            .majorant_size = m.size,
                            .sigma_a = triple(density.sigma_a),
                            .emission_scale = pack_grid(density.emission_scale),
                            .sigma_s = triple(density.sigma_s),
                            .light_density = 0,
                            .emission = triple(density.emission),
                            .pad1 = 0};
    return append_(texels_of(record), "grids");
}

std::uint32_t VolumePacker::pack_exponential(const ExponentialDensity& density,
                                             const glm::dmat4& medium_from_render) {
    const ExponentialRecord record{.medium_from_render = make_affine(medium_from_render),
                                   .origin = density.origin,
                                   .radius = static_cast<float>(density.radius),
                                   .up = density.up,
                                   .scale_height = static_cast<float>(density.scale_height)};
    return append_(texels_of(record), "atmospheres");
}

std::uint32_t VolumePacker::append_words(const std::vector<std::uint32_t>& words,
                                         const char* name) {
    std::vector<glm::uvec4> texels((words.size() + 3) / 4);
    std::memcpy(texels.data(), words.data(), words.size() * sizeof(words[0]));
    return append_(texels, name);
}

/// Appends a brick of 512 voxels and returns its number.
std::uint32_t VolumePacker::add_brick(const float* voxels) {
    const std::size_t start = voxels_.bytes.size();
    if (voxels_.is_half) {
        std::array<std::uint16_t, kBrickVoxels> half;
        for (int i = 0; i < kBrickVoxels; ++i)
            half[i] = glm::packHalf1x16(voxels[i]);
        voxels_.bytes.resize(start + sizeof(half));
        std::memcpy(voxels_.bytes.data() + start, half.data(), sizeof(half));
    } else {
        voxels_.bytes.resize(start + kBrickVoxels * sizeof(float));
        std::memcpy(voxels_.bytes.data() + start, voxels, kBrickVoxels * sizeof(float));
    }
    if (brick_count_ == 1u << 23)
        throw Error(ExitStatus::failed, "the grids have more than 2^32 voxels in stored bricks");
    return brick_count_++;
}

std::uint32_t VolumePacker::pack_grid(const std::shared_ptr<const Grid>& grid) {
    if (!grid) return NONE;
    if (const auto known = grids_.find(grid.get()); known != grids_.end()) return known->second;
    // A tile becomes one brick, however often it occurs.
    std::vector<std::uint32_t> tile_bricks;
    for (float value : grid->tiles) {
        std::array<float, kBrickVoxels> brick;
        brick.fill(value);
        tile_bricks.push_back(add_brick(brick.data()));
    }
    const std::uint32_t first = brick_count_;
    for (std::size_t at = 0; at < grid->voxels.size(); at += kBrickVoxels)
        add_brick(grid->voxels.data() + at);
    std::vector<std::uint32_t> words = grid->brick_index;
    for (std::uint32_t& word : words)
        if (word != Grid::empty) // which is NONE
            word = word & Grid::tile ? tile_bricks[word & ~Grid::tile] : first + word;
    const BrickTableRecord record{.first_brick = grid->first_brick,
                                  .table = append_words(words, "brick tables"),
                                  .brick_count = grid->brick_count};
    const std::uint32_t texel = append_(texels_of(record), "brick tables");
    grids_.emplace(grid.get(), texel);
    return texel;
}

std::uint32_t VolumePacker::pack_majorants(const MajorantGrid& majorants) {
    if (const auto known = majorants_.find(&majorants); known != majorants_.end())
        return known->second;
    std::vector<std::uint32_t> words(majorants.bounds.size());
    std::memcpy(words.data(), majorants.bounds.data(), words.size() * sizeof(words[0]));
    const std::uint32_t texel = append_words(words, "majorants");
    majorants_.emplace(&majorants, texel);
    return texel;
}

VolumePacker::VoxelLight VolumePacker::pack_voxel_light(int index) {
    const Medium& medium = scene_.media[index];
    const auto& density = std::get<GridDensity>(medium.density);
    const std::vector<EmittingVoxel> voxels = emitting_voxels(medium);
    const glm::dmat4 render_from_index =
        render_from_world_ * medium.world_from_medium * glm::inverse(density.index_from_medium);
    glm::ivec3 lower(std::numeric_limits<int>::max()), upper(std::numeric_limits<int>::min());
    std::vector<double> powers;
    for (const EmittingVoxel& v : voxels) {
        lower = glm::min(lower, v.voxel);
        upper = glm::max(upper, v.voxel);
        powers.push_back(v.power);
    }
    const bool is_light =
        !voxels.empty() && glm::all(glm::lessThan(upper - lower, glm::ivec3(0x10000)));
    std::vector<EmittingVoxelRecord> table;
    const std::vector<AliasCell> cells = make_alias_table(powers);
    for (std::size_t i = 0; is_light && i < voxels.size(); ++i) {
        const glm::uvec3 v(voxels[i].voxel - lower);
        table.push_back({.xy = v.x | v.y << 16,
                         .z = v.z,
                         .threshold = static_cast<float>(cells[i].threshold),
                         .alias = cells[i].alias});
    }
    const double volume = std::abs(glm::determinant(glm::dmat3(render_from_index)));
    const double total = is_light ? volume * std::accumulate(powers.begin(), powers.end(), 0.0) : 0;
    std::vector<glm::uvec4> texels(table.size());
    if (!table.empty()) std::memcpy(texels.data(), table.data(), table.size() * sizeof(table[0]));
    const VoxelLightRecord record{.render_from_index = make_affine(render_from_index),
                                  .lower = lower,
                                  .medium = static_cast<std::uint32_t>(index),
                                  .voxels = append_(texels, "emitting voxels"),
                                  .count = static_cast<std::uint32_t>(table.size()),
                                  .total = static_cast<float>(total)};
    const glm::dvec3 extent = glm::dvec3(upper) - glm::dvec3(lower) + 1.0;
    double size2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 edge = extent[axis] * glm::dvec3(render_from_index[axis]);
        size2 += glm::dot(edge, edge) / 12;
    }
    const glm::dvec3 middle = 0.5 * (glm::dvec3(lower) + glm::dvec3(upper));
    return {append_(texels_of(record), "emitting voxels"), total, records_[index].density_record,
            glm::vec3(render_from_index * glm::dvec4(middle, 1)), static_cast<float>(size2)};
}

std::vector<glm::vec4> make_blackbody_table() {
    std::vector<glm::vec4> table;
    for (std::uint32_t i = 0; i < BLACKBODY_ENTRIES; ++i) {
        const double share = double(i) / (BLACKBODY_ENTRIES - 1);
        const double kelvin =
            BLACKBODY_MIN * std::pow(double(BLACKBODY_MAX) / BLACKBODY_MIN, share);
        // What is out of gamut is 0, as good as exp(-90).
        const Rgb radiance = glm::max(blackbody_radiance(kelvin), std::exp(-90.0));
        table.emplace_back(glm::vec3(glm::log(radiance)), 0.0f);
    }
    return table;
}

} // namespace tyndall
