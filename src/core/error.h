/// Errors: how the library says that something went wrong.
///
/// Bugs assert (TYNDALL_ASSERT). Bad input and a bad environment throw Error, which carries the
/// exit status of the program; it is caught once, in main. Expected absence is std::optional.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace tyndall {

/// Exit status of the program, a contract with scripts.
enum class ExitStatus {
    done = 0,
    failed = 1,       ///< The render failed: device lost, output not written, health limit passed.
    bad_input = 2,    ///< Bad usage or bad scene.
    no_device = 3,    ///< No usable Vulkan device.
    interrupted = 130 ///< Interrupted; the image so far was written.
};

/// A place in a scene file. Lines and columns count from 1; line 0 means "the file as a whole".
struct SourceLocation {
    std::shared_ptr<const std::string> file;
    int line = 0;
    int column = 0;
};

/// "file:line:column", or "file" without a line, or "" without a file.
std::string to_string(const SourceLocation& where);

/// Something that the user or the machine got wrong. what() is complete: it names what failed and
/// why.
class Error : public std::runtime_error {
  public:
    Error(ExitStatus status, const std::string& what) : std::runtime_error(what), status_(status) {}
    ExitStatus status() const { return status_; }

  private:
    ExitStatus status_;
};

/// One or more errors in scene files, one line each: "file:line:column: error: what (expected
/// ...)".
class SceneError : public Error {
  public:
    explicit SceneError(std::vector<std::string> messages);
    const std::vector<std::string>& messages() const { return messages_; }

  private:
    std::vector<std::string> messages_;
};

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

} // namespace tyndall

/// States an invariant of our own code; checked in the dev and asan presets.
#ifdef TYNDALL_ASSERTIONS
#define TYNDALL_ASSERT(condition)                                                                  \
    ((condition) ? void(0) : ::tyndall::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define TYNDALL_ASSERT(condition) void(0)
#endif
