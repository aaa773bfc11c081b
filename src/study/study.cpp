#include "study/study.h"

#include "core/error.h"
#include "study/report.h"
#include "study/stored_pictures.h"

#include <algorithm>
#include <fmt/format.h>

namespace tyndall::study {
namespace {

constexpr double kReferenceShare = 0.25;  ///< Of the time.
constexpr double kEqualTimeShare = 0.125; ///< Of a technique's.

/// One study at work.
class Study {
  public:
    Study(const gpu::Context& context, const Scene& scene, const StudyOptions& options,
          const StudyHooks& hooks, Results about)
        : scene_(scene), options_(options), hooks_(hooks), results_(std::move(about)),
          selected_(select_techniques(list_techniques(scene), options.techniques)),
          end_(options.start + seconds(options.budget_seconds - report_seconds())),
          runner_(context, scene,
                  {.deadline = end_,
                   .is_stopped = [this] { return look_up(); },
                   .processors = results_.processors}) {}

    Results run();

  private:
    static Clock::duration seconds(double s) {
        return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
    }
    /// What is kept back for the report.
    double report_seconds() const {
        const double budget = options_.budget_seconds;
        return std::min(0.25 * budget, 3 + 0.03 * budget);
    }
    double left() const { return std::chrono::duration<double>(end_ - Clock::now()).count(); }
    bool look_up();
    void resume();
    void find_reference();
    void measure(const Technique& technique, double share);
    double expected_seconds(const Technique& technique) const;

    const Scene& scene_;
    const StudyOptions& options_;
    const StudyHooks& hooks_;
    Results results_;
    std::vector<Technique> selected_;
    Clock::time_point end_;
    Runner runner_;
    Reference reference_;
    std::string at_; ///< What it is doing.
    bool is_stopped_ = false;
};

bool Study::look_up() {
    is_stopped_ = is_stopped_ || hooks_.is_stopped();
    hooks_.tell(fmt::format("{}, {:.0f} s left", at_, std::max(0.0, left())));
    return is_stopped_;
}

/// Takes over what the folder holds.
void Study::resume() {
    std::optional<Results> before = read_results(options_.folder);
    if (!before) return;
    const auto same = [&](const char* what, const auto& was, const auto& is) {
        if (was != is)
            throw Error(ExitStatus::bad_input,
                        fmt::format("{} holds a study of another {} ({}, not {}): name another "
                                    "folder, or remove that one",
                                    options_.folder.string(), what, was, is));
    };
    same("scene", before->sha256, results_.sha256);
    same("version", before->version, results_.version);
    same("device", before->device, results_.device);
    same("driver", before->driver, results_.driver);
    same("seed", before->seed, results_.seed);
    same("part of the picture", before->part, results_.part);
    same("depth", before->max_depth, results_.max_depth);
    same("reference", before->reference.file, results_.reference.file);
    if (options_.budget_seconds > 2 * before->budget_seconds) return;
    results_.techniques = std::move(before->techniques);
    results_.reference = std::move(before->reference);
    results_.budget_seconds = before->budget_seconds;
    results_.equal_time_seconds = before->equal_time_seconds;
}

void Study::find_reference() {
    const StoredPictures stored(options_.folder, scene_);
    at_ = "reference";
    if (!options_.reference.empty()) {
        reference_ = stored.read_reference(options_.reference);
        results_.reference.error = reference_.error();
    } else if (results_.reference.samples > 0) {
        reference_ = stored.read_reference(stored.reference_file());
    } else {
        reference_ = runner_.make_reference(kReferenceShare * left(), results_.reference);
        stored.write_reference(reference_);
    }
    if (!(reference_.power() > 0))
        throw Error(ExitStatus::failed, "the reference is black, or nothing but noise: there is "
                                        "nothing to measure errors against");
}

/// From the members of its series before it: marching takes as long as it has steps.
double Study::expected_seconds(const Technique& technique) const {
    double expected = 0;
    for (const TechniqueResult& t : results_.techniques) {
        const double steps = technique.parameter / t.parameter;
        if (technique.family != Family::marching || t.series != technique.series || steps <= 1)
            continue;
        if (!t.is_measured() && t.first_seconds > 0) expected = t.first_seconds * steps;
        // With fewer, the rest of the path counts as much.
        if (t.is_measured() && t.parameter >= 16)
            expected = t.last().clock_seconds / t.last().samples * steps;
    }
    return expected;
}

void Study::measure(const Technique& technique, double share) {
    Measurement m = runner_.measure(technique, reference_,
                                    {.seconds = share,
                                     .equal_time = results_.equal_time_seconds,
                                     .expected = expected_seconds(technique)});
    if (m.is_interrupted) return;
    if (m.result.is_measured())
        StoredPictures(options_.folder, scene_).write(technique.name, m.mean, m.equal_time);
    results_.techniques.push_back(std::move(m.result));
    write_results(results_, options_.folder);
}

Results Study::run() {
    std::filesystem::create_directories(options_.folder / "images");
    resume();
    find_reference();
    std::vector<const Technique*> todo;
    for (const Technique& technique : selected_)
        if (!results_.find(technique.name)) todo.push_back(&technique);
    if (results_.equal_time_seconds == 0)
        results_.equal_time_seconds =
            kEqualTimeShare * left() / static_cast<double>(std::max<std::size_t>(1, todo.size()));
    write_results(results_, options_.folder);
    for (std::size_t i = 0; i < todo.size() && !is_stopped_ && left() > 0; ++i) {
        at_ = fmt::format("{} of {}: {}", i + 1, todo.size(), todo[i]->name);
        measure(*todo[i], left() / static_cast<double>(todo.size() - i));
    }
    at_ = "report";
    hooks_.tell(at_);
    results_.is_complete =
        std::all_of(selected_.begin(), selected_.end(), [&](const Technique& technique) {
            return results_.find(technique.name) != nullptr;
        });
    write_results(results_, options_.folder);
    write_report(results_, reference_, StoredPictures(options_.folder, scene_), options_.folder);
    return std::move(results_);
}

} // namespace

Results run_study(const gpu::Context& context, const Scene& scene, const StudyOptions& options,
                  const StudyHooks& hooks, Results about) {
    return Study(context, scene, options, hooks, std::move(about)).run();
}

} // namespace tyndall::study
