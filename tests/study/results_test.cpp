// Files of a study: what is written is what is read.
#include "study/results.h"

#include "core/error.h"
#include "study/html.h"
#include "study/pictures.h"

#include <fstream>
#include <gtest/gtest.h>

namespace tyndall::study {
namespace {

class ResultsTest : public testing::Test {
  protected:
    void SetUp() override { std::filesystem::create_directories(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / "tyndall_results_test";
};

TEST_F(ResultsTest, AreReadAsTheyWereWritten) {
    EXPECT_FALSE(read_results(folder));
    Results results{.version = "1", .scene = "a \"scene\".pbrt", .seed = 1ull << 63};
    TechniqueResult t{.name = "a", .title = "A", .family = "orders"};
    t.levels = {{.samples = 4, .seconds = 0.1, .bias = {-1e-9, 1e-8}, .slice_samples = 2}};
    t.health["negative"] = 3;
    results.techniques.push_back(t);
    write_results(results, folder);
    const std::optional<Results> read = read_results(folder);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->scene, results.scene);
    EXPECT_EQ(read->seed, results.seed);
    ASSERT_TRUE(read->find("a"));
    EXPECT_EQ(read->find("a")->last().bias.value, -1e-9);
    EXPECT_EQ(read->find("a")->health.at("negative"), 3u);
    EXPECT_FALSE(read->find("b"));
}

TEST_F(ResultsTest, OfAnotherProgramAreRefused) {
    std::ofstream(folder / "results.json") << "{\"a\": 1}";
    EXPECT_THROW(read_results(folder), Error);
}

TEST_F(ResultsTest, PicturesAreEmbedded) {
    const Canvas canvas{Picture(12, glm::dvec3(0.5)), 4};
    const std::string uri = embed_png(tone_mapped(canvas, 1), folder / "a.png");
    EXPECT_EQ(uri.rfind("data:image/png;base64,iVBORw0KGgo", 0), 0u); // the signature of PNG
    EXPECT_EQ((uri.size() - uri.find(',') - 1) % 4, 0u);
}

TEST(Words, SayWhatCanBeTold) {
    EXPECT_EQ(percent(0.0412), "4.1\u00a0%");
    EXPECT_EQ(duration(0.0031), "3.1\u00a0ms");
    EXPECT_EQ(duration(3700), "62\u00a0min");
    EXPECT_EQ(told(Estimate{-1e-6, 1e-6}), "below 0.14\u00a0%");
    EXPECT_NE(told(Estimate{1e-4, 1e-6}).find("1.000"), std::string::npos);
    EXPECT_EQ(escaped("<a & \"b\">"), "&lt;a &amp; &quot;b&quot;&gt;");
    EXPECT_EQ(listed({"a", "b", "c"}), "a, b and c");
}

TEST(Pictures, FindTheDetail) {
    Canvas canvas{Picture(200 * 100, glm::dvec3(1)), 200};
    canvas.pixels[70 * 200 + 150] = glm::dvec3(9);
    const Crop crop = find_detail(canvas);
    EXPECT_LE(crop.x, 150);
    EXPECT_GT(crop.x + crop.width, 150);
    EXPECT_GT(crop.y + crop.height, 70);
    EXPECT_EQ(cut(canvas, crop).height(), crop.height);
}

} // namespace
} // namespace tyndall::study
