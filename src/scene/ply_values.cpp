#include "scene/ply_values.h"

#include "core/error.h"
#include "scene/diagnostics.h"
#include "scene/numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/core.h>

namespace tyndall {
namespace {

[[noreturn]] void fail(const std::string& what) {
    throw Error(ExitStatus::bad_input, what);
}

} // namespace

double PlyValues::read(PlyType type) {
    return format_ == PlyFormat::ascii ? read_ascii() : read_binary(type);
}

std::size_t PlyValues::read_length(PlyType type) {
    const double length = read(type);
    if (length < 0 || length != std::floor(length)) {
        fail(fmt::format("a list with the length {}", length));
    }
    if (length > static_cast<double>(rest_.size())) {
        fail(fmt::format("a list of {} values, with {} bytes left in the file", length,
                         rest_.size()));
    }
    return static_cast<std::size_t>(length);
}

std::string PlyValues::place() const {
    return format_ == PlyFormat::ascii ? fmt::format(", line {}", line_) : "";
}

template<typename T>
T PlyValues::take() {
    if (rest_.size() < sizeof(T)) fail("the file is cut off");
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    const bool is_native =
        (format_ == PlyFormat::little_endian) == (std::endian::native == std::endian::little);
    if (!is_native) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
}

double PlyValues::read_ascii() {
    constexpr std::string_view space = " \t\r\n";
    const std::size_t begin = std::min(rest_.find_first_not_of(space), rest_.size());
    line_ +=
        static_cast<int>(std::count(rest_.begin(), rest_.begin() + static_cast<long>(begin), '\n'));
    rest_.remove_prefix(begin);
    if (rest_.empty()) fail("the file is cut off");
    const std::string_view word = rest_.substr(0, rest_.find_first_of(space));
    rest_.remove_prefix(word.size());
    if (const std::optional<double> value = parse_number(word)) return *value;
    fail(fmt::format("expected a finite number, found {}", in_quotes(word)));
}

double PlyValues::read_binary(PlyType type) {
    switch (type) {
    case PlyType::int8:
        return take<std::int8_t>();
    case PlyType::uint8:
        return take<std::uint8_t>();
    case PlyType::int16:
        return take<std::int16_t>();
    case PlyType::uint16:
        return take<std::uint16_t>();
    case PlyType::int32:
        return take<std::int32_t>();
    case PlyType::uint32:
        return take<std::uint32_t>();
    case PlyType::float32:
        return static_cast<double>(take<float>());
    case PlyType::float64:
        return take<double>();
    }
    fail("unknown type");
}

} // namespace tyndall
