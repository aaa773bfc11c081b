#include "study/runs.h"

#include <sys/resource.h>

namespace tyndall::study {
namespace {

Picture to_picture(const std::vector<glm::dvec4>& sums) {
    Picture picture(sums.size(), glm::dvec3(0));
    for (std::size_t i = 0; i < sums.size(); ++i)
        if (sums[i].w != 0) picture[i] = glm::dvec3(sums[i]) / sums[i].w;
    return picture;
}

} // namespace

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double Limits::work_seconds() const {
    if (processors == 0)
        return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return (seconds(usage.ru_utime) + seconds(usage.ru_stime)) / processors;
}

Outcome Runs::render(std::uint32_t range, std::uint32_t first_sample, std::uint32_t end_sample) {
    bool is_stopped = false;
    const std::uint32_t begin = range * range::length;
    const std::uint32_t got =
        renderer_.render(begin + first_sample, begin + end_sample, [&](const Progress&) {
            is_stopped = is_stopped || limits_.is_stopped();
            return !is_stopped && Clock::now() < limits_.deadline;
        });
    for (std::size_t kind = 0; kind < kHealthNames.size(); ++kind)
        if (renderer_.health()[kind] > 0) health_[kHealthNames[kind]] += renderer_.health()[kind];
    if (is_stopped) return Outcome::stopped;
    return got == end_sample - first_sample ? Outcome::done : Outcome::too_slow;
}

Outcome Runs::extend(std::uint32_t first_range, std::uint32_t end, double allowed_seconds) {
    std::vector<Sums> slices;
    const double work = limits_.work_seconds();
    const Clock::time_point start = Clock::now();
    for (std::uint32_t run = 0; run < kRuns; ++run) {
        const Outcome outcome = render(first_range + run, samples_, end);
        if (outcome != Outcome::done) return outcome;
        slices.push_back(renderer_.read_sums());
        if (run == 0 && kRuns * seconds_since(start) > allowed_seconds) return Outcome::too_slow;
    }
    seconds_ += (limits_.work_seconds() - work) / kRuns;
    clock_seconds_ += seconds_since(start) / kRuns;
    slice_.clear();
    for (std::uint32_t run = 0; run < kRuns; ++run) {
        slice_.push_back(to_picture(slices[run]));
        sums_[run].resize(slices[run].size(), glm::dvec4(0));
        for (std::size_t i = 0; i < slices[run].size(); ++i)
            sums_[run][i] += slices[run][i];
    }
    samples_ = end;
    return Outcome::done;
}

std::vector<Picture> Runs::pictures() const {
    std::vector<Picture> result;
    for (const Sums& sums : sums_)
        result.push_back(to_picture(sums));
    return result;
}

Picture Runs::film() {
    return to_picture(renderer_.read_sums());
}

} // namespace tyndall::study
