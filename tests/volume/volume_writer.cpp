#include "volume/volume_writer.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

namespace tyndall {
namespace {

openvdb::Coord as_coord(const glm::ivec3& v) {
    return {v.x, v.y, v.z};
}

openvdb::math::Transform::Ptr make_transform(const WrittenGrid& grid) {
    if (grid.is_frustum) {
        return openvdb::math::Transform::createFrustumTransform(
            openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(10)), 0.5, 10);
    }
    openvdb::math::Mat4d m;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            m(i, j) = grid.world_from_index[i][j];
    return openvdb::math::Transform::createLinearTransform(m);
}

template<typename GridT>
typename GridT::Ptr make_grid(const WrittenGrid& from) {
    using Value = typename GridT::ValueType;
    const auto grid = GridT::create(Value(from.background));
    grid->setName(from.name);
    grid->setTransform(make_transform(from));
    grid->setGridClass(from.grid_class == WrittenGrid::Class::fog         ? openvdb::GRID_FOG_VOLUME
                       : from.grid_class == WrittenGrid::Class::level_set ? openvdb::GRID_LEVEL_SET
                                                                          : openvdb::GRID_UNKNOWN);
    grid->setSaveFloatAsHalf(from.type == WrittenGrid::Type::float16);
    for (const auto& [box, value] : from.boxes)
        grid->sparseFill({as_coord(box.lower), as_coord(box.upper)}, Value(value), true);
    for (const auto& [voxel, value] : from.voxels)
        grid->tree().setValue(as_coord(voxel), Value(value));
    return grid;
}

openvdb::GridBase::Ptr make_any(const WrittenGrid& from) {
    switch (from.type) {
    case WrittenGrid::Type::float64:
        return make_grid<openvdb::DoubleGrid>(from);
    case WrittenGrid::Type::int32:
        return make_grid<openvdb::Int32Grid>(from);
    case WrittenGrid::Type::vec3:
        return make_grid<openvdb::Vec3SGrid>(from);
    default:
        return make_grid<openvdb::FloatGrid>(from);
    }
}

template<typename BuildT>
nanovdb::GridHandle<> convert(const openvdb::FloatGrid& grid) {
    nanovdb::OpenToNanoVDB<float, BuildT> converter;
    converter.setStats(nanovdb::StatsMode::All);
    converter.setChecksum(nanovdb::ChecksumMode::Full);
    return converter(grid);
}

nanovdb::GridHandle<> convert_any(const openvdb::FloatGrid& grid, NanoType type) {
    switch (type) {
    case NanoType::fp4:
        return convert<nanovdb::Fp4>(grid);
    case NanoType::fp8:
        return convert<nanovdb::Fp8>(grid);
    case NanoType::fp16:
        return convert<nanovdb::Fp16>(grid);
    case NanoType::fp_n:
        return convert<nanovdb::FpN>(grid);
    default:
        return convert<float>(grid);
    }
}

} // namespace

std::string write_vdb(const std::vector<WrittenGrid>& grids, bool is_seekable) {
    openvdb::initialize();
    openvdb::GridPtrVec made;
    for (const WrittenGrid& grid : grids)
        made.push_back(make_any(grid));
    std::ostringstream stream;
    if (!is_seekable) {
        openvdb::io::Stream(stream).write(made);
        return stream.str();
    }
    struct SeekableArchive : openvdb::io::Archive {
        void write_to(std::ostream& os, const openvdb::GridPtrVec& all) const {
            Archive::write(os, all, true);
        }
    };
    SeekableArchive().write_to(stream, made);
    return stream.str();
}

std::string write_nanovdb(const std::vector<WrittenGrid>& grids, NanoCodec codec, NanoType type) {
    openvdb::initialize();
    std::vector<nanovdb::GridHandle<>> handles;
    for (const WrittenGrid& grid : grids)
        handles.push_back(convert_any(*make_grid<openvdb::FloatGrid>(grid), type));
    // The writer jumps ahead of what is written, which only files allow.
    std::string name = (std::filesystem::temp_directory_path() / "tyndall-test-XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0) throw std::runtime_error("cannot make a file for the test");
    close(file);
    nanovdb::io::writeGrids(name, handles,
                            codec == NanoCodec::zip     ? nanovdb::io::Codec::ZIP
                            : codec == NanoCodec::blosc ? nanovdb::io::Codec::BLOSC
                                                        : nanovdb::io::Codec::NONE);
    std::ostringstream stream;
    stream << std::ifstream(name, std::ios::binary).rdbuf();
    std::filesystem::remove(name);
    return stream.str();
}

} // namespace tyndall
