#include "study/report.h"

#include "core/atomic_file.h"
#include "study/figure.h"
#include "study/gallery.h"
#include "study/html.h"
#include "study/report_css.h"
#include "study/report_figures.h"
#include "study/report_tables.h"
#include "study/sentences.h"

#include <fmt/format.h>

namespace tyndall::study {
namespace {

/// Collects the page; figures are drawn all at once, at the end.
class Page {
  public:
    void add(const std::string& html) { parts_.push_back({html, false}); }
    void heading(const char* id, const std::string& text) {
        parts_.push_back(
            {fmt::format("</section>\n<section id=\"{0}\">\n<h2>{1}</h2>\n", id, text), false});
    }
    void paragraph(const std::string& text) {
        if (!text.empty()) add(element("p", text));
    }
    void plot(const Figure& figure) {
        if (!has_points(figure)) return;
        parts_.push_back({"", true});
        figures_.push_back(figure);
    }
    std::string html() const;

  private:
    struct Part {
        std::string html;
        bool is_figure;
    };
    std::vector<Part> parts_;
    std::vector<Figure> figures_;
};

std::string Page::html() const {
    const std::vector<DrawnFigure> drawn = draw_figures(figures_);
    std::string text;
    std::size_t at = 0;
    for (const Part& part : parts_) {
        if (!part.is_figure) {
            text += part.html;
            continue;
        }
        text +=
            fmt::format("<figure class=\"plot\"><figcaption>{}</figcaption>\n{}"
                        "<div class=\"wide\">{}</div><div class=\"narrow\">{}</div></figure>\n",
                        figures_[at].title, legend(figures_[at]), drawn[at].wide, drawn[at].narrow);
        ++at;
    }
    return text;
}

void add_top(Page& page, const Results& results, const std::vector<Choice>& choices,
             const Gallery& gallery) {
    const std::string scene = std::filesystem::path(results.scene).filename().string();
    page.add(fmt::format("<header>\n<div><p class=\"eyebrow\">Tyndall study</p>\n<h1>What accuracy "
                         "costs in <span class=\"scene\">{}</span></h1>\n<p class=\"lead\">{}</p>"
                         "</div>\n{}</header>\n<section>",
                         escaped(scene), headline(results, choices), gallery.reference()));
    if (!results.is_complete)
        page.paragraph("<em>The study was ended before all techniques were measured. The same "
                       "command goes on with it.</em>");
    std::size_t measured = 0;
    for (const TechniqueResult& t : results.techniques)
        measured += t.is_measured();
    page.paragraph(fmt::format(
        "Each of {} ways to render this scene was given the same share of {} on {}. After every "
        "doubling of its samples, four independent pictures were held against a reference whose "
        "own error is {}. Errors are relative: the root of the mean square of all pixels, over "
        "that of the picture. {} They are for {} x {} pixels.",
        measured, duration(results.budget_seconds), escaped(results.device),
        percent(bounds(results.reference.error).value), time_text(results), results.width,
        results.height));
}

void add_techniques(Page& page, const Results& results) {
    if (!of_family(results, Family::marching).empty()) {
        page.heading("marching", "Marching, and where it ends");
        page.paragraph(marching_sentence(results));
        page.add(bias_table(results, "Bias of marching", "Steps",
                            {{"march-uniform", "Uniform steps"},
                             {"march-jittered", "Jittered"},
                             {"march-equiangular", "Equiangular"}}));
        std::vector<const TechniqueResult*> list = of_series(results, "march-uniform");
        if (const TechniqueResult* baseline = results.find(kBaseline);
            baseline && baseline->is_measured())
            list.insert(list.begin(), baseline);
        page.plot(time_figure(list, "marching", "Uniform steps: error against time"));
        page.plot(bias_figure(results, {"march-uniform", "march-jittered", "march-equiangular"},
                              "steps", "Bias of marching", "steps"));
    }
    if (!of_family(results, Family::orders).empty()) {
        page.heading("orders", "What scattering more than once adds");
        page.paragraph(orders_sentence(results));
        page.add(bias_table(results, "Bias of ending paths early", "Scattering events at most",
                            {{"orders", "Bias of the picture"}}));
        page.plot(bias_figure(results, {"orders"}, "orders", "Bias of ending paths early",
                              "scattering events"));
    }
    if (of_family(results, Family::estimators).size() > 1) {
        page.heading("estimators", "What the parts of volpath are worth");
        page.paragraph("Each line changes one thing in volpath. Factors are over those of volpath: "
                       "what is above 1 is worse.");
        page.add(factors_table(results, Family::estimators, "Variants of volpath"));
        page.plot(time_figure(of_family(results, Family::estimators), "estimators",
                              "Variants of volpath: error against time"));
    }
    if (!of_family(results, Family::cells).empty()) {
        page.heading("cells", "Majorant cells");
        page.paragraph(cells_sentence(results));
        page.plot(cells_figure(results));
    }
    if (!of_family(results, Family::phases).empty()) {
        page.heading("phases", "Simpler phase functions");
        page.paragraph("The phase function of the scene, replaced by one of the same mean cosine.");
        page.add(factors_table(results, Family::phases, "Other phase functions"));
    }
}

void add_end(Page& page, const Results& results) {
    if (!of_family(results, Family::without).empty()) {
        page.heading("effects", "What each effect costs");
        page.paragraph("Each effect was left out of the scene, for what a sample then costs and "
                       "how far the picture is from the whole.");
        page.add(effects_table(results));
    }
    page.heading("all", "All techniques");
    page.add(techniques_table(results));
    page.heading("how", "How this was measured");
    page.add(method_text(results));
    page.add(provenance_table(results));
}

Page make_page(const Results& results, const Gallery& gallery) {
    const std::vector<Choice> choices = choose(results);
    const std::vector<const TechniqueResult*> leaders = leading(results, choices);
    const Agreement agreement = test_unbiased(results);
    Page page;
    add_top(page, results, choices, gallery);
    page.heading("choose", "What to choose");
    page.add(choice_table(choices));
    page.plot(time_figure(leaders, "time", "Error against time"));
    page.paragraph("Lower is better, and further left is sooner. A line that bends to the "
                   "horizontal has reached its bias, which is the dashed line of its colour: more "
                   "time does not help.");
    page.plot(samples_figure(leaders));
    page.paragraph(slope_sentence(results));
    page.heading("same-time", "The same time for each");
    page.add(gallery.equal_time(leaders));
    page.heading("errors", "Where they are wrong");
    page.add(gallery.errors(leaders));
    page.heading("unbiased", "Do the unbiased techniques agree?");
    page.paragraph(agreement_sentence(agreement));
    page.add(agreement_table(agreement));
    add_techniques(page, results);
    add_end(page, results);
    return page;
}

} // namespace

void write_report(const Results& results, const Reference& reference, const StoredPictures& stored,
                  const std::filesystem::path& folder) {
    const Gallery gallery(results, reference, stored);
    const std::string scene = std::filesystem::path(results.scene).filename().string();
    const std::string html = fmt::format(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
        "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>What accuracy "
        "costs in {}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main>\n{}</section>\n</main>\n"
        "</body>\n</html>\n",
        escaped(scene), kReportCss, make_page(results, gallery).html());
    AtomicFile out(folder / "report.html");
    std::fwrite(html.data(), 1, html.size(), out.stream());
    out.commit();
}

} // namespace tyndall::study
