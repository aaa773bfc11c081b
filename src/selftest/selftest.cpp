#include "selftest/selftest.h"

#include "render/renderer.h"
#include "selftest/cases.h"
#include "selftest/functions.h"

namespace tyndall::selftest {
namespace {

constexpr double kPass = 4.5; ///< Standard errors.

struct Mean {
    Rgb value{0}, standard_error{0};
};

/// Over all pixels, with the error that the film's variances give.
Mean mean_of(const Image& film) {
    Rgb sum(0), variance(0);
    for (auto p = film.pixels.begin(); p != film.pixels.end(); p += 6) {
        sum += Rgb(p[0], p[1], p[2]);
        variance += Rgb(p[3], p[4], p[5]);
    }
    const double pixels = static_cast<double>(film.pixels.size()) / 6;
    return {sum / pixels, glm::sqrt(variance) / pixels};
}

class Selftest {
  public:
    Selftest(const gpu::Context& context, double corrupt, const OnRow& on_row)
        : context_(context), corrupt_(corrupt), on_row_(on_row) {}

    std::vector<Row> run() {
        for (const Row& row : check_functions(context_, corrupt_))
            add(row);
        for (const Case& c : cases())
            if (goes_on_) render(c);
        if (goes_on_) add({"paths that went wrong", 0, mishaps_ + (corrupt_ != 0 ? 1 : 0), 0});
        return std::move(rows_);
    }

  private:
    void add(const Row& row) {
        if (!goes_on_) return;
        rows_.push_back(row);
        goes_on_ = on_row_(row);
    }
    void render(const Case& c);

    const gpu::Context& context_;
    double corrupt_;
    const OnRow& on_row_;
    std::vector<Row> rows_;
    double mishaps_ = 0;
    bool goes_on_ = true;
};

/// One row, or one for each channel where they differ.
void Selftest::render(const Case& c) {
    Renderer renderer(context_, c.scene);
    renderer.render(0, c.samples);
    const Mean mean = mean_of(renderer.read_film());
    const bool is_grey = c.expected == Rgb(c.expected.g);
    for (int k = is_grey ? 1 : 0; k < (is_grey ? 2 : 3); ++k)
        add({is_grey ? c.name : c.name + ": " + "RGB"[k], c.expected[k],
             (1 + corrupt_) * mean.value[k],
             kPass * mean.standard_error[k] + c.rounding * c.expected[k]});
    for (const shared::Mishap& kind : renderer.health().kinds)
        mishaps_ += static_cast<double>(kind.count);
}

} // namespace

std::vector<Row> run(const gpu::Context& context, double corrupt, const OnRow& on_row) {
    return Selftest(context, corrupt, on_row).run();
}

} // namespace tyndall::selftest
