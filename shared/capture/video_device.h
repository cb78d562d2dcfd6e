#pragma once

// Interface to a Video4Linux driver: the system calls that it answers, so that tests can replace
// it. Private to capture.

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

  // See ioctl(2): returns -1 and sets errno on failure.
  virtual int Ioctl(unsigned long request, void* argument) = 0;
  // See mmap(2): shared, for reading and writing; nullptr on failure.
  virtual uint8_t* Map(size_t length, int64_t offset) = 0;
  virtual void Unmap(uint8_t* memory, size_t length) = 0;
  // See poll(2) for reading: above 0 if there is something to fetch, even an error; 0 on timeout;
  // -1 with errno on failure.
  virtual int Wait(int milliseconds) = 0;
  // File descriptor for libraries that identify the camera; -1 if there is none.
  virtual int descriptor() const = 0;
};

// Returns "/dev/video" and the number.
std::string VideoDeviceFile(int number);

// Opens the driver with a number. `name` is the camera in errors.
Result<std::unique_ptr<VideoDevice>> OpenVideoDevice(const std::string& name, int number);

// Calls Ioctl(), and repeats it if a signal interrupts it.
int Ask(VideoDevice& device, unsigned long request, void* argument);

// Returns the error for a camera that cannot be opened because a call failed with errno.
Status CannotOpen(const std::string& name, const std::string& call);

// Returns an argument for a system call: unset fields, and all bytes of a union, must be 0.
template <typename T>
T Zeroed() {
  T value;
  std::memset(&value, 0, sizeof(value));
  return value;
}

}  // namespace lararium::capture
