/// Rays against a mesh, beside Embree's rtcIntersect1 on the same rays.
#include "bench/bench.h"
#include "bench/made_scenes.h"
#include "bench/mesh_rays.h"
#include "spirv/mesh_rays.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <embree3/rtcore.h>
#include <limits>

namespace tyndall::bench {
namespace {

constexpr std::uint32_t kRays = 1u << 20;

/// The rays on the device, through the hierarchy of the renderer.
class DeviceRays {
  public:
    explicit DeviceRays(const Mesh& mesh);
    void trace();
    std::vector<glm::vec4> distances() const;

  private:
    static Scene make_scene(const Mesh& mesh);
    shared::Features features() const;

    Scene scene_;
    Effects effects_;
    SceneTables tables_;
    gpu::Buffer unused_, scene_texels_, film_;
    gpu::Descriptors descriptors_;
    gpu::Stage stage_;
    gpu::Commands commands_;
};

Scene DeviceRays::make_scene(const Mesh& mesh) {
    Scene scene; // its camera is at the origin: render space is the world
    scene.film.bounds = {0, 1, 0, 1};
    scene.materials.emplace_back();
    scene.shapes.push_back({.geometry = mesh});
    return scene;
}

shared::Features DeviceRays::features() const {
    shared::Features features = effects_.features;
    features.workgroup_size = 64;
    features.storage_fallback = descriptors_.storage_fallback();
    features.primitives = tables_.primitives;
    return features;
}

constexpr gpu::Buffer::Options kTexels{.texels = true};

DeviceRays::DeviceRays(const Mesh& mesh)
    : scene_(make_scene(mesh)), effects_(compute_effects(scene_)),
      tables_(make_scene_tables(scene_, effects_)), unused_(context(), "unused", 1024, kTexels),
      scene_texels_(context(), "scene", tables_.texels.size() * 16, kTexels),
      film_(context(), "distances", std::uint64_t{kRays} * 16, kTexels),
      descriptors_(context(),
                   {{&scene_texels_, &unused_, &unused_, &film_, &unused_}, &unused_, &unused_},
                   sizeof(tables_.push)),
      stage_(context(), descriptors_, "mesh_rays", mesh_rays_spirv, features()),
      commands_(context()) {
    gpu::upload(context(), scene_texels_, std::as_bytes(std::span(tables_.texels)));
    tables_.push.pixel_count = kRays;
}

void DeviceRays::trace() {
    commands_.begin();
    commands_.bind(descriptors_, std::as_bytes(std::span(&tables_.push, 1)));
    commands_.dispatch(stage_, kRays);
    commands_.barrier();
    commands_.submit();
    commands_.wait();
}

std::vector<glm::vec4> DeviceRays::distances() const {
    std::vector<glm::vec4> texels(kRays);
    gpu::download(context(), film_, 0, std::as_writable_bytes(std::span(texels)));
    return texels;
}

/// The same on one thread of the host.
class EmbreeRays {
  public:
    explicit EmbreeRays(const Mesh& mesh);
    ~EmbreeRays();
    EmbreeRays(const EmbreeRays&) = delete;
    EmbreeRays& operator=(const EmbreeRays&) = delete;
    std::vector<float> trace(glm::uvec2 seed) const;

  private:
    RTCDevice device_ = rtcNewDevice("threads=1");
    RTCScene scene_ = rtcNewScene(device_);
};

EmbreeRays::EmbreeRays(const Mesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                              RTC_FORMAT_FLOAT3, 12, mesh.positions.size());
    std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<glm::vec3*>(positions));
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              12, mesh.triangles.size());
    std::copy(mesh.triangles.begin(), mesh.triangles.end(),
              static_cast<std::array<std::uint32_t, 3>*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
}

EmbreeRays::~EmbreeRays() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

std::vector<float> EmbreeRays::trace(glm::uvec2 seed) const {
    std::vector<float> distances(kRays);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const shared::MeshRay r = shared::mesh_ray(seed, i);
        RTCRayHit hit{};
        hit.ray = {.org_x = r.origin.x,
                   .org_y = r.origin.y,
                   .org_z = r.origin.z,
                   .dir_x = r.direction.x,
                   .dir_y = r.direction.y,
                   .dir_z = r.direction.z,
                   .tfar = std::numeric_limits<float>::infinity(),
                   .mask = ~0u};
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &hit);
        distances[i] = hit.ray.tfar;
    }
    return distances;
}

void mesh_rays(benchmark::State& state) {
    const Mesh mesh = bumpy_ball(static_cast<int>(state.range(0)));
    DeviceRays device(mesh);
    const EmbreeRays embree(mesh);
    device.trace();
    double ours = std::numeric_limits<double>::max(), embrees = ours;
    std::vector<float> expected;
    for (auto _ : state) {
        ours = std::min(ours, cost_of([&] { device.trace(); }));
        embrees = std::min(embrees, cpu_of([&] { expected = embree.trace({0, 0}); }));
    }
    const std::vector<glm::vec4> got = device.distances();
    // Ours is the distance to the plane of the triangle, Embree's that along its edges as seen from
    // the origin: that is finer where the origin is close by, but not where vertices are far.
    const auto tolerance = [](float distance) { return 1e-4F * distance + 2e-6F; };
    std::uint32_t different = 0;
    for (std::uint32_t i = 0; i < kRays; ++i)
        different +=
            !(got[i].x == expected[i] || std::abs(got[i].x - expected[i]) < tolerance(expected[i]));
    state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
    state.counters["Mrays_per_second"] = kRays / ours * 1e-6;
    state.counters["embree_Mrays_per_second"] = kRays / embrees * 1e-6;
    state.counters["of_embree"] = embrees / ours;
    state.counters["different_hits"] = different;
}
BENCHMARK(mesh_rays)->Arg(187)->Arg(374)->Iterations(3)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace tyndall::bench
