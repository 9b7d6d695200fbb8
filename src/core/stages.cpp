#include "core/stages.hpp"

#include <algorithm>

namespace spindrift {

Stages::Scope::Scope(Stages& stages, std::size_t index)
    : stages_(stages), index_(index), start_(std::chrono::steady_clock::now()) {}

Stages::Scope::~Scope() {
  using Seconds = std::chrono::duration<double>;
  Stage& stage = stages_.stages_[index_];
  const double duration = Seconds(std::chrono::steady_clock::now() - start_).count();
  stage.seconds += duration;
  ++stage.passes;
  if (stages_.kept_.size() < stages_.most_)
    stages_.kept_.push_back({static_cast<std::uint32_t>(index_), Seconds(start_ - stages_.begin_).count(), duration});
}

Stages::Scope Stages::time(std::string_view name) {
  const auto found =
      std::find_if(stages_.begin(), stages_.end(), [&](const Stage& stage) { return stage.name == name; });
  const auto index = static_cast<std::size_t>(found - stages_.begin());
  if (found == stages_.end()) stages_.push_back({std::string(name)});
  return Scope(*this, index);
}

void Stages::keep_passes(std::size_t most) {
  most_ = most;
  begin_ = std::chrono::steady_clock::now();
}

std::uint64_t Stages::passes(std::string_view name) const {
  std::uint64_t n = 0;
  for (const Stage& stage : stages_) {
    const bool below =
        stage.name.size() > name.size() && stage.name.starts_with(name) && stage.name[name.size()] == '.';
    if (stage.name == name || below) n += stage.passes;
  }
  return n;
}

}  // namespace spindrift
