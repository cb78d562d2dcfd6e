#include "editor/window/window_sizes.h"

#include <algorithm>
#include <vector>

#include "editor/document/user_folders.h"

namespace lararium::editor {

namespace {

constexpr int kSizesSchema = 1;
constexpr double kLargest = 1 << 15;  // Largest size of a window or panel.

void DescribeSizes(Fields& fields, WindowSizes& sizes) {
  fields.Schema(kSizesSchema);
  fields.Object("window", sizes, [](Fields& window, WindowSizes& size) {
    const auto largest = static_cast<int64_t>(kLargest);
    window.Integer("width", size.width, 1, largest);
    window.Integer("height", size.height, 1, largest);
  });
  fields.Flag("maximized", sizes.maximized);
  fields.Number("outliner", sizes.panels.outliner, 1.0, kLargest);
  fields.Number("inspector", sizes.panels.inspector, 1.0, kLargest);
  auto& bottom = sizes.panels.bottom;
  std::vector heights(bottom.begin(), bottom.end());
  fields.List("bottom", heights, bottom.size(), [&](const FieldKey& key, auto& height) {
    fields.Number(key, height, 1.0, kLargest);
  });
  fields.RequireAt("bottom", heights.size() == bottom.size(), "must have a height for each tab");
  if (fields.reading() && heights.size() == bottom.size()) {
    std::copy(heights.begin(), heights.end(), bottom.begin());
  }
}

}  // namespace

Result<WindowSizes> LoadWindowSizes(const std::filesystem::path& file) {
  return LoadUserFile<WindowSizes>(file, "the window has its usual size", DescribeSizes);
}

Status SaveWindowSizes(const std::filesystem::path& file, const WindowSizes& sizes) {
  return SaveUserFile(file, sizes, DescribeSizes);
}

}  // namespace lararium::editor
