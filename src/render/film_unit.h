/// How bright a scene is, roughly, for the statistics of its film.
#pragma once

#include "scene/scene.h"

namespace tyndall {

/// What the device multiplies deviations with before it squares them: 1, or a power of two where
/// the squares of the scene's radiance could leave the range of float32.
double film_unit(const Scene& scene);

} // namespace tyndall
