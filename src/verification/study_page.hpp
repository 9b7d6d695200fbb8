#pragma once
/// What `spindrift verify` writes: a table of all points and the page that a scientist can put beside a paper.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "verification/study.hpp"

namespace spindrift {

/// Of every point, with a head line: points.csv.
std::string points_csv(const std::vector<CaseResult>& results);

/// Writes folder/verification/points.csv, whole or not at all.   Throws Error(io_failed).
void write_points(const std::filesystem::path& folder, const std::vector<CaseResult>& results);

/// Writes folder/verification.md, .html and folder/verification/{points.csv, CASE.png}, each whole or not at all.
/// note: is told why there are no pictures, if so.   Throws Error(io_failed).
void write_study(const std::filesystem::path& folder, const std::vector<CaseResult>& results,
                 const std::function<void(const std::string&)>& note);

}  // namespace spindrift
