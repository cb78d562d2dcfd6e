#include "shared/image/codecs.h"

// In a browser only JPEG and PNG are decoded here: keyframes need the very pixels that training
// saw, and letters those that the editor drew. The browser decodes all other pictures.

namespace lararium::image {
namespace {

Status LeftToBrowser(const std::string& where) {
  return Status::Error(where, "is no JPEG or PNG", "let the browser decode it");
}

}  // namespace

Result<cv::Mat> DecodeTiff(Bytes /*encoded*/, Channels /*channels*/, const std::string& where) {
  return LeftToBrowser(where);
}

Result<cv::Mat> DecodeHeif(Bytes /*encoded*/, Channels /*channels*/, const std::string& where) {
  return LeftToBrowser(where);
}

Result<cv::Mat> DecodeByLibav(Bytes /*encoded*/, Channels /*channels*/, const std::string& where) {
  return LeftToBrowser(where);
}

bool IsTiff(Bytes /*encoded*/) { return false; }

bool IsHeif(Bytes /*encoded*/) { return false; }

std::optional<cv::Size> ReadTiffSize(Bytes /*encoded*/) { return std::nullopt; }

std::optional<cv::Size> ReadHeifSize(Bytes /*encoded*/) { return std::nullopt; }

}  // namespace lararium::image
