// Media of scenes whose density is in a file.
#include "unit/scene_files.h"
#include "volume/volume_writer.h"

#include <gtest/gtest.h>

namespace tyndall {
namespace {

std::string volume(const std::string& text) {
    return "MakeNamedMedium \"m\" \"string type\" " + text;
}

WrittenGrid density_grid() {
    WrittenGrid grid;
    grid.voxels = {{{-4, 0, 2}, 0.5}, {{3, 1, 2}, 2}, {{5, 6, 9}, 0}};
    grid.world_from_index[0][0] = 0.25;
    grid.world_from_index[3] = {1, 2, 3, 1};
    return grid;
}

const GridDensity& density_of(const Scene& scene) {
    return std::get<GridDensity>(scene.media.at(0).density);
}

TEST(VolumeMedium, EitherTypeReadsEitherFile) {
    const SceneFolder folder;
    folder.write("a.vdb", write_vdb({density_grid()}));
    folder.write("a.nvdb", write_nanovdb({density_grid()}, NanoCodec::blosc));
    for (const char* type : {"vdb", "nanovdb"})
        for (const char* file : {"a.vdb", "a.nvdb"}) {
            const Scene scene =
                folder.read("WorldBegin Translate 10 0 0\n" +
                            volume('"' + std::string(type) + "\" \"string filename\" \"" + file +
                                   "\" \"float scale\" 3 \"rgb sigma_a\" [ 0 1 2 ]"));
            const GridDensity& density = density_of(scene);
            EXPECT_EQ(scene.media[0].sigma_a, Rgb(0, 3, 6));
            EXPECT_EQ(scene.media[0].emission, Rgb(0));
            // Index (4, 1, 1) is at (1 + 4 / 4, 2 + 1, 3 + 1) of the file's world.
            EXPECT_TRUE(is_near(density.index_from_medium * glm::dvec4(2, 3, 4, 1),
                                glm::dvec4(4, 1, 1, 1)));
            EXPECT_EQ(density.density->value({3, 1, 2}), 2);
            // From the first active voxel on, and to where the values end.
            EXPECT_EQ(density.lower, glm::dvec3(-4, 0, 2));
            EXPECT_EQ(density.upper, glm::dvec3(4, 2, 3));
            EXPECT_FALSE(density.temperature);
        }
}

TEST(VolumeMedium, EmitsByTemperature) {
    const SceneFolder folder;
    WrittenGrid heat = density_grid();
    heat.name = "temperature";
    heat.voxels = {{{3, 1, 2}, 1.5}, {{30, 1, 2}, 9}};
    WrittenGrid moved = heat; // the same, with voxels half as long
    moved.name = "moved";
    moved.voxels.clear();
    moved.boxes = {{{{-16, -8, -8}, {31, 23, 23}}, 3.0}};
    moved.world_from_index[0][0] /= 2;
    folder.write("a.vdb", write_vdb({density_grid(), heat, moved}));
    const std::string parameters =
        "\"vdb\" \"string filename\" \"a.vdb\" \"float Lescale\" 2 "
        "\"float temperaturescale\" 1000 \"float temperatureoffset\" 0.25 ";
    const Scene scene = folder.read("WorldBegin\n" + volume(parameters));
    EXPECT_EQ(scene.media[0].emission, Rgb(2));
    const GridDensity& density = density_of(scene);
    EXPECT_EQ(density.temperature->value({3, 1, 2}), 1250);
    EXPECT_EQ(density.temperature->value({-4, 0, 2}), -250);
    EXPECT_EQ(density.temperature->value({30, 1, 2}), 0); // no density there
    const Scene resampled =
        folder.read("WorldBegin\n" + volume(parameters + "\"string temperature\" \"moved\""));
    EXPECT_EQ(density_of(resampled).temperature->value({3, 1, 2}), 2750);
    EXPECT_EQ(
        folder.errors("WorldBegin\n" + volume(parameters + "\"string temperaturename\" \"heat\"")),
        std::vector<std::string>{
            "scene.pbrt:2:41: error: \"a.vdb\": no grid \"heat\" (the file has \"density\", "
            "\"temperature\", \"moved\")"});
}

TEST(VolumeMedium, ErrorsHaveThePlaceInTheScene) {
    const SceneFolder folder;
    folder.write("a.vdb", write_vdb({density_grid()}));
    folder.write("b.vdb", "VDB?");
    const auto error = [&](const std::string& text) {
        return folder.errors("WorldBegin\n" + volume(text));
    };
    using Lines = std::vector<std::string>;
    EXPECT_EQ(error("\"vdb\""),
              Lines{"scene.pbrt:2:1: error: medium \"m\" needs a parameter \"string filename\""});
    EXPECT_EQ(error("\"vdb\" \"string filename\" \"none.vdb\""),
              Lines{"scene.pbrt:2:41: error: cannot read \"none.vdb\": no such file"});
    EXPECT_EQ(error("\"vdb\" \"string filename\" \"b.vdb\" \"float temperaturescale\" 2"),
              Lines{"scene.pbrt:2:41: error: \"b.vdb\": neither an OpenVDB nor a NanoVDB file"});
    EXPECT_EQ(
        error("\"vdb\" \"string filename\" \"a.vdb\" \"string density\" \"smoke\""),
        Lines{"scene.pbrt:2:41: error: \"a.vdb\": no grid \"smoke\" (the file has \"density\")"});
    EXPECT_EQ(error("\"nanovdb\" \"string filename\" \"\""),
              Lines{"scene.pbrt:2:45: error: parameter \"string filename\" is \"\" (expected the "
                    "name of a file)"});
    EXPECT_EQ(error("\"nanovdb\" \"string filename\" \"a.vdb\" \"string density\" \"density\""),
              Lines{"scene.pbrt:2:71: error: unused parameter \"string density\" of medium \"m\""});
}

} // namespace
} // namespace tyndall
