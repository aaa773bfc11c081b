/// Files of OpenVDB. See volume_file.h, which is what others include.
///
/// Source: the library's own reader (openvdb/io), run over a stream that throws where the bytes
/// end.
#pragma once

#include "volume/volume_file.h"

namespace tyndall {

bool is_vdb(std::string_view bytes);

/// As read_field, for bytes of an OpenVDB file.
std::optional<Field> read_vdb(std::string_view bytes, const FieldRequest& request);

} // namespace tyndall
