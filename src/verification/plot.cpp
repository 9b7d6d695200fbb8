#include "verification/plot.hpp"

#include "io/program.hpp"
#include "verification/scene_texts.hpp"

namespace spindrift {

std::optional<std::string> plot(const std::string& what, const std::filesystem::path& folder) {
  std::string why = "python3 is not installed";
  // The first Python on PATH need not be the one that has matplotlib.
  for (const auto& python : {program_on_path("python3"), std::optional<std::filesystem::path>("/usr/bin/python3")}) {
    if (!python || !std::filesystem::exists(*python)) continue;
    const auto failure = run_program(*python, {"-c", std::string(plot_script()), what, "."}, folder);
    if (!failure) return {};
    why = *failure;
  }
  return "no pictures: " + why;
}

}  // namespace spindrift
