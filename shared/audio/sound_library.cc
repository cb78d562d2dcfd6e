#include "shared/audio/sound_library.h"

#include <algorithm>

#include "shared/core/parallel.h"

namespace lararium::audio {
namespace {

// Says whether the sum of two channels has far less power than their difference. Long sounds are
// judged by pieces that are spread over them.
bool HasOpposedChannels(SoundReader& reader) {
  constexpr int64_t kPieces = 64;
  constexpr size_t kPieceFrames = 4096;
  constexpr double kLeast = 0.1;  // -10 dB
  if (reader.channels() != 2) {
    return false;
  }
  const auto piece = static_cast<int64_t>(kPieceFrames);
  const int64_t step = std::max(piece, reader.frames() / kPieces);
  double sum = 0.0;
  double difference = 0.0;
  std::vector<int16_t> samples(2 * kPieceFrames);
  for (int64_t frame = 0; frame < reader.frames() && reader.Seek(frame); frame += step) {
    const size_t read = reader.Read(samples);
    for (size_t i = 0; i < 2 * read; i += 2) {
      const double left = samples[i];
      const double right = samples[i + 1];
      sum += (left + right) * (left + right);
      difference += (left - right) * (left - right);
    }
  }
  return sum < kLeast * difference;
}

Status Hold(Clip& clip) {
  LARARIUM_ASSIGN_OR_RETURN(SoundReader reader, SoundReader::Open(clip.data.bytes, clip.name));
  clip.samples.resize(static_cast<size_t>(clip.frames * clip.channels));
  if (reader.Read(clip.samples) != static_cast<size_t>(clip.frames)) {
    return Status::Error(clip.name, "ends too early: the file is damaged", "replace the file");
  }
  clip.data = {};
  return Status();
}

}  // namespace

Result<std::shared_ptr<const SoundLibrary>> SoundLibrary::Load(std::vector<SoundData> sounds) {
  std::shared_ptr<SoundLibrary> library(new SoundLibrary);
  std::sort(sounds.begin(), sounds.end(),
            [](const SoundData& a, const SoundData& b) { return a.name < b.name; });
  std::vector<size_t> held;
  size_t samples = 0;
  for (SoundData& sound : sounds) {
    if (!library->clips_.empty() && library->clips_.back().name == sound.name) {
      return Status::Error(sound.name, "is the name of two sounds", "rename one of them");
    }
    LARARIUM_ASSIGN_OR_RETURN(SoundReader reader, SoundReader::Open(sound.bytes, sound.name));
    Clip& clip = library->clips_.emplace_back();
    clip.name = sound.name;
    clip.rate = reader.rate();
    clip.channels = reader.channels();
    clip.frames = reader.frames();
    clip.has_opposed_channels = HasOpposedChannels(reader);
    clip.data = std::move(sound);
    const auto size = static_cast<size_t>(clip.frames * clip.channels);
    if (clip.seconds() <= kMaxHeldSeconds && samples + size <= kMaxHeldSamples) {
      held.push_back(library->clips_.size() - 1);
      samples += size;
    }
  }
  std::vector<Status> statuses(held.size());
  ParallelFor(held.size(), [&](size_t i) { statuses[i] = Hold(library->clips_[held[i]]); });
  for (const Status& status : statuses) {
    LARARIUM_RETURN_IF_ERROR(status);
  }
  return std::shared_ptr<const SoundLibrary>(std::move(library));
}

int SoundLibrary::Find(std::string_view name) const {
  const auto found =
      std::lower_bound(clips_.begin(), clips_.end(), name,
                       [](const Clip& clip, std::string_view n) { return clip.name < n; });
  return found != clips_.end() && found->name == name ? static_cast<int>(found - clips_.begin())
                                                      : -1;
}

}  // namespace lararium::audio
