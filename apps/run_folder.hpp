#pragma once
/// Reading a run folder back.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace spindrift {

/// What run.json holds.
/// Throws Error: bad_input, not a run folder;  io_failed, it cannot be read;  incompatible_file, it holds no object.
nlohmann::ordered_json read_run_json(const std::filesystem::path& folder);

}  // namespace spindrift
