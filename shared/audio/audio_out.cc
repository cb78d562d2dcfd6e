#include "shared/audio/audio_out.h"

#include <sndfile.h>

#include <chrono>
#include <thread>
#include <utility>

#include "shared/audio/openal_out.h"
#include "shared/audio/sound_graph.h"
#include "shared/core/file.h"

namespace lararium::audio {
namespace {

using SteadyClock = std::chrono::steady_clock;

class NoOut : public AudioOut {
 public:
  Status Write(std::span<const float> stereo) override {
    const SteadyClock::time_point now = SteadyClock::now();
    due_ = std::max(due_, now - kPatience);
    due_ += std::chrono::duration_cast<SteadyClock::duration>(
        std::chrono::duration<double>(static_cast<double>(stereo.size() / 2) / SoundGraph::kRate));
    std::this_thread::sleep_until(due_);
    return Status();
  }
  double latency() const override { return 0.0; }
  Status Finish() override { return Status(); }
  std::string name() const override { return "none"; }

 private:
  // A longer delay is not made up for.
  static constexpr std::chrono::milliseconds kPatience{100};

  SteadyClock::time_point due_ = SteadyClock::now();
};

class FileOut : public AudioOut {
 public:
  static Result<std::unique_ptr<AudioOut>> Create(const std::filesystem::path& file) {
    LARARIUM_ASSIGN_OR_RETURN(FileReplacement replacement, FileReplacement::Begin(file));
    auto out = std::unique_ptr<FileOut>(new FileOut(file, std::move(replacement)));
    SF_INFO info = {};
    info.samplerate = SoundGraph::kRate;
    info.channels = 2;
    info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
    out->sound_ = sf_open(out->replacement_.unfinished().c_str(), SFM_WRITE, &info);
    if (out->sound_ == nullptr) {
      return Status::Error(file.string(), std::string("cannot be written: ") + sf_strerror(nullptr),
                           "check the folder");
    }
    sf_command(out->sound_, SFC_SET_CLIPPING, nullptr, SF_TRUE);
    return std::unique_ptr<AudioOut>(std::move(out));
  }

  ~FileOut() override {
    if (sound_ != nullptr) {
      sf_close(sound_);
    }
  }

  Status Write(std::span<const float> stereo) override {
    const auto frames = static_cast<sf_count_t>(stereo.size() / 2);
    return sf_writef_float(sound_, stereo.data(), frames) == frames ? Status() : Problem();
  }
  double latency() const override { return 0.0; }
  Status Finish() override {
    const int error = sf_close(sound_);
    sound_ = nullptr;
    return error != 0 ? Problem() : replacement_.Commit();
  }
  std::string name() const override { return file_.string(); }

 private:
  FileOut(std::filesystem::path file, FileReplacement replacement)
      : file_(std::move(file)), replacement_(std::move(replacement)) {}
  Status Problem() const {
    return Status::Error(file_.string(), "cannot be written", "check the free space");
  }

  std::filesystem::path file_;
  FileReplacement replacement_;
  SNDFILE* sound_ = nullptr;
};

}  // namespace

Result<std::unique_ptr<AudioOut>> CreateAudioOut(AudioOutKind kind,
                                                 const std::filesystem::path& file) {
  switch (kind) {
    case AudioOutKind::kDevice:
      return OpenDeviceOut();
    case AudioOutKind::kFile:
      return FileOut::Create(file);
    case AudioOutKind::kNone:
      break;
  }
  return std::unique_ptr<AudioOut>(std::make_unique<NoOut>());
}

}  // namespace lararium::audio
