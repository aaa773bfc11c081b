/// pbrt's perspective and orthographic cameras with a thin lens.
#pragma once

#include "reference/sampling.h"
#include "scene/filter.h"
#include "scene/scene.h"

namespace tyndall::reference {

struct CameraSample {
    Ray ray;       ///< In render space: the world, moved so that the camera is at the origin.
    double weight; ///< Of the pixel filter: +1 or -1.
};

class PathCamera {
  public:
    explicit PathCamera(const Scene& scene);

    /// The camera's position in the world; render space is the world minus this.
    dvec3 position() const { return position_; }
    /// Event 0 of a path: the words 0, 1 of its path block place it in the pixel, 2, 3 on the lens.
    CameraSample sample(int x, int y, const RandomPath& random) const;

  private:
    Ray ray_through(dvec2 film_point, dvec2 lens_point) const;

    Camera camera_;
    double width_, height_;
    FilterTable x_filter_, y_filter_;
    dvec3 position_;
    dmat3 world_from_camera_; ///< Without the translation.
    double plane_scale_; ///< Extent of the plane z = 1 that the screen rectangle's unit covers.
};

} // namespace tyndall::reference
