#include "scene/ply_header.h"

#include "core/error.h"
#include "scene/diagnostics.h"

#include <array>
#include <charconv>
#include <fmt/core.h>
#include <utility>

namespace tyndall {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> type_names = {{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

class HeaderReader {
  public:
    explicit HeaderReader(std::string_view bytes) : bytes_(bytes) {}
    PlyHeader read();

  private:
    [[noreturn]] void fail(std::string_view what) const {
        throw Error(ExitStatus::bad_input, fmt::format("line {}: {}", header_.lines, what));
    }
    std::string_view next_line();
    std::string_view next_word(std::string_view& line) const;
    void read_format(std::string_view line);
    void read_element(std::string_view line);
    void read_property(std::string_view line);
    PlyType read_type(std::string_view word) const;

    std::string_view bytes_;
    PlyHeader header_;
};

PlyHeader HeaderReader::read() {
    if (next_line() != "ply") fail("not a PLY file (expected \"ply\")");
    bool has_format = false;
    while (true) {
        std::string_view line = next_line();
        const std::string_view keyword = next_word(line);
        if (keyword == "format") {
            read_format(line);
            has_format = true;
        } else if (keyword == "element") {
            read_element(line);
        } else if (keyword == "property") {
            read_property(line);
        } else if (keyword == "end_header") {
            if (!has_format) fail("the header names no format");
            return std::move(header_);
        } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
            fail(fmt::format("unknown keyword {}", in_quotes(keyword)));
        }
    }
}

std::string_view HeaderReader::next_line() {
    ++header_.lines;
    const std::size_t end = bytes_.find('\n', header_.size);
    if (end == std::string_view::npos) {
        fail(header_.lines == 1 ? "not a PLY file (expected \"ply\")"
                                : "the file ends in the header (expected \"end_header\")");
    }
    std::string_view line = bytes_.substr(header_.size, end - header_.size);
    header_.size = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::string_view HeaderReader::next_word(std::string_view& line) const {
    const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
    const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
    const std::string_view word = line.substr(begin, end - begin);
    line.remove_prefix(end);
    return word;
}

void HeaderReader::read_format(std::string_view line) {
    const std::string_view name = next_word(line);
    if (name == "ascii") {
        header_.format = PlyFormat::ascii;
    } else if (name == "binary_little_endian") {
        header_.format = PlyFormat::little_endian;
    } else if (name == "binary_big_endian") {
        header_.format = PlyFormat::big_endian;
    } else {
        fail(fmt::format("unknown format {} (expected ascii, binary_little_endian or "
                         "binary_big_endian)",
                         in_quotes(name)));
    }
    const std::string_view version = next_word(line);
    if (version != "1.0") fail(fmt::format("version {} (expected 1.0)", in_quotes(version)));
}

void HeaderReader::read_element(std::string_view line) {
    PlyElement element;
    element.name = next_word(line);
    const std::string_view count = next_word(line);
    const auto result = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (element.name.empty() || result.ec != std::errc() ||
        result.ptr != count.data() + count.size()) {
        fail("bad element (expected \"element NAME COUNT\")");
    }
    for (const PlyElement& other : header_.elements) {
        if (other.name == element.name) {
            fail(fmt::format("element {} appears twice", in_quotes(element.name)));
        }
    }
    header_.elements.push_back(std::move(element));
}

void HeaderReader::read_property(std::string_view line) {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyProperty property;
    std::string_view type = next_word(line);
    property.is_list = type == "list";
    if (property.is_list) {
        property.count_type = read_type(next_word(line));
        if (property.count_type >= PlyType::float32) {
            fail("a list with a length that is no integer (expected an integer type)");
        }
        type = next_word(line);
    }
    property.type = read_type(type);
    property.name = next_word(line);
    if (property.name.empty()) fail("a property without a name");
    header_.elements.back().properties.push_back(std::move(property));
}

PlyType HeaderReader::read_type(std::string_view word) const {
    for (const auto& [name, type] : type_names) {
        if (word == name) return type;
    }
    fail(fmt::format("unknown type {} of a property", in_quotes(word)));
}

} // namespace

PlyHeader read_ply_header(std::string_view bytes) {
    return HeaderReader(bytes).read();
}

} // namespace tyndall
