#include "support/materials.h"

namespace tyndall::support {
namespace {

int add(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}

} // namespace

int add_dielectric(Scene& scene, const Rgb& eta, double alpha) {
    return add(scene, {.kind = Material::Kind::dielectric, .eta = eta, .alpha = alpha});
}

int add_thin_dielectric(Scene& scene, const Rgb& eta) {
    return add(scene, {.kind = Material::Kind::thin_dielectric, .eta = eta});
}

int add_conductor(Scene& scene, const Rgb& eta, const Rgb& k, double alpha) {
    return add(scene, {.kind = Material::Kind::conductor, .eta = eta, .k = k, .alpha = alpha});
}

} // namespace tyndall::support
