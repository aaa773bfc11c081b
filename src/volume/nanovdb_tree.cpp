#include "volume/nanovdb_tree.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>
#include <set>
#include <zlib.h>

namespace tyndall {
namespace {

constexpr std::size_t alignment = NANOVDB_DATA_ALIGNMENT;

template<typename T>
const std::byte* bytes_of(const T* object) {
    return reinterpret_cast<const std::byte*>(object);
}

/// The bytes of a grid, from which nothing is read that they do not hold.
class GridBytes {
  public:
    GridBytes(std::span<const std::byte> bytes, const FieldRequest& request)
        : bytes_(bytes), request_(request) {}

    [[noreturn]] void refuse(const char* what) const {
        refuse_field(request_, fmt::format("damaged: {} outside of the grid's {} bytes", what,
                                           bytes_.size()));
    }

    /// The object at an offset from another one, with room for `extra` bytes behind it.
    template<typename T>
    const T* at(const void* base, std::int64_t offset, const char* what,
                std::uint64_t extra = 0) const {
        const std::int64_t start = static_cast<const std::byte*>(base) - bytes_.data();
        const auto size = static_cast<std::int64_t>(bytes_.size());
        if (offset < -start || offset > size - start ||
            (start + offset) % std::int64_t{alignment} != 0)
            refuse(what);
        const auto room = static_cast<std::uint64_t>(size - start - offset);
        if (room < sizeof(T) || room - sizeof(T) < extra) refuse(what);
        return reinterpret_cast<const T*>(static_cast<const std::byte*>(base) + offset);
    }

    std::size_t size() const { return bytes_.size(); }
    const std::byte* begin() const { return bytes_.data(); }
    const FieldRequest& request() const { return request_; }

  private:
    std::span<const std::byte> bytes_;
    const FieldRequest& request_;
};

/// CRC32 of what the grid's checksum covers in a node of that type.
template<typename Node>
std::uint32_t node_crc(const Node* node) {
    return static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(node), sizeof(Node)));
}

/// Walks the tree of a grid of values that are built as BuildT.
template<typename BuildT>
class TreeWalk {
    using Leaf = typename nanovdb::NanoLeaf<BuildT>::DataType;
    using Lower = typename nanovdb::NanoLower<BuildT>::DataType;
    using Upper = typename nanovdb::NanoUpper<BuildT>::DataType;
    using Root = typename nanovdb::NanoRoot<BuildT>::DataType;
    static constexpr int upper_edge = 32, lower_edge = 16; ///< Of their tables.

  public:
    explicit TreeWalk(const GridBytes& bytes) : bytes_(bytes) {}

    VdbTree walk(const nanovdb::TreeData<3>& tree) {
        if (tree.mNodeOffset[3] > bytes_.size()) bytes_.refuse("the root lies");
        const auto root_offset = static_cast<std::int64_t>(tree.mNodeOffset[3]);
        const auto* first = bytes_.at<Root>(&tree, root_offset, "the root lies");
        root_ = bytes_.at<Root>(first, 0, "tiles of the root lie",
                                std::uint64_t{first->mTableSize} * sizeof(typename Root::Tile));
        if (!(root_->mBackground == 0))
            refuse_field(bytes_.request(),
                         fmt::format("the background is {} (expected 0)", root_->mBackground));
        std::set<std::array<int, 3>> origins;
        for (std::uint32_t i = 0; i < root_->mTableSize; ++i) {
            const auto* tile = root_->tile(i);
            const nanovdb::Coord c = tile->origin();
            // Nodes that lie over each other would make a small file take forever.
            if (!origins.insert({c[0], c[1], c[2]}).second)
                refuse_field(bytes_.request(),
                             "damaged: two tiles of the root are in the same place");
            const glm::ivec3 brick = glm::ivec3(c[0], c[1], c[2]) >> 3;
            if (tile->isChild())
                walk_upper(child<Upper>(root_, tile->child, uppers_), brick);
            else
                add_tile(brick, upper_edge * lower_edge, tile->value);
        }
        tree_.unpack = [](const void* node, std::span<double, kBrickVoxels> values) {
            for (std::uint32_t i = 0; i < kBrickVoxels; ++i)
                values[i] = static_cast<const Leaf*>(node)->getValue(i);
        };
        return std::move(tree_);
    }

    /// The two halves of the checksum (nanovdb/util/GridChecksum.h): of grid, tree and root; and of
    /// the checksums of all nodes, each in 64 bits.
    std::array<std::uint32_t, 2> checksum(bool is_breadth_first) {
        constexpr std::size_t first_byte = 16; // behind magic number and checksum
        const std::byte* end =
            bytes_of(root_ + 1) + root_->mTableSize * sizeof(typename Root::Tile);
        const auto head = crc32_z(0, reinterpret_cast<const Bytef*>(bytes_.begin() + first_byte),
                                  static_cast<std::size_t>(end - bytes_.begin()) - first_byte);
        std::vector<std::uint64_t> nodes;
        const auto add = [&](auto& level) {
            if (is_breadth_first) std::sort(level.begin(), level.end());
            for (const auto* node : level)
                nodes.push_back(node_crc(node));
        };
        add(uppers_);
        add(lowers_);
        add(leaves_);
        const auto tail = crc32_z(0, reinterpret_cast<const Bytef*>(nodes.data()),
                                  nodes.size() * sizeof(nodes[0]));
        return {static_cast<std::uint32_t>(head), static_cast<std::uint32_t>(tail)};
    }
    bool is_empty() const { return root_->mTableSize == 0; }

  private:
    /// A child of a node, of which there cannot be more than fit the bytes.
    template<typename Node>
    const Node* child(const void* parent, std::int64_t offset, std::vector<const Node*>& level) {
        const Node* node = bytes_.at<Node>(parent, offset, "a node lies");
        if (level.size() == bytes_.size() / sizeof(Node))
            refuse_field(bytes_.request(), "damaged: nodes are used more than once");
        level.push_back(node);
        return node;
    }

    void walk_upper(const Upper* node, const glm::ivec3& first) {
        each_entry<upper_edge>([&](std::uint32_t i, const glm::ivec3& at) {
            const glm::ivec3 brick = first + lower_edge * at;
            if (node->isChild(i))
                walk_lower(child<Lower>(node, node->mTable[i].child, lowers_), brick);
            else
                add_tile(brick, lower_edge, node->mTable[i].value);
        });
    }

    void walk_lower(const Lower* node, const glm::ivec3& first) {
        each_entry<lower_edge>([&](std::uint32_t i, const glm::ivec3& at) {
            if (node->isChild(i))
                add_leaf(child<Leaf>(node, node->mTable[i].child, leaves_), first + at);
            else
                add_tile(first + at, 1, node->mTable[i].value);
        });
    }

    /// Calls visit(entry, place) for each entry of the table of a node; the table has z fastest.
    template<int edge, typename Visit>
    static void each_entry(const Visit& visit) {
        std::uint32_t i = 0;
        for (int x = 0; x < edge; ++x)
            for (int y = 0; y < edge; ++y)
                for (int z = 0; z < edge; ++z)
                    visit(i++, glm::ivec3(x, y, z));
    }

    void add_leaf(const Leaf* leaf, const glm::ivec3& brick) {
        if constexpr (std::is_same_v<BuildT, nanovdb::FpN>) {
            // getValue reads at most 16 bits a value.
            const auto bits = std::min<std::uint64_t>(16, 1u << (leaf->mFlags >> 5));
            bytes_.at<Leaf>(leaf, 0, "values of a node lie", bits * kBrickVoxels / 8);
        }
        tree_.leaves.push_back({brick, leaf});
    }

    void add_tile(const glm::ivec3& brick, int edge, double value) {
        if (value != 0) tree_.tiles.push_back({brick, edge, value});
    }

    const GridBytes& bytes_;
    const Root* root_ = nullptr;
    std::vector<const Upper*> uppers_;
    std::vector<const Lower*> lowers_;
    std::vector<const Leaf*> leaves_;
    VdbTree tree_;
};

const nanovdb::GridData* header_of(const GridBytes& bytes) {
    return bytes.at<nanovdb::GridData>(bytes.begin(), 0, "its header lies",
                                       sizeof(nanovdb::TreeData<3>));
}

template<typename BuildT>
VdbTree walk_tree(const GridBytes& bytes) {
    const nanovdb::GridData* header = header_of(bytes);
    TreeWalk<BuildT> walk(bytes);
    VdbTree tree = walk.walk(*static_cast<const nanovdb::TreeData<3>*>(header->treePtr()));
    // Later versions compute the checksum in another way.
    if (header->mVersion.getMinor() > NANOVDB_MINOR_VERSION_NUMBER) return tree;
    constexpr std::uint32_t none = 0xFFFFFFFFu;
    const std::array<std::uint32_t, 2> stored{static_cast<std::uint32_t>(header->mChecksum),
                                              static_cast<std::uint32_t>(header->mChecksum >> 32)};
    const bool is_breadth_first =
        header->mFlags & static_cast<std::uint32_t>(nanovdb::GridFlags::IsBreadthFirst);
    const std::array<std::uint32_t, 2> computed = walk.checksum(is_breadth_first);
    if ((stored[0] != none && stored[0] != computed[0]) ||
        (stored[1] != none && stored[1] != computed[1] && !walk.is_empty()))
        refuse_field(bytes.request(), "damaged: its checksum does not match");
    return tree;
}

} // namespace

VdbTree read_nanovdb_tree(std::span<const std::byte> span, const FieldRequest& request) {
    const GridBytes bytes(span, request);
    switch (header_of(bytes)->mGridType) {
    case nanovdb::GridType::Float:
        return walk_tree<float>(bytes);
    case nanovdb::GridType::Double:
        return walk_tree<double>(bytes);
    case nanovdb::GridType::Fp4:
        return walk_tree<nanovdb::Fp4>(bytes);
    case nanovdb::GridType::Fp8:
        return walk_tree<nanovdb::Fp8>(bytes);
    case nanovdb::GridType::Fp16:
        return walk_tree<nanovdb::Fp16>(bytes);
    case nanovdb::GridType::FpN:
        return walk_tree<nanovdb::FpN>(bytes);
    default:
        refuse_field(
            request,
            "values of another type than float (expected float, double, Fp4, Fp8, Fp16 or FpN)");
    }
}

Field read_nanovdb_header(std::span<const std::byte> span, const FieldRequest& request) {
    const GridBytes bytes(span, request);
    const nanovdb::GridData* header = header_of(bytes);
    constexpr std::uint64_t later_magic = 0x314244566f6e614eull; // "NanoVDB1", of grids since 32.6
    if (header->mMagic != NANOVDB_MAGIC_NUMBER && header->mMagic != later_magic)
        refuse_field(request, "damaged: it does not begin as a grid of NanoVDB");
    if (header->mVersion.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER) {
        refuse_field(request,
                     fmt::format("version {} of NanoVDB (expected {})", header->mVersion.getMajor(),
                                 NANOVDB_MAJOR_VERSION_NUMBER));
    }
    if (header->mGridClass != nanovdb::GridClass::FogVolume &&
        header->mGridClass != nanovdb::GridClass::Unknown) {
        refuse_field(request, fmt::format("{} (expected a fog volume)",
                                          header->mGridClass == nanovdb::GridClass::LevelSet
                                              ? "a level set"
                                              : "no density"));
    }
    Field field;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            field.world_from_index[column][row] = header->mMap.mMatD[3 * row + column];
        field.world_from_index[3][row] = header->mMap.mVecD[row];
    }
    // The box is the first member of the root, whatever the type of its values.
    const auto* tree = static_cast<const nanovdb::TreeData<3>*>(header->treePtr());
    if (tree->mNodeOffset[3] > bytes.size()) bytes.refuse("the root lies");
    const auto* box = bytes.at<nanovdb::CoordBBox>(
        tree, static_cast<std::int64_t>(tree->mNodeOffset[3]), "the root lies");
    field.active.lower = {box->min()[0], box->min()[1], box->min()[2]};
    field.active.upper = {box->max()[0], box->max()[1], box->max()[2]};
    return field;
}

} // namespace tyndall
