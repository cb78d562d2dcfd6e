#include "shared/capture/video_writer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "shared/core/file.h"
#include "shared/image/libav.h"

namespace lararium::capture {

using image::LibavMessage;
using image::LibavPtr;

namespace {

constexpr int kSoundChannels = 2;
constexpr int64_t kSoundBits = 192'000;  // bits per second
constexpr int kTicksPerSecond = 90'000;  // Whole numbers of them make the usual frame intervals.

struct MuxerDeleter {
  void operator()(AVFormatContext* context) const {
    if (context->pb != nullptr) {
      avio_closep(&context->pb);
    }
    avformat_free_context(context);
  }
};

}  // namespace

struct VideoWriter::Encoder {
  std::filesystem::path file;
  std::optional<FileReplacement> replacement;  // Set by VideoWriter::Create.
  std::unique_ptr<AVFormatContext, MuxerDeleter> muxer;
  LibavPtr<AVCodecContext> codec;
  LibavPtr<AVFrame> picture;
  LibavPtr<AVPacket> packet;
  LibavPtr<SwsContext> scaler;
  AVStream* stream = nullptr;
  int64_t frame_ticks = 1;  // One frame interval.
  int64_t last_ticks = -1;  // Time of the last frame; -1: there is none.
  // The sound encoder, if there is sound.
  LibavPtr<AVCodecContext> sound_codec;
  LibavPtr<AVFrame> sound_frame;
  AVStream* sound_stream = nullptr;
  int sound_filled = 0;  // Number of samples in sound_frame.
  int64_t sound_written = 0;

  Status Problem(std::string_view problem, int error) const {
    return Status::Error(file.string(), std::string(problem) + " (" + LibavMessage(error) + ")",
                         "check the folder and the free space");
  }

  Status OpenCodec(int width, int height, double frames_per_second) {
    const AVCodec* h264 = avcodec_find_encoder_by_name("libx264");
    if (h264 == nullptr) {
      h264 = avcodec_find_encoder(AV_CODEC_ID_H264);
    }
    codec.reset(h264 == nullptr ? nullptr : avcodec_alloc_context3(h264));
    if (codec == nullptr) {
      return Status::Error(file.string(), "no H.264 encoder is installed", "install libx264");
    }
    const AVRational rate = av_d2q(frames_per_second, 100000);
    codec->width = width;
    codec->height = height;
    codec->pix_fmt = AV_PIX_FMT_YUV420P;
    codec->time_base = {1, kTicksPerSecond};
    codec->framerate = rate;
    frame_ticks = std::llround(kTicksPerSecond / frames_per_second);
    codec->color_range = AVCOL_RANGE_MPEG;
    codec->colorspace = AVCOL_SPC_BT709;
    codec->color_primaries = AVCOL_PRI_BT709;
    codec->color_trc = AVCOL_TRC_BT709;
    codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    AVDictionary* options = nullptr;
    av_dict_set(&options, "crf", "18", 0);
    av_dict_set(&options, "preset", "veryfast", 0);
    const int error = avcodec_open2(codec.get(), h264, &options);
    av_dict_free(&options);
    return error < 0 ? Problem("the H.264 encoder does not start", error) : Status();
  }

  Status OpenSoundCodec() {
    const AVCodec* aac = avcodec_find_encoder(AV_CODEC_ID_AAC);
    sound_codec.reset(aac == nullptr ? nullptr : avcodec_alloc_context3(aac));
    if (sound_codec == nullptr) {
      return Status::Error(file.string(), "no AAC encoder is installed", "install libavcodec");
    }
    sound_codec->sample_rate = VideoWriter::kSoundRate;
    sound_codec->sample_fmt = AV_SAMPLE_FMT_FLTP;
    sound_codec->bit_rate = kSoundBits;
    sound_codec->time_base = {1, VideoWriter::kSoundRate};
    sound_codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    av_channel_layout_default(&sound_codec->ch_layout, kSoundChannels);
    if (const int error = avcodec_open2(sound_codec.get(), aac, nullptr); error < 0) {
      return Problem("the AAC encoder does not start", error);
    }
    sound_frame.reset(av_frame_alloc());
    if (sound_frame == nullptr) {
      return Problem("cannot be written", AVERROR(ENOMEM));
    }
    sound_frame->format = sound_codec->sample_fmt;
    sound_frame->nb_samples = sound_codec->frame_size;
    sound_frame->sample_rate = VideoWriter::kSoundRate;
    av_channel_layout_copy(&sound_frame->ch_layout, &sound_codec->ch_layout);
    const int error = av_frame_get_buffer(sound_frame.get(), 0);
    return error < 0 ? Problem("cannot be written", error) : Status();
  }

  Result<AVStream*> AddStream(const AVCodecContext& encoder) {
    AVStream* added = avformat_new_stream(muxer.get(), nullptr);
    if (added == nullptr || avcodec_parameters_from_context(added->codecpar, &encoder) < 0) {
      return Problem("cannot be written as MP4", AVERROR(ENOMEM));
    }
    added->time_base = encoder.time_base;
    return added;
  }

  Status OpenMuxer() {
    const std::string url = "file:" + replacement->unfinished().string();
    AVFormatContext* context = nullptr;
    if (const int error = avformat_alloc_output_context2(&context, nullptr, "mp4", url.c_str());
        error < 0) {
      return Problem("cannot be written as MP4", error);
    }
    muxer.reset(context);
    LARARIUM_ASSIGN_OR_RETURN(stream, AddStream(*codec));
    if (sound_codec != nullptr) {
      LARARIUM_ASSIGN_OR_RETURN(sound_stream, AddStream(*sound_codec));
    }
    stream->avg_frame_rate = codec->framerate;
    if (const int error = avio_open(&context->pb, url.c_str(), AVIO_FLAG_WRITE); error < 0) {
      return Problem("cannot be written", error);
    }
    AVDictionary* options = nullptr;
    av_dict_set(&options, "movflags", "+faststart", 0);
    const int error = avformat_write_header(context, &options);
    av_dict_free(&options);
    return error < 0 ? Problem("cannot be written", error) : Status();
  }

  Status OpenPicture() {
    packet.reset(av_packet_alloc());
    picture.reset(av_frame_alloc());
    scaler.reset(sws_getContext(codec->width, codec->height, AV_PIX_FMT_BGR24, codec->width,
                                codec->height, AV_PIX_FMT_YUV420P,
                                SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP, nullptr,
                                nullptr, nullptr));
    if (packet == nullptr || picture == nullptr || scaler == nullptr) {
      return Problem("cannot be written", AVERROR(ENOMEM));
    }
    sws_setColorspaceDetails(scaler.get(), sws_getCoefficients(SWS_CS_DEFAULT), 1,
                             sws_getCoefficients(SWS_CS_ITU709), 0, 0, 1 << 16, 1 << 16);
    picture->format = codec->pix_fmt;
    picture->width = codec->width;
    picture->height = codec->height;
    const int error = av_frame_get_buffer(picture.get(), 0);
    return error < 0 ? Problem("cannot be written", error) : Status();
  }

  // A null frame drains the encoder.
  Status Encode(AVCodecContext& encoder, const AVFrame* frame, const AVStream& to) {
    if (const int error = avcodec_send_frame(&encoder, frame); error < 0) {
      return Problem("a frame cannot be encoded", error);
    }
    while (true) {
      const int error = avcodec_receive_packet(&encoder, packet.get());
      if (error == AVERROR(EAGAIN) || error == AVERROR_EOF) {
        return Status();
      }
      if (error < 0) {
        return Problem("a frame cannot be encoded", error);
      }
      if (&to == stream) {
        packet->duration = frame_ticks;
      }
      av_packet_rescale_ts(packet.get(), encoder.time_base, to.time_base);
      packet->stream_index = to.index;
      if (const int written = av_interleaved_write_frame(muxer.get(), packet.get()); written < 0) {
        return Problem("cannot be written", written);
      }
    }
  }

  // Encodes the content of sound_frame.
  Status EncodeSound() {
    sound_frame->nb_samples = sound_filled;
    sound_frame->pts = sound_written;
    sound_written += sound_filled;
    sound_filled = 0;
    return Encode(*sound_codec, sound_frame.get(), *sound_stream);
  }

  Status AddSound(std::span<const float> stereo) {
    for (size_t i = 0; i + 1 < stereo.size(); i += kSoundChannels) {
      if (sound_filled == 0) {
        if (const int error = av_frame_make_writable(sound_frame.get()); error < 0) {
          return Problem("the sound cannot be encoded", error);
        }
      }
      for (size_t channel = 0; channel < kSoundChannels; ++channel) {
        reinterpret_cast<float*>(sound_frame->data[channel])[sound_filled] = stereo[i + channel];
      }
      if (++sound_filled == sound_codec->frame_size) {
        LARARIUM_RETURN_IF_ERROR(EncodeSound());
      }
    }
    return Status();
  }

  Status Drain() {
    LARARIUM_RETURN_IF_ERROR(Encode(*codec, nullptr, *stream));
    if (sound_codec == nullptr) {
      return Status();
    }
    if (sound_filled > 0) {
      LARARIUM_RETURN_IF_ERROR(EncodeSound());
    }
    return Encode(*sound_codec, nullptr, *sound_stream);
  }
};

VideoWriter::VideoWriter(std::unique_ptr<Encoder> encoder) : encoder_(std::move(encoder)) {}
VideoWriter::~VideoWriter() = default;

Result<std::unique_ptr<VideoWriter>> VideoWriter::Create(const std::filesystem::path& file,
                                                         int width,
                                                         int height,
                                                         double frames_per_second,
                                                         bool with_sound) {
  if (width < 16 || height < 16 || width > 16384 || height > 16384 || width % 2 != 0 ||
      height % 2 != 0) {
    return Status::Error(
        file.string(),
        "a video cannot be " + std::to_string(width) + "x" + std::to_string(height) + " pixels",
        "width and height must be even, from 16 to 16384");
  }
  if (!(frames_per_second >= 0.1 && frames_per_second <= 1000.0)) {
    return Status::Error(file.string(), "the frame rate must lie between 0.1 and 1000");
  }
  av_log_set_level(AV_LOG_FATAL);  // Errors are reported as Status.
  auto encoder = std::make_unique<Encoder>();
  encoder->file = file;
  LARARIUM_ASSIGN_OR_RETURN(encoder->replacement, FileReplacement::Begin(file));
  LARARIUM_RETURN_IF_ERROR(encoder->OpenCodec(width, height, frames_per_second));
  if (with_sound) {
    LARARIUM_RETURN_IF_ERROR(encoder->OpenSoundCodec());
  }
  LARARIUM_RETURN_IF_ERROR(encoder->OpenMuxer());
  LARARIUM_RETURN_IF_ERROR(encoder->OpenPicture());
  return std::unique_ptr<VideoWriter>(new VideoWriter(std::move(encoder)));
}

Status VideoWriter::Write(const cv::Mat& bgr) {
  CHECK(encoder_ != nullptr);
  const Encoder& e = *encoder_;
  const int64_t ticks = e.last_ticks < 0 ? 0 : e.last_ticks + e.frame_ticks;
  return Write(bgr, static_cast<double>(ticks) / kTicksPerSecond);
}

Status VideoWriter::Write(const cv::Mat& bgr, double seconds) {
  CHECK(encoder_ != nullptr);
  Encoder& e = *encoder_;
  if (bgr.type() != CV_8UC3 || bgr.cols != e.codec->width || bgr.rows != e.codec->height) {
    return Status::Error(e.file.string(), "a frame is " + std::to_string(bgr.cols) + "x" +
                                              std::to_string(bgr.rows) + ", the video " +
                                              std::to_string(e.codec->width) + "x" +
                                              std::to_string(e.codec->height));
  }
  if (const int error = av_frame_make_writable(e.picture.get()); error < 0) {
    return e.Problem("a frame cannot be encoded", error);
  }
  const uint8_t* planes[] = {bgr.data};
  const int strides[] = {static_cast<int>(bgr.step)};
  sws_scale(e.scaler.get(), planes, strides, 0, bgr.rows, e.picture->data, e.picture->linesize);
  e.last_ticks = std::max<int64_t>(std::llround(seconds * kTicksPerSecond), e.last_ticks + 1);
  e.picture->pts = e.last_ticks;
  return e.Encode(*e.codec, e.picture.get(), *e.stream);
}

Status VideoWriter::WriteSound(std::span<const float> stereo) {
  CHECK(encoder_ != nullptr && encoder_->sound_codec != nullptr);
  return encoder_->AddSound(stereo);
}

Status VideoWriter::Finish() {
  CHECK(encoder_ != nullptr);
  const std::unique_ptr<Encoder> e = std::move(encoder_);
  LARARIUM_RETURN_IF_ERROR(e->Drain());
  if (const int error = av_write_trailer(e->muxer.get()); error < 0) {
    return e->Problem("cannot be completed", error);
  }
  if (const int error = avio_closep(&e->muxer->pb); error < 0) {
    return e->Problem("cannot be completed", error);
  }
  return e->replacement->Commit();
}

}  // namespace lararium::capture
