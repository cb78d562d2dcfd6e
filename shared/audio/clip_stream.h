#pragma once

// Decodes a long clip piece by piece while it plays. Private to shared/audio.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "shared/audio/sound_file.h"
#include "shared/audio/sound_library.h"

namespace lararium::audio {

// Channels in which a clip is played. A stereo clip becomes one point where it has a position.
enum class Channels : uint8_t { kMono, kStereo };

// Converts the samples of a clip. Stereo gives a mono clip to both ears.
void Convert(std::span<const int16_t> samples,
             const Clip& clip,
             Channels channels,
             std::vector<int16_t>& converted);

class ClipStream {
 public:
  static constexpr size_t kPieceFrames = 4096;  // Frames per piece.

  // Begins at a frame. Returns nullopt if the file is damaged. Borrows the clip.
  static std::optional<ClipStream> Open(const Clip& clip,
                                        int64_t frame,
                                        bool loops,
                                        Channels channels);

  // Returns the next piece, which is valid until the next call. It is empty at the end.
  std::span<const int16_t> Next();

 private:
  ClipStream(const Clip& clip, SoundReader reader, bool loops, Channels channels)
      : clip_(&clip), reader_(std::move(reader)), loops_(loops), channels_(channels) {}

  const Clip* clip_;
  SoundReader reader_;
  bool loops_;
  Channels channels_;
  std::vector<int16_t> piece_;
  std::vector<int16_t> converted_;
};

}  // namespace lararium::audio
