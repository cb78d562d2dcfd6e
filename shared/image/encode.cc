#include "shared/image/encode.h"

#include <string>

#include "shared/core/file.h"
#include "shared/core/lower_case.h"

namespace lararium::image {
namespace {

Result<std::vector<std::byte>> EncodeAs(const std::string& ending,
                                        const cv::Mat& image,
                                        int jpeg_quality) {
  if (ending == ".png") {
    return EncodePng(image);
  }
  if (ending == ".jpg" || ending == ".jpeg") {
    return EncodeJpeg(image, jpeg_quality);
  }
  return Status::Error("picture", "cannot be written as \"" + ending + "\"");
}

}  // namespace

Status WriteImage(const std::filesystem::path& file, const cv::Mat& image, int jpeg_quality) {
  const auto encoded = EncodeAs(LowerCase(file.extension().string()), image, jpeg_quality);
  return encoded.ok() ? WriteFileAtomically(file, *encoded)
                      : Status::Error(file.string(), "the file name has no extension of a picture",
                                      "choose a name that ends in .png or .jpg");
}

}  // namespace lararium::image
