#pragma once

// A driver of Video4Linux as its user sees it: the calls of the system that it answers, so that
// a double may stand in for it. Private to capture.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>

#include "shared/core/status.h"

namespace lararium::capture {

class VideoDevice {
 public:
  virtual ~VideoDevice() = default;

  // As ioctl(2): -1, with errno, where it fails.
  virtual int Ioctl(unsigned long request, void* argument) = 0;
  // As mmap(2), shared, for reading and writing; nullptr where it fails.
  virtual uint8_t* Map(size_t length, int64_t offset) = 0;
  virtual void Unmap(uint8_t* memory, size_t length) = 0;
  // As poll(2) for reading: above 0 where there is something to fetch, be it an error; 0 where
  // nothing came in this time; -1, with errno, where it fails.
  virtual int Wait(int milliseconds) = 0;
  // For libraries that look up which camera it is; -1: none.
  virtual int descriptor() const = 0;
};

// /dev/video and the number.
std::string VideoDeviceFile(int number);

// The driver behind it. name: of the camera, for errors.
Result<std::unique_ptr<VideoDevice>> OpenVideoDevice(const std::string& name, int number);

// Ioctl(), asked again where a signal came in between.
int Ask(VideoDevice& device, unsigned long request, void* argument);

// That a camera cannot be opened because a call failed, by errno.
Status CannotOpen(const std::string& name, const std::string& call);

// What the system is asked with: fields that are not set must be 0, in all of a union.
template <typename T>
T Zeroed() {
  T value;
  std::memset(&value, 0, sizeof(value));
  return value;
}

}  // namespace lararium::capture
