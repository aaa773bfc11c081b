// Files of OpenVDB and NanoVDB, as the libraries write them and damaged.
#include "core/error.h"
#include "volume/fields.h"
#include "volume/volume_file.h"
#include "volume/volume_writer.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

#ifdef __SANITIZE_ADDRESS__
/// OpenVDB 10 loses a node whose reading throws (RootNode::readTopology).
extern "C" const char* __lsan_default_suppressions() {
    return "leak:readTopology\n";
}
#endif

namespace tyndall {
namespace {

using Type = WrittenGrid::Type;
using Class = WrittenGrid::Class;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Field read(const std::string& bytes, FieldRequest request = {.name = "density"}) {
    return read_field(bytes, request).value();
}

/// The message of the error that reading gives; "" if there is none.
std::string error_of(const std::string& bytes, const FieldRequest& request = {.name = "density"}) {
    try {
        read_field(bytes, request);
        return "";
    } catch (const Error& error) {
        return error.what();
    }
}

/// A cloud of voxels around the origin, with tiles of two sizes.
WrittenGrid sample_grid() {
    Random random(11);
    WrittenGrid grid;
    for (int i = 0; i < 500; ++i) {
        const glm::ivec3 voxel(
            glm::floor(random_point(random, glm::dvec3(-30, -200, 5), glm::dvec3(40, 10, 25), 0)));
        grid.voxels.emplace_back(voxel, double(1 + random() % 64) / 8); // a half
    }
    grid.boxes.push_back({{{128, 0, 0}, {255, 127, 127}}, 0.25}); // one tile of 128^3
    grid.boxes.push_back({{{-64, 0, 0}, {-57, 15, 7}}, 3});       // two tiles of 8^3
    return grid;
}

float written_value(const WrittenGrid& grid, const glm::ivec3& voxel) {
    float value = 0;
    for (const auto& [box, v] : grid.boxes)
        if (box.contains(voxel)) value = static_cast<float>(v);
    for (const auto& [at, v] : grid.voxels)
        if (at == voxel) value = static_cast<float>(v);
    return value;
}

/// Voxels of the written grid and around them that read otherwise.
int differences(const WrittenGrid& written, const Grid& grid) {
    int count = 0;
    const auto check = [&](const glm::ivec3& voxel) {
        count += grid.value(voxel) != written_value(written, voxel);
    };
    for (const auto& [voxel, value] : written.voxels)
        for (int i = -1; i <= 1; ++i)
            check(voxel + glm::ivec3(i, -i, 2 * i));
    for (const auto& [box, value] : written.boxes)
        for (int i = -1; i <= 1; ++i) {
            check(box.lower + i);
            check(box.upper + i);
        }
    return count;
}

TEST(VdbFile, ReadsVoxelsAndTiles) {
    WrittenGrid written = sample_grid();
    const Field field = read(write_vdb({written}));
    EXPECT_EQ(differences(written, field.grid), 0);
    EXPECT_EQ(field.active.lower.x, -64);
    EXPECT_EQ(field.active.upper, glm::ivec3(255, 127, 127));
    EXPECT_TRUE(field.grid.is_half);
    EXPECT_LT(field.grid.bytes(), 8u << 20); // the tile of 2^21 voxels costs its index only
    // Control: one voxel that is 1 % off.
    written.voxels[7].second *= 1.01;
    EXPECT_GT(differences(written, field.grid), 0);
}

TEST(VdbFile, ReadsHalvesAndDoubles) {
    for (const Type type : {Type::float16, Type::float64}) {
        WrittenGrid written = sample_grid();
        written.type = type;
        EXPECT_EQ(differences(written, read(write_vdb({written})).grid), 0);
    }
}

TEST(VdbFile, ReadsTransforms) {
    WrittenGrid written = sample_grid();
    written.world_from_index = {{0.5, 0.1, 0, 0}, {0, 2, 0.25, 0}, {-1, 0, 1, 0}, {10, -20, 30, 1}};
    const std::array files{write_vdb({written}), write_nanovdb({written}, NanoCodec::none)};
    for (const std::string& file : files)
        EXPECT_EQ(read(file).world_from_index, written.world_from_index);
}

TEST(VdbFile, ChoosesByName) {
    WrittenGrid a = sample_grid(), b = a, c = a;
    b.name = "temperature";
    b.voxels = {{{1, 2, 3}, -5}};
    c.name = "v";
    c.type = Type::vec3;
    const std::string file = write_vdb({c, a, b});
    EXPECT_EQ(differences(b, read(file, {.name = "temperature", .may_be_negative = true}).grid), 0);
    EXPECT_EQ(error_of(file, {.name = "heat"}),
              "no grid \"heat\" (the file has \"v\", \"density\", \"temperature\")");
    EXPECT_FALSE(read_field(file, {.name = "heat", .may_be_missing = true}));
    EXPECT_EQ(error_of(write_vdb({})), "no grid \"density\" (the file has no grids)");
    a.name = "smoke";
    EXPECT_EQ(error_of(write_nanovdb({a, b}, NanoCodec::zip)),
              "no grid \"density\" (the file has \"smoke\", \"temperature\")");
}

TEST(VdbFile, RefusesWhatIsNoFog) {
    const auto error_with = [](auto change) {
        WrittenGrid grid = sample_grid();
        change(grid);
        return error_of(write_vdb({grid}));
    };
    EXPECT_EQ(error_with([](WrittenGrid&) {}), ""); // control
    EXPECT_EQ(error_with([](WrittenGrid& g) { g.grid_class = Class::unknown; }), "");
    EXPECT_EQ(error_with([](WrittenGrid& g) { g.grid_class = Class::level_set; }),
              "grid \"density\": a level set (expected a fog volume)");
    EXPECT_EQ(error_with([](WrittenGrid& g) { g.type = Type::int32; }),
              "grid \"density\": values of type int32 (expected float, half or double)");
    EXPECT_EQ(error_with([](WrittenGrid& g) { g.type = Type::vec3; }),
              "grid \"density\": values of type vec3s (expected float, half or double)");
    EXPECT_EQ(error_with([](WrittenGrid& g) { g.background = 0.5; }),
              "grid \"density\": the background is 0.5 (expected 0)");
    EXPECT_EQ(error_with([](WrittenGrid& g) { g.is_frustum = true; }),
              "grid \"density\": a frustum for its transform (expected an affine one)");
    EXPECT_EQ(error_of(write_vdb({sample_grid()}, false)),
              "the file was written as a stream, without a table of grids (expected one written as "
              "a file)");
    EXPECT_EQ(error_of("P6 640 480 255 "), "neither an OpenVDB nor a NanoVDB file");
    EXPECT_EQ(error_of(""), "neither an OpenVDB nor a NanoVDB file");
}

TEST(VdbFile, NamesTheVoxelOfABadValue) {
    const auto both = [](double value, Type type = Type::float32) {
        WrittenGrid grid = sample_grid();
        grid.type = type;
        grid.voxels.emplace_back(glm::ivec3(-3, 12, -200), value);
        const std::string error = error_of(write_vdb({grid}));
        if (type == Type::float32) {
            EXPECT_EQ(error, error_of(write_nanovdb({grid}, NanoCodec::none)));
        }
        return error;
    };
    EXPECT_EQ(both(nan), "grid \"density\": voxel (-3, 12, -200) is nan (expected a finite value "
                         "that fits a float)");
    EXPECT_EQ(both(INFINITY), "grid \"density\": voxel (-3, 12, -200) is inf (expected a finite "
                              "value that fits a float)");
    EXPECT_EQ(both(1e60, Type::float64), "grid \"density\": voxel (-3, 12, -200) is 1e+60 "
                                         "(expected a finite value that fits a float)");
    EXPECT_EQ(both(-0.5), "grid \"density\": voxel (-3, 12, -200) is -0.5 (expected a value >= 0)");
}

TEST(VdbFile, EmptyGridsAreEmpty) {
    const WrittenGrid empty;
    for (const std::string& file : {write_vdb({empty}), write_nanovdb({empty}, NanoCodec::none)}) {
        const Field field = read(file);
        EXPECT_TRUE(field.grid.is_empty());
        EXPECT_TRUE(field.active.is_empty());
    }
}

TEST(VdbFile, MemoryIsBounded) {
    const WrittenGrid grid = sample_grid();
    for (const std::string& file : {write_vdb({grid}), write_nanovdb({grid}, NanoCodec::blosc)})
        EXPECT_NE(error_of(file, {.name = "density", .max_voxels = 2048})
                      .find("too many (expected at most"),
                  std::string::npos);
    WrittenGrid wide;
    wide.voxels = {{glm::ivec3(-1'000'000), 1}, {glm::ivec3(1'000'000), 1}};
    EXPECT_EQ(error_of(write_vdb({wide})), "a grid over 2000008 x 2000008 x 2000008 voxels is too "
                                           "large (expected at most 2^26 bricks of 8^3 voxels, "
                                           "stored or not)");
}

TEST(NanoVdbFile, EveryCodecEqualsOpenVdb) {
    const WrittenGrid written = sample_grid();
    const Field vdb = read(write_vdb({written}));
    for (const NanoCodec codec : {NanoCodec::none, NanoCodec::zip, NanoCodec::blosc}) {
        const Field nano = read(write_nanovdb({written}, codec));
        EXPECT_EQ(differences(written, nano.grid), 0);
        EXPECT_EQ(nano.active.lower, vdb.active.lower);
        EXPECT_EQ(nano.active.upper, vdb.active.upper);
        EXPECT_EQ(nano.grid.first_brick, vdb.grid.first_brick);
        EXPECT_EQ(nano.grid.brick_index.size(), vdb.grid.brick_index.size());
    }
}

TEST(NanoVdbFile, QuantisedValuesAreWithinTheirSteps) {
    const WrittenGrid written = sample_grid();
    const std::array types{std::pair{NanoType::fp4, 15}, std::pair{NanoType::fp8, 255},
                           std::pair{NanoType::fp16, 65535}};
    for (const auto& [type, steps] : types) {
        const Field field = read(write_nanovdb({written}, NanoCodec::none, type));
        double worst = 0;
        for (const auto& [voxel, value] : written.voxels)
            worst = std::max(
                worst, std::abs(double(field.grid.value(voxel)) - written_value(written, voxel)));
        // Values reach from 0 to 8; dithering chooses between two neighbours.
        EXPECT_LE(worst, 8.0 / steps * (1 + 1e-3));
        EXPECT_GT(worst, 0);
    }
    EXPECT_FALSE(read(write_nanovdb({written}, NanoCodec::none, NanoType::fp_n)).grid.is_empty());
}

/// Reading either succeeds or gives an Error.
void expect_no_crash(const std::string& bytes) {
    const std::string error = error_of(bytes, {.name = "density", .max_voxels = 1 << 20});
    static_cast<void>(error);
}

std::vector<std::string> small_files() {
    WrittenGrid grid;
    Random random(12);
    for (int i = 0; i < 40; ++i)
        grid.voxels.emplace_back(glm::ivec3(random() % 20, random() % 9, random() % 9),
                                 1 + random() % 8);
    grid.boxes.push_back({{{-8, 0, 0}, {-1, 7, 7}}, 2});
    return {write_nanovdb({grid}, NanoCodec::none), write_nanovdb({grid}, NanoCodec::zip),
            write_nanovdb({grid}, NanoCodec::blosc),
            write_nanovdb({grid}, NanoCodec::none, NanoType::fp_n), write_vdb({grid})};
}

TEST(VolumeFileFuzz, TruncatedFilesAreRefused) {
    Random random(13);
    for (const std::string& file : small_files()) {
        ASSERT_EQ(error_of(file), "");
        for (std::size_t size = 0; size < file.size();
             size += 1 + (size > 800 ? random() % (file.size() / 100) : 0))
            EXPECT_NE(error_of(file.substr(0, size)), "") << size << " of " << file.size();
    }
}

/// Each text of an OpenVDB file stands behind its length, which the library would believe.
TEST(VolumeFileFuzz, LengthsBeyondTheFileTakeNoMemory) {
    const std::string file = write_vdb({sample_grid()});
    const auto peak = [] {
        rusage usage;
        getrusage(RUSAGE_SELF, &usage);
        return usage.ru_maxrss; // KiB
    };
    const long before = peak();
    int lengths = 0;
    for (std::size_t at = 8; at + 4 < std::min<std::size_t>(file.size(), 2000); ++at) {
        std::uint32_t length = 0;
        std::memcpy(&length, &file[at], sizeof(length));
        const bool is_text = length > 3 && length < 40 && at + 4 + length < file.size() &&
                             std::all_of(&file[at + 4], &file[at + 4 + length],
                                         [](unsigned char c) { return std::isprint(c) != 0; });
        if (!is_text) continue;
        ++lengths;
        for (const std::uint32_t wrong : {0xFFFFFFF0u, 0x60000000u}) {
            std::string damaged = file;
            std::memcpy(&damaged[at], &wrong, sizeof(wrong));
            EXPECT_EQ(error_of(damaged), "the OpenVDB file is cut off or damaged") << at;
        }
    }
    EXPECT_GT(lengths, 8) << "no teeth";
    EXPECT_LT(peak() - before, 64 << 10);
}

/// Keeps the process from more than 1 GiB of address space beyond what it has.
class MemoryLimit {
  public:
    MemoryLimit() {
#ifndef __SANITIZE_ADDRESS__ // which takes terabytes of addresses
        getrlimit(RLIMIT_AS, &before_);
        long pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        rlimit limit = before_;
        limit.rlim_cur = static_cast<rlim_t>(pages * sysconf(_SC_PAGESIZE)) + (1u << 30);
        setrlimit(RLIMIT_AS, &limit);
#endif
    }
    ~MemoryLimit() {
#ifndef __SANITIZE_ADDRESS__
        setrlimit(RLIMIT_AS, &before_);
#endif
    }
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

  private:
    rlimit before_{};
};

TEST(VolumeFileFuzz, DamagedFilesDoNotCrash) {
    Random random(14);
    const MemoryLimit limit;
    for (const std::string& file : small_files()) {
        for (int i = 0; i < 150; ++i) {
            std::string bytes = file;
            const int edits = 1 + static_cast<int>(random() % 4);
            // The first kilobytes hold headers, sizes and offsets.
            for (int k = 0; k < edits; ++k)
                bytes[random() %
                      (random() % 2 ? std::min<std::size_t>(bytes.size(), 2000) : bytes.size())] =
                    static_cast<char>(random() % 2 ? random() : 0xFF * (random() % 2));
            expect_no_crash(bytes);
        }
    }
}

} // namespace
} // namespace tyndall
