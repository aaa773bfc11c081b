// The volumes of scenes/volumes make the same picture, to the last bit, whether they come from
// OpenVDB's file through "vdb" or from a NanoVDB file that nanovdb_convert made of it.
#include "device/device_test.h"
#include "scene/reader.h"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>

namespace tyndall::device_test {
namespace {

namespace fs = std::filesystem;

class ConvertedVolumeTest : public DeviceTest {
  protected:
    void SetUp() override {
        DeviceTest::SetUp();
        fs::create_directories(folder_);
    }
    void TearDown() override {
        fs::remove_all(folder_);
        DeviceTest::TearDown();
    }

    /// A NanoVDB file with all grids of the volume; `codec` is an option of nanovdb_convert.
    std::string convert(const fs::path& vdb, const std::string& codec) const {
        const std::string file = (folder_ / vdb.stem()).string() + ".nvdb";
        const std::string command =
            fmt::format("'{}' -f {} '{}' '{}'", TYNDALL_NANOVDB_CONVERT, codec, vdb.string(), file);
        EXPECT_EQ(std::system(command.c_str()), 0)
            << command << ": is nanovdb_convert (package libnanovdb-tools) installed?";
        return file;
    }

    /// The volume in the sun.
    Scene scene_of(const std::string& type, const std::string& file,
                   const std::string& parameters) const {
        const fs::path scene = folder_ / "scene.pbrt";
        std::ofstream(scene) << fmt::format(R"(
LookAt 7 -3.5 2.6  2 2 1.6  0 0 1
Camera "perspective" "float fov" 38
Film "rgb" "integer xresolution" 24 "integer yresolution" 24 "string filename" "scene.exr"
Integrator "volpath" "integer maxdepth" 20
WorldBegin
LightSource "infinite" "rgb L" [ 0.25 0.3 0.4 ]
LightSource "distant" "point3 from" [ 3 -2 5 ] "rgb L" [ 3 2.8 2.5 ]
MakeNamedMedium "volume" "string type" "{}" "string filename" "{}" "rgb sigma_a" [ 1 1.1 1.2 ] {}
MediumInterface "volume" ""
Material "interface"
Translate 2 2 2
Shape "sphere" "float radius" 5
)",
                                            type, file, parameters);
        return read_scene(scene);
    }

    void expect_same_picture(const std::string& name, const std::string& codec,
                             const std::string& more = "") const {
        const std::string vdb = source_folder() + "/scenes/volumes/" + name;
        const std::string nanovdb = convert(vdb, codec);
        const std::string smoke = "\"rgb sigma_s\" [ 8 7 6 ] " + more;
        const auto picture = render_sums(scene_of("vdb", vdb, smoke), 0, 8);
        EXPECT_EQ(render_sums(scene_of("nanovdb", nanovdb, smoke), 0, 8), picture);
        // The control: the density times 1.001.
        const std::string denser = "\"float scale\" 1.001 " + smoke;
        EXPECT_NE(render_sums(scene_of("nanovdb", nanovdb, denser), 0, 8), picture);
    }

  private:
    fs::path folder_ = fs::temp_directory_path() / fmt::format("tyndall-test-{}", getpid());
};

TEST_F(ConvertedVolumeTest, SmokeIsTheSame) {
    expect_same_picture("smoke.vdb", "");
}
TEST_F(ConvertedVolumeTest, PlumePackedByZipIsTheSame) {
    expect_same_picture("plume.vdb", "-z");
}
TEST_F(ConvertedVolumeTest, ExplosionPackedByBloscIsTheSame) {
    expect_same_picture("explosion.vdb", "-b",
                        "\"float temperaturescale\" 1000 \"float Lescale\" 0.2");
}

} // namespace
} // namespace tyndall::device_test
