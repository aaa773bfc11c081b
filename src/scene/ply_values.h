/// The values of a PLY file, whatever its format.
#pragma once

#include "scene/ply_header.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace tyndall {

/// The values behind the header of a PLY file, one after the other.
class PlyValues {
  public:
    /// @param bytes  the whole file; must outlive this.
    PlyValues(std::string_view bytes, const PlyHeader& header)
        : rest_(bytes.substr(header.size)), format_(header.format), line_(header.lines + 1) {}

    /// The next value. Infinite ones and NaN come from binary files only.
    /// @throws Error if the file is cut off or has no number there.
    double read(PlyType type);

    /// The length of a list: at most the number of bytes left.
    /// @throws Error as read, or if that is no length.
    std::size_t read_length(PlyType type);

    /// ", line N" in an ascii file, else nothing.
    std::string place() const;

  private:
    double read_ascii();
    double read_binary(PlyType type);
    template<typename T>
    T take();

    std::string_view rest_;
    PlyFormat format_;
    int line_;
};

} // namespace tyndall
