#pragma once
/// Which frames of a run a command takes: all, every Nth, or one.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>

namespace spindrift {

struct FrameChoice {
  std::uint64_t every = 1;
  std::optional<std::uint64_t> frame;

  bool takes(std::uint64_t number) const { return frame ? number == *frame : number % every == 0; }
  bool takes_all() const { return every == 1 && !frame; }

  /// --every N and --frame N, which exclude each other.
  void add_to(CLI::App& command) {
    CLI::Option* every_option =
        command.add_option("--every", every, "every Nth frame")->check(CLI::Range(1, 1000000))->type_name("N");
    command.add_option("--frame", frame, "frame N alone; the first is 0")
        ->check(CLI::Range(0, 1000000000))
        ->type_name("N")
        ->excludes(every_option);
  }
};

}  // namespace spindrift
