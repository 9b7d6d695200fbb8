#pragma once
/// Numbers as people read them.

#include <string>

namespace spindrift {

std::string count_text(double n);           ///< 1234567 -> "1,234,567"; from 1e15 on "1e+18"
std::string bytes_text(double bytes);       ///< 123456789 -> "123 MB"
std::string duration_text(double seconds);  ///< 83 -> "1:23", 3723 -> "1:02:03"

}  // namespace spindrift
