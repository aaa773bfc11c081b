#include "study/gallery.h"

#include "study/html.h"

#include <cmath>
#include <fmt/format.h>

namespace tyndall::study {
namespace {

/// A step of 1, 2 or 5 times a power of ten that is not below the value.
double round_up(double value) {
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (digit * power >= value) return digit * power;
    return 10 * power;
}

double mean_brightness(const Canvas& canvas) {
    double sum = 0;
    for (const glm::dvec3& pixel : canvas.pixels)
        sum += (pixel.r + pixel.g + pixel.b) / 3;
    return sum / static_cast<double>(canvas.pixels.size());
}

} // namespace

Gallery::Gallery(const Results& results, const Reference& reference, const StoredPictures& stored)
    : results_(results), stored_(stored), reference_{reference.mean, stored.width()},
      exposure_(exposure(reference_)), detail_(find_detail(reference_)) {}

std::string Gallery::figure(const Image& image, const std::string& name, const std::string& alt,
                            const std::string& caption) const {
    return fmt::format("<figure><img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">"
                       "<figcaption>{}</figcaption></figure>\n",
                       embed_png(image, stored_.file(name, ".png")), image.width, image.height, alt,
                       caption);
}

std::string Gallery::reference() const {
    return figure(tone_mapped(reference_, exposure_), "reference", "The scene, as the reference",
                  "The reference: an error of " + percent(bounds(results_.reference.error).value) +
                      ".");
}

std::string Gallery::equal_time(const std::vector<const TechniqueResult*>& techniques) const {
    std::string pictures =
        figure(tone_mapped(cut(reference_, detail_), exposure_), "detail-reference",
               "Detail of the reference", "<strong>reference</strong>");
    for (const TechniqueResult* t : techniques) {
        const Canvas canvas = stored_.read(t->name, "equal.");
        if (canvas.pixels.empty()) continue;
        pictures += figure(tone_mapped(cut(canvas, detail_), exposure_), "detail-" + t->name,
                           "Detail by " + t->title,
                           fmt::format("<strong>{}</strong><br>{} sample{} in {}", t->title,
                                       t->equal_time.samples, t->equal_time.samples == 1 ? "" : "s",
                                       duration(t->equal_time.seconds)));
    }
    return element("p", fmt::format("A detail of {} x {} pixels, after {} for each technique, or "
                                    "after one sample where that takes longer. All have the same "
                                    "exposure.",
                                    detail_.width, detail_.height,
                                    duration(results_.equal_time_seconds))) +
           element("div", pictures, "gallery");
}

std::string Gallery::errors(const std::vector<const TechniqueResult*>& techniques) const {
    const double brightness = mean_brightness(reference_);
    double largest = 0;
    for (const TechniqueResult* t : techniques)
        largest = std::max(largest, bounds(t->last().bias).value);
    // So that the largest bias shows in full colour, and 5 % at least.
    const double share = round_up(std::max(0.05, largest));
    std::string pictures;
    for (const TechniqueResult* t : techniques)
        pictures +=
            figure(signed_error(stored_.read(t->name, ""), reference_.pixels, share * brightness),
                   "error-" + t->name, "Signed error of " + t->title,
                   fmt::format("<strong>{}</strong><br>bias {}", t->title, told(t->last().bias)));
    const std::string scale = fmt::format(
        "<div class=\"scale\" role=\"img\" aria-label=\"Colour scale: blue is too dark, red too "
        "bright\"><span>-{0}</span><span class=\"ramp\" style=\"background:{1}\"></span>"
        "<span>+{0}</span></div>\n",
        percent(share), signed_error_gradient());
    return element("p", "The mean of all samples that a technique took, less the reference, in "
                        "shares of the mean brightness of the picture. Blue is too dark, red too "
                        "bright; what is left of the noise is even speckle.") +
           scale + element("div", pictures, "gallery");
}

} // namespace tyndall::study
