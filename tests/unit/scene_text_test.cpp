// Text: tokens, numbers, parameters, errors and their places, files.
#include "scene/lexer.h"
#include "scene/numbers.h"
#include "unit/scene_files.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

using Lines = std::vector<std::string>;

/// Kinds and texts of all tokens: words as they are, "..." strings, brackets, ! for invalid ones.
std::string tokens_of(const std::string& text) {
    Diagnostics diagnostics;
    Lexer lexer(text, "t", diagnostics);
    std::string result;
    while (const std::optional<Token> token = lexer.next()) {
        if (!result.empty()) result += ' ';
        switch (token->kind) {
        case Token::Kind::string:
            result += '"' + string_value(*token) + '"';
            break;
        case Token::Kind::invalid:
            result += '!';
            break;
        default:
            result += token->text;
        }
    }
    return result;
}

std::string place_of_second_token(const std::string& text) {
    Diagnostics diagnostics;
    Lexer lexer(text, "t", diagnostics);
    lexer.next();
    return to_string(lexer.next()->where);
}

TEST(Lexer, SplitsAtSpaceQuotesAndBrackets) {
    EXPECT_EQ(tokens_of("Shape\"sphere\"[1\t2]\r\n-3"), "Shape \"sphere\" [ 1 2 ] -3");
    EXPECT_EQ(tokens_of("\"a\"\"b\"\"\""), "\"a\" \"b\" \"\"");
    EXPECT_EQ(tokens_of(""), "");
    EXPECT_NE(tokens_of("ab"), tokens_of("a b"));
}

TEST(Lexer, CommentsRunToTheEndOfTheLineAndStartOnlyWhereATokenCould) {
    EXPECT_EQ(tokens_of("a # b \"c\" [\nd"), "a d");
    EXPECT_EQ(tokens_of("a#b c"), "a#b c");
    EXPECT_EQ(tokens_of("\"#\" # x\rd"), "\"#\" d");
}

TEST(Lexer, ResolvesEscapes) {
    EXPECT_EQ(tokens_of(R"("a\"b\\c\'d")"), "\"a\"b\\c'd\"");
    EXPECT_EQ(tokens_of(R"("\b\f\n\r\t")"), "\"\b\f\n\r\t\"");
}

TEST(Lexer, CountsCharactersNotBytes) {
    EXPECT_EQ(place_of_second_token("ab cd"), "t:1:4");
    EXPECT_EQ(place_of_second_token("\xc3\xa4\xe2\x82\xac cd"), "t:1:4");
    EXPECT_EQ(place_of_second_token("ab\n\t cd"), "t:2:3");
    EXPECT_EQ(place_of_second_token("\xef\xbb\xbf"
                                    "ab cd"),
              "t:1:4"); // a byte order mark
}

TEST(Numbers, AreDecimalOrHexadecimalAndFinite) {
    EXPECT_EQ(parse_number("-1.5e3"), -1500);
    EXPECT_EQ(parse_number("+.5"), 0.5);
    EXPECT_EQ(parse_number("2."), 2);
    EXPECT_EQ(parse_number("0x1f"), 31);
    EXPECT_EQ(parse_number("1e-400"), 0);
    const std::string zeros(400, '0');
    EXPECT_EQ(parse_number(fmt::format("0.{}1", zeros)), 0);
    EXPECT_EQ(parse_number(fmt::format("{}7", zeros)), 7);
    for (const char* bad :
         {"", "+", "-", "1x", "nan", "inf", "1e39", "-1e400", "+-1", "1,5", "0x"}) {
        EXPECT_FALSE(parse_number(bad)) << bad;
    }
    EXPECT_FALSE(parse_number(fmt::format("1{}e-5", zeros)));
}

TEST(Numbers, IntegersHave32Bits) {
    EXPECT_EQ(parse_integer("-2147483648"), -2147483647 - 1);
    EXPECT_EQ(parse_integer("+12"), 12);
    for (const char* bad : {"", "2147483648", "1.0", "1e3", "0x1", "a"}) {
        EXPECT_FALSE(parse_integer(bad)) << bad;
    }
}

TEST(Errors, HavePlaceAndExpectation) {
    EXPECT_EQ(
        world_errors("Shape \"sphere\" \"float radius\" -1"),
        Lines{"scene.pbrt:2:16: error: parameter \"float radius\" is -1 (expected a value > 0)"});
    EXPECT_EQ(world_errors("Shpae \"sphere\""),
              Lines{"scene.pbrt:2:1: error: \"Shpae\" is no directive"});
    EXPECT_EQ(world_errors("\"Shape\""),
              Lines{"scene.pbrt:2:1: error: the string \"Shape\" is no directive"});
    EXPECT_EQ(world_errors("Shape sphere"),
              Lines{"scene.pbrt:2:7: error: Shape: expected a string in quotes, found \"sphere\""});
    EXPECT_EQ(world_errors("Translate 1 2 Scale 1 1 1"),
              Lines{"scene.pbrt:2:15: error: Translate: expected a number, found \"Scale\""});
    EXPECT_EQ(world_errors("Translate 1 2 3x"),
              Lines{"scene.pbrt:2:15: error: Translate: expected a finite number, found \"3x\""});
    EXPECT_EQ(world_errors("Translate 1"),
              Lines{"scene.pbrt:2:1: error: the file ends inside Translate (expected a number)"});
    EXPECT_EQ(world_errors("Shape \"sphere"),
              Lines{"scene.pbrt:2:7: error: unterminated string (expected \" on the same line)"});
    EXPECT_EQ(
        world_errors("Material \"a\\q\""),
        Lines{"scene.pbrt:2:12: error: unknown escape \"\\q\" in a string (expected \\b, \\f, "
              "\\n, \\r, \\t, \\\\, \\' or \\\")"});
    EXPECT_TRUE(world_errors("Shape \"sphere\" \"float radius\" 1").empty());
}

TEST(Errors, AreAllToldInOneRun) {
    const Lines errors = world_errors("Shape \"sphere\" \"float radius\" [ 0 ]\n"
                                      "Bogus 1 2 \"x\" [ 3 ]\n"
                                      "Material \"hair\"\n"
                                      "Shape \"disk\" \"float radius\" \"one\"\n"
                                      "Shape \"sphere\"\n");
    const Lines expected{
        "scene.pbrt:2:16: error: parameter \"float radius\" is 0 (expected a value > 0)",
        "scene.pbrt:3:1: error: \"Bogus\" is no directive",
        "scene.pbrt:4:1: error: material \"hair\" is not supported yet",
        "scene.pbrt:5:29: error: the string \"one\" is no value for parameter \"float radius\" "
        "(expected a finite number)"};
    EXPECT_EQ(errors, expected);
}

TEST(Errors, EndAfterTwenty) {
    std::string text;
    for (int i = 0; i < 30; ++i)
        text += "Bogus Identity\n";
    const Lines errors = world_errors(text);
    ASSERT_EQ(errors.size(), 21u);
    EXPECT_EQ(errors[19], "scene.pbrt:21:1: error: \"Bogus\" is no directive");
    EXPECT_EQ(errors[20], "scene.pbrt:22:1: error: too many errors");
}

TEST(Errors, EndAfterTwentyWhereverTheyComeFrom) {
    SceneFolder folder;
    folder.write("wide.pbrt", "\xff\xfe");
    folder.write("odd.spd", "1 2 3");
    folder.write("odd.ply", "ply\n");
    for (const char* directive :
         {"Include \"wide.pbrt\"\n", "Include \"none.pbrt\"\n",
          "LightSource \"infinite\" \"spectrum L\" \"odd.spd\"\n",
          "LightSource \"infinite\" \"spectrum L\" \"none.spd\"\n",
          "Shape \"plymesh\" \"string filename\" \"odd.ply\"\n", "Shape \"torus\"\n"}) {
        std::string text = "WorldBegin\n";
        for (int i = 0; i < 30; ++i)
            text += directive;
        const Lines errors = folder.errors(text);
        EXPECT_EQ(errors.size(), 21u) << directive;
        EXPECT_NE(errors.back().find("too many errors"), std::string::npos) << directive;
        EXPECT_EQ(errors[19].find("too many errors"), std::string::npos) << directive;
    }
}

TEST(Errors, ShowTextThatDoesNotPrint) {
    EXPECT_EQ(world_errors("\x01\xff\xc3\xa4"),
              Lines{"scene.pbrt:2:1: error: \"\\x01\\xff\xc3\xa4\" is no directive"});
    const Lines errors = world_errors(std::string(1000, 'x'));
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0],
              "scene.pbrt:2:1: error: \"" + std::string(60, 'x') + "...\" is no directive");
}

TEST(Errors, OfUtf16) {
    EXPECT_EQ(SceneFolder().errors(std::string_view("\xff\xfeW\0", 4))[0],
              "scene.pbrt:1:1: error: the file is in UTF-16 (expected UTF-8)");
}

TEST(Parameters, TakeOneValueOrAList) {
    const auto radius = [](const Scene& scene) {
        return std::get<Sphere>(scene.shapes.at(0).geometry).radius;
    };
    EXPECT_EQ(radius(read_world("Shape \"sphere\" \"float radius\" 3")), 3);
    EXPECT_EQ(radius(read_world("Shape \"sphere\" \"  float\t radius \" [ 3 ]")), 3);
    EXPECT_NE(radius(read_world("Shape \"sphere\"")), 3);
}

TEST(Parameters, TheLastOfTheSameNameCounts) {
    const Scene scene = read_world("Shape \"sphere\" \"float radius\" 3 \"float radius\" 4");
    EXPECT_EQ(std::get<Sphere>(scene.shapes.at(0).geometry).radius, 4);
}

TEST(Parameters, ValuesMustFitTheType) {
    const auto error_of = [](const std::string& parameter) {
        const Lines errors = world_errors("Shape \"sphere\" " + parameter);
        return errors.size() == 1 ? errors[0] : "not one error";
    };
    EXPECT_EQ(
        error_of("\"float radius\" true"),
        "scene.pbrt:2:31: error: \"true\" is no value for parameter \"float radius\" (expected a "
        "finite number)");
    EXPECT_EQ(error_of("\"float radius\" [ 1 2 ]"),
              "scene.pbrt:2:16: error: parameter \"float radius\" has 2 values (expected 1)");
    EXPECT_EQ(error_of("\"float radius\" [ ]"),
              "scene.pbrt:2:16: error: parameter \"float radius\" has no values");
    EXPECT_EQ(
        error_of("\"float radius\" 1e50"),
        "scene.pbrt:2:31: error: \"1e50\" is no value for parameter \"float radius\" (expected a "
        "finite number)");
    EXPECT_EQ(error_of("\"float radius\" [ 1"),
              "scene.pbrt:2:16: error: the file ends inside parameter \"float radius\"");
    EXPECT_EQ(
        error_of("\"float radius\" [ [ 1 ] ]"),
        "scene.pbrt:2:33: error: \"[\" is no value for parameter \"float radius\" (expected a "
        "finite number, or ])");
    EXPECT_EQ(
        error_of("\"float radius\" ]"),
        "scene.pbrt:2:31: error: \"]\" is no value for parameter \"float radius\" (expected a "
        "finite number)");
    EXPECT_EQ(error_of("\"float radius\" Identity"),
              "scene.pbrt:2:31: error: \"Identity\" is no value for parameter \"float radius\" "
              "(expected a finite number)");
    EXPECT_EQ(error_of("\"radius\" 1"), "scene.pbrt:2:16: error: the string \"radius\" declares no "
                                        "parameter (expected \"type name\")");
    EXPECT_EQ(error_of("\"color radius\" 1"),
              "scene.pbrt:2:16: error: unknown parameter type \"color\" (expected \"rgb\")");
    EXPECT_EQ(
        error_of("\"flaot radius\" 1"),
        "scene.pbrt:2:16: error: unknown parameter type \"flaot\" (expected one of bool, integer, "
        "float, point2, vector2, point3, vector3, normal, string, rgb, texture, blackbody, "
        "spectrum)");
}

TEST(Parameters, OfEveryTypeAreRead) {
    const Scene scene = read_world(
        "LightSource \"infinite\" \"spectrum L\" [ 400 1 700 1 ] \"float scale\" 2\n"
        "LightSource \"point\" \"blackbody I\" 5000 \"point3 from\" [ 1 2 3 ]\n"
        "AreaLightSource \"diffuse\" \"bool twosided\" true\n"
        "Material \"diffuse\" \"rgb reflectance\" [ 0.1 0.2 0.3 ]\n"
        "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]\n"
        "  \"normal N\" [ 0 0 1 0 0 1 0 0 1 ] \"vector3 S\" [ 1 0 0 1 0 0 1 0 0 ]\n"
        "  \"point2 uv\" [ 0 0 1 0 0 1 ] \"float alpha\" 1\n");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_TRUE(scene.area_lights.at(0).two_sided);
    const Mesh& mesh = std::get<Mesh>(scene.shapes.at(0).geometry);
    EXPECT_EQ(mesh.positions.at(1), glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.normals.at(2), glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.uvs.at(1), glm::vec2(1, 0));
    EXPECT_NE(mesh.uvs.at(1), mesh.uvs.at(2));
    EXPECT_EQ(std::get<PointLight>(scene.lights.at(1).emitter).position, glm::dvec3(1, 2, 3));
}

TEST(Parameters, CountsMustBeWhole) {
    EXPECT_EQ(
        world_errors("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 ]"),
        Lines{"scene.pbrt:2:22: error: parameter \"point3 P\" has 4 values (expected a multiple of "
              "3)"});
    EXPECT_EQ(
        world_errors("Material \"diffuse\" \"rgb reflectance\" [ 1 1 1 0 0 0 ]"),
        Lines{"scene.pbrt:2:20: error: parameter \"rgb reflectance\" has 6 values (expected 3)"});
}

TEST(Parameters, UnusedOnesAreErrorsWithAdvice) {
    EXPECT_EQ(
        world_errors("Shape \"sphere\" \"float raduis\" 1"),
        Lines{"scene.pbrt:2:16: error: unused parameter \"float raduis\" of shape \"sphere\" (did "
              "you mean \"float radius\"?)"});
    EXPECT_EQ(
        world_errors("Shape \"sphere\" \"integer radius\" 1"),
        Lines{"scene.pbrt:2:16: error: unused parameter \"integer radius\" of shape \"sphere\" "
              "(expected \"float radius\")"});
    EXPECT_EQ(
        world_errors("Shape \"sphere\" \"float colour\" 1"),
        Lines{"scene.pbrt:2:16: error: unused parameter \"float colour\" of shape \"sphere\""});
    EXPECT_EQ(
        world_errors("Material \"diffuse\" \"float reflectance\" 1"),
        Lines{"scene.pbrt:2:20: error: unused parameter \"float reflectance\" of material "
              "\"diffuse\" (expected \"texture reflectance\" or \"rgb reflectance\" or \"blackbody "
              "reflectance\" or \"spectrum reflectance\")"});
    // Set by Attribute they may stay unused.
    EXPECT_TRUE(world_errors("Attribute \"shape\" \"float colour\" 1 Shape \"sphere\"").empty());
}

TEST(Files, IncludeIsReadInPlace) {
    SceneFolder folder;
    folder.write("parts/a.pbrt", "Translate 1 0 0\nInclude \"parts/b.pbrt\"\n");
    folder.write("parts/b.pbrt", "Translate 2 0 0");
    const Scene scene = folder.read("WorldBegin\nInclude \"parts/a.pbrt\"\nShape \"sphere\"\n");
    EXPECT_EQ(scene.shapes.at(0).world_from_object[3].x, 3);
}

TEST(Files, NamesStartAtTheMainFileOrElseAtTheFileTheyStandIn) {
    SceneFolder folder;
    folder.write("parts/a.pbrt", "Include \"b.pbrt\"");
    folder.write("parts/b.pbrt", "Translate 2 0 0");
    const char* text = "WorldBegin\nInclude \"parts/a.pbrt\"\nShape \"sphere\"\n";
    EXPECT_EQ(folder.read(text).shapes.at(0).world_from_object[3].x, 2);
    folder.write("b.pbrt", "Translate 5 0 0");
    EXPECT_EQ(folder.read(text).shapes.at(0).world_from_object[3].x, 5);
}

TEST(Files, ParametersMayGoOnBehindAnInclude) {
    SceneFolder folder;
    folder.write("a.pbrt", "Shape \"sphere\"");
    const Scene scene = folder.read("WorldBegin\nInclude \"a.pbrt\"\n\"float radius\" 7\n");
    EXPECT_EQ(std::get<Sphere>(scene.shapes.at(0).geometry).radius, 7);
}

TEST(Files, ErrorsNameTheIncludedFile) {
    SceneFolder folder;
    folder.write("a.pbrt", "\n  Bogus");
    EXPECT_EQ(folder.errors("WorldBegin\nInclude \"a.pbrt\"\nInclude \"none.pbrt\"\n"),
              (Lines{"a.pbrt:2:3: error: \"Bogus\" is no directive",
                     "scene.pbrt:3:1: error: cannot read \"none.pbrt\": no such file"}));
    EXPECT_EQ(folder.errors("WorldBegin Include \".\""),
              Lines{"scene.pbrt:1:12: error: cannot read \".\": not a file"});
}

TEST(Files, RecursionEndsWithTheChain) {
    SceneFolder folder;
    folder.write("a.pbrt", "Include \"b.pbrt\"");
    folder.write("b.pbrt", "\nInclude \"a.pbrt\"");
    EXPECT_EQ(
        folder.errors("WorldBegin\nInclude \"a.pbrt\"\n"),
        Lines{"b.pbrt:2:1: error: \"a.pbrt\" includes itself (scene.pbrt -> a.pbrt -> b.pbrt -> "
              "a.pbrt)"});
    for (int i = 0; i < 150; ++i) {
        folder.write(fmt::format("c{}", i), fmt::format("Import \"c{}\"", i + 1));
    }
    const Lines errors = folder.errors("WorldBegin\nInclude \"c0\"\n");
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].find("c98:1:1: error: files are included more than 100 deep (... -> c91"),
              0u);
}

TEST(Files, MayBePacked) {
    SceneFolder folder;
    folder.write("a.pbrt.gz", gzip("Shape \"sphere\"\n") + gzip("Shape \"disk\"\n"));
    EXPECT_EQ(folder.read("WorldBegin\nInclude \"a.pbrt.gz\"").shapes.size(), 2u);
    folder.write("scene.pbrt.gz", gzip("WorldBegin Shape \"disk\""));
    EXPECT_EQ(read_scene(folder.path() / "scene.pbrt.gz").shapes.size(), 1u);

    const std::string packed = gzip("Shape \"sphere\"\n");
    folder.write("a.pbrt.gz", packed.substr(0, packed.size() - 3));
    EXPECT_EQ(folder.errors("WorldBegin Include \"a.pbrt.gz\""),
              Lines{"scene.pbrt:1:12: error: cannot read \"a.pbrt.gz\": the gzip file is cut off"});
    folder.write("a.pbrt.gz", "Shape \"sphere\"");
    EXPECT_EQ(folder.errors("WorldBegin Include \"a.pbrt.gz\""),
              Lines{"scene.pbrt:1:12: error: cannot read \"a.pbrt.gz\": not a valid gzip file"});
}

TEST(Files, DecompressionIsBounded) {
    SceneFolder folder;
    std::string text(3'000'000, ' ');
    text += "WorldBegin";
    folder.write("scene.pbrt.gz", gzip(text));
    ReadOptions options;
    options.max_bytes = 1'000'000;
    try {
        read_scene(folder.path() / "scene.pbrt.gz", options);
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_EQ(
            folder.without_folder(error.messages()),
            Lines{"error: cannot read \"scene.pbrt.gz\": the files of the scene have more than "
                  "1000000 bytes"});
    }
    options.max_bytes = 4'000'000;
    EXPECT_NO_THROW(read_scene(folder.path() / "scene.pbrt.gz", options));
}

TEST(Files, AMissingSceneIsAnError) {
    SceneFolder folder;
    try {
        read_scene(folder.path() / "none.pbrt");
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_EQ(error.status(), ExitStatus::bad_input);
        EXPECT_EQ(folder.without_folder(error.messages()),
                  Lines{"error: cannot read \"none.pbrt\": no such file"});
    }
}

TEST(Files, Sha256IsThatOfAllBytesInReadingOrder) {
    SceneFolder folder;
    // printf 'WorldBegin\n' | sha256sum
    EXPECT_EQ(folder.read("WorldBegin\n").sha256,
              "fe4ae18509e1d567f1a6d301954b0a275449881cd015564ea70a56ee29b90b24");
    // printf 'WorldBegin\nInclude "a.pbrt"\nIdentity' | sha256sum
    folder.write("a.pbrt", "Identity");
    EXPECT_EQ(folder.read("WorldBegin\nInclude \"a.pbrt\"\n").sha256,
              "5ef56c34c74aed82598c97eacc33365d29aef2f24b80ac56c214e643b9b69875");
}

} // namespace
} // namespace tyndall
