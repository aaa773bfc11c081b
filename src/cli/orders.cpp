#include "cli/orders.h"

#include "cli/engine.h"
#include "core/error.h"

#include <fmt/format.h>

namespace tyndall::cli {
namespace {

/// The picture with at most so many scattering events; none if it was interrupted.
std::optional<Image> render_up_to(int depth, Scene scene, DeviceOptions options,
                                  std::uint32_t samples,
                                  const std::function<bool()>& is_interrupted) {
    options.calibrate = false; // was done for the whole picture
    scene.integrator.max_depth = std::min(depth, scene.integrator.max_depth);
    const std::unique_ptr<Engine> engine = make_engine(scene, options);
    engine->render(0, samples, [&](const Progress&) { return !is_interrupted(); });
    if (engine->validation_messages() > 0)
        throw Error(ExitStatus::failed, fmt::format("the validation layer had {} messages",
                                                    engine->validation_messages()));
    if (engine->samples() < samples) return std::nullopt;
    return engine->read_film();
}

/// A copy with room for more channels behind those that there are.
Image widened(const Image& image, const std::vector<std::string>& more) {
    std::vector<std::string> channels = image.channels;
    channels.insert(channels.end(), more.begin(), more.end());
    Image result(image.width, image.height, channels);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (std::size_t c = 0; c < image.channels.size(); ++c)
                result.at(x, y, c) = image.at(x, y, c);
    return result;
}

/// Writes `upper` - `lower` into three channels from `first` on.
void set_difference(Image& image, std::size_t first, const Image& upper, const Image* lower) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                image.at(x, y, first + c) = upper.at(x, y, c) - (lower ? lower->at(x, y, c) : 0.0F);
}

} // namespace

std::optional<Image> with_orders(const Image& film, const Scene& scene,
                                 const DeviceOptions& options, std::uint32_t samples,
                                 const std::function<bool()>& is_interrupted) {
    std::vector<std::string> names;
    for (int order = 0; order <= kOrders; ++order)
        for (const char* channel : {"R", "G", "B"})
            names.push_back(
                fmt::format("order{}{}.{}", order, order == kOrders ? "+" : "", channel));
    std::size_t first = film.channels.size();
    Image result = widened(film, names);
    Image lower;
    for (int order = 0; order < kOrders; ++order, first += 3) {
        std::optional<Image> upper = render_up_to(order, scene, options, samples, is_interrupted);
        if (!upper) return std::nullopt;
        set_difference(result, first, *upper, order > 0 ? &lower : nullptr);
        lower = std::move(*upper);
    }
    set_difference(result, first, film, &lower);
    return result;
}

} // namespace tyndall::cli
