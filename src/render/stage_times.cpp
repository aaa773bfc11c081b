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
    }
}

void StageTimes::take_in(const shared::Control& control) {
    for (std::size_t i = 0; i < list_.size(); ++i) {
        const std::uint32_t queue = stages_[i]->queue;
        if (stages_[i]->input == StageInput::queue) // modulo 2^32
            list_[i].paths += control.queue_total[queue] - seen_queues_[queue];
        if (stages_[i]->input == StageInput::slots)
            list_[i].paths += std::uint64_t{control.slot_rounds - seen_rounds_} * slots_;
    }
    std::copy_n(control.queue_total, seen_queues_.size(), seen_queues_.begin());
    seen_rounds_ = control.slot_rounds;
}

} // namespace tyndall
