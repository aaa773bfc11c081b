#include "reference/camera.h"

namespace tyndall::reference {
namespace {

/// pbrt: the shorter axis of the picture spans [-1, 1], the longer one as much more as the aspect.
std::array<double, 4> screen_window(const Camera& camera, const Film& film) {
    if (camera.screen_window_given) return camera.screen_window;
    const double aspect = camera.frame_aspect_ratio > 0
                              ? camera.frame_aspect_ratio
                              : static_cast<double>(film.width) / film.height;
    if (aspect > 1) return {-aspect, aspect, -1, 1};
    return {-1, 1, -1 / aspect, 1 / aspect};
}

} // namespace

PathCamera::PathCamera(const Scene& scene)
    : camera_(scene.camera), width_(scene.film.width), height_(scene.film.height),
      x_filter_(make_filter_table(scene.filter, scene.filter.x_radius)),
      y_filter_(make_filter_table(scene.filter, scene.filter.y_radius)),
      position_(scene.camera.world_from_camera[3]),
      world_from_camera_(scene.camera.world_from_camera),
      plane_scale_(std::tan(glm::radians(scene.camera.fov) / 2)) {
    camera_.screen_window = screen_window(scene.camera, scene.film);
}

CameraSample PathCamera::sample(int x, int y, const RandomPath& random) const {
    const glm::uvec4 words = random.camera_words();
    const FilterSample in_x = sample_filter(x_filter_, unit(words.x));
    const FilterSample in_y = sample_filter(y_filter_, unit(words.y));
    const dvec2 film_point(x + 0.5 + in_x.offset, y + 0.5 + in_y.offset);
    const dvec2 lens_point = camera_.lens_radius * concentric_disk(unit(words.z), unit(words.w));
    return {ray_through(film_point, lens_point), in_x.weight * in_y.weight};
}

Ray PathCamera::ray_through(dvec2 film_point, dvec2 lens_point) const {
    const auto& [x0, x1, y0, y1] = camera_.screen_window;
    const double x = x0 + (x1 - x0) * film_point.x / width_;
    const double y = y1 - (y1 - y0) * film_point.y / height_;
    const bool perspective = camera_.kind == Camera::Kind::perspective;
    dvec3 origin = perspective ? dvec3(0) : dvec3(x, y, 0);
    dvec3 direction = perspective ? dvec3(plane_scale_ * x, plane_scale_ * y, 1) : dvec3(0, 0, 1);
    if (camera_.lens_radius > 0) { // All rays of a film point meet on the plane z = focal_distance.
        const dvec3 focus = origin + direction * camera_.focal_distance;
        origin += dvec3(lens_point, 0);
        direction = focus - origin;
    }
    return {world_from_camera_ * origin, glm::normalize(world_from_camera_ * direction)};
}

} // namespace tyndall::reference
