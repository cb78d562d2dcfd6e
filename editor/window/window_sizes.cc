#include "editor/window/window_sizes.h"

#include <algorithm>
#include <string>
#include <vector>

#include "editor/document/user_folders.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"

namespace lararium::editor {

namespace {

constexpr int kSizesSchema = 1;
constexpr size_t kMaxFileBytes = size_t{1} << 16;
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
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return WindowSizes();
  }
  const Result<std::string> text = ReadText(file, kMaxFileBytes);
  Result<WindowSizes> sizes =
      text.ok() ? ParseFields<WindowSizes>(*text, file.string(), DescribeSizes) : text.status();
  if (!sizes.ok()) {
    return SetAside(file, sizes.status(), "the window has its usual size");
  }
  return sizes;
}

Status SaveWindowSizes(const std::filesystem::path& file, const WindowSizes& sizes) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  return SaveJson(file, FormatFields(sizes, DescribeSizes));
}

}  // namespace lararium::editor
