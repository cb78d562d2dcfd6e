#include "editor/bake/libav_sound.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>

#include "shared/image/libav.h"

extern "C" {
#include <libswresample/swresample.h>
}

namespace lararium::bake {
namespace {

using image::LibavMessage;
using image::LibavPtr;

// Playlists and similar formats would open further files or addresses that the file names.
constexpr char kContainers[] =
    "mov,mp4,m4a,3gp,3g2,mj2,mp3,aac,adts,loas,asf,wav,w64,rf64,aiff,caf,au,ogg,flac,amr,amrnb,"
    "amrwb,"
    "matroska,webm,ac3,eac3,mpegts,mpeg,avi,ape,tta,wv,dsf";
constexpr int kBufferBytes = 32'768;

Status SoundError(const std::string& where, const std::string& problem) {
  return Status::Error(where, "cannot be read as a sound: " + problem,
                       "save it as WAV, FLAC or Ogg");
}

// Bytes in memory as a file for libav.
struct SourceBytes {
  std::span<const std::byte> bytes;
  int64_t at = 0;
};

int ReadSource(void* opaque, uint8_t* to, int count) {
  auto& memory = *static_cast<SourceBytes*>(opaque);
  const int64_t left = static_cast<int64_t>(memory.bytes.size()) - memory.at;
  const auto taken = static_cast<int>(std::min<int64_t>(count, left));
  if (taken <= 0) {
    return AVERROR_EOF;
  }
  std::memcpy(to, memory.bytes.data() + memory.at, static_cast<size_t>(taken));
  memory.at += taken;
  return taken;
}

int64_t SeekSource(void* opaque, int64_t offset, int whence) {
  auto& memory = *static_cast<SourceBytes*>(opaque);
  const auto size = static_cast<int64_t>(memory.bytes.size());
  if ((whence & AVSEEK_SIZE) != 0) {
    return size;
  }
  const int from = whence & ~AVSEEK_FORCE;
  const int64_t base = from == SEEK_SET ? 0 : from == SEEK_CUR ? memory.at : size;
  if (offset < -base || offset > size - base) {
    return AVERROR(EINVAL);
  }
  memory.at = base + offset;
  return memory.at;
}

struct Close {
  void operator()(AVIOContext* io) const {
    av_freep(&io->buffer);
    avio_context_free(&io);
  }
  void operator()(AVFormatContext* format) const { avformat_close_input(&format); }
  void operator()(SwrContext* converter) const { swr_free(&converter); }
};

// Converts decoded frames to interleaved floats and appends them.
class Collector {
 public:
  explicit Collector(DecodedSound& sound) : sound_(sound) {}

  // Returns 0 or an error of libav. A stream whose layout changes midway is an error.
  int Add(AVFrame& frame) {
    if (converter_ == nullptr) {
      sound_.rate = frame.sample_rate;
      sound_.channels = frame.ch_layout.nb_channels;
      SwrContext* made = nullptr;
      int error = swr_alloc_set_opts2(&made, &frame.ch_layout, AV_SAMPLE_FMT_FLT, frame.sample_rate,
                                      &frame.ch_layout, static_cast<AVSampleFormat>(frame.format),
                                      frame.sample_rate, 0, nullptr);
      converter_.reset(made);
      error = error < 0 ? error : swr_init(made);
      if (error < 0) {
        return error;
      }
    }
    if (frame.sample_rate != sound_.rate || frame.ch_layout.nb_channels != sound_.channels) {
      return AVERROR_INPUT_CHANGED;
    }
    const size_t before = sound_.samples.size();
    sound_.samples.resize(before + static_cast<size_t>(frame.nb_samples) *
                                       static_cast<size_t>(sound_.channels));
    auto* to = reinterpret_cast<uint8_t*>(sound_.samples.data() + before);
    const int made =
        swr_convert(converter_.get(), &to, frame.nb_samples,
                    const_cast<const uint8_t**>(frame.extended_data), frame.nb_samples);
    return std::min(made, 0);
  }

 private:
  DecodedSound& sound_;
  std::unique_ptr<SwrContext, Close> converter_;
};

}  // namespace

Result<DecodedSound> DecodeWithLibav(std::span<const std::byte> bytes,
                                     const std::string& where,
                                     double max_seconds) {
  av_log_set_level(AV_LOG_FATAL);  // Errors are reported as Status.
  SourceBytes memory{bytes};
  const std::unique_ptr<AVIOContext, Close> io(
      avio_alloc_context(static_cast<uint8_t*>(av_malloc(kBufferBytes)), kBufferBytes, 0, &memory,
                         ReadSource, nullptr, SeekSource));
  AVFormatContext* opened = avformat_alloc_context();
  if (io == nullptr || opened == nullptr) {
    avformat_free_context(opened);
    return SoundError(where, "too little memory");
  }
  opened->pb = io.get();
  AVDictionary* options = nullptr;
  av_dict_set(&options, "format_whitelist", kContainers, 0);
  // This frees `opened` on an error.
  const int error = avformat_open_input(&opened, nullptr, nullptr, &options);
  av_dict_free(&options);
  if (error < 0) {
    return SoundError(where, LibavMessage(error));
  }
  const std::unique_ptr<AVFormatContext, Close> format(opened);
  const AVCodec* codec = nullptr;
  if (avformat_find_stream_info(format.get(), nullptr) < 0) {
    return SoundError(where, "it is damaged");
  }
  const int index = av_find_best_stream(format.get(), AVMEDIA_TYPE_AUDIO, -1, -1, &codec, 0);
  if (index < 0) {
    return SoundError(where, "it holds no sound that can be decoded");
  }
  const AVStream& stream = *format->streams[index];
  const LibavPtr<AVCodecContext> decoder(avcodec_alloc_context3(codec));
  if (decoder == nullptr || avcodec_parameters_to_context(decoder.get(), stream.codecpar) < 0) {
    return SoundError(where, "its parameters are broken");
  }
  // With the time base, the decoder skips the silence that an encoder puts first.
  decoder->pkt_timebase = stream.time_base;
  if (const int failed = avcodec_open2(decoder.get(), codec, nullptr); failed < 0) {
    return SoundError(where, LibavMessage(failed));
  }
  const LibavPtr<AVPacket> packet(av_packet_alloc());
  const LibavPtr<AVFrame> frame(av_frame_alloc());
  DecodedSound sound;
  Collector collector(sound);
  bool at_end = false;
  while (!at_end) {
    const int read = av_read_frame(format.get(), packet.get());
    at_end = read < 0;
    if (!at_end && packet->stream_index != index) {
      av_packet_unref(packet.get());
      continue;
    }
    // A damaged packet costs that packet.
    static_cast<void>(avcodec_send_packet(decoder.get(), at_end ? nullptr : packet.get()));
    av_packet_unref(packet.get());
    while (avcodec_receive_frame(decoder.get(), frame.get()) >= 0) {
      if (const int failed = collector.Add(*frame); failed < 0) {
        return SoundError(where, LibavMessage(failed));
      }
    }
    if (sound.rate > 0 &&
        static_cast<double>(sound.samples.size()) > max_seconds * sound.rate * sound.channels) {
      return Status::Error(where, "is too long", "cut it to the line");
    }
  }
  return sound;
}

}  // namespace lararium::bake
