#pragma once
/// Wall time and number of passes of each named stage of the step. A stage that never ran has no entry: that is how the
/// tests prove that absent physics costs no pass.

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

class Stages {
 public:
  struct Stage {
    std::string name;
    double seconds = 0;
    std::uint64_t passes = 0;
  };

  /// One pass of a stage.
  struct Pass {
    std::uint32_t stage;             ///< in all()
    double start = 0, duration = 0;  ///< [s], start since keep_passes()
  };

  /// Times from its construction to its destruction.
  class Scope {
   public:
    Scope(Stages& stages, std::size_t index);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Stages& stages_;
    std::size_t index_;
    std::chrono::steady_clock::time_point start_;
  };

  /// `auto timed = stages.time("dense_flow.neighbours");` Nested names are joined by dots, nested times both count.
  [[nodiscard]] Scope time(std::string_view name);

  /// In the order of first use.
  const std::vector<Stage>& all() const { return stages_; }

  /// Passes of the stage `name`, and of every stage below it ("dense_flow" counts "dense_flow.viscosity").
  std::uint64_t passes(std::string_view name) const;

  /// From now on remembers every single pass, the first `most` of them.
  void keep_passes(std::size_t most);
  const std::vector<Pass>& kept() const { return kept_; }

 private:
  std::vector<Stage> stages_;
  std::vector<Pass> kept_;
  std::size_t most_ = 0;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace spindrift
