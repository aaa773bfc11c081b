/// Lengths in files of OpenVDB, checked before the library believes them.
#pragma once

#include <string_view>

namespace tyndall {

/// Walks over the header, the table of grids, and the metadata and transform names of each grid,
/// as the library will, which makes room for a text or a value before it finds that the file is
/// shorter. Files of before version 222 of the format (2013) are let through.
///
/// @throws Error (bad_input)  a length or an offset points beyond the end.
void check_vdb_lengths(std::string_view bytes);

} // namespace tyndall
