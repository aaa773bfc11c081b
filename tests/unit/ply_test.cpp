// PLY files: all formats, odd headers, and files that lie.
#include "scene/ply.h"
#include "unit/scene_files.h"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

namespace tyndall {
namespace {

/// A binary body, value after value.
class Body {
  public:
    explicit Body(bool big_endian) : big_endian_(big_endian) {}

    template<typename T>
    Body& add(T value) {
        char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        if (big_endian_) std::reverse(bytes, bytes + sizeof(T));
        bytes_.append(bytes, sizeof(T));
        return *this;
    }
    const std::string& bytes() const { return bytes_; }

  private:
    bool big_endian_;
    std::string bytes_;
};

const std::string square_header = "element vertex 4\n"
                                  "property float x\nproperty float y\nproperty float z\n"
                                  "element face 2\n"
                                  "property list uchar int vertex_indices\n"
                                  "end_header\n";
const std::string square_ascii =
    "ply\nformat ascii 1.0\n" + square_header + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n";

std::string square_binary(bool big_endian) {
    Body body(big_endian);
    for (const float v : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f})
        body.add(v);
    body.add(std::uint8_t{3}).add(0).add(1).add(2);
    body.add(std::uint8_t{4}).add(0).add(1).add(2).add(3);
    return std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n" +
           square_header + body.bytes();
}

std::string error_of(const std::string& bytes) {
    try {
        read_ply(bytes, "m.ply");
        return "no error";
    } catch (const Error& error) {
        return error.what();
    }
}

void expect_square(const Mesh& mesh) {
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 0));
    EXPECT_NE(mesh.positions[1], mesh.positions[3]);
    ASSERT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
    ASSERT_EQ(mesh.patches.size(), 1u);
    // Around the edge becomes row after row: p00 p10 p01 p11.
    EXPECT_EQ(mesh.patches[0], (std::array<std::uint32_t, 4>{0, 1, 3, 2}));
}

TEST(Ply, AllFormatsGiveTheSameMesh) {
    expect_square(read_ply(square_ascii, "m.ply").mesh);
    expect_square(read_ply(square_binary(false), "m.ply").mesh);
    expect_square(read_ply(square_binary(true), "m.ply").mesh);
}

TEST(Ply, LinesMayEndWithCarriageReturns) {
    std::string text;
    for (const char c : square_ascii)
        text += c == '\n' ? std::string("\r\n") : std::string(1, c);
    expect_square(read_ply(text, "m.ply").mesh);
}

TEST(Ply, OrderAndExtrasDoNotMatter) {
    const std::string text =
        "ply\nformat ascii 1.0\ncomment by hand\nobj_info none\n"
        "element material 1\nproperty list uchar float colours\n"
        "element face 1\n"
        "property uchar flags\nproperty list uint8 uint32 vertex_index\n"
        "property list ushort double weights\n"
        "element vertex 3\n"
        "property float v\nproperty double z\nproperty list uchar int links\n"
        "property short x\nproperty float ny\nproperty float y\nproperty float nx\n"
        "property float u\nproperty float nz\n"
        "element edge 0\nproperty int a\n"
        "end_header\n"
        "2 0.5 0.5\n"
        "1 3 2 1 0 2 0.1 0.2\n"
        "0.1 3 0 1 20 2 10 0.2 30\n"
        "0.3 4 2 7 8 2 21 3 11 0.4 31\n"
        "0.5 5 1 9 3 22 4 12 0.6 32\n";
    const Mesh mesh = read_ply(text, "m.ply").mesh;
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.positions[1], glm::vec3(2, 3, 4));
    EXPECT_EQ(mesh.normals[1], glm::vec3(11, 21, 31));
    EXPECT_EQ(mesh.uvs[2], glm::vec2(0.6f, 0.5f));
    EXPECT_EQ(mesh.triangles.at(0), (std::array<std::uint32_t, 3>{2, 1, 0}));
}

TEST(Ply, NamesOfTextureCoordinates) {
    for (const auto& [u, v] :
         {std::pair("u", "v"), std::pair("s", "t"), std::pair("texture_u", "texture_v"),
          std::pair("texture_s", "texture_t")}) {
        const std::string text =
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nproperty float " +
            std::string(u) + "\nproperty float " + v +
            "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0 0.25 0.5\n1 0 0 0 0\n0 1 0 0 0\n3 0 1 2\n";
        EXPECT_EQ(read_ply(text, "m.ply").mesh.uvs.at(0), glm::vec2(0.25f, 0.5f)) << u;
    }
}

TEST(Ply, LargerPolygonsAreLeftOutAsInPbrt) {
    const std::string text = "ply\nformat ascii 1.0\n" + square_header +
                             "0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 0 1 2 3 0\n3 0 1 2\n";
    const PlyMesh ply = read_ply(text, "m.ply");
    EXPECT_EQ(ply.ignored_faces, 1u);
    EXPECT_EQ(ply.mesh.triangles.size(), 1u);
}

TEST(Ply, BadHeadersAreErrors) {
    const std::string start = "ply\nformat ascii 1.0\n";
    EXPECT_EQ(error_of(""), "m.ply: line 1: not a PLY file (expected \"ply\")");
    EXPECT_EQ(error_of("solid\n"), "m.ply: line 1: not a PLY file (expected \"ply\")");
    EXPECT_EQ(error_of("ply\nformat ascii"),
              "m.ply: line 2: the file ends in the header (expected \"end_header\")");
    EXPECT_EQ(error_of("ply\nformat text 1.0\n"),
              "m.ply: line 2: unknown format \"text\" (expected ascii, "
              "binary_little_endian or binary_big_endian)");
    EXPECT_EQ(error_of("ply\nformat ascii 2.0\n"), "m.ply: line 2: version \"2.0\" (expected 1.0)");
    EXPECT_EQ(error_of("ply\nend_header\n"), "m.ply: line 2: the header names no format");
    EXPECT_EQ(error_of(start + "element vertex -1\n"),
              "m.ply: line 3: bad element (expected \"element NAME COUNT\")");
    EXPECT_EQ(error_of(start + "element vertex 99999999999999999999\n"),
              "m.ply: line 3: bad element (expected \"element NAME COUNT\")");
    EXPECT_EQ(error_of(start + "property float x\n"),
              "m.ply: line 3: a property before the first element");
    EXPECT_EQ(error_of(start + "element vertex 1\nproperty half x\n"),
              "m.ply: line 4: unknown type \"half\" of a property");
    EXPECT_EQ(error_of(start + "element vertex 1\nproperty float\n"),
              "m.ply: line 4: a property without a name");
    EXPECT_EQ(error_of(start + "element face 1\nproperty list float int vertex_indices\n"),
              "m.ply: line 4: a list with a length that is no integer (expected an integer type)");
    EXPECT_EQ(error_of(start + "element vertex 1\nelement vertex 1\n"),
              "m.ply: line 4: element \"vertex\" appears twice");
    EXPECT_EQ(error_of(start + "bogus\n"), "m.ply: line 3: unknown keyword \"bogus\"");
    EXPECT_EQ(error_of(start + "end_header\n"), "m.ply: no vertices");
    EXPECT_EQ(error_of(square_ascii), "no error");
}

TEST(Ply, CutOffFilesAreErrorsWhereverTheCutIs) {
    for (const std::string& whole : {square_ascii, square_binary(false), square_binary(true)}) {
        for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
            EXPECT_NE(error_of(whole.substr(0, size)), "no error") << size;
        }
    }
    EXPECT_EQ(error_of(square_binary(false).substr(0, square_binary(false).size() - 1)),
              "m.ply: face 1 of 2: the file is cut off");
    EXPECT_EQ(error_of(square_ascii.substr(0, square_ascii.size() - 5)),
              "m.ply: face 1 of 2, line 15: the file is cut off");
    EXPECT_EQ(error_of(square_ascii.substr(0, square_ascii.size() - 9)),
              "m.ply: face 1 of 2, line 15: a list of 4 values, with 0 bytes left in the file");
}

TEST(Ply, LyingCountsCostNoMemory) {
    const std::string header =
        "ply\nformat binary_little_endian 1.0\n"
        "element nothing 18446744073709551615\n"
        "element vertex 18446744073709551615\n"
        "property float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uint int vertex_indices\nend_header\n";
    EXPECT_EQ(error_of(header + std::string(12, '\0')),
              "m.ply: vertex 1 of 18446744073709551615: the file is cut off");
    std::string list = square_ascii;
    list.replace(list.find("3 0 1 2"), 1, "255");
    EXPECT_EQ(error_of(list),
              "m.ply: face 0 of 2, line 14: a list of 255 values, with 17 bytes left in "
              "the file");
    list = square_ascii;
    list.replace(list.find("3 0 1 2"), 1, "-3");
    EXPECT_EQ(error_of(list), "m.ply: face 0 of 2, line 14: a list with the length -3");
}

TEST(Ply, BadValuesAreErrors) {
    const auto with = [](const std::string& vertices, const std::string& faces) {
        return error_of("ply\nformat ascii 1.0\n" + square_header + vertices + faces);
    };
    const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const std::string faces = "3 0 1 2\n3 1 2 3\n";
    EXPECT_EQ(with(vertices, faces), "no error");
    EXPECT_EQ(with("0 0 0\n1 nan 0\n1 1 0\n0 1 0\n", faces),
              "m.ply: vertex 1 of 4, line 11: expected a finite number, found \"nan\"");
    EXPECT_EQ(with("0 0 0\n1 1e39 0\n1 1 0\n0 1 0\n", faces),
              "m.ply: vertex 1 of 4, line 11: expected a finite number, found \"1e39\"");
    EXPECT_EQ(
        with(vertices, "3 0 1 2\n3 1 2 4\n"),
        "m.ply: a face has the vertex index 4 (expected one below 4, the number of vertices)");
    EXPECT_EQ(with(vertices, "3 0 1 2\n3 1 2 -1\n"),
              "m.ply: face 1 of 2, line 15: the vertex index -1 (expected an integer >= 0)");
    EXPECT_EQ(with(vertices, "3 0 1 2\n3 1 2 0.5\n"),
              "m.ply: face 1 of 2, line 15: the vertex index 0.5 (expected an integer >= 0)");
    EXPECT_EQ(with(vertices, "1 0\n2 1 2\n"), "m.ply: no faces with 3 or 4 vertices");

    std::string infinite = square_binary(false);
    const float infinity = std::numeric_limits<float>::infinity();
    std::memcpy(infinite.data() + infinite.find("end_header\n") + 11 + 4, &infinity, 4);
    EXPECT_EQ(error_of(infinite),
              "m.ply: vertex 0 of 4: property \"y\" is inf (expected a finite number)");
    EXPECT_EQ(
        error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
        "m.ply: vertices without x, y and z");
}

TEST(Ply, IsReadByPlymesh) {
    SceneFolder folder;
    folder.write("meshes/m.ply", square_ascii);
    folder.write("m.ply.gz", gzip(square_binary(true)));
    const Scene scene =
        folder.read("WorldBegin\nShape \"plymesh\" \"string filename\" \"meshes/m.ply\"\n"
                    "Shape \"plymesh\" \"string filename\" \"m.ply.gz\"\n");
    expect_square(std::get<Mesh>(scene.shapes.at(0).geometry));
    expect_square(std::get<Mesh>(scene.shapes.at(1).geometry));
    folder.write("m.ply", "ply\n");
    EXPECT_EQ(
        folder.errors(
            "WorldBegin\n  Shape \"plymesh\" \"string filename\" \"m.ply\"\n"
            "Shape \"plymesh\"\n"
            "Shape \"plymesh\" \"string filename\" \"none.ply\" \"texture displacement\" \"a\""),
        (std::vector<std::string>{
            "scene.pbrt:2:3: error: m.ply: line 2: the file ends in the header (expected "
            "\"end_header\")",
            "scene.pbrt:3:1: error: shape \"plymesh\" needs a parameter \"string filename\"",
            "scene.pbrt:4:46: error: parameter \"texture displacement\": textures are not "
            "supported "
            "yet",
            "scene.pbrt:4:1: error: cannot read \"none.ply\": no such file"}));
}

} // namespace
} // namespace tyndall
