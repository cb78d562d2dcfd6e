#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

#include "shared/capture/frame_source.h"
#include "shared/capture/video_writer.h"
#include "shared/core/file.h"
#include "shared/core/random.h"
#include "shared/image/libav.h"
#include "tests/support/test_files.h"

namespace lararium::capture {
namespace {

using image::LibavPtr;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kWidth = 160;
constexpr int kHeight = 96;
constexpr int kBits = 10;
constexpr int kFrames = 300;  // more than one group of pictures of the encoder

// An image that shows the number of a frame as ten black or white bars.
cv::Mat NumberedImage(int number) {
  cv::Mat image(kHeight, kWidth, CV_8UC3, cv::Scalar::all(0));
  for (int bit = 0; bit < kBits; ++bit) {
    if ((number >> bit & 1) != 0) {
      image.colRange(16 * bit, 16 * bit + 16).setTo(cv::Scalar::all(255));
    }
  }
  return image;
}

int ReadNumber(const cv::Mat& grey) {
  int number = 0;
  for (int bit = 0; bit < kBits; ++bit) {
    const double mean = cv::mean(grey(cv::Rect(16 * bit + 4, 8, 8, kHeight - 16)))[0];
    number |= (mean > 127.0 ? 1 : 0) << bit;
  }
  return number;
}

Status WriteNumberedVideo(const std::filesystem::path& file, int frames) {
  LARARIUM_ASSIGN_OR_RETURN(const auto writer, VideoWriter::Create(file, kWidth, kHeight, 30.0));
  for (int i = 0; i < frames; ++i) {
    LARARIUM_RETURN_IF_ERROR(writer->Write(NumberedImage(i)));
  }
  return writer->Finish();
}

class NumberedVideo : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new test::TemporaryFolder;
    const Status written = WriteNumberedVideo(File(), kFrames);
    ASSERT_TRUE(written.ok()) << written.message();
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::filesystem::path File() { return *folder_ / "numbers.mp4"; }

  static std::unique_ptr<FrameSource> Open() {
    auto source = OpenVideo(File());
    EXPECT_TRUE(source.ok()) << source.message();
    return std::move(source).value();
  }

  static test::TemporaryFolder* folder_;
};
test::TemporaryFolder* NumberedVideo::folder_ = nullptr;

TEST_F(NumberedVideo, ReadsEveryFrameOnceInOrder) {
  const auto source = Open();
  EXPECT_EQ(source->width(), kWidth);
  EXPECT_EQ(source->height(), kHeight);
  EXPECT_DOUBLE_EQ(source->frames_per_second(), 30.0);
  EXPECT_EQ(source->estimated_frame_count(), kFrames);
  EXPECT_FALSE(source->frame_count().has_value());
  for (int i = 0; i < kFrames; ++i) {
    const auto frame = source->Next();
    ASSERT_TRUE(frame.ok()) << frame.message();
    ASSERT_TRUE(frame->has_value());
    EXPECT_EQ((*frame)->index, i);
    EXPECT_EQ(ReadNumber((*frame)->grey), i);
    EXPECT_NEAR((*frame)->capture_time, i / 30.0, 1e-4);
  }
  const auto end = source->Next();
  ASSERT_TRUE(end.ok());
  EXPECT_FALSE(end->has_value());
  EXPECT_EQ(source->frame_count(), kFrames);
}

TEST_F(NumberedVideo, SeeksToTheExactFrameInAnyOrder) {
  const auto source = Open();
  Random random(7);
  for (int i = 0; i < 40; ++i) {
    const int target = static_cast<int>(random.Below(kFrames));
    const Status sought = source->Seek(target);
    ASSERT_TRUE(sought.ok()) << sought.message();
    for (int k = 0; k < 2 && target + k < kFrames; ++k) {
      const auto frame = source->Next();
      ASSERT_TRUE(frame.ok() && frame->has_value()) << "seed 7, frame " << target + k;
      EXPECT_EQ((*frame)->index, target + k);
      EXPECT_EQ(ReadNumber((*frame)->grey), target + k);
    }
  }
}

TEST_F(NumberedVideo, SeekingAgainGivesTheSamePixels) {
  const auto source = Open();
  ASSERT_TRUE(source->Seek(271).ok());
  const cv::Mat first = source->Next()->value().bgr.clone();
  ASSERT_TRUE(source->Seek(3).ok());
  ASSERT_TRUE(source->Next()->has_value());
  ASSERT_TRUE(source->Seek(271).ok());
  EXPECT_EQ(cv::norm(first, source->Next()->value().bgr, cv::NORM_INF), 0.0);
}

TEST_F(NumberedVideo, SeekingOutsideIsAnErrorThatNamesTheFile) {
  const auto source = Open();
  EXPECT_THAT(source->Seek(-1).message(), HasSubstr("numbers.mp4"));
  EXPECT_THAT(source->Seek(kFrames).message(), HasSubstr("300 frames"));
  ASSERT_TRUE(source->Seek(5).ok());
  EXPECT_EQ(ReadNumber(source->Next()->value().grey), 5);
}

TEST_F(NumberedVideo, FramesThatAreHeldKeepTheirPixels) {
  const auto source = Open();
  std::vector<geometry::Frame> held;
  for (int i = 0; i < 40; ++i) {
    held.push_back(source->Next()->value());
  }
  for (int i = 0; i < 40; ++i) {
    EXPECT_EQ(ReadNumber(held[i].grey), i);
  }
}

TEST_F(NumberedVideo, CutOffFilesAreOneClearError) {
  const auto bytes = ReadBytes(File());
  ASSERT_TRUE(bytes.ok());
  for (const double part : {0.01, 0.3, 0.9, 0.999}) {
    const auto file = *folder_ / "cut.mp4";
    const size_t size = static_cast<size_t>(part * static_cast<double>(bytes->size()));
    ASSERT_TRUE(WriteFileAtomically(file, std::span(*bytes).first(size)).ok());
    const auto source = OpenVideo(file);
    ASSERT_FALSE(source.ok()) << part;
    EXPECT_THAT(source.message(), HasSubstr("cut.mp4: "));
  }
}

// Writes pictures at these times; two neighbours may have the same time.
void WriteTimedVideo(const std::filesystem::path& file, std::span<const int64_t> milliseconds) {
  AVFormatContext* format = nullptr;
  ASSERT_GE(avformat_alloc_output_context2(&format, nullptr, "matroska", file.c_str()), 0);
  AVStream* stream = avformat_new_stream(format, nullptr);
  stream->codecpar->codec_type = AVMEDIA_TYPE_VIDEO;
  stream->codecpar->codec_id = AV_CODEC_ID_MJPEG;
  stream->codecpar->width = kWidth;
  stream->codecpar->height = kHeight;
  stream->avg_frame_rate = {25, 1};
  stream->time_base = {1, 1000};
  ASSERT_GE(avio_open(&format->pb, file.c_str(), AVIO_FLAG_WRITE), 0);
  ASSERT_GE(avformat_write_header(format, nullptr), 0);
  const LibavPtr<AVPacket> packet(av_packet_alloc());
  for (size_t i = 0; i < milliseconds.size(); ++i) {
    std::vector<uint8_t> jpeg;
    cv::imencode(".jpg", NumberedImage(static_cast<int>(i)), jpeg);
    ASSERT_EQ(av_new_packet(packet.get(), static_cast<int>(jpeg.size())), 0);
    std::copy(jpeg.begin(), jpeg.end(), packet->data);
    packet->pts = packet->dts = milliseconds[i];
    packet->flags = AV_PKT_FLAG_KEY;
    ASSERT_GE(av_write_frame(format, packet.get()), 0);
    av_packet_unref(packet.get());
  }
  ASSERT_EQ(av_write_trailer(format), 0);
  avio_closep(&format->pb);
  avformat_free_context(format);
}

TEST(OpenVideo, TimeGoesOnWhereTheFilesOwnTimesLoseTheirOrder) {
  test::TemporaryFolder folder;
  const auto file = folder / "times.mkv";
  ASSERT_NO_FATAL_FAILURE(
      WriteTimedVideo(file, std::array<int64_t, 6>{0, 100, 200, 300, 300, 400}));
  const auto source = OpenVideo(file);
  ASSERT_TRUE(source.ok()) << source.message();
  const std::array<double, 6> expected = {0.0, 0.1, 0.2, 0.3, 0.34, 0.38};  // 25 frames a second
  for (const size_t first : {size_t{0}, size_t{2}, size_t{0}}) {
    ASSERT_TRUE((*source)->Seek(static_cast<int64_t>(first)).ok());
    for (size_t i = first; i < expected.size(); ++i) {
      const auto frame = (*source)->Next();
      ASSERT_TRUE(frame.ok() && frame->has_value()) << i;
      EXPECT_EQ(ReadNumber((*frame)->grey), static_cast<int>(i));
      EXPECT_NEAR((*frame)->capture_time, expected[i], 1e-9) << i;
    }
  }
}

TEST(OpenVideo, TimeGoesOnWhereTheFilesOwnTimesJump) {
  test::TemporaryFolder folder;
  const auto file = folder / "joined.mkv";
  ASSERT_NO_FATAL_FAILURE(WriteTimedVideo(
      file, std::array<int64_t, 6>{0, 100, 9'100, 3'609'100, 3'609'200, 90'000'000}));
  const auto source = OpenVideo(file);
  ASSERT_TRUE(source.ok()) << source.message();
  const std::array<double, 6> expected = {0.0, 0.1, 9.1, 9.14, 9.24, 9.28};  // 25 frames a second
  for (const size_t first : {size_t{0}, size_t{4}, size_t{2}}) {
    ASSERT_TRUE((*source)->Seek(static_cast<int64_t>(first)).ok());
    for (size_t i = first; i < expected.size(); ++i) {
      const auto frame = (*source)->Next();
      ASSERT_TRUE(frame.ok() && frame->has_value()) << i;
      EXPECT_EQ(ReadNumber((*frame)->grey), static_cast<int>(i));
      EXPECT_NEAR((*frame)->capture_time, expected[i], 1e-9) << i;
    }
  }
  EXPECT_THAT((*source)->Notes(), ElementsAre(HasSubstr("its times jump in 2 places")));
}

TEST(OpenVideo, SaysThatTheEndOfAFilmIsMissing) {
  test::TemporaryFolder folder;
  std::vector<int64_t> milliseconds(200);
  for (size_t i = 0; i < milliseconds.size(); ++i) {
    milliseconds[i] = 40 * static_cast<int64_t>(i);
  }
  ASSERT_NO_FATAL_FAILURE(WriteTimedVideo(folder / "whole.mkv", milliseconds));
  const auto bytes = ReadBytes(folder / "whole.mkv");
  ASSERT_TRUE(bytes.ok());
  ASSERT_TRUE(
      WriteFileAtomically(folder / "cut.mkv", std::span(*bytes).first(bytes->size() / 2)).ok());
  const auto notes_of = [&](const char* name) {
    const auto source = OpenVideo(folder / name);
    while (source.ok() && (*source)->frame_count() == std::nullopt && (*source)->Next().ok()) {
    }
    return source.ok() ? (*source)->Notes() : std::vector<std::string>{source.message()};
  };
  EXPECT_THAT(notes_of("whole.mkv"), IsEmpty());
  EXPECT_THAT(notes_of("cut.mkv"), ElementsAre(HasSubstr("but states 8.0 s: it is cut off")));
}

// Writes an MP4 with a large cover, a small preview and the film, in this order.
void WriteVideoWithCover(const std::filesystem::path& file) {
  constexpr int kFilmFrames = 5;
  const cv::Size sizes[] = {{640, 480}, {kWidth / 2, kHeight / 2}, {kWidth, kHeight}};
  AVFormatContext* format = nullptr;
  ASSERT_GE(avformat_alloc_output_context2(&format, nullptr, "mp4", file.c_str()), 0);
  for (const cv::Size& size : sizes) {
    AVStream* stream = avformat_new_stream(format, nullptr);
    stream->codecpar->codec_type = AVMEDIA_TYPE_VIDEO;
    stream->codecpar->codec_id = AV_CODEC_ID_MJPEG;
    stream->codecpar->width = size.width;
    stream->codecpar->height = size.height;
    stream->time_base = {1, 25};
  }
  format->streams[0]->disposition = AV_DISPOSITION_ATTACHED_PIC;
  ASSERT_GE(avio_open(&format->pb, file.c_str(), AVIO_FLAG_WRITE), 0);
  ASSERT_GE(avformat_write_header(format, nullptr), 0);
  const LibavPtr<AVPacket> packet(av_packet_alloc());
  for (int i = 0; i < kFilmFrames; ++i) {
    for (int stream = i == 0 ? 0 : 1; stream < 3; ++stream) {
      cv::Mat image;
      cv::resize(NumberedImage(stream == 0 ? 1023 : i), image, sizes[stream]);
      std::vector<uint8_t> jpeg;
      cv::imencode(".jpg", image, jpeg);
      ASSERT_EQ(av_new_packet(packet.get(), static_cast<int>(jpeg.size())), 0);
      std::copy(jpeg.begin(), jpeg.end(), packet->data);
      packet->stream_index = stream;
      packet->pts = packet->dts = av_rescale_q(i, {1, 25}, format->streams[stream]->time_base);
      packet->duration = av_rescale_q(1, {1, 25}, format->streams[stream]->time_base);
      packet->flags = AV_PKT_FLAG_KEY;
      ASSERT_GE(av_interleaved_write_frame(format, packet.get()), 0);
      av_packet_unref(packet.get());
    }
  }
  ASSERT_EQ(av_write_trailer(format), 0);
  avio_closep(&format->pb);
  avformat_free_context(format);
}

TEST(OpenVideo, PlaysTheFilmAndNotItsCoverOrPreview) {
  test::TemporaryFolder folder;
  const auto file = folder / "cover.mp4";
  ASSERT_NO_FATAL_FAILURE(WriteVideoWithCover(file));
  const auto source = OpenVideo(file);
  ASSERT_TRUE(source.ok()) << source.message();
  EXPECT_EQ((*source)->width(), kWidth);
  for (int i = 0; i < 5; ++i) {
    const auto frame = (*source)->Next();
    ASSERT_TRUE(frame.ok()) << frame.message();
    ASSERT_TRUE(frame->has_value()) << i;
    EXPECT_EQ(ReadNumber((*frame)->grey), i);
  }
  EXPECT_FALSE((*source)->Next()->has_value());
  EXPECT_THAT((*source)->Notes(), ::testing::ElementsAre(HasSubstr("holds 2 films; stream")));
}

TEST(OpenVideo, RefusesWhatIsNoVideo) {
  test::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "empty.mp4", "").ok());
  ASSERT_TRUE(WriteFileAtomically(folder / "text.mp4", "This is a letter, not a video.\n").ok());
  ASSERT_TRUE(WriteFileAtomically(folder / "list.m3u8", "#EXTM3U\n#EXTINF:1,\nother.ts\n").ok());
  for (const char* name : {"empty.mp4", "text.mp4", "list.m3u8", "absent.mp4", "."}) {
    const auto source = OpenVideo(folder / name);
    ASSERT_FALSE(source.ok()) << name;
    EXPECT_THAT(source.message(), HasSubstr(name));
  }
}

TEST(VideoWriter, KeepsColours) {
  test::TemporaryFolder folder;
  const auto file = folder / "colours.mp4";
  const cv::Vec3b colours[] = {{40, 40, 200},   {40, 180, 60}, {190, 70, 50},
                               {128, 128, 128}, {10, 10, 10},  {245, 245, 245}};
  cv::Mat image(128, 192, CV_8UC3);
  for (int i = 0; i < 6; ++i) {
    image.colRange(32 * i, 32 * i + 32).setTo(colours[i]);
  }
  auto writer = VideoWriter::Create(file, image.cols, image.rows, 25.0);
  ASSERT_TRUE(writer.ok()) << writer.message();
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE((*writer)->Write(image).ok());
  }
  ASSERT_TRUE((*writer)->Finish().ok());
  const auto source = OpenVideo(file);
  ASSERT_TRUE(source.ok()) << source.message();
  const cv::Mat read = (*source)->Next()->value().bgr;
  for (int i = 0; i < 6; ++i) {
    const cv::Scalar mean = cv::mean(read(cv::Rect(32 * i + 8, 8, 16, 112)));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(mean[c], colours[i][c], 3.0) << "colour " << i << " channel " << c;
    }
  }
}

// Returns the samples of a file's sound (left channel, 48000 a second), each at its time.
std::vector<float> DecodeSound(const std::filesystem::path& file) {
  std::vector<float> left;
  AVFormatContext* format = nullptr;
  EXPECT_GE(avformat_open_input(&format, file.c_str(), nullptr, nullptr), 0);
  EXPECT_GE(avformat_find_stream_info(format, nullptr), 0);
  const AVCodec* aac = nullptr;
  const int stream = av_find_best_stream(format, AVMEDIA_TYPE_AUDIO, -1, -1, &aac, 0);
  EXPECT_GE(stream, 0) << "there is no sound";
  if (stream >= 0) {
    const LibavPtr<AVCodecContext> codec(avcodec_alloc_context3(aac));
    avcodec_parameters_to_context(codec.get(), format->streams[stream]->codecpar);
    codec->pkt_timebase = format->streams[stream]->time_base;
    EXPECT_EQ(codec->sample_rate, VideoWriter::kSoundRate);
    EXPECT_GE(avcodec_open2(codec.get(), aac, nullptr), 0);
    const LibavPtr<AVPacket> packet(av_packet_alloc());
    const LibavPtr<AVFrame> frame(av_frame_alloc());
    for (bool more = true; more;) {
      more = av_read_frame(format, packet.get()) >= 0;
      if (more && packet->stream_index != stream) {
        av_packet_unref(packet.get());
        continue;
      }
      avcodec_send_packet(codec.get(), more ? packet.get() : nullptr);
      av_packet_unref(packet.get());
      while (avcodec_receive_frame(codec.get(), frame.get()) >= 0) {
        const int64_t begin = av_rescale_q(frame->pts, codec->pkt_timebase, {1, 48'000});
        left.resize(static_cast<size_t>(std::max<int64_t>(begin, 0)));
        const float* samples = reinterpret_cast<const float*>(frame->data[0]);
        left.insert(left.end(), samples, samples + frame->nb_samples);
      }
    }
  }
  avformat_close_input(&format);
  return left;
}

TEST(VideoWriter, AClickIsHeardWithItsFrame) {
  const test::TemporaryFolder folder;
  const auto file = folder / "click.mp4";
  for (const int clicked : {0, 1, 37, 58}) {
    auto writer = VideoWriter::Create(file, kWidth, kHeight, 30.0, true);
    ASSERT_TRUE(writer.ok()) << writer.message();
    std::vector<float> interval(2 * 1600);
    for (int i = 0; i < 60; ++i) {
      ASSERT_TRUE((*writer)->Write(NumberedImage(i)).ok());
      std::fill(interval.begin(), interval.end(), 0.0f);
      interval[0] = interval[1] = i == clicked ? 0.9f : 0.0f;
      ASSERT_TRUE((*writer)->WriteSound(interval).ok());
    }
    ASSERT_TRUE((*writer)->Finish().ok());
    const std::vector<float> left = DecodeSound(file);
    EXPECT_NEAR(static_cast<double>(left.size()), 60 * 1600, 2048.0);
    const auto loudest = std::max_element(
        left.begin(), left.end(), [](float a, float b) { return std::abs(a) < std::abs(b); });
    EXPECT_GT(*loudest, 0.1f);
    EXPECT_NEAR(static_cast<double>(loudest - left.begin()) / 48'000.0, clicked / 30.0, 0.002)
        << "frame " << clicked;
  }
}

TEST(VideoWriter, FramesOfAVariableRateKeepTheirTimes) {
  const test::TemporaryFolder folder;
  const auto file = folder / "variable.mp4";
  const double seconds[] = {0.0, 0.0333, 0.05, 0.1667, 0.1701, 0.6667, 2.0};
  auto writer = VideoWriter::Create(file, kWidth, kHeight, 30.0);
  ASSERT_TRUE(writer.ok());
  for (size_t i = 0; i < std::size(seconds); ++i) {
    ASSERT_TRUE((*writer)->Write(NumberedImage(static_cast<int>(i)), seconds[i]).ok());
  }
  ASSERT_TRUE((*writer)->Write(NumberedImage(7), 1.0).ok()) << "It comes just after the last one.";
  ASSERT_TRUE((*writer)->Finish().ok());
  const auto source = OpenVideo(file);
  ASSERT_TRUE(source.ok()) << source.message();
  for (size_t i = 0; i <= std::size(seconds); ++i) {
    const auto frame = (*source)->Next();
    ASSERT_TRUE(frame.ok() && frame->has_value());
    EXPECT_EQ(ReadNumber((*frame)->grey), static_cast<int>(i));
    EXPECT_NEAR((*frame)->capture_time, i < std::size(seconds) ? seconds[i] : 2.0, 1e-4);
  }
}

TEST(VideoWriter, LeavesNothingWhenUnfinished) {
  test::TemporaryFolder folder;
  {
    auto writer = VideoWriter::Create(folder / "half.mp4", kWidth, kHeight, 30.0);
    ASSERT_TRUE(writer.ok()) << writer.message();
    ASSERT_TRUE((*writer)->Write(NumberedImage(1)).ok());
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(VideoWriter, RefusesWhatItCannotWrite) {
  test::TemporaryFolder folder;
  EXPECT_THAT(VideoWriter::Create(folder / "odd.mp4", 161, 96, 30.0).message(), HasSubstr("even"));
  EXPECT_THAT(VideoWriter::Create(folder / "rate.mp4", 160, 96, 0.0).message(),
              HasSubstr("frame rate"));
  EXPECT_FALSE(VideoWriter::Create(folder / "no" / "such.mp4", 160, 96, 30.0).ok());
  auto writer = VideoWriter::Create(folder / "size.mp4", kWidth, kHeight, 30.0);
  ASSERT_TRUE(writer.ok());
  EXPECT_THAT((*writer)->Write(cv::Mat(10, 10, CV_8UC3)).message(), HasSubstr("10x10"));
}

}  // namespace
}  // namespace lararium::capture
