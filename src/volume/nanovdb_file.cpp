#include "volume/nanovdb_file.h"

#include "core/error.h"
#include "volume/nanovdb_tree.h"

#include <algorithm>
#include <blosc.h>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <new>
#include <zlib.h>

namespace tyndall {
namespace {

constexpr std::uint64_t magic = 0x304244566f6e614eull;       // "NanoVDB0"
constexpr std::uint64_t later_magic = 0x324244566f6e614eull; // "NanoVDB2", of files since 32.6
constexpr std::uint32_t major_version = 32;

enum class Codec : std::uint16_t { none, zip, blosc };

/// What a segment begins with; gridCount times GridEntry and a name follow, then the grids.
struct SegmentHeader {
    std::uint64_t magic;
    std::uint32_t version; ///< 11 bits major, 11 minor, 10 patch.
    std::uint16_t grid_count;
    Codec codec;
};
static_assert(sizeof(SegmentHeader) == 16);

struct GridEntry {
    std::uint64_t grid_size; ///< Unpacked.
    std::uint64_t file_size; ///< As it is in the file.
    std::uint64_t name_key, voxel_count;
    std::uint32_t grid_type, grid_class;
    double world_box[6];
    std::int32_t index_box[6];
    double voxel_size[3];
    std::uint32_t name_size; ///< With a 0 at the end.
    std::uint32_t node_counts[4], tile_counts[3];
    std::uint16_t codec, padding;
    std::uint32_t version;
};
static_assert(sizeof(GridEntry) == 176);

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ExitStatus::bad_input, what);
}

/// Takes pieces from the front of some bytes.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    bool is_at_end() const { return bytes_.empty(); }
    std::string_view take(std::uint64_t count, const char* what) {
        if (count > bytes_.size()) {
            refuse(fmt::format("the NanoVDB file is cut off: {} bytes of {} and {} are left", count,
                               what, bytes_.size()));
        }
        const std::string_view piece = bytes_.substr(0, count);
        bytes_.remove_prefix(count);
        return piece;
    }
    template<typename T>
    T take(const char* what) {
        T value;
        std::memcpy(&value, take(sizeof(T), what).data(), sizeof(T));
        return value;
    }

  private:
    std::string_view bytes_;
};

struct PackedGrid {
    std::string name;
    Codec codec = Codec::none;
    std::uint64_t size = 0; ///< Unpacked.
    std::string_view bytes;
};

std::vector<PackedGrid> list_grids(std::string_view file) {
    std::vector<PackedGrid> grids;
    Reader reader(file);
    while (!reader.is_at_end()) {
        const auto header = reader.take<SegmentHeader>("a segment's header");
        if (header.magic != magic && header.magic != later_magic)
            refuse("the NanoVDB file is damaged: a segment does not begin as one");
        if (header.version >> 21 != major_version) {
            refuse(
                fmt::format("the file is of version {} of NanoVDB (expected {}: convert it anew)",
                            header.version >> 21, major_version));
        }
        if (header.codec > Codec::blosc) refuse("the NanoVDB file is packed in an unknown way");
        std::vector<GridEntry> entries;
        const std::size_t first = grids.size();
        for (int i = 0; i < header.grid_count; ++i) {
            const auto entry = reader.take<GridEntry>("a grid's description");
            const std::string_view name = reader.take(entry.name_size, "a grid's name");
            grids.push_back(
                {std::string(name.substr(0, name.find('\0'))), header.codec, entry.grid_size, {}});
            entries.push_back(entry);
        }
        for (std::size_t i = 0; i < entries.size(); ++i)
            grids[first + i].bytes = reader.take(entries[i].file_size, "a grid");
    }
    return grids;
}

struct AlignedDelete {
    void operator()(std::byte* bytes) const { ::operator delete[](bytes, std::align_val_t{64}); }
};
using AlignedBytes = std::unique_ptr<std::byte[], AlignedDelete>;

AlignedBytes allocate(std::uint64_t size) {
    return AlignedBytes(static_cast<std::byte*>(::operator new[](size, std::align_val_t{64})));
}

[[noreturn]] void refuse_size(const PackedGrid& grid) {
    refuse(fmt::format(
        "grid \"{}\": damaged: its {} bytes do not unpack to the {} that the file tells of",
        grid.name, grid.bytes.size(), grid.size));
}

AlignedBytes unpack_zip(const PackedGrid& grid) {
    constexpr std::uint64_t largest_ratio = 1032; // of deflate: 258 bytes from 2 bits
    Reader reader(grid.bytes);
    const std::string_view packed =
        reader.take(reader.take<std::uint64_t>("a packed size"), "a packed grid");
    if (grid.size / largest_ratio > packed.size()) refuse_size(grid);
    AlignedBytes bytes = allocate(grid.size);
    uLongf size = grid.size;
    const int status = uncompress(reinterpret_cast<Bytef*>(bytes.get()), &size,
                                  reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    if (status != Z_OK || size != grid.size) refuse_size(grid);
    return bytes;
}

AlignedBytes unpack_blosc(const PackedGrid& grid) {
    // Chunks of up to 1 GiB, each behind its packed size.
    std::vector<std::string_view> chunks;
    std::uint64_t total = 0;
    for (Reader reader(grid.bytes); !reader.is_at_end();) {
        const std::string_view chunk =
            reader.take(reader.take<std::uint64_t>("a packed size"), "a packed chunk");
        std::size_t size = 0;
        if (blosc_cbuffer_validate(chunk.data(), chunk.size(), &size) != 0) refuse_size(grid);
        total += size;
        chunks.push_back(chunk);
    }
    if (total != grid.size) refuse_size(grid);
    AlignedBytes bytes = allocate(grid.size);
    std::uint64_t done = 0;
    for (const std::string_view chunk : chunks) {
        const int size =
            blosc_decompress_ctx(chunk.data(), bytes.get() + done, grid.size - done, 1);
        if (size <= 0) refuse_size(grid);
        done += static_cast<std::uint64_t>(size);
    }
    if (done != grid.size) refuse_size(grid);
    return bytes;
}

AlignedBytes unpack(const PackedGrid& grid) {
    if (grid.codec == Codec::zip) return unpack_zip(grid);
    if (grid.codec == Codec::blosc) return unpack_blosc(grid);
    if (grid.bytes.size() != grid.size) refuse_size(grid);
    AlignedBytes bytes = allocate(grid.size);
    std::memcpy(bytes.get(), grid.bytes.data(), grid.size);
    return bytes;
}

} // namespace

bool is_nanovdb(std::string_view bytes) {
    std::uint64_t start = 0;
    if (bytes.size() < sizeof(start)) return false;
    std::memcpy(&start, bytes.data(), sizeof(start));
    return start == magic || start == later_magic;
}

std::optional<Field> read_nanovdb(std::string_view file, const FieldRequest& request) {
    const std::vector<PackedGrid> grids = list_grids(file);
    const auto grid = std::find_if(grids.begin(), grids.end(),
                                   [&](const PackedGrid& g) { return g.name == request.name; });
    if (grid == grids.end()) {
        std::vector<std::string> names;
        for (const PackedGrid& g : grids)
            names.push_back(g.name);
        report_missing(request, names);
        return std::nullopt;
    }
    // Nodes of a quarter of a byte a voxel to eight, and tables over them.
    if (grid->size / 16 > request.max_voxels) {
        refuse_field(request,
                     fmt::format("{} bytes are too many (expected at most {}, for {} voxels)",
                                 grid->size, 16 * request.max_voxels, request.max_voxels));
    }
    const AlignedBytes bytes = unpack(*grid);
    const std::span<const std::byte> span(bytes.get(), grid->size);
    Field field = read_nanovdb_header(span, request);
    field.grid = assemble_grid(read_nanovdb_tree(span, request), request);
    return field;
}

} // namespace tyndall
