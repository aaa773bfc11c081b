/// The files that a scene consists of: finding, reading, unpacking and fingerprinting them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>

namespace tyndall {

/// Reads files and keeps the account: how much was read, and the SHA-256 of all of it.
class InputFiles {
  public:
    static constexpr int max_files = 1'000'000;
    using OnFile = std::function<void(const std::filesystem::path&, std::uint64_t bytes)>;

    /// @param main_file  the scene file; names in it and in the files it includes start at its
    /// folder.
    /// @param max_bytes  most bytes that all files may have together, packed and unpacked ones
    /// counted, each file once.
    /// @param on_file    called with each file and its length once it is read; may be empty.
    InputFiles(const std::filesystem::path& main_file, std::uint64_t max_bytes,
               OnFile on_file = {});
    ~InputFiles();
    InputFiles(const InputFiles&) = delete;
    InputFiles& operator=(const InputFiles&) = delete;

    /// The file that a name in a scene means. Relative names start at the folder of the main file
    /// (pbrt's rule) or, if there is no such file, at the folder of the file with the name in it.
    std::filesystem::path resolve(const std::string& name,
                                  const std::filesystem::path& named_in) const;

    /// The bytes of a file, unpacked if its name ends in ".gz".
    /// @throws Error "cannot read ...: why"; without a place, the caller adds it.
    std::string read(const std::filesystem::path& file);

    /// Hex digest over the bytes of all files as they are on disk, in the order of read().
    std::string sha256() const;

  private:
    struct Digest;
    void count_bytes(std::uint64_t bytes, const std::filesystem::path& file);
    std::string read_bytes(const std::filesystem::path& file);
    std::string unpack(const std::string& packed, const std::filesystem::path& file);

    std::filesystem::path main_folder_;
    std::uint64_t max_bytes_;
    OnFile on_file_;
    std::uint64_t bytes_ = 0;
    std::set<std::filesystem::path> counted_;
    bool counts_ = true; ///< The file that is read now is one that was not read before.
    int files_ = 0;
    std::unique_ptr<Digest> digest_;
};

} // namespace tyndall
