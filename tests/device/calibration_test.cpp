// Tunings that were found by trying: kept by device and kind of scene, and without effect on the
// image.
#include "render/calibration.h"

#include "device/device_test.h"
#include "device/test_scenes.h"

#include <fstream>
#include <unistd.h>

namespace tyndall::device_test {
namespace {

namespace fs = std::filesystem;

class TuningFileTest : public testing::Test {
  protected:
    void TearDown() override { fs::remove_all(folder_); }

    TuningFile file(const std::string& device = "a device") const {
        return {folder_, {.name = device, .driver = "its driver"}};
    }
    void write(const std::string& text) const { std::ofstream(folder_ / "tunings.json") << text; }

    fs::path folder_ = fs::temp_directory_path() / ("tyndall-tunings-" + std::to_string(getpid()));
    const Tuning tuning_{
        .slots = 1000, .run_length = 20, .workgroup_size = 32, .stages = STAGES_APART};
};

TEST_F(TuningFileTest, FindsWhatWasStoredForTheDeviceAndTheKindOfScene) {
    EXPECT_EQ(file().find("fog"), std::nullopt); // there is no file
    file().store("fog", tuning_);
    file().store("smoke",
                 {.slots = 2000, .run_length = 20, .workgroup_size = 32, .stages = STAGES_FUSED});
    EXPECT_EQ(file().find("fog"), tuning_);
    EXPECT_EQ(file().find("glass"), std::nullopt);
    EXPECT_EQ(file("another device").find("fog"), std::nullopt);
    EXPECT_EQ(TuningFile({}, {}).find("fog"), std::nullopt); // no home
}

TEST_F(TuningFileTest, DamageCountsAsNothing) {
    file().store("fog", tuning_);
    const std::string start = R"({"a device, its driver": {"fog": {"run_length": 20, "slots": )";
    for (const std::string& text :
         {std::string("{"), std::string("[1]"), std::string(R"({"a device, its driver": 7})"),
          start + "1}}}", start + R"("many", "stages": 2, "workgroup_size": 32}}})",
          start + R"(4000000000, "stages": 2, "workgroup_size": 32}}})",
          std::string(R"({"a device, its driver": {"fog": 7}})")}) {
        write(text);
        EXPECT_EQ(file().find("fog"), std::nullopt) << text;
        file().store("fog", tuning_);
        EXPECT_EQ(file().find("fog"), tuning_) << text;
    }
    write(start + R"(1000, "stages": 2, "workgroup_size": 32}}})"); // the control
    EXPECT_EQ(file().find("fog"), tuning_);
}

TEST_F(TuningFileTest, KindsOfScenesAreTheirEffects) {
    shared::Features features;
    const std::string key = tuning_key(features);
    EXPECT_EQ(tuning_key(features), key);
    features.has_emission = !features.has_emission;
    EXPECT_NE(tuning_key(features), key);
}

class CalibrationTest : public DeviceTest {};

TEST_F(CalibrationTest, ChangesNoImageAndNothingThatIsFixed) {
    int questions = 100;
    const Tuning found =
        calibrate(context(), plain_scene(), {.run_length = 16}, [&] { return --questions > 0; });
    EXPECT_LE(questions, 0); // the trials took place
    EXPECT_EQ(found.run_length, 16);
    for (const Scene& scene : {plain_scene(), busy_scene()}) {
        Renderer renderer(context(), scene, {.slots = 512, .run_length = 16});
        renderer.render(0, 8);
        const auto before = renderer.read_sums();
        for (const std::uint32_t stages : {STAGES_FUSED, STAGES_APART}) {
            renderer.retune({.slots = 3 * found.slots,
                             .run_length = 8,
                             .workgroup_size = 16,
                             .stages = stages});
            EXPECT_EQ(renderer.wavefront().tuning().run_length, 8);
            renderer.render(0, 8);
            EXPECT_EQ(renderer.read_sums(), before);
        }
        renderer.set_seed(77); // the control
        renderer.render(0, 8);
        EXPECT_NE(renderer.read_sums(), before);
    }
}

TEST_F(CalibrationTest, EndsWhenToldWithWhatIsSetAndChosen) {
    const Tuning fixed{.slots = 300, .stages = STAGES_FUSED};
    const Renderer renderer(context(), busy_scene(), fixed);
    EXPECT_EQ(renderer.wavefront().tuning().slots, 300);
    for (const int answers : {0, 3})
        EXPECT_EQ(calibrate(context(), busy_scene(), fixed,
                            [left = answers]() mutable { return left-- > 0; }),
                  renderer.wavefront().tuning())
            << answers;
}

} // namespace
} // namespace tyndall::device_test
