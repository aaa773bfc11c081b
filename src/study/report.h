/// report.html: what was found, for someone who was not there. One page that asks for nothing else.
#pragma once

#include "study/results.h"
#include "study/stored_pictures.h"

namespace tyndall::study {

/// Writes report.html, and the pictures in it as PNG to images/.
/// @throws Error failed: a file cannot be written, or gnuplot is not installed.
void write_report(const Results& results, const Reference& reference, const StoredPictures& stored,
                  const std::filesystem::path& folder);

} // namespace tyndall::study
