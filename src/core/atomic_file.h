/// Files that are written as a whole or not at all.
#pragma once

#include <cstdio>
#include <filesystem>

namespace tyndall {

/// A file that is written under a temporary name in the same folder. commit() gives it its name;
/// until then, and if anything fails, whatever had that name before stays as it was. A symbolic
/// link is followed; what is no file (a pipe, /dev/stdout) is written to at once.
class AtomicFile {
  public:
    /// @throws Error failed: "cannot write FILE: reason".
    explicit AtomicFile(std::filesystem::path path);
    ~AtomicFile(); ///< Without commit(): removes the temporary file.
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    std::FILE* stream() const { return stream_; }
    /// Closes, checks that every byte was taken, and renames. Call it once, last.
    /// @throws Error failed: "cannot write FILE: reason", also if an earlier write failed.
    void commit();

  private:
    std::filesystem::path path_;
    std::filesystem::path temporary_;
    std::FILE* stream_;
};

} // namespace tyndall
