#include "shared/audio/clip_stream.h"

namespace lararium::audio {

void Convert(std::span<const int16_t> samples,
             const Clip& clip,
             Channels channels,
             std::vector<int16_t>& converted) {
  converted.clear();
  if (channels == Channels::kStereo) {
    for (const int16_t sample : samples) {
      converted.insert(converted.end(), clip.channels == 1 ? 2 : 1, sample);
    }
    return;
  }
  const int sign = clip.has_opposed_channels ? -1 : 1;
  for (size_t i = 0; i < samples.size(); i += static_cast<size_t>(clip.channels)) {
    converted.push_back(clip.channels == 1
                            ? samples[i]
                            : static_cast<int16_t>((samples[i] + sign * samples[i + 1]) / 2));
  }
}

std::optional<ClipStream> ClipStream::Open(const Clip& clip,
                                           int64_t frame,
                                           bool loops,
                                           Channels channels) {
  Result<SoundReader> reader = SoundReader::Open(clip.data.bytes, clip.name);
  if (!reader.ok() || (frame > 0 && !reader->Seek(frame))) {
    return std::nullopt;
  }
  ClipStream stream(clip, std::move(*reader), loops, channels);
  stream.piece_.resize(kPieceFrames * static_cast<size_t>(clip.channels));
  stream.converted_.reserve(2 * kPieceFrames);
  return stream;
}

std::span<const int16_t> ClipStream::Next() {
  const auto channels = static_cast<size_t>(clip_->channels);
  const std::span<int16_t> piece(piece_);
  size_t frames = reader_.Read(piece);
  if (frames < kPieceFrames && loops_) {
    // Continue at the beginning. A file that yields nothing even from there is damaged.
    if (reader_.Seek(0)) {
      frames += reader_.Read(piece.subspan(frames * channels));
    }
  }
  Convert(piece.first(frames * channels), *clip_, channels_, converted_);
  return converted_;
}

}  // namespace lararium::audio
