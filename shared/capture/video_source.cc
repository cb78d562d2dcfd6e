#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "shared/capture/film_converter.h"
#include "shared/capture/frame_source.h"
#include "shared/image/libav.h"

namespace lararium::capture {
namespace {

using geometry::Frame;
using image::LibavMessage;
using image::LibavPtr;

// Only plain video containers are allowed: playlists and similar formats would open further files
// or addresses that the file names.
constexpr char kContainers[] =
    "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,mpegts,mpeg,ogg,flv,asf,ivf,m4v,h264,hevc,mjpeg,mxf,"
    "dv";

// Seconds. Recorders that were stopped in between and films that were joined leave longer ones,
// which are no time that passed in the film.
constexpr double kLongestPause = 10.0;

struct FormatDeleter {
  void operator()(AVFormatContext* context) const { avformat_close_input(&context); }
};

// One pass through the file: demuxer and decoder.
struct Decoder {
  std::unique_ptr<AVFormatContext, FormatDeleter> format;
  LibavPtr<AVCodecContext> codec;
  AVStream* stream = nullptr;
  int films = 0;  // The number of streams that could be shown.
  bool draining = false;
};

Status VideoError(const std::filesystem::path& file, std::string_view problem) {
  return Status::Error(file.string(), problem, "give a complete video file, for example MP4");
}

// Containers with an index (MP4) state where each picture is stored.
Status CheckComplete(const std::filesystem::path& file, Decoder& decoder) {
  const int64_t file_size = avio_size(decoder.format->pb);
  const int count = avformat_index_get_entries_count(decoder.stream);
  for (int i = 0; i < count; ++i) {
    const AVIndexEntry* entry = avformat_index_get_entry(decoder.stream, i);
    if (entry->pos < 0 || entry->pos > file_size - entry->size) {
      return VideoError(file, "is cut off: picture " + std::to_string(i) + " of " +
                                  std::to_string(count) + " lies beyond its end");
    }
  }
  return Status();
}

Status OpenFormat(const std::filesystem::path& file, Decoder& decoder) {
  AVDictionary* options = nullptr;
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  av_dict_set(&options, "format_whitelist", kContainers, 0);
  AVFormatContext* context = nullptr;
  const int error =
      avformat_open_input(&context, ("file:" + file.string()).c_str(), nullptr, &options);
  av_dict_free(&options);
  if (error < 0) {
    return VideoError(file, "cannot be opened as a video (" + LibavMessage(error) + ")");
  }
  decoder.format.reset(context);
  if (const int found = avformat_find_stream_info(context, nullptr); found < 0) {
    return VideoError(file, "cannot be read as a video (" + LibavMessage(found) + ")");
  }
  return Status();
}

// Threads that each decode a frame hold their own images and answer later. Small videos, which one
// thread decodes in a few milliseconds per frame, get one thread. 0: one thread for each core.
int ThreadCount(const AVCodecContext& codec) {
  constexpr int64_t kLargePixels = 1280 * 720;
  return int64_t{codec.width} * codec.height <= kLargePixels ? 1 : 0;
}

// Chooses the largest film, and of equally large ones the one that the file recommends. Covers and
// previews are streams too: some say so, others hold one picture or are small. Returns -1 if there
// is no film.
int ChooseStream(const AVFormatContext& format, Decoder& decoder) {
  constexpr int kNoFilm =
      AV_DISPOSITION_ATTACHED_PIC | AV_DISPOSITION_TIMED_THUMBNAILS | AV_DISPOSITION_STILL_IMAGE;
  int best = -1;
  std::tuple<bool, int64_t, bool> best_rank;
  for (unsigned i = 0; i < format.nb_streams; ++i) {
    const AVStream& stream = *format.streams[i];
    if (stream.codecpar->codec_type != AVMEDIA_TYPE_VIDEO || (stream.disposition & kNoFilm) != 0 ||
        avcodec_find_decoder(stream.codecpar->codec_id) == nullptr) {
      continue;
    }
    ++decoder.films;
    const std::tuple rank(stream.nb_frames != 1,
                          int64_t{stream.codecpar->width} * stream.codecpar->height,
                          (stream.disposition & AV_DISPOSITION_DEFAULT) != 0);
    if (best < 0 || rank > best_rank) {
      best = static_cast<int>(i);
      best_rank = rank;
    }
  }
  return best;
}

Status OpenCodec(const std::filesystem::path& file, Decoder& decoder) {
  AVFormatContext* format = decoder.format.get();
  const int index = ChooseStream(*format, decoder);
  if (index < 0) {
    return VideoError(file, "contains no video that can be decoded");
  }
  const AVCodec* codec = avcodec_find_decoder(format->streams[index]->codecpar->codec_id);
  decoder.stream = format->streams[index];
  for (unsigned i = 0; i < format->nb_streams; ++i) {
    if (static_cast<int>(i) != index) {
      format->streams[i]->discard = AVDISCARD_ALL;
    }
  }
  decoder.codec.reset(avcodec_alloc_context3(codec));
  if (decoder.codec == nullptr ||
      avcodec_parameters_to_context(decoder.codec.get(), decoder.stream->codecpar) < 0) {
    return VideoError(file, "has broken video parameters");
  }
  decoder.codec->pkt_timebase = decoder.stream->time_base;
  decoder.codec->thread_count = ThreadCount(*decoder.codec);
  if (const int error = avcodec_open2(decoder.codec.get(), codec, nullptr); error < 0) {
    return VideoError(file, "cannot be decoded (" + LibavMessage(error) + ")");
  }
  return Status();
}

Result<Decoder> OpenDecoder(const std::filesystem::path& file) {
  Decoder decoder;
  LARARIUM_RETURN_IF_ERROR(OpenFormat(file, decoder));
  LARARIUM_RETURN_IF_ERROR(OpenCodec(file, decoder));
  LARARIUM_RETURN_IF_ERROR(CheckComplete(file, decoder));
  return decoder;
}

double FramesPerSecond(const AVStream& stream) {
  for (const AVRational rate : {stream.avg_frame_rate, stream.r_frame_rate}) {
    const double value = rate.den > 0 ? av_q2d(rate) : 0.0;
    if (value >= 0.1 && value <= 1000.0) {
      return value;
    }
  }
  return 30.0;
}

int64_t EstimateFrameCount(const Decoder& decoder, double frames_per_second) {
  if (decoder.stream->nb_frames > 0) {
    return decoder.stream->nb_frames;
  }
  if (decoder.format->duration > 0) {
    return std::llround(static_cast<double>(decoder.format->duration) / AV_TIME_BASE *
                        frames_per_second);
  }
  return 0;
}

// How long the film is by what its container states; zero if that is not known or known to be right
// (CheckComplete). What is stated for the file as a whole may be the length of its sound.
double StatedSeconds(const Decoder& decoder) {
  const AVFormatContext& format = *decoder.format;
  if (std::string_view(format.iformat->name).starts_with("mov") ||
      format.duration_estimation_method == AVFMT_DURATION_FROM_BITRATE) {
    return 0.0;
  }
  if (decoder.stream->duration > 0) {
    return static_cast<double>(decoder.stream->duration) * av_q2d(decoder.stream->time_base);
  }
  return format.nb_streams == 1 && format.duration > 0
             ? static_cast<double>(format.duration) / AV_TIME_BASE
             : 0.0;
}

// Frames are numbered in the order in which the decoder returns them when the file is read from its
// start, because containers may state wrong counts and packets may be undecodable. Times of frames
// are learned while decoding. A jump goes to a key frame, identifies the frame by its time, and
// decodes forward. A part of the file that was never decoded is reached by decoding up to it.
class VideoSource final : public FrameSource {
 public:
  VideoSource(std::filesystem::path file, Decoder decoder)
      : file_(std::move(file)),
        decoder_(std::move(decoder)),
        packet_(av_packet_alloc()),
        picture_(av_frame_alloc()),
        frames_per_second_(FramesPerSecond(*decoder_.stream)),
        estimated_count_(EstimateFrameCount(decoder_, frames_per_second_)) {}

  // Decodes the first frame, which determines the size.
  Status Start() {
    LARARIUM_ASSIGN_OR_RETURN(const bool decoded, Decode());
    if (!decoded) {
      return VideoError(file_, "contains no frame that can be decoded");
    }
    LARARIUM_ASSIGN_OR_RETURN(
        FilmConverter converter,
        FilmConverter::Create(file_, *decoder_.format, *decoder_.stream, *picture_));
    converter_.emplace(std::move(converter));
    if (converter_->high_dynamic_range()) {
      LARARIUM_RETURN_IF_ERROR(MeasureHighlights());
    }
    pending_ = true;
    return Status();
  }

  Result<std::optional<Frame>> Next() override {
    if (!pending_) {
      LARARIUM_ASSIGN_OR_RETURN(const bool decoded, Decode());
      if (!decoded) {
        return std::optional<Frame>();
      }
    }
    pending_ = false;
    LARARIUM_ASSIGN_OR_RETURN(Frame frame, Convert());
    return std::optional<Frame>(std::move(frame));
  }

  Status Seek(int64_t index) override {
    if (index < 0) {
      return Status::Error(file_.string(), "frame " + std::to_string(index) + " does not exist");
    }
    if (index != next_index_ - 1 || !has_picture_) {
      LARARIUM_RETURN_IF_ERROR(Reach(index));
    }
    pending_ = true;
    return Status();
  }

  std::optional<int64_t> frame_count() const override { return count_; }
  int64_t estimated_frame_count() const override { return count_.value_or(estimated_count_); }
  int width() const override { return converter_->size().width; }
  int height() const override { return converter_->size().height; }
  double frames_per_second() const override { return frames_per_second_; }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override { return NumberedFrameName(index); }
  std::vector<std::string> Notes() const override {
    std::vector<std::string> notes = converter_->notes();
    if (decoder_.films > 1) {
      notes.push_back(file_.string() + ": holds " + std::to_string(decoder_.films) +
                      " films; stream " + std::to_string(decoder_.stream->index) + " is used");
    }
    // What is found while the film is read comes last.
    if (undecodable_ > 0) {
      notes.push_back(file_.string() + ": " + std::to_string(undecodable_) +
                      " of its packets cannot be decoded; their frames are missing");
    }
    if (jumps_ > 0) {
      notes.push_back(file_.string() + ": its times jump in " + std::to_string(jumps_) +
                      " places, as if several films were joined; it is played without a pause "
                      "there");
    }
    if (!cut_off_.empty()) {
      notes.push_back(cut_off_);
    }
    return notes;
  }

 private:
  // Measures the present picture, and others at places all over the film.
  Status MeasureHighlights() {
    constexpr int kPlaces = 4;
    LARARIUM_RETURN_IF_ERROR(converter_->MeasureHighlights(*picture_));
    LARARIUM_ASSIGN_OR_RETURN(Decoder decoder, OpenDecoder(file_));
    std::swap(decoder_, decoder);
    LibavPtr<AVFrame> first = std::exchange(picture_, LibavPtr<AVFrame>(av_frame_alloc()));
    Status measured;
    for (int place = 1; place < kPlaces && measured.ok(); ++place) {
      if (av_seek_frame(decoder_.format.get(), -1, decoder_.format->duration / kPlaces * place,
                        AVSEEK_FLAG_BACKWARD) < 0) {
        break;
      }
      avcodec_flush_buffers(decoder_.codec.get());
      decoder_.draining = false;
      if (const Result<bool> received = ReceivePicture(); received.ok() && *received) {
        measured = converter_->MeasureHighlights(*picture_);
      }
    }
    std::swap(decoder_, decoder);
    picture_ = std::move(first);
    undecodable_ = 0;  // Errors behind a jump are no damage.
    return measured;
  }

  // Decodes frame `index` into picture_.
  Status Reach(int64_t index) {
    const auto next_key = std::lower_bound(key_frames_.begin(), key_frames_.end(), next_index_);
    const bool key_on_the_way = next_key != key_frames_.end() && *next_key <= index;
    if (index < next_index_ || key_on_the_way) {
      LARARIUM_RETURN_IF_ERROR(Jump(index));
    }
    while (next_index_ <= index) {
      LARARIUM_ASSIGN_OR_RETURN(const bool decoded, Decode());
      if (!decoded) {
        return Status::Error(file_.string(), "frame " + std::to_string(index) +
                                                 " does not exist, it has " +
                                                 std::to_string(next_index_) + " frames");
      }
    }
    return Status();
  }

  // Continues at a frame at or before `index`: at a known key frame, otherwise at the start.
  Status Jump(int64_t index) {
    if (times_are_ordered_) {
      auto key = std::upper_bound(key_frames_.begin(), key_frames_.end(), index);
      for (int attempt = 0; attempt < 2 && key != key_frames_.begin(); ++attempt) {
        --key;
        LARARIUM_ASSIGN_OR_RETURN(const bool landed, JumpToTime(times_[*key], index));
        if (landed) {
          return Status();
        }
      }
    }
    LARARIUM_ASSIGN_OR_RETURN(decoder_, OpenDecoder(file_));
    next_index_ = 0;
    has_picture_ = false;
    return Status();
  }

  // Returns false if the demuxer did not land on a known frame at or before `index`.
  Result<bool> JumpToTime(int64_t time, int64_t index) {
    if (av_seek_frame(decoder_.format.get(), decoder_.stream->index, time, AVSEEK_FLAG_BACKWARD) <
        0) {
      return false;
    }
    avcodec_flush_buffers(decoder_.codec.get());
    decoder_.draining = false;
    LARARIUM_ASSIGN_OR_RETURN(const bool decoded, ReceivePicture());
    const auto known =
        std::lower_bound(times_.begin(), times_.end(), picture_->best_effort_timestamp);
    if (!decoded || known == times_.end() || *known != picture_->best_effort_timestamp ||
        known - times_.begin() > index) {
      return false;
    }
    next_index_ = known - times_.begin() + 1;
    has_picture_ = true;
    return true;
  }

  // Decodes the next frame into picture_. Returns false at the end.
  Result<bool> Decode() {
    LARARIUM_ASSIGN_OR_RETURN(has_picture_, ReceivePicture());
    if (!has_picture_) {
      count_ = next_index_;
      CompareWithStated();
      return false;
    }
    if (next_index_ == static_cast<int64_t>(times_.size())) {
      Learn();
    }
    ++next_index_;
    return true;
  }

  // Notes that the film ends much earlier than its container states.
  void CompareWithStated() {
    const double stated = StatedSeconds(decoder_);
    const double unit = av_q2d(decoder_.stream->time_base);
    const double end = seconds_.empty() ? 0.0
                                        : seconds_.back() + 1.0 / frames_per_second_ +
                                              static_cast<double>(skipped_) * unit;
    if (times_are_ordered_ && end < 0.9 * stated - 1.0) {
      std::array<char, 128> text = {};
      std::snprintf(text.data(), text.size(),
                    ": ends after %.1f s, but states %.1f s: it is cut off; copy it again", end,
                    stated);
      cut_off_ = file_.string() + text.data();
    }
  }

  void Learn() {
    const int64_t time = picture_->best_effort_timestamp;
    times_are_ordered_ =
        times_are_ordered_ && time != AV_NOPTS_VALUE && (times_.empty() || time > times_.back());
    const double unit = av_q2d(decoder_.stream->time_base);
    if (times_are_ordered_) {
      const int64_t step = times_.empty() ? 0 : time - times_.back();
      if (static_cast<double>(step) * unit > kLongestPause) {
        ++jumps_;
        skipped_ += step - std::llround(1.0 / (frames_per_second_ * unit));
      }
      times_.push_back(time);
      seconds_.push_back(static_cast<double>(time - times_[0] - skipped_) * unit);
    } else {
      times_.push_back(time);
      seconds_.push_back(seconds_.empty() ? 0.0 : seconds_.back() + 1.0 / frames_per_second_);
    }
    if (image::IsKeyFrame(*picture_)) {
      key_frames_.push_back(next_index_);
    }
  }

  // Skips undecodable packets, as every player does. Returns false at the end.
  Result<bool> ReceivePicture() {
    while (true) {
      const int received = avcodec_receive_frame(decoder_.codec.get(), picture_.get());
      if (received == 0) {
        return true;
      }
      if (received == AVERROR_EOF) {
        return false;
      }
      LARARIUM_RETURN_IF_ERROR(SendPacket());
    }
  }

  Status SendPacket() {
    if (decoder_.draining) {
      return VideoError(file_, "cannot be decoded to its end");
    }
    const int read = av_read_frame(decoder_.format.get(), packet_.get());
    if (read == AVERROR_EOF) {
      decoder_.draining = true;
      avcodec_send_packet(decoder_.codec.get(), nullptr);
      return Status();
    }
    if (read < 0) {
      return VideoError(file_, "cannot be read after frame " + std::to_string(next_index_ - 1) +
                                   " (" + LibavMessage(read) + ")");
    }
    if (packet_->stream_index == decoder_.stream->index) {
      const bool first_time = next_index_ >= static_cast<int64_t>(times_.size());
      const int sent = avcodec_send_packet(decoder_.codec.get(), packet_.get());
      undecodable_ += sent < 0 && first_time ? 1 : 0;
    }
    av_packet_unref(packet_.get());
    return Status();
  }

  Result<Frame> Convert() {
    Frame frame;
    frame.index = next_index_ - 1;
    frame.capture_time = seconds_[static_cast<size_t>(frame.index)];
    LARARIUM_RETURN_IF_ERROR(converter_->Convert(*picture_, frame));
    return frame;
  }

  std::filesystem::path file_;
  Decoder decoder_;
  LibavPtr<AVPacket> packet_;
  LibavPtr<AVFrame> picture_;
  std::optional<FilmConverter> converter_;  // Set by Start().
  double frames_per_second_;
  int64_t estimated_count_;
  std::optional<int64_t> count_;

  int64_t next_index_ = 0;      // index of the frame that the decoder returns next
  bool has_picture_ = false;    // True if picture_ is frame next_index_ - 1.
  bool pending_ = false;        // True if Next() has not returned that frame yet.
  std::vector<int64_t> times_;  // Times of the decoded frames in the stream's time base.
  // Capture times of the same frames. They continue at the file's frame rate where its times jump,
  // and from the frame on at which they are no longer in order.
  std::vector<double> seconds_;
  int64_t skipped_ = 0;  // Time that jumps leave out, in the stream's time base.
  int jumps_ = 0;  // The number of frames that came more than kLongestPause after the one before.
  std::vector<int64_t> key_frames_;
  std::string cut_off_;  // The note that the end of the film is missing; empty if it is not.
  int undecodable_ = 0;  // The number of packets that gave an error when they were first read.
  bool times_are_ordered_ = true;
};

}  // namespace

std::string NumberedFrameName(int64_t index) {
  std::array<char, 32> name = {};
  std::snprintf(name.data(), name.size(), "%06lld.png", static_cast<long long>(index));
  return name.data();
}

Result<std::unique_ptr<FrameSource>> OpenVideo(const std::filesystem::path& file) {
  av_log_set_level(AV_LOG_FATAL);  // Errors are reported as Status.
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    return Status::Error(file.string(), "is not a file", "give the path of a video");
  }
  LARARIUM_ASSIGN_OR_RETURN(Decoder decoder, OpenDecoder(file));
  auto source = std::make_unique<VideoSource>(file, std::move(decoder));
  LARARIUM_RETURN_IF_ERROR(source->Start());
  return std::unique_ptr<FrameSource>(std::move(source));
}

}  // namespace lararium::capture
