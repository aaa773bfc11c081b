/// The techniques that a study compares: each is a change to the scene.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tyndall::study {

/// What a technique is about; each is a section of the report.
enum class Family {
    estimators, ///< How volpath estimates the whole of light transport.
    marching,   ///< Single scattering by marching.
    orders,     ///< Only so many scattering events.
    cells,      ///< Sizes of majorant cells.
    phases,     ///< Other phase functions of the same mean cosine.
    without     ///< An effect is left out, for what it costs.
};

struct Technique {
    std::string name;  ///< For --technique and files: "march-uniform-16".
    std::string title; ///< For people: "marching, 16 uniform steps".
    Family family = Family::estimators;
    /// Of the same kind as others that differ in `parameter` alone ("march-uniform"); else "".
    std::string series;
    double parameter = 0; ///< Steps, scattering events, or voxels along a cell.
    bool is_unbiased = false;
    std::function<void(Scene&)> apply;
};

/// The baseline of every study, first in the list: unbiased, with all that makes it fast.
inline constexpr const char* kBaseline = "volpath";

/// The techniques that make sense for a scene, from its effects; the baseline is the first.
std::vector<Technique> list_techniques(const Scene& scene);

/// Those whose name one of the patterns matches (*, ? and [...] as in a shell), in their order; all
/// if there are none.
/// @throws Error bad_input: a pattern matches none; names all.
std::vector<Technique> select_techniques(std::vector<Technique> all,
                                         std::span<const std::string> patterns);

/// The scene as the technique renders it.
Scene changed_scene(const Scene& scene, const Technique& technique);

/// Parts of that list, for a scene as the baseline renders it: other majorant cells, other phase
/// functions (media_techniques.cpp), and what leaves out an effect that the scene has
/// (left_out.cpp).
void list_cells(const Scene& scene, std::vector<Technique>& techniques);
void list_phases(const Scene& scene, std::vector<Technique>& techniques);
void list_left_out(const Scene& scene, std::vector<Technique>& techniques);

} // namespace tyndall::study
