#include "render/renderer.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace tyndall {
namespace {

using shared::Control;
using Clock = std::chrono::steady_clock;

/// What one submission should take: short enough for watchdogs, Ctrl-C and progress.
constexpr double kSubmitSeconds = 0.04;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The result of make(), and how long it took.
template<typename Make>
auto timed(double& seconds, const Make& make) {
    const Clock::time_point start = Clock::now();
    auto result = make();
    seconds = seconds_since(start);
    return result;
}

} // namespace

/// One submission: while one runs, the next is recorded.
struct Renderer::Flight {
    Flight(const gpu::Context& context, std::size_t stage_count)
        : commands(context),
          control(context, "control readback", sizeof(Control), {.host_visible = true}),
          clock(context, static_cast<std::uint32_t>(stage_count) + 1) {}

    gpu::Commands commands;
    gpu::Buffer control;
    gpu::Timestamps clock;
    std::uint32_t rounds = 0;
};

Renderer::Renderer(const gpu::Context& context, const Scene& scene, const Tuning& tuning)
    : Renderer(context, scene, compute_effects(scene), tuning) {}

Renderer::Renderer(const gpu::Context& context, const Scene& scene, Effects effects,
                   const Tuning& tuning, std::span<const StageKind> kinds)
    : context_(&context), effects_(std::move(effects)),
      tables_(timed(build_seconds_, [&] { return make_scene_tables(scene, effects_); })),
      wavefront_(timed(compile_seconds_,
                       [&] { return Wavefront(context, tables_, effects_, tuning, kinds); })) {
    tables_.texels = {}; // on the device now
}

std::uint32_t Renderer::render(std::uint32_t first_sample, std::uint32_t end_sample,
                               const KeepGoing& keep_going) {
    if (first_sample >= end_sample)
        throw Error(ExitStatus::failed, "a render needs one sample per pixel or more");
    const std::uint32_t piece_log2_limit =
        shared::piece_log2_limit(wavefront_.features().geometry == shared::GEOMETRY_BVH);
    batches_ = {first_sample, end_sample, piece_log2_limit};
    contrasts_ = {};
    error_.reset();
    histogram_ = {};
    health_ = {};
    stage_times_ = {wavefront_.stages(), wavefront_.tuning().slots};
    folded_batches_ = contrasted_batches_ = batches_.first();
    look_batch_ = keep_going ? batches_.next_look(batches_.first()) : batches_.end();
    // Tickets are 32-bit words: an epoch has as many batches as they can number.
    const std::uint32_t per_epoch = std::max(1u, 0x7FFFFFFFu / tables_.push.pixel_count >>
                                                     (shared::BATCH_LOG2_LIMIT - piece_log2_limit));
    for (bool first_epoch = true; folded_batches_ < batches_.end(); first_epoch = false) {
        const std::uint32_t count = std::min(per_epoch, batches_.end() - folded_batches_);
        epoch_batch_ = folded_batches_;
        epoch_piece_ = folded_pieces_ = batches_.first_piece(epoch_batch_);
        health_.restart();
        stage_times_.restart();
        wavefront_.begin_epoch(epoch_piece_,
                               batches_.first_piece(epoch_batch_ + count) - epoch_piece_,
                               first_sample, end_sample, first_epoch);
        if (!run_epoch(count, keep_going)) break;
    }
    measure_error();
    return samples();
}

/// Pieces of the epoch that may be in the film before the next look.
std::uint32_t Renderer::fold_limit() const {
    return batches_.first_piece(look_batch_) - epoch_piece_;
}

void Renderer::submit(Flight& flight) {
    flight.commands.begin();
    flight.rounds = rounds_;
    // Each time another round, by a golden section (Weyl 1916): what follows a look or the end of
    // an epoch, or keeps time with submissions, is neither left out nor counted too often.
    timed_share_ = std::fmod(timed_share_ + 0.6180339887498949, 1.0);
    wavefront_.record_rounds(flight.commands, rounds_, fold_limit(), flight.clock,
                             static_cast<std::uint32_t>(timed_share_ * rounds_));
    wavefront_.record_readback(flight.commands, flight.control);
    flight.commands.submit();
}

/// Waits for a submission and takes in what it left.
void Renderer::land(Flight& flight) {
    flight.commands.wait();
    Control control;
    std::memcpy(&control, flight.control.mapped(), sizeof(control));
    take_in(control);
    stage_times_.take_in(control);
    stage_times_.add(flight.clock.intervals(), flight.rounds);
}

void Renderer::take_in(const Control& control) {
    // The last round's update_film has folded fold_count pieces on top of folded_pieces.
    folded_pieces_ = epoch_piece_ + control.folded_pieces + control.fold_count;
    while (folded_batches_ < batches_.end() &&
           batches_.first_piece(folded_batches_ + 1) <= folded_pieces_)
        ++folded_batches_;
    health_.take_in(control);
    epoch_share_ = control.next_ticket / double(tables_.push.pixel_count);
    samples_done_ = batches_.samples_before_piece(folded_pieces_);
    const std::uint32_t window = wavefront_.window(), pending = folded_pieces_ - epoch_piece_;
    for (std::uint32_t piece = pending; piece < pending + window; ++piece)
        samples_done_ += (batches_.samples_before_piece(epoch_piece_ + piece + 1) -
                          batches_.samples_before_piece(epoch_piece_ + piece)) *
                         (control.finished[piece % window] / double(tables_.push.pixel_count));
    if (epoch_batch_ == batches_.first())
        std::copy_n(control.sample_histogram, histogram_.size(), histogram_.begin());
}

/// Brings the film up to date: with all that is complete, up to the next look.
void Renderer::fold() {
    for (std::uint32_t before = ~0u; folded_pieces_ != before;) {
        before = folded_pieces_;
        wavefront_.fold(fold_limit());
        take_in(wavefront_.read_control());
    }
}

/// Takes in the error of the film, which must hold folded_batches_.
void Renderer::measure_error() {
    for (; contrasted_batches_ < folded_batches_; ++contrasted_batches_)
        contrasts_.add(contrasted_batches_, batches_.samples_of(contrasted_batches_));
    error_ =
        stats::estimate_error(contrasts_, wavefront_.read_error_sums(), tables_.push.pixel_count);
}

/// Samples begun of each pixel; between pieces, in proportion.
double Renderer::samples_begun(std::uint32_t batch_count) const {
    const std::uint32_t end = batches_.first_piece(epoch_batch_ + batch_count);
    const double pieces = std::min<double>(epoch_share_, end - epoch_piece_);
    const auto whole = epoch_piece_ + static_cast<std::uint32_t>(pieces);
    const double first = batches_.samples_before_piece(whole);
    return first +
           (batches_.samples_before_piece(whole + 1) - first) * (epoch_piece_ + pieces - whole);
}

/// Looks if it is time to, and asks whether to go on.
bool Renderer::ask(std::uint32_t batch_count, const KeepGoing& keep_going) {
    if (!keep_going) return true;
    const bool is_look = folded_batches_ == look_batch_;
    if (is_look) measure_error();
    const Progress progress{.samples = samples(),
                            .end_samples = batches_.samples_before(batches_.end()),
                            .begun = samples_begun(batch_count),
                            .done = samples_done_,
                            .error = error_,
                            .is_look = is_look,
                            .batches = folded_batches_ - batches_.first(),
                            .has_heavy_tail = stats::is_heavy_tail(tail_share())};
    const bool goes_on = keep_going(progress) || samples() == 0;
    // Who stops at a look gets what was looked at, though more may be complete.
    if (is_look && goes_on) look_batch_ = batches_.next_look(look_batch_);
    return goes_on;
}

/// Runs rounds until every batch of the epoch is in the film. False if told to stop before.
bool Renderer::run_epoch(std::uint32_t batch_count, const KeepGoing& keep_going) {
    const std::size_t stages = stage_times_.list().size();
    std::array<Flight, 2> flights{Flight(*context_, stages), Flight(*context_, stages)};
    submit(flights[0]);
    Clock::time_point last = Clock::now();
    for (std::size_t i = 0;; i ^= 1) {
        submit(flights[i ^ 1]);
        land(flights[i]);
        const bool is_done = folded_batches_ == epoch_batch_ + batch_count;
        const std::uint32_t look = look_batch_;
        if (!ask(batch_count, keep_going) || is_done) {
            land(flights[i ^ 1]);
            fold();
            return folded_batches_ == epoch_batch_ + batch_count;
        }
        // Twice as much or half as much at a time: one submission is no reliable measure. Small
        // pictures may have run out of work before a look: less at a time then, to see it sooner.
        const double seconds = seconds_since(last);
        last = Clock::now();
        if (look_batch_ != look) {
            rounds_ = std::max(rounds_ / 4, 1u);
            continue;
        }
        if (seconds < 0.5 * kSubmitSeconds) rounds_ = std::min(rounds_ * 2, 1024u);
        if (seconds > 2.0 * kSubmitSeconds) rounds_ = std::max(rounds_ / 2, 1u);
    }
}

void Renderer::each_film_pixel(const std::function<void(std::size_t, const glm::vec4*)>& visit) {
    fold();
    constexpr std::uint32_t chunk = 1u << 18;
    std::vector<glm::vec4> texels;
    for (std::uint32_t first = 0; first < tables_.push.pixel_count; first += chunk) {
        const std::uint32_t count = std::min(chunk, tables_.push.pixel_count - first);
        wavefront_.read_film(first, count, texels);
        for (std::uint32_t i = 0; i < count; ++i)
            visit(std::size_t{first} + i, &texels[std::size_t{i} * shared::FILM_TEXELS]);
    }
}

std::vector<glm::dvec4> Renderer::read_sums() {
    std::vector<glm::dvec4> sums(tables_.push.pixel_count);
    each_film_pixel([&](std::size_t pixel, const glm::vec4* film) {
        sums[pixel] =
            glm::dvec4(film[shared::FILM_SUM]) + glm::dvec4(film[shared::FILM_COMPENSATION]);
    });
    return sums;
}

Image Renderer::read_film() {
    const auto width = static_cast<int>(tables_.push.width);
    const double unit = tables_.film_unit * tables_.film_unit; // of squares
    constexpr double most = std::numeric_limits<float>::max();
    Image image(width, static_cast<int>(tables_.push.pixel_count) / width,
                {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
    each_film_pixel([&](std::size_t pixel, const glm::vec4* film) {
        const glm::dvec4 sum =
            glm::dvec4(film[shared::FILM_SUM]) + glm::dvec4(film[shared::FILM_COMPENSATION]);
        if (sum.w == 0) return;
        const double batches = folded_batches_ - batches_.first();
        const double divisor = batches > 1 ? (batches - 1) * samples() : 0;
        for (int c = 0; c < 3; ++c) {
            image.pixels[pixel * 6 + c] = static_cast<float>(sum[c] / sum.w);
            if (divisor > 0)
                image.pixels[pixel * 6 + 3 + c] = static_cast<float>(
                    std::min(film[shared::FILM_RESIDUAL][c] / divisor / unit, most));
        }
    });
    measure_error();
    return image;
}

} // namespace tyndall
