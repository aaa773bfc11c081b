// Directives: transformations, graphics state, objects, blocks.
#include "unit/scene_files.h"

#include <cmath>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

using Lines = std::vector<std::string>;

/// Rows, as one writes a matrix.
glm::dmat4 rows(const std::array<double, 16>& r) {
    glm::dmat4 m;
    for (int i = 0; i < 16; ++i)
        m[i % 4][i / 4] = r[static_cast<std::size_t>(i)];
    return m;
}

glm::dmat4 transform_of(const std::string& directives) {
    return read_world(directives + "\nShape \"sphere\"").shapes.at(0).world_from_object;
}

TEST(Transformations, MatchMatricesByHand) {
    EXPECT_TRUE(is_near(transform_of("Translate 1 2 3"),
                        rows({1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1})));
    EXPECT_TRUE(is_near(transform_of("Scale 2 3 -4"),
                        rows({2, 0, 0, 0, 0, 3, 0, 0, 0, 0, -4, 0, 0, 0, 0, 1})));
    // A quarter turn about z takes x to y.
    EXPECT_TRUE(is_near(transform_of("Rotate 90 0 0 2"),
                        rows({0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1})));
    EXPECT_FALSE(is_near(transform_of("Rotate -90 0 0 2"),
                         rows({0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1})));
    // A third of a turn about (1, 1, 1) takes x to y to z to x.
    EXPECT_TRUE(is_near(transform_of("Rotate 120 1 1 1"),
                        rows({0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1})));
}

TEST(Transformations, ComposeFromTheRight) {
    EXPECT_TRUE(is_near(transform_of("Translate 1 0 0 Scale 2 2 2"),
                        rows({2, 0, 0, 1, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1})));
    EXPECT_TRUE(is_near(transform_of("Scale 2 2 2 Translate 1 0 0"),
                        rows({2, 0, 0, 2, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1})));
    EXPECT_TRUE(is_near(transform_of("Scale 2 2 2 Identity"), glm::dmat4(1)));
}

TEST(Transformations, MatricesAreWrittenColumnAfterColumn) {
    const char* values = "[ 0 1 0 0  -1 0 0 0  0 0 1 0  5 6 7 1 ]";
    const glm::dmat4 expected = rows({0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1});
    EXPECT_TRUE(is_near(transform_of(std::string("Scale 9 9 9 Transform ") + values), expected));
    EXPECT_TRUE(is_near(transform_of(std::string("ConcatTransform ") + values), expected));
    EXPECT_TRUE(is_near(transform_of(std::string("Translate 1 0 0 ConcatTransform ") + values),
                        rows({0, -1, 0, 6, 1, 0, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1})));
    EXPECT_FALSE(
        is_near(transform_of(std::string("ConcatTransform ") + values), glm::transpose(expected)));
}

TEST(Transformations, LookAtFacesZ) {
    const Scene scene = read_options("LookAt 0 0 -6  0 0 0  0 1 0\nCamera \"perspective\"");
    EXPECT_TRUE(is_near(scene.camera.world_from_camera,
                        rows({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -6, 0, 0, 0, 1})));
    // Looking along -x from (3, 0, 0) with y up: camera x is world +z (left-handed).
    const Scene side = read_options("LookAt 3 0 0  0 0 0  0 5 0\nCamera \"perspective\"");
    EXPECT_TRUE(is_near(side.camera.world_from_camera,
                        rows({0, 0, -1, 3, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1})));
    EXPECT_FALSE(is_near(side.camera.world_from_camera, scene.camera.world_from_camera));
}

TEST(Transformations, DegenerateOnesAreErrors) {
    EXPECT_EQ(
        world_errors("Rotate 90 0 0 0"),
        Lines{"scene.pbrt:2:1: error: Rotate: the axis has no length (expected a vector other than "
              "0 0 0)"});
    EXPECT_EQ(world_errors("LookAt 0 0 0 0 0 1 0 0 1").size(), 1u);
    EXPECT_EQ(world_errors("LookAt 0 0 0 0 0 0 0 1 0").size(), 1u);
    EXPECT_EQ(
        world_errors("Scale 1 1 0 Shape \"sphere\""),
        Lines{"scene.pbrt:2:13: error: the transformation has no inverse (expected one that keeps "
              "three dimensions)"});
    EXPECT_EQ(world_errors("Transform [ 1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1 ]").size(), 1u);
    EXPECT_EQ(world_errors("Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 ]"),
              Lines{"scene.pbrt:2:43: error: Transform: expected a number, found \"]\""});
    EXPECT_EQ(world_errors("Transform 1"),
              Lines{"scene.pbrt:2:11: error: Transform: expected [, found \"1\""});
}

TEST(Transformations, CoordinateSystemsAreKept) {
    EXPECT_TRUE(is_near(transform_of("Translate 1 0 0 CoordinateSystem \"here\" Translate 0 5 0\n"
                                     "CoordSysTransform \"here\""),
                        transform_of("Translate 1 0 0")));
    const Scene scene = SceneFolder().read("Translate 1 2 3 Camera \"perspective\" WorldBegin\n"
                                           "CoordSysTransform \"camera\" Shape \"sphere\"\n"
                                           "CoordSysTransform \"world\" Shape \"sphere\"\n");
    EXPECT_TRUE(is_near(scene.shapes.at(0).world_from_object, transform_of("Translate -1 -2 -3")));
    EXPECT_TRUE(is_near(scene.shapes.at(1).world_from_object, glm::dmat4(1)));
    EXPECT_EQ(
        world_warnings("CoordSysTransform \"none\""),
        Lines{"scene.pbrt:2:1: warning: no coordinate system is named \"none\"; the transformation "
              "stays as it is"});
}

TEST(Transformations, AnimatedOnesAreNotSupported) {
    EXPECT_EQ(
        world_errors("ActiveTransform EndTime Translate 1 0 0 ActiveTransform All Shape \"disk\""),
        Lines{"scene.pbrt:2:61: error: animated transforms are not supported yet"});
    EXPECT_TRUE(is_near(transform_of("ActiveTransform EndTime Translate 1 0 0\n"
                                     "ActiveTransform StartTime Translate 1 0 0"),
                        transform_of("Translate 1 0 0")));
    EXPECT_EQ(option_errors("TransformTimes 0 1 ActiveTransform EndTime Translate 1 0 0\n"
                            "Camera \"perspective\""),
              Lines{"scene.pbrt:2:1: error: animated transforms are not supported yet"});
    EXPECT_EQ(
        world_errors("ActiveTransform Middle"),
        Lines{"scene.pbrt:2:17: error: ActiveTransform: expected All, StartTime or EndTime, found "
              "\"Middle\""});
}

TEST(GraphicsState, WorldBeginResetsTheTransformationOnly) {
    const Scene scene = SceneFolder().read("MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\n"
                                           "MediumInterface \"m\" Translate 1 0 0\n"
                                           "WorldBegin Shape \"sphere\"");
    EXPECT_TRUE(is_near(scene.shapes.at(0).world_from_object, glm::dmat4(1)));
    EXPECT_EQ(scene.shapes.at(0).media.inside, 0);
    EXPECT_EQ(scene.shapes.at(0).media.outside, 0);
}

TEST(GraphicsState, AttributesAreScoped) {
    const Scene scene = read_world("AttributeBegin\n"
                                   "Translate 1 0 0 ReverseOrientation Material \"interface\"\n"
                                   "Attribute \"shape\" \"float radius\" 2\n"
                                   "Shape \"sphere\"\n"
                                   "AttributeEnd\n"
                                   "Shape \"sphere\"\n");
    const Shape& inner = scene.shapes.at(0);
    const Shape& outer = scene.shapes.at(1);
    EXPECT_TRUE(inner.reverse_orientation);
    EXPECT_FALSE(outer.reverse_orientation);
    EXPECT_EQ(inner.world_from_object[3].x, 1);
    EXPECT_EQ(outer.world_from_object[3].x, 0);
    EXPECT_EQ(scene.materials.at(static_cast<std::size_t>(inner.material)).kind,
              Material::Kind::interface);
    EXPECT_EQ(scene.materials.at(static_cast<std::size_t>(outer.material)).kind,
              Material::Kind::diffuse);
    EXPECT_EQ(std::get<Sphere>(inner.geometry).radius, 2);
    EXPECT_EQ(std::get<Sphere>(outer.geometry).radius, 1);
}

TEST(GraphicsState, ScopesMustMatch) {
    EXPECT_EQ(world_errors("AttributeBegin"),
              Lines{"scene.pbrt:2:1: error: AttributeBegin without AttributeEnd"});
    EXPECT_EQ(world_errors("AttributeEnd"),
              Lines{"scene.pbrt:2:1: error: AttributeEnd without AttributeBegin"});
    EXPECT_EQ(
        world_errors("ObjectBegin \"a\" AttributeEnd ObjectEnd"),
        Lines{"scene.pbrt:2:17: error: AttributeEnd inside the ObjectBegin at scene.pbrt:2:1"});
    EXPECT_EQ(
        world_errors("ObjectBegin \"a\" AttributeBegin ObjectEnd AttributeEnd ObjectEnd"),
        Lines{"scene.pbrt:2:32: error: ObjectEnd inside the AttributeBegin at scene.pbrt:2:17"});
    EXPECT_EQ(world_errors("ObjectEnd"),
              Lines{"scene.pbrt:2:1: error: ObjectEnd without ObjectBegin"});
    EXPECT_EQ(world_errors("ObjectBegin \"a\""),
              Lines{"scene.pbrt:2:1: error: ObjectBegin without ObjectEnd"});
    EXPECT_TRUE(world_errors("AttributeBegin AttributeBegin AttributeEnd AttributeEnd").empty());
}

TEST(GraphicsState, NestingIsBounded) {
    std::string text;
    for (int i = 0; i < 2000; ++i)
        text += "AttributeBegin ";
    EXPECT_EQ(world_errors(text).back(),
              "scene.pbrt:2:15001: error: attributes are nested more than 1000 deep");
}

TEST(GraphicsState, TransformBeginIsDeprecated) {
    EXPECT_EQ(
        world_warnings("TransformBegin TransformEnd TransformBegin TransformEnd"),
        Lines{"scene.pbrt:2:1: warning: TransformBegin and TransformEnd are deprecated; they do "
              "what AttributeBegin and AttributeEnd do"});
}

TEST(GraphicsState, AttributeReachesEveryTarget) {
    const Scene scene =
        read_world("Attribute \"light\" \"float scale\" 3\n"
                   "Attribute \"material\" \"rgb reflectance\" [ 0.1 0.1 0.1 ]\n"
                   "Attribute \"medium\" \"float g\" 0.5\n"
                   "Attribute \"texture\" \"float scale\" 2\n"
                   "LightSource \"infinite\"\n"
                   "Material \"diffuse\"\n"
                   "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\n"
                   "MakeNamedMedium \"n\" \"string type\" \"homogeneous\" \"float g\" 0.25\n");
    EXPECT_EQ(std::get<InfiniteLight>(scene.lights.at(0).emitter).radiance, Rgb(3));
    EXPECT_EQ(scene.materials.at(1).reflectance, Rgb(0.1));
    EXPECT_EQ(scene.media.at(0).phases.front().g, 0.5);
    EXPECT_EQ(scene.media.at(1).phases.front().g, 0.25);
    EXPECT_EQ(
        world_errors("Attribute \"sound\" \"float x\" 1"),
        Lines{"scene.pbrt:2:1: error: unknown attribute target \"sound\" (expected one of shape, "
              "light, material, medium, texture)"});
}

TEST(Blocks, DirectivesHaveTheirs) {
    EXPECT_EQ(world_errors("Camera \"perspective\" Film \"rgb\""),
              (Lines{"scene.pbrt:2:1: error: Camera is not allowed after WorldBegin",
                     "scene.pbrt:2:22: error: Film is not allowed after WorldBegin"}));
    EXPECT_EQ(world_errors("WorldBegin"),
              Lines{"scene.pbrt:2:1: error: WorldBegin is not allowed after WorldBegin"});
    // Told once, with or without a later WorldBegin.
    EXPECT_EQ(SceneFolder().errors("Shape \"sphere\" Shape \"disk\""),
              Lines{"scene.pbrt:1:1: error: Shape is not allowed before WorldBegin"});
    EXPECT_EQ(SceneFolder().errors("Camera \"perspective\""),
              Lines{"scene.pbrt: error: the scene has no WorldBegin"});
    EXPECT_EQ(world_errors("WorldEnd"), Lines{"scene.pbrt:2:1: error: WorldEnd is no directive of "
                                              "pbrt-v4 (expected the end of the file)"});
}

TEST(Names, MediaOfShapesMayBeDefinedLater) {
    const char* medium = "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\n";
    const Scene scene =
        read_world(std::string("MediumInterface \"m\" \"\" Shape \"sphere\"\n") + medium);
    EXPECT_EQ(scene.shapes.at(0).media.inside, 0);
    EXPECT_EQ(scene.shapes.at(0).media.outside, -1);
    EXPECT_TRUE(scene.shapes.at(0).media.is_transition());
    EXPECT_EQ(world_errors("MediumInterface \"m\" \"n\" Shape \"sphere\" Shape \"sphere\""),
              (Lines{"scene.pbrt:2:25: error: medium \"m\" is not defined",
                     "scene.pbrt:2:25: error: medium \"n\" is not defined"}));
    EXPECT_EQ(world_errors(std::string(medium) + medium),
              Lines{"scene.pbrt:3:1: error: medium \"m\" is defined twice"});
}

TEST(Names, MediaOfCamerasAndLightsMayNot) {
    const char* medium = "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\n";
    const std::string camera = "MediumInterface \"\" \"m\"\nCamera \"perspective\"\n";
    EXPECT_EQ(read_options(medium + camera).camera.medium, 0);
    EXPECT_EQ(read_options(camera + medium).camera.medium, 0);
    EXPECT_EQ(
        read_options(std::string(medium) + "MediumInterface \"m\" \"\"\nCamera \"perspective\"\n")
            .camera.medium,
        -1);
    EXPECT_EQ(SceneFolder().errors(camera + "WorldBegin\n" + medium),
              Lines{"scene.pbrt:2:1: error: medium \"m\" is not defined"});
    EXPECT_EQ(
        world_errors("MediumInterface \"m\"\nLightSource \"infinite\"\n" + std::string(medium)),
        Lines{"scene.pbrt:3:1: error: medium \"m\" is not defined"});
}

TEST(Names, MaterialsMayBeDefinedLater) {
    const Scene scene = read_world("NamedMaterial \"a\" Shape \"sphere\"\n"
                                   "MakeNamedMaterial \"b\" \"string type\" \"diffuse\"\n"
                                   "MakeNamedMaterial \"a\" \"string type\" \"interface\"\n"
                                   "NamedMaterial \"b\" Shape \"sphere\"\n");
    const auto kind = [&](std::size_t i) {
        return scene.materials.at(static_cast<std::size_t>(scene.shapes.at(i).material)).kind;
    };
    EXPECT_EQ(kind(0), Material::Kind::interface);
    EXPECT_EQ(kind(1), Material::Kind::diffuse);
    EXPECT_EQ(world_errors("NamedMaterial \"a\" Shape \"sphere\""),
              Lines{"scene.pbrt:2:19: error: material \"a\" is not defined"});
    EXPECT_EQ(world_errors("MakeNamedMaterial \"a\""),
              Lines{"scene.pbrt:2:1: error: material \"a\" needs a parameter \"string type\""});
}

TEST(Objects, HoldShapesInTheirOwnSpace) {
    const Scene scene = read_world("Translate 9 0 0\n"
                                   "ObjectBegin \"pair\"\n"
                                   "  Shape \"sphere\"\n"
                                   "  Translate 1 0 0 Shape \"disk\"\n"
                                   "ObjectEnd\n"
                                   "Shape \"sphere\"\n"
                                   "Translate 0 2 0 ObjectInstance \"pair\"\n"
                                   "ObjectInstance \"late\"\n"
                                   "ObjectBegin \"late\" ObjectEnd\n");
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.shapes.size(), 1u);
    ASSERT_EQ(scene.objects[0].shapes.size(), 2u);
    EXPECT_EQ(scene.objects[0].shapes[1].world_from_object[3].x, 10);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].object, 0);
    EXPECT_EQ(scene.instances[0].world_from_definition[3], glm::dvec4(9, 2, 0, 1));
    EXPECT_EQ(scene.instances[1].object, 1);
    EXPECT_EQ(scene.shapes[0].world_from_object[3].x, 9); // ObjectEnd restored the state
}

TEST(Objects, HaveRules) {
    EXPECT_EQ(world_errors("ObjectInstance \"none\""),
              Lines{"scene.pbrt:2:1: error: object \"none\" is not defined"});
    EXPECT_EQ(world_errors("ObjectBegin \"a\" ObjectEnd ObjectBegin \"a\" ObjectEnd"),
              Lines{"scene.pbrt:2:27: error: object \"a\" is defined twice"});
    EXPECT_EQ(
        world_errors("ObjectBegin \"a\" ObjectBegin \"b\" ObjectEnd ObjectEnd"),
        Lines{
            "scene.pbrt:2:17: error: ObjectBegin inside of an object (expected ObjectEnd first)"});
    EXPECT_EQ(
        world_errors("ObjectBegin \"a\" ObjectInstance \"a\" ObjectEnd"),
        Lines{"scene.pbrt:2:17: error: ObjectInstance inside of an object (expected ObjectEnd "
              "first)"});
    EXPECT_EQ(
        world_warnings("AreaLightSource \"diffuse\" ObjectBegin \"a\" Shape \"sphere\" ObjectEnd"),
        Lines{"scene.pbrt:2:43: warning: shapes of objects do not emit; the area light is left "
              "out"});
}

TEST(Import, KeepsItsStateToItself) {
    SceneFolder folder;
    folder.write("a.pbrt", "Translate 1 0 0 Shape \"sphere\"\n"
                           "MakeNamedMaterial \"a\" \"string type\" \"interface\"\n"
                           "CoordinateSystem \"inner\"\n");
    const char* text = "WorldBegin Translate 0 5 0\n"
                       "Import \"a.pbrt\"\n"
                       "NamedMaterial \"a\" Shape \"sphere\"\n"
                       "CoordSysTransform \"inner\"\n";
    const Scene scene = folder.read(text);
    EXPECT_EQ(scene.shapes.at(0).world_from_object[3], glm::dvec4(1, 5, 0, 1));
    EXPECT_EQ(scene.shapes.at(1).world_from_object[3], glm::dvec4(0, 5, 0, 1));
    EXPECT_EQ(scene.warnings.size(), 1u);
    folder.write("a.pbrt", "AttributeBegin");
    EXPECT_EQ(folder.errors("WorldBegin Import \"a.pbrt\""),
              Lines{"a.pbrt:1:1: error: AttributeBegin without AttributeEnd"});
    folder.write("a.pbrt", "AttributeEnd");
    EXPECT_EQ(folder.errors("WorldBegin AttributeBegin Import \"a.pbrt\" AttributeEnd"),
              Lines{"a.pbrt:1:1: error: AttributeEnd without AttributeBegin"});
    EXPECT_EQ(folder.errors("Import \"b.pbrt\" WorldBegin"),
              (Lines{"scene.pbrt:1:1: error: Import is not allowed before WorldBegin",
                     "scene.pbrt:1:1: error: cannot read \"b.pbrt\": no such file"}));
}

TEST(Options, ColorSpaceIsSrgb) {
    EXPECT_TRUE(option_errors("ColorSpace \"srgb\"").empty());
    EXPECT_EQ(option_errors("ColorSpace \"rec2020\""),
              Lines{"scene.pbrt:1:1: error: color space \"rec2020\" is not supported yet"});
    EXPECT_EQ(option_errors("ColorSpace \"cmyk\""),
              Lines{"scene.pbrt:1:1: error: unknown color space \"cmyk\" (expected srgb)"});
}

TEST(Options, OptionKnowsPbrtsNames) {
    EXPECT_EQ(read_options("Option \"seed\" 7").seed, 7u);
    EXPECT_EQ(read_options("Option \"seed\" 7 Sampler \"halton\" \"integer seed\" 8").seed, 8u);
    EXPECT_EQ(SceneFolder().warnings("Option \"pixel-Stats\" true Option \"wavefront\" false\n"
                                     "Option \"msereferenceimage\" \"a.exr\" WorldBegin"),
              (Lines{"scene.pbrt:1:1: warning: option \"pixel-Stats\" has no effect",
                     "scene.pbrt:2:1: warning: option \"msereferenceimage\" has no effect"}));
    EXPECT_EQ(option_errors("Option \"forcediffuse\" true"),
              Lines{"scene.pbrt:1:1: error: option \"forcediffuse\" is not supported yet"});
    EXPECT_TRUE(option_errors("Option \"forcediffuse\" false").empty());
    EXPECT_EQ(option_errors("Option \"colour\" 1"),
              Lines{"scene.pbrt:1:1: error: unknown option \"colour\""});
    EXPECT_EQ(
        option_errors("Option \"seed\" \"a\""),
        Lines{"scene.pbrt:1:15: error: the string \"a\" is no value for option \"seed\" (expected "
              "an integer)"});
    EXPECT_EQ(option_errors("Option \"seed\" Identity"),
              Lines{"scene.pbrt:1:1: error: Option \"seed\" has no value"});
}

TEST(Textures, AreNotSupported) {
    EXPECT_EQ(
        world_errors("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\"\n"
                     "Material \"diffuse\" \"texture reflectance\" \"t\"\n"
                     "Texture \"t\" \"spectrum\" \"bogus\"\n"
                     "Texture \"t\" \"colour\" \"imagemap\"\n"),
        (Lines{"scene.pbrt:2:1: error: texture \"imagemap\" is not supported yet",
               "scene.pbrt:3:20: error: parameter \"texture reflectance\": textures are not "
               "supported yet",
               "scene.pbrt:4:1: error: unknown texture \"bogus\"",
               "scene.pbrt:5:1: error: unknown texture type \"colour\" (expected one of float, "
               "spectrum)"}));
}

} // namespace
} // namespace tyndall
