// Garbage: whatever the bytes, reading returns or throws SceneError, in bounded time and memory.
#include "scene/ply.h"
#include "unit/scene_files.h"

#include <chrono>
#include <gtest/gtest.h>
#include <random>
#include <sys/resource.h>

namespace tyndall {
namespace {

constexpr std::size_t garbage_size = 10'000'000;

const std::vector<std::string> seeds = {
    "LookAt 0 0 -6  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" [ 38 ]\n"
    "Film \"rgb\" \"integer xresolution\" [ 128 ] \"string filename\" [ \"a.exr\" ]\n"
    "PixelFilter \"box\" \"float xradius\" [ 0.5 ]\nSampler \"independent\" \"integer "
    "pixelsamples\" 64\n"
    "Integrator \"volpath\" \"integer maxdepth\" [ 1000 ] Option \"seed\" 3\n"
    "WorldBegin\nLightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n"
    "MakeNamedMedium \"m\" \"string type\" [ \"homogeneous\" ] \"rgb sigma_a\" [ 0.5 0.5 0.5 ]\n"
    "AttributeBegin MediumInterface \"m\" \"\" Material \"interface\"\n"
    "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\" [ 0 1 2 ]\n"
    "AttributeEnd\n",
    "WorldBegin\nObjectBegin \"o\" Shape \"sphere\" \"float radius\" 2 ObjectEnd ObjectInstance "
    "\"o\"\n"
    "Import \"part.pbrt\" Include \"part.pbrt\"\nAttribute \"shape\" \"float radius\" 3\n"
    "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" NamedMaterial \"a\"\n"
    "AreaLightSource \"diffuse\" \"blackbody L\" 5000 \"float power\" 5\n"
    "Shape \"plymesh\" \"string filename\" \"mesh.ply\" Shape \"disk\" Shape \"bilinearmesh\"\n"
    "\"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ] LightSource \"spot\" \"spectrum I\" [ 400 1 700 2 ]\n"
    "ActiveTransform All Rotate 30 1 0 0 ConcatTransform [ 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 ]\n"
    "CoordinateSystem \"c\" CoordSysTransform \"c\" ReverseOrientation ColorSpace \"srgb\"\n"};

const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
    "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n";

const std::string part = "Shape \"disk\"";

/// Changes a text in a few places: bytes, pieces cut out, doubled or moved, words from a list.
class Mutator {
  public:
    explicit Mutator(unsigned seed) : random_(seed) {}

    std::string mutate(std::string text) {
        const std::size_t edits = 1 + pick(3);
        for (std::size_t i = 0; i < edits; ++i)
            edit(text);
        return text;
    }
    std::size_t pick(std::size_t count) { return random_() % count; }

  private:
    void edit(std::string& text) {
        static const std::vector<std::string> words = {"[",
                                                       "]",
                                                       "\"",
                                                       "#",
                                                       "\n",
                                                       " ",
                                                       "\\",
                                                       "-1",
                                                       "0",
                                                       "1e30",
                                                       "1e-30",
                                                       "4294967296",
                                                       "nan",
                                                       "true",
                                                       "\"float x\"",
                                                       "\"\"",
                                                       "WorldBegin",
                                                       "AttributeBegin",
                                                       "AttributeEnd",
                                                       "ObjectBegin",
                                                       "ObjectEnd",
                                                       "Shape",
                                                       "Include",
                                                       "\"scene.pbrt\"",
                                                       "\"mesh.ply\"",
                                                       "Scale 0 0 0",
                                                       std::string(1, '\0'),
                                                       "\xff",
                                                       "element vertex 999999999",
                                                       "property list uint int a",
                                                       "format binary_big_endian 1.0",
                                                       "end_header\n"};
        const std::size_t at = pick(text.size() + 1);
        const std::size_t length = std::min(pick(40), text.size() - at);
        switch (pick(12)) {
        case 0:
            if (at < text.size()) text[at] = static_cast<char>(random_());
            break;
        case 1:
            text.erase(at, length);
            break;
        case 2:
            text.insert(pick(text.size() + 1), text.substr(at, length));
            break;
        case 3:
            text.resize(at);
            break;
        default:
            text.insert(at, words[pick(words.size())]);
        }
    }

    std::mt19937 random_;
};

/// What came of reading: whether there was a scene. Anything else than SceneError fails the test.
bool reads(const SceneFolder& folder, std::string_view text) {
    try {
        folder.read(text);
        return true;
    } catch (const SceneError& error) {
        EXPECT_FALSE(error.messages().empty());
        EXPECT_LE(error.messages().size(), 21u);
        return false;
    }
}

/// The most memory that the process had; 0 where a sanitizer's own memory would drown it.
long peak_kilobytes() {
#ifdef __SANITIZE_ADDRESS__
    return 0;
#else
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
#endif
}

TEST(Fuzz, MutatedScenesAreReadOrRefused) {
    SceneFolder folder;
    Mutator mutator(1);
    int scenes = 0;
    constexpr int rounds = 2500;
    for (int i = 0; i < rounds; ++i) {
        if (i % 3 < 2) folder.write("mesh.ply", i % 3 == 0 ? mutator.mutate(ply) : ply);
        if (i % 5 < 2) folder.write("part.pbrt", i % 5 == 0 ? mutator.mutate(part) : part);
        scenes += reads(folder, mutator.mutate(seeds[mutator.pick(seeds.size())]));
    }
    // Both ends happen, else the mutations test nothing.
    EXPECT_GT(scenes, rounds / 100);
    EXPECT_LT(scenes, rounds / 2);
    for (const std::string& seed : seeds) {
        folder.write("mesh.ply", ply);
        folder.write("part.pbrt", part);
        EXPECT_TRUE(reads(folder, seed));
    }
}

TEST(Fuzz, MutatedPolygonFilesAreReadOrRefused) {
    std::string binary = ply.substr(0, ply.find("0 0 0\n"));
    binary.replace(binary.find("ascii"), 5, "binary_little_endian");
    binary += std::string(48, '\1') + std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13) +
              std::string("\4\0\0\0\0\1\0\0\0\2\0\0\0\3\0\0\0", 17);
    Mutator mutator(2);
    int meshes = 0;
    constexpr int rounds = 20000;
    for (int i = 0; i < rounds; ++i) {
        try {
            read_ply(mutator.mutate(i % 2 ? ply : binary), "m.ply");
            ++meshes;
        } catch (const Error&) {
        }
    }
    EXPECT_GT(meshes, rounds / 100);
    EXPECT_LT(meshes, rounds / 2);
}

TEST(Garbage, EndsSoonAndSmall) {
    std::string random(garbage_size, '\0');
    std::mt19937 generator(3);
    for (char& c : random)
        c = static_cast<char>(generator());
    const std::string world = "WorldBegin\n";
    std::string long_name = "WorldBegin MediumInterface \"";
    long_name.append(garbage_size / 2, 'm').append("\" ");
    const std::vector<std::string> texts = {
        random,
        filled(world, "["),
        filled(world, "]"),
        filled(world, "\""),
        filled(world, "\"\n"),
        filled(world, "\\"),
        filled(world, "x "),
        filled(world, "AttributeBegin "),
        filled(world, "AttributeEnd "),
        filled(world, "Shape \"sphere\" \"float x\" ["),
        filled(world, "Attribute \"shape\" \"float radius\" 2 "),
        filled(world, "MediumInterface \"a rather long name of a medium that nobody has\" "),
        filled("WorldBegin Shape \"trianglemesh\" \"point3 P\" [ ", "1 "),
        filled("WorldBegin Shape \"sphere\" ", "\"float x\" 1 "),
        filled(long_name, "Shape \"disk\" ")};
    SceneFolder folder;
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < texts.size(); ++i) {
        EXPECT_EQ(reads(folder, texts[i]), i == 11) << i;
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_LT(seconds.count(), 120);
    EXPECT_LT(peak_kilobytes(), 1'000'000);
}

} // namespace
} // namespace tyndall
