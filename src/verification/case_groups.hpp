#pragma once
/// The groups that verification_cases() puts together, one file each.

#include <vector>

#include "verification/case.hpp"

namespace spindrift {

std::vector<Case> free_surface_cases();
std::vector<Case> slope_flow_cases();
std::vector<Case> air_flow_cases();
std::vector<Case> smoke_cases();
std::vector<Case> cloud_cases();
std::vector<Case> embedded_ground_cases();
std::vector<Case> plume_cases();
std::vector<Case> coupling_cases();
std::vector<Case> entrainment_cases();

}  // namespace spindrift
