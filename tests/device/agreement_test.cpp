// Every file in scenes/, small: device against reference.
#include "device/device_test.h"
#include "scene/reader.h"

#include <algorithm>
#include <filesystem>

namespace tyndall::device_test {
namespace {

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(source_folder() + "/scenes"))
        if (entry.path().extension() == ".pbrt") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

class AgreementTest : public DeviceTest, public testing::WithParamInterface<std::string> {};

TEST_P(AgreementTest, DeviceEqualsReference) {
    Scene scene = read_scene(source_folder() + "/scenes/" + GetParam() + ".pbrt");
    const int width = 16;
    set_size(scene, width, width * scene.film.height / scene.film.width);
    expect_agreement(scene, 16);
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Scenes, AgreementTest, testing::ValuesIn(scene_names()), name_of);

TEST(AgreementTestScenes, ThereAreSevenOrMore) {
    EXPECT_GE(scene_names().size(), 7u);
}

} // namespace
} // namespace tyndall::device_test
