/// Which boundaries between media may touch other surfaces.
#pragma once

#include "scene/scene.h"

namespace tyndall {

/// A shape that is a mere boundary, and whose box in the world meets that of another shape; nullptr
/// if there is none. Only such a shape can touch another where a ray crosses it. Definitions of
/// objects count where their instances are.
const Shape* find_contact(const Scene& scene);

} // namespace tyndall
