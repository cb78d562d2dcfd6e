// libFuzzer harness: parsing any three files as a COLMAP model terminates. An accepted model keeps
// every promise of colmap_model.h and reads back as it was written. The first byte chooses the
// format, the next four the positions at which the input is split into files.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "editor/colmap/colmap_model.h"
#include "shared/core/check.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using lararium::train::ColmapFormat;
  if (size < 5) {
    return 0;
  }
  const ColmapFormat format = (data[0] & 1) != 0 ? ColmapFormat::kText : ColmapFormat::kBinary;
  const std::string content(data + 5, data + size);
  const size_t first = std::min<size_t>(content.size(), data[1] << 8 | data[2]);
  const size_t second = std::min<size_t>(content.size() - first, data[3] << 8 | data[4]);
  const lararium::train::ColmapFiles files = {
      content.substr(0, first), content.substr(first, second), content.substr(first + second)};
  const auto model = lararium::train::ParseColmapModel(files, format, "fuzz");
  if (!model.ok()) {
    return 0;
  }
  CHECK(model->Validate().ok());
  for (const lararium::train::ColmapCamera& camera : model->cameras) {
    const auto ours = lararium::train::CameraFromColmap(camera);
    CHECK(!ours.ok() || ours->Validate().ok());
  }
  const auto written = lararium::train::SerializeColmapModel(*model, ColmapFormat::kBinary);
  CHECK(lararium::train::ParseColmapModel(written, ColmapFormat::kBinary, "fuzz").ok());
  return 0;
}
