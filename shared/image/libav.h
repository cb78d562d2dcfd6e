#pragma once

// Owning pointers to libav's objects, and what differs between its versions. Private to image,
// capture and the editor's bake.

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dovi_meta.h>
#include <libavutil/pixdesc.h>
#include <libavutil/spherical.h>
#include <libavutil/stereo3d.h>
#include <libswscale/swscale.h>
}

#include <array>
#include <memory>
#include <string>

namespace lararium::image {

struct LibavDeleter {
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* context) const { sws_freeContext(context); }
};
template <typename T>
using LibavPtr = std::unique_ptr<T, LibavDeleter>;

inline std::string LibavMessage(int error) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text = {};
  av_strerror(error, text.data(), text.size());
  return text.data();
}

inline bool IsKeyFrame(const AVFrame& frame) {
#ifdef AV_FRAME_FLAG_KEY
  return (frame.flags & AV_FRAME_FLAG_KEY) != 0;
#else
  return frame.key_frame != 0;
#endif
}

inline bool IsInterlaced(const AVFrame& frame) {
#ifdef AV_FRAME_FLAG_INTERLACED
  return (frame.flags & AV_FRAME_FLAG_INTERLACED) != 0;
#else
  return frame.interlaced_frame != 0;
#endif
}

// Returns what a container says of a stream; null if it says nothing of this type or too little of
// it to be a T.
template <typename T>
const T* StreamSideData(const AVStream& stream, AVPacketSideDataType type) {
#if LIBAVFORMAT_VERSION_INT >= AV_VERSION_INT(60, 15, 100)
  const AVPacketSideData* found = av_packet_side_data_get(
      stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data, type);
  return found != nullptr && found->size >= sizeof(T) ? reinterpret_cast<const T*>(found->data)
                                                      : nullptr;
#else
  size_t size = 0;
  const uint8_t* found = av_stream_get_side_data(&stream, type, &size);
  return found != nullptr && size >= sizeof(T) ? reinterpret_cast<const T*>(found) : nullptr;
#endif
}

}  // namespace lararium::image
