#include "scene/reader.h"

#include "scene/parser.h"
#include "scene/scene_builder.h"

namespace tyndall {

Scene read_scene(const std::filesystem::path& file, const ReadOptions& options) {
    const SourceLocation whole_file{std::make_shared<const std::string>(file.string())};
    Diagnostics diagnostics;
    InputFiles files(file, options.max_bytes, options.on_file);
    TokenStream tokens(files, diagnostics);
    tokens.open(file, {}, TokenStream::FileKind::included);
    diagnostics.throw_if_errors();
    SceneBuilder builder(files, diagnostics);
    Parser(tokens, files, builder, diagnostics).parse();
    Scene scene = builder.finish(whole_file);
    scene.filename = file.string();
    scene.sha256 = files.sha256();
    scene.warnings = diagnostics.warnings();
    return scene;
}

void fit_screen_window(Scene& scene) {
    Camera& camera = scene.camera;
    if (camera.screen_window_given) return;
    const double aspect = camera.frame_aspect_ratio > 0
                              ? camera.frame_aspect_ratio
                              : static_cast<double>(scene.film.width) / scene.film.height;
    if (aspect > 1) {
        camera.screen_window = {-aspect, aspect, -1, 1};
    } else {
        camera.screen_window = {-1, 1, -1 / aspect, 1 / aspect};
    }
}

} // namespace tyndall
