#include "volume/vdb_lengths.h"

#include "core/error.h"

#include <cstdint>
#include <cstring>

namespace tyndall {
namespace {

/// Source: openvdb/io/Archive.cc, GridDescriptor.cc and MetaMap.cc of OpenVDB 10.
class Walk {
  public:
    explicit Walk(std::string_view bytes) : bytes_(bytes) {}

    void file() {
        seek(8); // the magic number
        const auto version = take<std::uint32_t>();
        constexpr std::uint32_t first_version = 222;
        if (version < first_version) return;
        skip(2 * 4); // version of the library
        const bool has_offsets = take<char>() != 0;
        skip(36); // UUID
        metadata();
        const auto grids = take<std::int32_t>();
        for (std::int32_t i = 0; has_offsets && i < grids; ++i) {
            const std::uint64_t begin = at_, next = grid();
            if (next <= begin) refuse(); // else one entry could stand for 2^31
            seek(next);
        }
    }

  private:
    /// One entry of the table, and the start of its grid. Returns where the next entry is.
    std::uint64_t grid() {
        for (int text = 0; text < 3; ++text) // name, type, the grid whose voxels it shares
            skip(take<std::uint32_t>());
        const auto begin = take<std::uint64_t>();
        skip(8); // the voxels
        const auto end = take<std::uint64_t>();
        seek(begin);
        skip(4); // how it is packed
        metadata();
        skip(take<std::uint32_t>()); // name of the transform
        return end;
    }
    void metadata() {
        const auto count = take<std::uint32_t>();
        for (std::uint32_t i = 0; i < count; ++i)
            for (int text = 0; text < 3; ++text) // name, type, value
                skip(take<std::uint32_t>());
    }

    template<typename T>
    T take() {
        const std::uint64_t from = at_;
        skip(sizeof(T));
        T value;
        std::memcpy(&value, bytes_.data() + from, sizeof(T));
        return value;
    }
    void skip(std::uint64_t count) {
        if (count > bytes_.size() - at_) refuse();
        at_ += count;
    }
    void seek(std::uint64_t to) {
        if (to > bytes_.size()) refuse();
        at_ = to;
    }
    [[noreturn]] static void refuse() {
        throw Error(ExitStatus::bad_input, "the OpenVDB file is cut off or damaged");
    }

    std::string_view bytes_;
    std::uint64_t at_ = 0;
};

} // namespace

void check_vdb_lengths(std::string_view bytes) {
    Walk(bytes).file();
}

} // namespace tyndall
