#include "cli/interrupt.h"

#include "core/error.h"

#include <atomic>
#include <csignal>
#include <unistd.h>

namespace tyndall::cli {
namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int) {
    if (interrupted.exchange(true)) _exit(static_cast<int>(ExitStatus::interrupted));
}

} // namespace

void watch_interrupts() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool was_interrupted() {
    return interrupted;
}

} // namespace tyndall::cli
