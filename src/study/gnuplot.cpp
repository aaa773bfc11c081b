#include "study/gnuplot.h"

#include "core/error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ; // NOLINT: POSIX has it in no header

namespace tyndall::study {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// A file without a name: a pipe could fill up, and a name could be anybody's.
File scratch_file() {
    File file(std::tmpfile(), std::fclose);
    if (!file)
        throw Error(ExitStatus::failed,
                    std::string("cannot make a temporary file: ") + std::strerror(errno));
    return file;
}

std::string contents(std::FILE* file) {
    std::string text;
    std::rewind(file);
    char buffer[1 << 14];
    while (const std::size_t count = std::fread(buffer, 1, sizeof(buffer), file))
        text.append(buffer, count);
    return text;
}

} // namespace

std::string run_gnuplot(const std::string& script) {
    const File in = scratch_file(), out = scratch_file(), errors = scratch_file();
    std::fwrite(script.data(), 1, script.size(), in.get());
    std::fflush(in.get());
    std::rewind(in.get());
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, fileno(in.get()), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(errors.get()), STDERR_FILENO);
    char program[] = "gnuplot", no_settings[] = "-d";
    char* arguments[] = {program, no_settings, nullptr};
    pid_t process = 0;
    const int problem = posix_spawnp(&process, program, &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (problem == ENOENT)
        throw Error(ExitStatus::failed, "the report needs gnuplot, which is not installed: apt "
                                        "install gnuplot-nox (results.json and results.csv are "
                                        "written; the same command will then make the report)");
    if (problem != 0)
        throw Error(ExitStatus::failed,
                    std::string("cannot run gnuplot: ") + std::strerror(problem));
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw Error(ExitStatus::failed, "gnuplot failed: " + contents(errors.get()));
    return contents(out.get());
}

} // namespace tyndall::study
