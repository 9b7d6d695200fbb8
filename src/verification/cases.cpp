#include "verification/cases.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "verification/case_groups.hpp"
#include "verification/scene_texts.hpp"

namespace spindrift {

std::vector<Case> verification_cases() {
  std::vector<Case> all;
  for (auto* group : {free_surface_cases, slope_flow_cases, air_flow_cases, smoke_cases, cloud_cases,
                      embedded_ground_cases, plume_cases, coupling_cases, entrainment_cases})
    for (Case& one : group()) all.push_back(std::move(one));
  return all;
}

std::string_view scene_text(std::string_view file) {
  for (const SceneText& scene : scene_texts())
    if (scene.file == file) return scene.text;
  throw Error(ExitCode::bug, fmt::format("no scene {} is built in", file));
}

}  // namespace spindrift
