// The only file that includes OpenVDB, which takes long to compile.
#include "volume/vdb_file.h"

#include "core/error.h"
#include "volume/field_assembly.h"
#include "volume/vdb_lengths.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <istream>
#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>
#include <openvdb/openvdb.h>
#include <streambuf>

namespace tyndall {
namespace {

/// Reads from memory, anywhere.
class MemoryBuffer : public std::streambuf {
  public:
    explicit MemoryBuffer(std::string_view bytes) {
        char* begin = const_cast<char*>(bytes.data()); // which setg wants, and nothing writes to
        setg(begin, begin, begin + bytes.size());
    }

  protected:
    pos_type seekoff(off_type offset, std::ios_base::seekdir from,
                     std::ios_base::openmode) override {
        const off_type base = from == std::ios_base::beg   ? 0
                              : from == std::ios_base::cur ? gptr() - eback()
                                                           : egptr() - eback();
        if (offset < -base || offset > egptr() - eback() - base) return pos_type(off_type(-1));
        setg(eback(), eback() + base + offset, egptr());
        return pos_type(base + offset);
    }
    pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
        return seekoff(off_type(position), std::ios_base::beg, mode);
    }
};

/// The archive of a file in memory: OpenVDB's own has either no access by name or no stream of the
/// caller's.
class MemoryArchive : public openvdb::io::Archive {
  public:
    explicit MemoryArchive(std::string_view bytes);

    /// The grid, read whole if its number of voxels is allowed; null if there is none.
    openvdb::GridBase::Ptr read(const FieldRequest& request);
    const std::vector<std::string>& names() const { return names_; }

  private:
    openvdb::GridBase::Ptr read_grid(const openvdb::io::GridDescriptor& descriptor,
                                     const FieldRequest& request);
    void read_tree(openvdb::GridBase& grid, const openvdb::io::GridDescriptor& descriptor,
                   const FieldRequest& request);

    MemoryBuffer buffer_;
    std::shared_ptr<openvdb::io::StreamMetadata> metadata_ =
        std::make_shared<openvdb::io::StreamMetadata>();
    std::istream stream_; ///< Points to metadata_.
    std::vector<std::string> names_;
    std::vector<openvdb::io::GridDescriptor> descriptors_;
};

MemoryArchive::MemoryArchive(std::string_view bytes) : buffer_(bytes), stream_(&buffer_) {
    static const bool is_initialized = (openvdb::initialize(), true);
    static_cast<void>(is_initialized);
    // The library does not ask whether a read succeeded.
    stream_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    readHeader(stream_);
    openvdb::io::setStreamMetadataPtr(stream_, metadata_);
    setFormatVersion(stream_);
    setLibraryVersion(stream_);
    setDataCompression(stream_);
    if (!inputHasGridOffsets()) {
        throw Error(ExitStatus::bad_input, "the file was written as a stream, without a table of "
                                           "grids (expected one written as a file)");
    }
    openvdb::MetaMap metadata;
    metadata.readMeta(stream_);
    const int count = readGridCount(stream_);
    for (int i = 0; i < count; ++i) {
        openvdb::io::GridDescriptor descriptor;
        descriptor.read(stream_);
        names_.push_back(openvdb::io::GridDescriptor::nameAsString(descriptor.uniqueName()));
        descriptors_.push_back(descriptor);
        descriptor.seekToEnd(stream_);
    }
}

openvdb::GridBase::Ptr MemoryArchive::read(const FieldRequest& request) {
    for (const auto& descriptor : descriptors_)
        if (descriptor.gridName() == request.name) return read_grid(descriptor, request);
    return nullptr;
}

openvdb::GridBase::Ptr MemoryArchive::read_grid(const openvdb::io::GridDescriptor& descriptor,
                                                const FieldRequest& request) {
    using openvdb::GridBase;
    GridBase::Ptr grid = GridBase::createGrid(descriptor.gridType());
    if (!grid->isType<openvdb::FloatGrid>() && !grid->isType<openvdb::DoubleGrid>()) {
        refuse_field(request, fmt::format("values of type {} (expected float, half or double)",
                                          grid->valueType()));
    }
    grid->setSaveFloatAsHalf(descriptor.saveFloatAsHalf());
    descriptor.seekToGrid(stream_);
    readGridCompression(stream_);
    grid->readMeta(stream_);
    const bool has_transform_first =
        openvdb::io::getFormatVersion(stream_) >= openvdb::OPENVDB_FILE_VERSION_GRID_INSTANCING;
    if (has_transform_first) grid->readTransform(stream_);
    if (descriptor.isInstance()) {
        // The tree is that of another grid.
        for (const auto& parent : descriptors_)
            if (parent.uniqueName() == descriptor.instanceParentName() && !parent.isInstance() &&
                parent.gridType() == descriptor.gridType()) {
                grid->setTree(read_grid(parent, request)->baseTreePtr());
                return grid;
            }
        refuse_field(request, "shares the voxels of a grid that the file does not have");
    }
    grid->readTopology(stream_);
    if (!has_transform_first) grid->readTransform(stream_);
    const std::uint64_t voxels = std::uint64_t{grid->constBaseTree().leafCount()} * kBrickVoxels;
    if (voxels > request.max_voxels) {
        refuse_field(request,
                     fmt::format("{} voxels in nodes of 8^3 are too many (expected at most {})",
                                 voxels, request.max_voxels));
    }
    grid->readBuffers(stream_);
    return grid;
}

glm::ivec3 as_ivec(const openvdb::Coord& c) {
    return {c.x(), c.y(), c.z()};
}

/// Rows of OpenVDB's matrices are the columns of ours: its vectors stand on the left.
glm::dmat4 world_from_index(const openvdb::math::Transform& transform) {
    const openvdb::math::Mat4d m = transform.baseMap()->getAffineMap()->getMat4();
    glm::dmat4 result;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            result[i][j] = m(i, j);
    return result;
}

template<typename GridT>
VdbTree tree_of(const GridT& grid) {
    using TreeT = typename GridT::TreeType;
    using Leaf = typename TreeT::LeafNodeType;
    static_assert(Leaf::LOG2DIM == 3);
    VdbTree tree;
    tree.leaves.reserve(grid.tree().leafCount());
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf)
        tree.leaves.push_back({as_ivec(leaf->origin()) >> 3, &*leaf});
    auto tile = grid.tree().cbeginValueAll();
    tile.setMaxDepth(TreeT::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        if (*tile == 0) continue;
        const openvdb::CoordBBox box = tile.getBoundingBox();
        tree.tiles.push_back({as_ivec(box.min()) >> 3, box.dim().x() / kBrickSize, double(*tile)});
    }
    tree.unpack = [](const void* node, std::span<double, kBrickVoxels> values) {
        const auto* data = static_cast<const Leaf*>(node)->buffer().data();
        std::copy_n(data, kBrickVoxels, values.begin());
    };
    return tree;
}

template<typename GridT>
Field field_of(const GridT& grid, const FieldRequest& request) {
    if (!(grid.background() == 0))
        refuse_field(request, fmt::format("the background is {} (expected 0)", grid.background()));
    Field field;
    field.grid = assemble_grid(tree_of(grid), request);
    field.world_from_index = world_from_index(grid.transform());
    const openvdb::CoordBBox active = grid.evalActiveVoxelBoundingBox();
    if (!active.empty()) field.active = {as_ivec(active.min()), as_ivec(active.max())};
    return field;
}

} // namespace

bool is_vdb(std::string_view bytes) {
    std::int64_t magic = 0;
    if (bytes.size() < sizeof(magic)) return false;
    std::memcpy(&magic, bytes.data(), sizeof(magic));
    return magic == openvdb::OPENVDB_MAGIC;
}

std::optional<Field> read_vdb(std::string_view bytes, const FieldRequest& request) {
    check_vdb_lengths(bytes);
    try {
        MemoryArchive archive(bytes);
        const openvdb::GridBase::Ptr grid = archive.read(request);
        if (!grid) {
            report_missing(request, archive.names());
            return std::nullopt;
        }
        if (grid->getGridClass() != openvdb::GRID_FOG_VOLUME &&
            grid->getGridClass() != openvdb::GRID_UNKNOWN) {
            refuse_field(request,
                         fmt::format("a {} (expected a fog volume)",
                                     openvdb::GridBase::gridClassToString(grid->getGridClass())));
        }
        if (!grid->transform().isLinear())
            refuse_field(request, "a frustum for its transform (expected an affine one)");
        if (const auto floats = openvdb::gridPtrCast<openvdb::FloatGrid>(grid))
            return field_of(*floats, request);
        return field_of(*openvdb::gridPtrCast<openvdb::DoubleGrid>(grid), request);
    } catch (const std::ios_base::failure&) {
        throw Error(ExitStatus::bad_input, "the OpenVDB file is cut off or damaged");
    } catch (const openvdb::Exception& exception) {
        throw Error(ExitStatus::bad_input, fmt::format("OpenVDB: {}", exception.what()));
    } catch (const std::length_error&) {
        throw Error(ExitStatus::bad_input,
                    "the OpenVDB file is damaged: it tells of impossible sizes");
    }
}

} // namespace tyndall
