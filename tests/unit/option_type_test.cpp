// Types before WorldBegin and their parameters.
#include "unit/scene_files.h"

#include <gtest/gtest.h>
#include <limits>

namespace tyndall {
namespace {

using Lines = std::vector<std::string>;

TEST(CameraType, HasPbrtsDefaults) {
    const Camera camera = read_options("").camera;
    EXPECT_EQ(camera.kind, Camera::Kind::perspective);
    EXPECT_EQ(camera.fov, 90);
    EXPECT_EQ(camera.lens_radius, 0);
    EXPECT_EQ(camera.focal_distance, 1e6);
    EXPECT_EQ(camera.shutter_seconds, 1);
    EXPECT_EQ(camera.world_from_camera, glm::dmat4(1));
    EXPECT_EQ(camera.medium, -1);
    EXPECT_FALSE(camera.screen_window_given);
}

TEST(CameraType, ReadsItsParameters) {
    const Camera camera =
        read_options("Camera \"orthographic\" \"float lensradius\" 0.1 \"float focaldistance\" 5\n"
                     "\"float shutteropen\" 1 \"float shutterclose\" 1.5\n"
                     "\"float screenwindow\" [ -2 3 -4 5 ] \"float frameaspectratio\" 2")
            .camera;
    EXPECT_EQ(camera.kind, Camera::Kind::orthographic);
    EXPECT_EQ(camera.lens_radius, 0.1);
    EXPECT_EQ(camera.focal_distance, 5);
    EXPECT_EQ(camera.shutter_seconds, 0.5);
    EXPECT_EQ(camera.frame_aspect_ratio, 2);
    EXPECT_EQ(camera.screen_window, (std::array<double, 4>{-2, 3, -4, 5}));
    EXPECT_EQ(read_options("Camera \"perspective\" \"float fov\" 30").camera.fov, 30);
    EXPECT_EQ(option_error("Camera \"orthographic\" \"float fov\" 30"),
              "unused parameter \"float fov\" of camera \"orthographic\"");
}

TEST(CameraType, FitsItsWindowToTheFilm) {
    const auto window = [](const std::string& text) {
        return read_options(text).camera.screen_window;
    };
    using Window = std::array<double, 4>;
    const std::string film = "Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" ";
    EXPECT_EQ(window(film + "100"), (Window{-2, 2, -1, 1}));
    EXPECT_EQ(window(film + "400"), (Window{-1, 1, -2, 2}));
    EXPECT_EQ(window("Camera \"perspective\" \"float frameaspectratio\" 3"),
              (Window{-3, 3, -1, 1}));
    Scene scene = read_options(film + "100");
    scene.film.width = 100;
    fit_screen_window(scene);
    EXPECT_EQ(scene.camera.screen_window, (Window{-1, 1, -1, 1}));
}

TEST(CameraType, ChecksItsParameters) {
    EXPECT_EQ(option_error("Camera \"perspective\" \"float fov\" 180"),
              "parameter \"float fov\" is 180 (expected a value in (0, 180))");
    EXPECT_EQ(option_error("Camera \"perspective\" \"float shutterclose\" -1"),
              "the shutter closes at -1 and opens at 0 (expected it to open first)");
    EXPECT_EQ(option_error("Camera \"perspective\" \"float screenwindow\" [ 0 1 2 ]"),
              "parameter \"float screenwindow\" is no window (expected x0 x1 y0 y1)");
    EXPECT_EQ(option_error("Camera \"spherical\" \"string mapping\" \"equalarea\""),
              "camera \"spherical\" is not supported yet");
    EXPECT_EQ(option_error("Camera \"fisheye\""),
              "unknown camera \"fisheye\" (expected one of perspective, orthographic)");
    EXPECT_EQ(option_error("Scale 0 1 1 Camera \"perspective\""),
              "the transformation has no inverse (expected one that keeps three dimensions)");
}

TEST(FilmType, HasPbrtsDefaults) {
    const Film film = read_options("").film;
    EXPECT_EQ(film.width, 1280);
    EXPECT_EQ(film.height, 720);
    EXPECT_EQ(film.bounds.width(), 1280);
    EXPECT_EQ(film.filename, "pbrt.exr");
    EXPECT_EQ(film.iso, 100);
    EXPECT_EQ(film.max_component_value, std::numeric_limits<double>::infinity());
    EXPECT_FALSE(film.half_float);
}

TEST(FilmType, ReadsItsParameters) {
    const Film film =
        read_options(
            "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 32\n"
            "\"string filename\" \"a.png\" \"float iso\" 200 \"bool savefp16\" true\n"
            "\"float maxcomponentvalue\" 10 \"float diagonal\" 50 \"string sensor\" \"cie1931\"\n"
            "\"float whitebalance\" 0 \"float cropwindow\" [ 0.25 0.75 0.51 1 ]")
            .film;
    EXPECT_EQ(film.width, 64);
    EXPECT_EQ(film.filename, "a.png");
    EXPECT_EQ(film.iso, 200);
    EXPECT_TRUE(film.half_float);
    EXPECT_EQ(film.max_component_value, 10);
    EXPECT_EQ(film.bounds.x0, 16);
    EXPECT_EQ(film.bounds.x1, 48);
    EXPECT_EQ(film.bounds.y0, 17); // 16.32 rounded up
    EXPECT_EQ(film.bounds.y1, 32);
    EXPECT_EQ(read_options("Film \"rgb\" \"integer pixelbounds\" [ 1 5 2 9 ]").film.bounds.y1, 9);
}

TEST(FilmType, ChecksItsParameters) {
    EXPECT_EQ(option_error("Film \"rgb\" \"integer xresolution\" 0"),
              "parameter \"integer xresolution\" is 0 (expected a value > 0)");
    EXPECT_EQ(
        option_error("Film \"rgb\" \"integer xresolution\" 65536 \"integer yresolution\" 32768"),
        "65536 x 32768 are too many pixels (expected fewer than 2^31)");
    EXPECT_EQ(option_error("Film \"rgb\" \"integer xresolution\" 70000 \"integer yresolution\" 9"),
              "70000 x 9 pixels (expected at most 65535 on each side)");
    EXPECT_EQ(option_error("Film \"rgb\" \"integer pixelbounds\" [ 5 5 0 9 ]"),
              "no pixel is left to render (expected bounds with an area)");
    EXPECT_EQ(option_error("Film \"rgb\" \"float cropwindow\" [ 0 1 ]"),
              "parameter \"float cropwindow\" has 2 values (expected x0 x1 y0 y1)");
    EXPECT_EQ(option_error("Film \"rgb\" \"float whitebalance\" 5000"),
              "parameter \"float whitebalance\" of film \"rgb\" is not supported yet");
    EXPECT_EQ(option_error("Film \"rgb\" \"string sensor\" \"canon_eos_5d\""),
              "sensor \"canon_eos_5d\" is not supported yet");
    EXPECT_EQ(option_error("Film \"gbuffer\""), "film \"gbuffer\" is not supported yet");
    EXPECT_EQ(option_error("Film \"image\""), "unknown film \"image\" (expected rgb)");
    EXPECT_EQ(
        SceneFolder().warnings("Film \"rgb\" \"integer pixelbounds\" [ 0 9999 0 9 ] WorldBegin"),
        Lines{"scene.pbrt:1:12: warning: the pixel bounds go beyond the picture; they are cut to "
              "it"});
}

TEST(PixelFilterType, ReadsItsParameters) {
    const auto filter = [](const std::string& text) { return read_options(text).filter; };
    EXPECT_EQ(filter("").kind, PixelFilter::Kind::gaussian);
    EXPECT_EQ(filter("").x_radius, 1.5);
    EXPECT_EQ(filter("PixelFilter \"box\"").x_radius, 0.5);
    EXPECT_EQ(filter("PixelFilter \"triangle\"").y_radius, 2);
    EXPECT_EQ(filter("PixelFilter \"gaussian\" \"float sigma\" 1").sigma, 1);
    const PixelFilter mitchell = filter("PixelFilter \"mitchell\" \"float B\" 0.5 \"float C\" 0.25 "
                                        "\"float xradius\" 3");
    EXPECT_EQ(mitchell.b, 0.5);
    EXPECT_EQ(mitchell.c, 0.25);
    EXPECT_EQ(mitchell.x_radius, 3);
    EXPECT_EQ(mitchell.y_radius, 2);
    EXPECT_EQ(option_error("PixelFilter \"sinc\""), "pixel filter \"sinc\" is not supported yet");
    EXPECT_EQ(option_error("PixelFilter \"box\" \"float xradius\" 0"),
              "parameter \"float xradius\" is 0 (expected a value > 0)");
}

TEST(SamplerType, GivesCountAndSeed) {
    const auto samples = [](const std::string& text) {
        return read_options(text).samples_per_pixel;
    };
    EXPECT_EQ(samples(""), 16);
    for (const char* name : {"zsobol", "sobol", "paddedsobol", "halton", "pmj02bn"}) {
        const std::string sampler = "Sampler \"" + std::string(name) + "\"";
        EXPECT_EQ(samples(sampler), 16) << name;
        const Sampler expected = name == std::string("zsobol") ? Sampler::zsobol : Sampler::sobol;
        EXPECT_EQ(read_options(sampler).sampler, expected) << name;
        EXPECT_EQ(samples(sampler + " \"integer pixelsamples\" 7"), 7) << name;
        EXPECT_EQ(read_options(sampler + " \"integer seed\" 3").seed, 3u) << name;
    }
    EXPECT_EQ(read_options("").sampler, Sampler::sobol);
    EXPECT_EQ(samples("Sampler \"independent\""), 4);
    EXPECT_EQ(read_options("Sampler \"independent\"").sampler, Sampler::independent);
    EXPECT_EQ(samples("Sampler \"stratified\" \"integer xsamples\" 3 \"bool jitter\" false"), 12);
    EXPECT_TRUE(
        read_options("Sampler \"zsobol\" \"string randomization\" \"none\"").warnings.empty());
    EXPECT_EQ(
        option_error("Sampler \"sobol\" \"string randomization\" \"maybe\""),
        "unknown randomization \"maybe\" (expected one of fastowen, owen, permutedigits, none)");
    EXPECT_EQ(option_error("Sampler \"independent\" \"integer pixelsamples\" 0"),
              "parameter \"integer pixelsamples\" is 0 (expected a value > 0)");
    EXPECT_EQ(option_error(
                  "Sampler \"stratified\" \"integer xsamples\" 99999 \"integer ysamples\" 99999"),
              "9999800001 samples per pixel (expected fewer than 2^31)");
}

TEST(IntegratorType, ReadsItsParameters) {
    EXPECT_EQ(read_options("").integrator.kind, Integrator::Kind::volpath);
    EXPECT_EQ(read_options("").integrator.max_depth, 5);
    const Integrator path = read_options("Integrator \"path\" \"integer maxdepth\" 9 \"string "
                                         "lightsampler\" \"power\" \"bool regularize\" false")
                                .integrator;
    EXPECT_EQ(path.kind, Integrator::Kind::path);
    EXPECT_EQ(path.max_depth, 9);
    EXPECT_EQ(option_error("Integrator \"volpath\" \"bool regularize\" true"),
              "parameter \"bool regularize\" of integrator \"volpath\" is not supported yet");
    EXPECT_EQ(option_error("Integrator \"volpath\" \"integer maxdepth\" -1"),
              "parameter \"integer maxdepth\" is -1 (expected a value >= 0)");
    EXPECT_EQ(option_error("Integrator \"bdpt\" \"integer maxdepth\" 3"),
              "integrator \"bdpt\" is not supported yet");
    EXPECT_EQ(option_error("Integrator \"magic\""),
              "unknown integrator \"magic\" (expected one of volpath, path, singlescatter)");
}

TEST(IntegratorType, ReadsItsTechniques) {
    const Integrator plain = read_options("").integrator;
    EXPECT_TRUE(plain.samples_lights);
    EXPECT_EQ(plain.absorption, Integrator::Absorption::expected);
    EXPECT_EQ(plain.transmittance, Integrator::Transmittance::tracked);
    const Integrator analog =
        read_options("Integrator \"volpath\" \"bool lightsampling\" false \"string absorption\" "
                     "\"analog\" \"string transmittance\" \"marched\" \"float stepsize\" 0.25")
            .integrator;
    EXPECT_FALSE(analog.samples_lights);
    EXPECT_EQ(analog.absorption, Integrator::Absorption::analog);
    EXPECT_EQ(analog.transmittance, Integrator::Transmittance::marched);
    EXPECT_EQ(analog.step_size, 0.25);
    const Integrator march = read_options("Integrator \"singlescatter\" \"integer steps\" 7 "
                                          "\"string placement\" \"equiangular\"")
                                 .integrator;
    EXPECT_EQ(march.kind, Integrator::Kind::singlescatter);
    EXPECT_EQ(march.steps, 7);
    EXPECT_EQ(march.step_size, 0);
    EXPECT_EQ(march.placement, Integrator::Placement::equiangular);
}

TEST(IntegratorType, RefusesTechniquesThatAreNone) {
    EXPECT_EQ(option_error("Integrator \"volpath\" \"string absorption\" \"none\""),
              "unknown absorption \"none\" (expected one of expected, analog)");
    EXPECT_EQ(option_error("Integrator \"singlescatter\" \"integer steps\" 0"),
              "parameter \"integer steps\" is 0 (expected 1 to 4096 steps)");
    EXPECT_EQ(option_error("Integrator \"singlescatter\" \"integer steps\" 4097"),
              "parameter \"integer steps\" is 4097 (expected 1 to 4096 steps)");
    EXPECT_EQ(
        option_error("Integrator \"singlescatter\" \"integer steps\" 9 \"float stepsize\" 0.1"),
        "parameters \"float stepsize\" and \"integer steps\" exclude each other");
    EXPECT_EQ(option_errors("Integrator \"path\" \"string placement\" \"uniform\"").size(), 1u);
}

TEST(AcceleratorType, IsCheckedOnly) {
    EXPECT_TRUE(option_errors("Accelerator \"bvh\" \"string splitmethod\" \"hlbvh\" \"integer "
                              "maxnodeprims\" 2")
                    .empty());
    EXPECT_TRUE(
        option_errors("Accelerator \"kdtree\" \"float emptybonus\" 0.2 \"integer maxdepth\" 2")
            .empty());
    EXPECT_EQ(option_error("Accelerator \"grid\""),
              "unknown accelerator \"grid\" (expected one of bvh, kdtree)");
}

} // namespace
} // namespace tyndall
