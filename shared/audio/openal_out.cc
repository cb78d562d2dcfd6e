#include "shared/audio/openal_out.h"

#define AL_ALEXT_PROTOTYPES
#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <thread>

#include "shared/audio/sound_graph.h"
#include "shared/core/file.h"

namespace lararium::audio {
namespace {

// Number of blocks queued in advance: enough for a busy machine, few enough that the delay after a
// turn of the head is not noticed.
constexpr size_t kQueued = 4;
constexpr std::chrono::milliseconds kPoll(2);
// A device that accepts nothing for this long is lost, even if it reports otherwise.
constexpr std::chrono::seconds kStuck(2);

// Without a device, OpenAL's back ends would print errors to the terminal.
bool MayHaveDevice() {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/snd", ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("pcm") && name.ends_with("p")) {
      return true;
    }
  }
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  return std::getenv("PULSE_SERVER") != nullptr || std::getenv("ALSOFT_DRIVERS") != nullptr ||
         (runtime != nullptr && FileExists(std::filesystem::path(runtime) / "pulse/native"));
}

class DeviceOut : public AudioOut {
 public:
  static Result<std::unique_ptr<AudioOut>> Open() {
    auto out = std::unique_ptr<DeviceOut>(new DeviceOut);
    out->device_ = MayHaveDevice() ? alcOpenDevice(nullptr) : nullptr;
    if (out->device_ == nullptr) {
      return Status::Error("sound device", "no device can be opened",
                           "connect one; the program keeps looking for it");
    }
    // The samples already contain HRTF filtering.
    const ALCint attributes[] = {ALC_FREQUENCY, SoundGraph::kRate, ALC_HRTF_SOFT, ALC_FALSE, 0};
    out->context_ = alcCreateContext(out->device_, attributes);
    if (out->context_ == nullptr) {
      return Status::Error("sound device", "does not accept stereo sound");
    }
    const Entered entered(*out);
    alGenSources(1, &out->source_);
    alGenBuffers(static_cast<ALsizei>(out->free_.size()), out->free_.data());
    alSourcei(out->source_, AL_DIRECT_CHANNELS_SOFT, AL_TRUE);
    if (alGetError() != AL_NO_ERROR) {
      return Status::Error("sound device", "has no free channel");
    }
    out->free_count_ = out->free_.size();
    return std::unique_ptr<AudioOut>(std::move(out));
  }

  ~DeviceOut() override {
    if (context_ != nullptr) {
      alcDestroyContext(context_);
    }
    if (device_ != nullptr) {
      alcCloseDevice(device_);
    }
  }

  Status Write(std::span<const float> stereo) override {
    const Entered entered(*this);
    LARARIUM_RETURN_IF_ERROR(WaitForBuffer());
    const ALuint buffer = free_[--free_count_];
    alBufferData(buffer, AL_FORMAT_STEREO_FLOAT32, stereo.data(),
                 static_cast<ALsizei>(stereo.size_bytes()), SoundGraph::kRate);
    alSourceQueueBuffers(source_, 1, &buffer);
    block_seconds_ = static_cast<double>(stereo.size() / 2) / SoundGraph::kRate;
    ALint state = AL_STOPPED;
    alGetSourcei(source_, AL_SOURCE_STATE, &state);
    // The queue is full at the start, and again after it ran empty.
    if (state != AL_PLAYING && free_count_ == 0) {
      alSourcePlay(source_);
    }
    return alGetError() == AL_NO_ERROR ? Status() : Lost();
  }
  double latency() const override {
    ALCint64SOFT device_ns = 0;
    alcGetInteger64vSOFT(device_, ALC_DEVICE_LATENCY_SOFT, 1, &device_ns);
    return static_cast<double>(kQueued) * block_seconds_ + 1e-9 * static_cast<double>(device_ns);
  }
  Status Finish() override { return Status(); }
  std::string name() const override {
    const char* const name = alcGetString(device_, ALC_ALL_DEVICES_SPECIFIER);
    return name == nullptr ? "unnamed" : name;
  }

 private:
  class Entered {
   public:
    explicit Entered(const DeviceOut& out) { alcSetThreadContext(out.context_); }
    ~Entered() { alcSetThreadContext(nullptr); }
    Entered(const Entered&) = delete;
    Entered& operator=(const Entered&) = delete;
  };

  DeviceOut() = default;

  static Status Lost() { return Status::Error("sound device", "was lost"); }

  Status WaitForBuffer() {
    const auto begin = std::chrono::steady_clock::now();
    while (true) {
      ALCint connected = ALC_TRUE;
      alcGetIntegerv(device_, ALC_CONNECTED, 1, &connected);
      if (connected == ALC_FALSE || std::chrono::steady_clock::now() - begin > kStuck) {
        return Lost();
      }
      ALint played = 0;
      alGetSourcei(source_, AL_BUFFERS_PROCESSED, &played);
      for (; played > 0 && free_count_ < free_.size(); --played) {
        alSourceUnqueueBuffers(source_, 1, &free_[free_count_]);
        ++free_count_;
      }
      if (free_count_ > 0) {
        return Status();
      }
      std::this_thread::sleep_for(kPoll);
    }
  }

  ALCdevice* device_ = nullptr;
  ALCcontext* context_ = nullptr;
  ALuint source_ = 0;
  std::array<ALuint, kQueued> free_ = {};  // Buffers that are not queued.
  size_t free_count_ = 0;
  double block_seconds_ = 0.01;
};

}  // namespace

Result<std::unique_ptr<AudioOut>> OpenDeviceOut() { return DeviceOut::Open(); }

}  // namespace lararium::audio
