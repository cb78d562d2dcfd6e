#include "shared/capture/video_device.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace lararium::capture {
namespace {

class LinuxVideoDevice final : public VideoDevice {
 public:
  explicit LinuxVideoDevice(int descriptor) : descriptor_(descriptor) {}
  ~LinuxVideoDevice() override { close(descriptor_); }
  LinuxVideoDevice(const LinuxVideoDevice&) = delete;
  LinuxVideoDevice& operator=(const LinuxVideoDevice&) = delete;

  int Ioctl(unsigned long request, void* argument) override {
    return ioctl(descriptor_, request, argument);
  }

  uint8_t* Map(size_t length, int64_t offset) override {
    void* memory = mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, offset);
    return memory == MAP_FAILED ? nullptr : static_cast<uint8_t*>(memory);
  }

  void Unmap(uint8_t* memory, size_t length) override { munmap(memory, length); }

  int Wait(int milliseconds) override {
    pollfd asked = {.fd = descriptor_, .events = POLLIN, .revents = 0};
    return poll(&asked, 1, milliseconds);
  }

  int descriptor() const override { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

std::string VideoDeviceFile(int number) { return "/dev/video" + std::to_string(number); }

Result<std::unique_ptr<VideoDevice>> OpenVideoDevice(const std::string& name, int number) {
  const std::string file = VideoDeviceFile(number);
  const int descriptor = open(file.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    return CannotOpen(name, file);
  }
  return std::unique_ptr<VideoDevice>(std::make_unique<LinuxVideoDevice>(descriptor));
}

int Ask(VideoDevice& device, unsigned long request, void* argument) {
  int answer = 0;
  do {
    answer = device.Ioctl(request, argument);
  } while (answer < 0 && errno == EINTR);
  return answer;
}

Status CannotOpen(const std::string& name, const std::string& call) {
  const std::string why = std::generic_category().message(errno);
  return Status::Error(name, "cannot be opened (" + call + ": " + why + ")",
                       "check that it is connected and not in use");
}

}  // namespace lararium::capture
