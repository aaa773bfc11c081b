/// The header of a PLY file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool is_list = false;
    PlyType count_type = PlyType::uint8; ///< Of a list.
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0; ///< As claimed; may be anything.
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0; ///< Bytes up to the first element.
    int lines = 0;
};

/// @throws Error "line N: what is wrong"; the caller adds the file.
PlyHeader read_ply_header(std::string_view bytes);

} // namespace tyndall
