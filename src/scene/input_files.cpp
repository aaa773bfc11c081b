#include "scene/input_files.h"

#include "core/error.h"
#include "scene/diagnostics.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/core.h>
#include <sha2.h>
#include <zlib.h>

namespace tyndall {
namespace {

constexpr std::size_t chunk_size = 1 << 18;

[[noreturn]] void cannot_read(const std::filesystem::path& file, std::string_view why) {
    throw Error(ExitStatus::bad_input,
                fmt::format("cannot read {}: {}", file_in_quotes(file.string()), why));
}

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

struct InflateCloser {
    void operator()(z_stream* stream) const { inflateEnd(stream); }
};

} // namespace

struct InputFiles::Digest {
    SHA2_CTX context{};
};

InputFiles::InputFiles(const std::filesystem::path& main_file, std::uint64_t max_bytes,
                       OnFile on_file)
    : main_folder_(main_file.parent_path()), max_bytes_(max_bytes), on_file_(std::move(on_file)),
      digest_(std::make_unique<Digest>()) {
    SHA256Init(&digest_->context);
}

InputFiles::~InputFiles() = default;

std::filesystem::path InputFiles::resolve(const std::string& name,
                                          const std::filesystem::path& named_in) const {
    const std::filesystem::path path(name);
    if (path.is_absolute()) return path;
    std::error_code ignored;
    const std::filesystem::path from_main = main_folder_ / path;
    if (std::filesystem::exists(from_main, ignored)) return from_main;
    const std::filesystem::path from_sibling = named_in.parent_path() / path;
    return std::filesystem::exists(from_sibling, ignored) ? from_sibling : from_main;
}

std::string InputFiles::read(const std::filesystem::path& file) {
    if (++files_ > max_files) cannot_read(file, fmt::format("more than {} files", max_files));
    std::error_code ignored;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(file, ignored);
    counts_ = counted_.insert(whole.empty() ? file : whole).second;
    std::string bytes = read_bytes(file);
    SHA256Update(&digest_->context, reinterpret_cast<const std::uint8_t*>(bytes.data()),
                 bytes.size());
    if (on_file_) on_file_(file, bytes.size());
    return file.extension() == ".gz" ? unpack(bytes, file) : bytes;
}

std::string InputFiles::sha256() const {
    SHA2_CTX context = digest_->context;
    std::array<char, SHA256_DIGEST_STRING_LENGTH> hex{};
    SHA256End(&context, hex.data());
    return hex.data();
}

void InputFiles::count_bytes(std::uint64_t bytes, const std::filesystem::path& file) {
    if (counts_) bytes_ += bytes;
    if (bytes_ > max_bytes_) {
        cannot_read(file,
                    fmt::format("the files of the scene have more than {} bytes", max_bytes_));
    }
}

std::string InputFiles::read_bytes(const std::filesystem::path& file) {
    std::error_code status_error;
    const std::filesystem::file_status status = std::filesystem::status(file, status_error);
    if (!std::filesystem::exists(status)) cannot_read(file, "no such file");
    if (!std::filesystem::is_regular_file(status) && !std::filesystem::is_fifo(status)) {
        cannot_read(file, "not a file");
    }
    const std::unique_ptr<std::FILE, FileCloser> stream(std::fopen(file.c_str(), "rb"));
    if (!stream) cannot_read(file, std::strerror(errno));
    std::string bytes;
    while (true) {
        const std::size_t old_size = bytes.size();
        bytes.resize(old_size + chunk_size);
        const std::size_t count = std::fread(bytes.data() + old_size, 1, chunk_size, stream.get());
        bytes.resize(old_size + count);
        count_bytes(count, file);
        if (std::ferror(stream.get())) cannot_read(file, std::strerror(errno));
        if (count < chunk_size) return bytes;
    }
}

std::string InputFiles::unpack(const std::string& packed, const std::filesystem::path& file) {
    constexpr int gzip_window_bits = 15 + 16; // zlib's way to ask for the gzip format
    z_stream stream{};
    if (inflateInit2(&stream, gzip_window_bits) != Z_OK) cannot_read(file, "out of memory");
    const std::unique_ptr<z_stream, InflateCloser> closer(&stream);
    std::string bytes;
    std::size_t consumed = 0;
    int status = Z_OK;
    while (consumed < packed.size()) {
        const std::size_t old_size = bytes.size();
        bytes.resize(old_size + chunk_size);
        const std::size_t input = std::min(packed.size() - consumed, chunk_size);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + consumed));
        stream.avail_in = static_cast<uInt>(input);
        stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + old_size);
        stream.avail_out = static_cast<uInt>(chunk_size);
        status = inflate(&stream, Z_NO_FLUSH);
        consumed += input - stream.avail_in;
        bytes.resize(old_size + chunk_size - stream.avail_out);
        count_bytes(chunk_size - stream.avail_out, file);
        if (status == Z_STREAM_END) {
            inflateReset(&stream); // a gzip file may have several members
        } else if (status != Z_OK) {
            cannot_read(file, "not a valid gzip file");
        }
    }
    if (status != Z_STREAM_END) cannot_read(file, "the gzip file is cut off");
    return bytes;
}

} // namespace tyndall
