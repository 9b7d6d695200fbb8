#pragma once
/// Pictures as a film, by the program ffmpeg where the machine has it.

#include <filesystem>
#include <optional>
#include <string>

namespace spindrift {

struct Film {
  std::filesystem::path folder;               ///< where all names below stand
  std::string pictures = "preview/%06d.png";  ///< numbered from 0, all of one size
  std::string file = "preview.mp4";
  double frames_per_second = 10;
  int threads = 0;  ///< of the encoder, 0: its choice
};

/// Makes an H.264 film (yuv420p, even sizes, as every player takes it). The file appears whole or not at all; the
/// program runs without a shell, writes nothing to the terminal and has ended at the return.
/// Returns   nothing when the film is there, else why it is not, as one line for the user.
std::optional<std::string> make_film(const Film& film);

}  // namespace spindrift
