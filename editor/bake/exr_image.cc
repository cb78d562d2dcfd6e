#include "editor/bake/exr_image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

#include <exception>
#include <string>
#include <system_error>

namespace lararium::bake {

Status WriteExr(const std::filesystem::path& file,
                int width,
                int height,
                std::span<const glm::vec4> pixels) {
  const std::filesystem::path unfinished = file.string() + ".part";
  try {
    Imf::Header header(width, height);
    Imf::FrameBuffer buffer;
    const char* names[4] = {"R", "G", "B", "A"};
    for (int channel = 0; channel < 4; ++channel) {
      header.channels().insert(names[channel], Imf::Channel(Imf::FLOAT));
      buffer.insert(
          names[channel],
          Imf::Slice::Make(Imf::FLOAT, &pixels[0][channel], header.dataWindow(), sizeof(glm::vec4),
                           sizeof(glm::vec4) * static_cast<size_t>(width)));
    }
    Imf::OutputFile output(unfinished.c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(height);
  } catch (const std::exception& error) {
    return Status::Error(file.string(), std::string("cannot be written: ") + error.what());
  }
  std::error_code error;
  std::filesystem::rename(unfinished, file, error);
  return error ? Status::Error(file.string(), "cannot be written: " + error.message()) : Status();
}

}  // namespace lararium::bake
