#pragma once
/// Points as a table for spreadsheets, pandas and R.

#include <string>

#include "io/vtkhdf.hpp"

namespace spindrift {

/// A row a point: its position, then every component of every array in the given order. Numbers stand in their shortest
/// form that reads back to the same bits, whatever the locale. The header line names the columns, with the units that
/// the attributes "unit.NAME" tell:  x [m],y [m],z [m],velocity_x [m/s],...,layer
std::string csv_text(const PointCloud& cloud);

}  // namespace spindrift
