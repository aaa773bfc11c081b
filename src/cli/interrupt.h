/// Ctrl-C and termination, turned into a question.
#pragma once

namespace tyndall::cli {

/// From now on the first SIGINT or SIGTERM only sets a flag; the second ends the program at once
/// with status 130.
void watch_interrupts();

bool was_interrupted();

} // namespace tyndall::cli
