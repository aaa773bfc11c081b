// Types after WorldBegin and their parameters; whole scenes.
#include "unit/scene_files.h"

#include <cmath>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

using Lines = std::vector<std::string>;
constexpr double pi = 3.14159265358979323846;

TEST(ShapeType, SphereAndDisk) {
    const Scene scene =
        read_world("Shape \"sphere\" \"float radius\" 2 \"float zmin\" 1 \"float zmax\" -9\n"
                   "\"float phimax\" 90\n"
                   "Shape \"disk\" \"float height\" 3 \"float innerradius\" 0.5\n"
                   "Shape \"sphere\" \"float phimax\" 720\n");
    const auto& cut = std::get<Sphere>(scene.shapes.at(0).geometry);
    EXPECT_EQ(cut.z_min, -2);
    EXPECT_EQ(cut.z_max, 1);
    EXPECT_NEAR(cut.phi_max, pi / 2, 1e-15);
    EXPECT_FALSE(cut.is_full());
    const auto& disk = std::get<Disk>(scene.shapes.at(1).geometry);
    EXPECT_EQ(disk.height, 3);
    EXPECT_EQ(disk.inner_radius, 0.5);
    EXPECT_TRUE(std::get<Sphere>(scene.shapes.at(2).geometry).is_full());
    EXPECT_EQ(
        to_string(scene.shapes.at(1).where).substr(to_string(scene.shapes[1].where).size() - 4),
        ":4:1");
    EXPECT_EQ(
        world_error("Shape \"sphere\" \"float zmin\" 2 \"float zmax\" 3"),
        "the sphere of radius 1 has nothing between zmin 2 and zmax 3 (expected a part of it)");
    EXPECT_EQ(
        world_error("Shape \"disk\" \"float innerradius\" 1"),
        "the disk has the radius 1 and the inner radius 1 (expected the inner one to be smaller)");
}

TEST(ShapeType, Meshes) {
    const Scene scene =
        read_world("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]\n"
                   "Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]\n"
                   "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ] \"integer "
                   "indices\" [ 3 2 1 0 1 "
                   "2 ]\n");
    EXPECT_EQ(std::get<Mesh>(scene.shapes.at(0).geometry).triangles.at(0),
              (std::array<std::uint32_t, 3>{0, 1, 2}));
    EXPECT_EQ(std::get<Mesh>(scene.shapes.at(1).geometry).patches.at(0),
              (std::array<std::uint32_t, 4>{0, 1, 2, 3}));
    EXPECT_EQ(std::get<Mesh>(scene.shapes.at(2).geometry).triangles.at(0),
              (std::array<std::uint32_t, 3>{3, 2, 1}));
}

TEST(ShapeType, MeshesAreChecked) {
    const std::string quad = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ] ";
    EXPECT_EQ(world_error(quad), "shape \"trianglemesh\" needs a parameter \"integer indices\"");
    EXPECT_EQ(world_error("Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ]"),
              "shape \"trianglemesh\" needs a parameter \"point3 P\"");
    EXPECT_EQ(
        world_error(quad + "\"integer indices\" [ 0 1 4 ]"),
        "parameter \"integer indices\" is 4 at position 2 (expected indices from 0 to below 4, the "
        "number of points)");
    EXPECT_EQ(
        world_error(quad + "\"integer indices\" [ 0 -1 2 ]"),
        "parameter \"integer indices\" is -1 at position 1 (expected indices from 0 to below 4, "
        "the number of points)");
    EXPECT_EQ(world_error(quad + "\"integer indices\" [ 0 1 ]"),
              "parameter \"integer indices\" is too short (expected at least 3 indices)");
    EXPECT_EQ(
        world_warnings(quad + "\"integer indices\" [ 0 1 2 3 ] \"normal N\" [ 0 0 1 ] \"integer "
                              "faceIndices\" [ 1 2 ]"),
        (Lines{
            "scene.pbrt:2:1: warning: shape \"trianglemesh\" has 1 values of \"N\" (expected 4); "
            "they are left out",
            "scene.pbrt:2:61: warning: 4 indices (expected a multiple of 3); the last 1 are left "
            "out",
            "scene.pbrt:2:1: warning: shape \"trianglemesh\" has 2 values of \"faceIndices\" "
            "(expected 1); they are left out"}));
}

TEST(ShapeType, OthersAreNotSupported) {
    EXPECT_EQ(world_error("Shape \"loopsubdiv\" \"integer levels\" 2"),
              "shape \"loopsubdiv\" is not supported yet");
    EXPECT_EQ(world_error("Shape \"torus\""),
              "unknown shape \"torus\" (expected one of sphere, disk, "
              "trianglemesh, plymesh, bilinearmesh)");
    EXPECT_EQ(world_error("Shape \"sphere\" \"float alpha\" 0.5"),
              "parameter \"float alpha\" of shape \"sphere\" is not supported yet");
    EXPECT_EQ(world_error("Shape \"sphere\" \"texture alpha\" \"t\""),
              "parameter \"texture alpha\": textures are not supported yet");
}

TEST(MaterialType, ReadsItsParameters) {
    const Scene scene = read_world("Material \"diffuse\" Material \"interface\"\n"
                                   "Material \"diffuse\" \"rgb reflectance\" [ 0 0.5 1 ]\n"
                                   "Material \"\" Material \"none\"\n");
    EXPECT_EQ(scene.materials.at(0).reflectance, Rgb(0.5)); // pbrt's default material
    EXPECT_EQ(scene.materials.at(1).reflectance, Rgb(0.5));
    EXPECT_EQ(scene.materials.at(2).kind, Material::Kind::interface);
    EXPECT_EQ(scene.materials.at(3).reflectance, Rgb(0, 0.5, 1));
    EXPECT_EQ(scene.materials.at(4).kind, Material::Kind::interface);
    EXPECT_EQ(scene.materials.at(5).kind, Material::Kind::interface);
    EXPECT_EQ(scene.warnings.size(), 2u);
    EXPECT_EQ(world_error("Material \"diffuse\" \"rgb reflectance\" [ 0 0.5 1.1 ]"),
              "parameter \"rgb reflectance\" is 1.1 (expected a value in [0, 1])");
    EXPECT_EQ(world_error("Material \"diffuse\" \"rgb reflectance\" [ -0.1 0.5 1 ]"),
              "parameter \"rgb reflectance\" is -0.1 (expected a value in [0, 1])");
    EXPECT_EQ(world_error("Material \"glossy\""),
              "unknown material \"glossy\" (expected one of diffuse, dielectric, "
              "thindielectric, conductor, interface)");
    EXPECT_EQ(world_error("Material \"diffuse\" \"string normalmap\" \"a.png\""),
              "parameter \"string normalmap\" of material \"diffuse\" is not supported yet");
    for (const char* name : {"hair", "mix", "coateddiffuse"}) {
        EXPECT_EQ(world_error("Material \"" + std::string(name) + "\" \"float roughness\" 0.1"),
                  "material \"" + std::string(name) + "\" is not supported yet");
    }
}

TEST(MediumType, ReadsItsParameters) {
    const Scene scene = read_world(
        "MakeNamedMedium \"a\" \"string type\" \"homogeneous\"\n"
        "MakeNamedMedium \"b\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 1 2 3 ]\n"
        "\"rgb sigma_s\" [ 4 5 6 ] \"float scale\" 10 \"float g\" -0.5 \"rgb Le\" [ 1 0 2 ]\n"
        "\"float Lescale\" 3 \"string phase\" \"henyey-greenstein\"\n"
        "MakeNamedMedium \"c\" \"string type\" \"homogeneous\"\n"
        "\"spectrum sigma_s\" [ 464.3 1 549.1 2 611.4 3 ]\n");
    EXPECT_EQ(scene.media.at(0).name, "a");
    EXPECT_EQ(scene.media.at(0).sigma_a, Rgb(1));
    EXPECT_EQ(scene.media.at(0).sigma_s, Rgb(1));
    EXPECT_EQ(scene.media.at(0).emission, Rgb(0));
    EXPECT_EQ(scene.media.at(0).phases.front().g, 0);
    EXPECT_EQ(scene.media.at(1).sigma_a, Rgb(10, 20, 30));
    EXPECT_EQ(scene.media.at(1).sigma_s, Rgb(40, 50, 60));
    EXPECT_EQ(scene.media.at(1).emission, Rgb(3, 0, 6));
    EXPECT_EQ(scene.media.at(1).phases.front().g, -0.5);
    EXPECT_EQ(scene.media.at(2).sigma_s, Rgb(3, 2, 1)); // at the wavelengths of R, G and B
    EXPECT_NE(scene.media.at(2).sigma_s, Rgb(1, 2, 3));
}

TEST(MediumType, ChecksItsParameters) {
    const std::string medium = "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" ";
    EXPECT_EQ(world_error(medium + "\"float g\" 1.5"),
              "parameter \"float g\" is 1.5 (expected a value in [-1, 1])");
    EXPECT_EQ(world_error(medium + "\"rgb sigma_a\" [ 0 -1 0 ]"),
              "parameter \"rgb sigma_a\" is -1 (expected a value >= 0)");
    EXPECT_EQ(world_error("MakeNamedMedium \"a\""),
              "medium \"a\" needs a parameter \"string type\"");
    EXPECT_EQ(world_error("MakeNamedMedium \"a\" \"string type\" \"fog\""),
              "unknown medium \"fog\" (expected one of homogeneous, uniformgrid, "
              "rgbgrid, cloud, nanovdb, vdb, exponential)");
}

template<typename T>
T light_of(const std::string& text) {
    return std::get<T>(read_world(text).lights.at(0).emitter);
}

TEST(LightType, Infinite) {
    EXPECT_TRUE(is_near(light_of<InfiniteLight>("LightSource \"infinite\"").radiance, Rgb(1)));
    const std::string light = "LightSource \"infinite\" \"rgb L\" [ 1 2 3 ] \"float scale\" 2 ";
    EXPECT_TRUE(is_near(light_of<InfiniteLight>(light).radiance, Rgb(2, 4, 6)));
    EXPECT_TRUE(is_near(light_of<InfiniteLight>(light + "\"float illuminance\" 5").radiance,
                        Rgb(2, 4, 6) * 5.0 / pi));
    EXPECT_TRUE(is_near(light_of<InfiniteLight>(light + "\"float illuminance\" -1").radiance,
                        Rgb(2, 4, 6)));
    EXPECT_EQ(world_error("LightSource \"infinite\" \"string filename\" \"sky.exr\""),
              "parameter \"string filename\" of light \"infinite\" is not supported yet");
    EXPECT_EQ(world_error("LightSource \"infinite\" \"rgb L\" [ 1 -1 1 ]"),
              "parameter \"rgb L\" is -1 (expected a value >= 0)");
}

TEST(LightType, Distant) {
    const std::string light =
        "LightSource \"distant\" \"rgb L\" [ 1 2 3 ] \"point3 from\" [ 1 1 5 ] "
        "\"point3 to\" [ 1 1 1 ]";
    EXPECT_TRUE(is_near(light_of<DistantLight>(light).direction, glm::dvec3(0, 0, -1)));
    EXPECT_TRUE(is_near(light_of<DistantLight>(light).irradiance, Rgb(1, 2, 3)));
    EXPECT_TRUE(
        is_near(light_of<DistantLight>("LightSource \"distant\"").direction, glm::dvec3(0, 0, 1)));
    EXPECT_TRUE(is_near(light_of<DistantLight>("Rotate 90 0 1 0 " + light).direction,
                        glm::dvec3(-1, 0, 0)));
    EXPECT_TRUE(is_near(light_of<DistantLight>(light + " \"float illuminance\" 7").irradiance,
                        Rgb(7, 14, 21)));
    EXPECT_EQ(world_error("LightSource \"distant\" \"point3 from\" [ 0 0 1 ]"),
              "light \"distant\": \"from\" and \"to\" are the same point (expected two points)");
}

TEST(LightType, Point) {
    const std::string light =
        "Translate 1 0 0 LightSource \"point\" \"rgb I\" [ 1 2 3 ] \"point3 from\" "
        "[ 1 2 3 ] \"float scale\" 2";
    EXPECT_TRUE(is_near(light_of<PointLight>(light).position, glm::dvec3(2, 2, 3)));
    EXPECT_TRUE(is_near(light_of<PointLight>(light).intensity, Rgb(2, 4, 6)));
    EXPECT_TRUE(is_near(light_of<PointLight>(light + " \"float power\" 8").intensity,
                        Rgb(2, 4, 6) * 8.0 / (4 * pi)));
}

TEST(LightType, Spot) {
    const std::string light =
        "LightSource \"spot\" \"float coneangle\" 60 \"float conedeltaangle\" 30 "
        "\"point3 from\" [ 0 1 0 ] \"point3 to\" [ 0 0 0 ] ";
    const auto spot = light_of<SpotLight>(light);
    EXPECT_TRUE(is_near(spot.axis, glm::dvec3(0, -1, 0)));
    EXPECT_TRUE(is_near(spot.position, glm::dvec3(0, 1, 0)));
    EXPECT_NEAR(spot.cos_total_width, 0.5, 1e-15);
    EXPECT_NEAR(spot.cos_falloff_start, std::sqrt(0.75), 1e-15);
    EXPECT_TRUE(is_near(spot.intensity, Rgb(1)));
    // By quadrature: the power of an intensity with that falloff is the one asked for.
    const auto powered = light_of<SpotLight>(light + "\"float power\" 10");
    double power = 0;
    const int steps = 100000;
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        const double t = glm::clamp((cosine - powered.cos_total_width) /
                                        (powered.cos_falloff_start - powered.cos_total_width),
                                    0.0, 1.0);
        power += powered.intensity.g * t * t * (3 - 2 * t) * 2 * pi / steps;
    }
    EXPECT_NEAR(power, 10, 1e-6);
    EXPECT_GT(std::abs(power - 10 * powered.intensity.g), 1e-6);
    EXPECT_TRUE(world_errors("LightSource \"spot\" \"float coneangle\" 3").empty());
    EXPECT_EQ(world_warnings("Scale 1 2 1 LightSource \"spot\"").size(), 1u);
    EXPECT_EQ(world_error("LightSource \"spot\" \"float coneangle\" 1 \"float conedeltaangle\" 5"),
              "light \"spot\": \"conedeltaangle\" is 5 (expected at most twice the coneangle, 1)");
    EXPECT_EQ(world_error("LightSource \"goniometric\""),
              "light \"goniometric\" is not supported yet");
}

TEST(AreaLightType, IsSharedByShapes) {
    const Scene scene =
        read_world("AreaLightSource \"diffuse\" \"rgb L\" [ 1 2 3 ] \"float scale\" 2\n"
                   "Shape \"sphere\" Shape \"disk\"\n"
                   "AreaLightSource \"diffuse\" \"bool twosided\" true\n"
                   "Shape \"disk\"\n"
                   "Material \"interface\" Shape \"disk\"\n");
    ASSERT_EQ(scene.area_lights.size(), 2u);
    EXPECT_EQ(scene.area_lights[0].radiance, Rgb(2, 4, 6));
    EXPECT_FALSE(scene.area_lights[0].two_sided);
    EXPECT_TRUE(scene.area_lights[1].two_sided);
    EXPECT_EQ(scene.shapes.at(0).area_light, 0);
    EXPECT_EQ(scene.shapes.at(1).area_light, 0);
    EXPECT_EQ(scene.shapes.at(2).area_light, 1);
    EXPECT_EQ(scene.shapes.at(3).area_light, -1);
    EXPECT_EQ(scene.warnings.size(), 1u);
}

TEST(AreaLightType, PowerDependsOnTheShape) {
    const Scene scene =
        read_world("AreaLightSource \"diffuse\" \"rgb L\" [ 1 2 3 ] \"float power\" 12\n"
                   "Shape \"sphere\" \"float radius\" 2 Shape \"disk\"\n"
                   "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]\n"
                   "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 2 0 0 0 2 0 ]\n"
                   "AreaLightSource \"diffuse\" \"float power\" 12 \"bool twosided\" true\n"
                   "Shape \"disk\" \"float innerradius\" 0.5 \"float phimax\" 180\n");
    ASSERT_EQ(scene.area_lights.size(), 4u);
    EXPECT_TRUE(is_near(scene.area_lights[0].radiance, Rgb(1, 2, 3) * 12.0 / (pi * 16 * pi)));
    EXPECT_TRUE(is_near(scene.area_lights[1].radiance, Rgb(1, 2, 3) * 12.0 / (pi * pi)));
    EXPECT_EQ(scene.area_lights[2].radiance, Rgb(0));
    EXPECT_TRUE(is_near(scene.area_lights[2].power_radiance, Rgb(1, 2, 3) * 12.0 / pi));
    EXPECT_EQ(scene.shapes.at(2).area_light, scene.shapes.at(3).area_light);
    EXPECT_TRUE(is_near(scene.area_lights[3].radiance, Rgb(12 / (2 * pi * 0.5 * pi * 0.75))));
    EXPECT_FALSE(is_near(scene.area_lights[3].radiance, Rgb(12 / (pi * 0.5 * pi * 0.75))));
    EXPECT_EQ(world_error("AreaLightSource \"diffuse\" \"string filename\" \"a.exr\""),
              "parameter \"string filename\" of area light \"diffuse\" is not supported yet");
    EXPECT_EQ(world_error("AreaLightSource \"spot\""),
              "unknown area light \"spot\" (expected diffuse)");
}

TEST(WholeScenes, CubeOfFog) {
    const Scene scene = SceneFolder().read(
        "LookAt 0 0 -6  0 0 0  0 1 0\n"
        "Camera \"perspective\" \"float fov\" [ 38 ]\n"
        "Film \"rgb\" \"integer xresolution\" [ 128 ] \"integer yresolution\" [ 128 ]\n"
        "  \"string filename\" [ \"homogeneous-cube.exr\" ] \"bool savefp16\" false\n"
        "PixelFilter \"box\" \"float xradius\" [ 0.5 ] \"float yradius\" [ 0.5 ]\n"
        "Sampler \"independent\" \"integer pixelsamples\" [ 64 ]\n"
        "Integrator \"volpath\" \"integer maxdepth\" [ 1000 ]\n"
        "WorldBegin\n"
        "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n"
        "MakeNamedMedium \"m\" \"string type\" [ \"homogeneous\" ]\n"
        "  \"rgb sigma_a\" [ 0.5 0.5 0.5 ] \"rgb sigma_s\" [ 2 2 2 ] \"float g\" [ 0.5 ]\n"
        "AttributeBegin\n"
        "  MediumInterface \"m\" \"\"\n"
        "  Material \"interface\"\n"
        "  Shape \"trianglemesh\"\n"
        "  \"point3 P\" [ -1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  -1 -1 1  1 -1 1  1 1 1  -1 1 1 ]\n"
        "  \"integer indices\" [ 0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 3 7 6 3 6 2 0 4 7 0 7 3 1 2 6 "
        "1 6 5 "
        "]\n"
        "AttributeEnd\n");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.samples_per_pixel, 64);
    EXPECT_EQ(scene.integrator.max_depth, 1000);
    const Shape& cube = scene.shapes.at(0);
    EXPECT_EQ(std::get<Mesh>(cube.geometry).triangles.size(), 12u);
    EXPECT_EQ(cube.media.inside, 0);
    EXPECT_EQ(cube.media.outside, -1);
    EXPECT_EQ(scene.camera.medium, -1);
    EXPECT_TRUE(is_near(std::get<InfiniteLight>(scene.lights.at(0).emitter).radiance, Rgb(1)));
    EXPECT_FALSE(is_near(scene.media.at(0).sigma_s, scene.media.at(0).sigma_a));
}

} // namespace
} // namespace tyndall
