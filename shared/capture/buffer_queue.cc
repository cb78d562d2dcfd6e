#include "shared/capture/buffer_queue.h"

#include <algorithm>
#include <cerrno>

namespace lararium::capture {
namespace {

constexpr uint32_t kBuffers = 4;
constexpr uint32_t kLeastBuffers = 2;  // One is filled while the other is read.
constexpr std::chrono::seconds kPatience(2);
constexpr std::chrono::seconds kPatienceAtFirst(5);  // Cameras start slowly.

v4l2_buffer Buffer(uint32_t index) {
  v4l2_buffer buffer = Zeroed<v4l2_buffer>();
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

v4l2_requestbuffers RequestOf(uint32_t count) {
  v4l2_requestbuffers request = Zeroed<v4l2_requestbuffers>();
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  request.count = count;
  return request;
}

// Linux's monotonic clock is std::chrono::steady_clock.
std::optional<double> TimeTaken(const v4l2_buffer& buffer) {
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    return std::nullopt;
  }
  return static_cast<double>(buffer.timestamp.tv_sec) +
         1e-6 * static_cast<double>(buffer.timestamp.tv_usec);
}

bool IsDamaged(const v4l2_buffer& buffer) {
  return (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 || buffer.bytesused == 0;
}

Status GivesNoImage(const std::string& name) {
  return Status::Error(name, "gives no image", "check that it is connected");
}

}  // namespace

Result<std::unique_ptr<BufferQueue>> BufferQueue::Start(const std::string& name,
                                                        VideoDevice& device) {
  std::unique_ptr<BufferQueue> queue(new BufferQueue(name, device));
  LARARIUM_RETURN_IF_ERROR(queue->Allocate());
  LARARIUM_RETURN_IF_ERROR(queue->Flow());
  return queue;
}

BufferQueue::~BufferQueue() {
  if (flows_) {
    uint32_t type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    Ask(device_, VIDIOC_STREAMOFF, &type);
  }
  for (const std::span<uint8_t> buffer : buffers_) {
    device_.Unmap(buffer.data(), buffer.size());
  }
  v4l2_requestbuffers none = RequestOf(0);
  Ask(device_, VIDIOC_REQBUFS, &none);
}

Status BufferQueue::Allocate() {
  v4l2_requestbuffers request = RequestOf(kBuffers);
  if (Ask(device_, VIDIOC_REQBUFS, &request) != 0) {
    return CannotOpen(name_, "VIDIOC_REQBUFS");
  }
  if (request.count < kLeastBuffers) {
    errno = ENOMEM;
    return CannotOpen(name_, "VIDIOC_REQBUFS");
  }
  for (uint32_t i = 0; i < request.count; ++i) {
    LARARIUM_RETURN_IF_ERROR(Share(i));
  }
  return Status();
}

Status BufferQueue::Share(uint32_t index) {
  v4l2_buffer buffer = Buffer(index);
  if (Ask(device_, VIDIOC_QUERYBUF, &buffer) != 0) {
    return CannotOpen(name_, "VIDIOC_QUERYBUF");
  }
  uint8_t* memory = device_.Map(buffer.length, buffer.m.offset);
  if (memory == nullptr) {
    return CannotOpen(name_, "mmap");
  }
  buffers_.emplace_back(memory, buffer.length);
  return Queue(index) ? Status() : CannotOpen(name_, "VIDIOC_QBUF");
}

Status BufferQueue::Flow() {
  uint32_t type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (Ask(device_, VIDIOC_STREAMON, &type) != 0) {
    return CannotOpen(name_, "VIDIOC_STREAMON");
  }
  flows_ = true;
  return Status();
}

bool BufferQueue::Queue(uint32_t index) {
  v4l2_buffer buffer = Buffer(index);
  return Ask(device_, VIDIOC_QBUF, &buffer) == 0;
}

// If the driver does not accept the buffer it has failed, and no image will come any more.
void BufferQueue::GiveBack(const SentImage& image) { Queue(image.buffer); }

Result<SentImage> BufferQueue::Newest() {
  const Clock::time_point deadline = Clock::now() + (came_ ? kPatience : kPatienceAtFirst);
  for (bool first = true; WaitUntil(deadline); first = false) {
    LARARIUM_ASSIGN_OR_RETURN(const std::optional<SentImage> image, Drain(!first));
    if (image) {
      came_ = true;
      return *image;
    }
  }
  return GivesNoImage(name_);
}

// True if there is something to fetch.
bool BufferQueue::WaitUntil(Clock::time_point deadline) {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) {
      return false;
    }
    const int ready = device_.Wait(static_cast<int>(left));
    if (ready >= 0 || errno != EINTR) {
      return ready > 0;
    }
  }
}

// Returns a filled buffer; nullopt if there is none.
Result<std::optional<v4l2_buffer>> BufferQueue::Fetch() {
  v4l2_buffer buffer = Buffer(0);
  if (Ask(device_, VIDIOC_DQBUF, &buffer) == 0) {
    CHECK(buffer.index < buffers_.size());
    return std::optional(buffer);
  }
  if (errno == EAGAIN) {
    return std::optional<v4l2_buffer>();
  }
  return GivesNoImage(name_);
}

// Returns the newest of the waiting images; nullopt if all are damaged. If every buffer was full,
// the driver had none for newer images: all are then returned to it, unless the caller accepts old
// images.
Result<std::optional<SentImage>> BufferQueue::Drain(bool may_be_old) {
  std::optional<SentImage> newest;
  size_t fetched = 0;
  for (; fetched < buffers_.size(); ++fetched) {
    LARARIUM_ASSIGN_OR_RETURN(const std::optional<v4l2_buffer> buffer, Fetch());
    if (!buffer) {
      break;
    }
    if (IsDamaged(*buffer)) {
      Queue(buffer->index);
      continue;
    }
    if (newest) {
      GiveBack(*newest);
    }
    const std::span<uint8_t> memory = buffers_[buffer->index];
    const size_t used = std::min<size_t>(buffer->bytesused, memory.size());
    newest = SentImage{buffer->index, memory.first(used), TimeTaken(*buffer)};
  }
  if (newest && fetched == buffers_.size() && !may_be_old) {
    GiveBack(*newest);
    newest.reset();
  }
  return newest;
}

}  // namespace lararium::capture
