/// Files of NanoVDB. See volume_file.h, which is what others include.
///
/// Source: nanovdb/util/IO.h (segments and codecs) and nanovdb/NanoVDB.h (nodes) of version 32.
/// Their readers believe every size and offset, so that only the layout of the nodes is taken from
/// there.
#pragma once

#include "volume/volume_file.h"

namespace tyndall {

bool is_nanovdb(std::string_view bytes);

/// As read_field, for bytes of a NanoVDB file.
std::optional<Field> read_nanovdb(std::string_view bytes, const FieldRequest& request);

} // namespace tyndall
