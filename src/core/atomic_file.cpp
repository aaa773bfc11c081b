#include "core/atomic_file.h"

#include "core/error.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace tyndall {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw Error(ExitStatus::failed, "cannot write " + path.string() + ": " + reason);
}

/// What the path leads to: links stay links.
std::filesystem::path follow(const std::filesystem::path& path) {
    std::error_code ignored;
    std::filesystem::path end = std::filesystem::weakly_canonical(path, ignored);
    return end.empty() ? path : end;
}

/// A device or a pipe has no place beside it for a file that could replace it.
bool is_special(const std::filesystem::path& path) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

std::filesystem::path temporary_name(std::filesystem::path path) {
    if (is_special(path)) return path;
    return path += '.' + std::to_string(::getpid()).append(".tmp");
}

} // namespace

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(follow(path)), temporary_(temporary_name(path_)),
      stream_(std::fopen(temporary_.c_str(), "wb")) {
    if (!stream_) fail(path_, std::strerror(errno));
}

AtomicFile::~AtomicFile() {
    if (stream_) std::fclose(stream_);
    std::error_code ignored; // After commit() there is nothing to remove.
    if (temporary_ != path_) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
    const bool failed_before = std::ferror(stream_) != 0;
    // Only what is on the disk may replace the old file: a crash must not leave an empty one.
    const bool is_whole = temporary_ != path_;
    const bool flushed =
        std::fflush(stream_) == 0 && (!is_whole || ::fsync(::fileno(stream_)) == 0);
    const int flush_error = errno;
    const bool closed = std::fclose(std::exchange(stream_, nullptr)) == 0;
    if (!flushed) fail(path_, std::strerror(flush_error));
    if (!closed) fail(path_, std::strerror(errno));
    if (failed_before) fail(path_, "a write failed (the disk may be full)");
    if (!is_whole) return;
    std::error_code error;
    std::filesystem::rename(temporary_, path_, error);
    if (error) fail(path_, error.message());
}

} // namespace tyndall
