#include "volume/volume_file.h"

#include "core/error.h"
#include "volume/nanovdb_file.h"
#include "volume/vdb_file.h"

#include <new>

namespace tyndall {

std::optional<Field> read_field(std::string_view bytes, const FieldRequest& request) {
    try {
        if (is_vdb(bytes)) return read_vdb(bytes, request);
        if (is_nanovdb(bytes)) return read_nanovdb(bytes, request);
    } catch (const std::bad_alloc&) {
        throw Error(ExitStatus::failed, "not enough memory for grid \"" + request.name + "\"");
    }
    throw Error(ExitStatus::bad_input, "neither an OpenVDB nor a NanoVDB file");
}

} // namespace tyndall
