#include "render/stage_times.h"

#include <algorithm>

namespace tyndall {

StageTimes::StageTimes(std::vector<const StageKind*> stages, std::uint32_t slots)
    : stages_(std::move(stages)), slots_(slots) {
    for (const StageKind* stage : stages_)
        list_.push_back({.name = stage->name});
}

void StageTimes::add(const std::vector<double>& seconds, std::uint32_t rounds) {
    for (std::size_t i = 0; i < list_.size(); ++i) {
        list_[i].dispatches += rounds;
        list_[i].seconds += seconds[i] * rounds;
        if (stages_[i]->input == StageInput::slots)
            list_[i].paths += std::uint64_t{rounds} * slots_;
    }
}

void StageTimes::take_in(const shared::Control& control) {
    for (std::size_t i = 0; i < list_.size(); ++i) {
        if (stages_[i]->input != StageInput::queue) continue;
        const std::uint32_t queue = stages_[i]->queue;
        list_[i].paths += control.queue_total[queue] - seen_[queue]; // modulo 2^32
    }
    std::copy_n(control.queue_total, seen_.size(), seen_.begin());
}

} // namespace tyndall
