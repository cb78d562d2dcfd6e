#pragma once

// A sound file in memory that libsndfile writes.

#include <sndfile.h>

#include <cstddef>
#include <vector>

namespace lararium::audio {

struct SoundMemory {
  // The functions for sf_open_virtual() with SFM_WRITE, whose user data is a SoundMemory.
  static SF_VIRTUAL_IO Io();

  std::vector<std::byte> bytes;
  sf_count_t position = 0;
};

}  // namespace lararium::audio
