#include "editor/window/window_sizes.h"

#include <string>
#include <vector>

#include "editor/document/user_folders.h"
#include "shared/core/file.h"
#include "shared/core/json.h"

namespace lararium::editor {

namespace {

constexpr int kSizesSchema = 1;
constexpr size_t kMaxFileBytes = size_t{1} << 16;
constexpr double kLargest = 1 << 15;  // Largest size of a window or panel.

Result<WindowSizes> Parse(const std::string& text, const std::string& place) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, place));
  const JsonView view(json, place);
  LARARIUM_RETURN_IF_ERROR(
      view.CheckFields({"schema", "window", "maximized", "outliner", "inspector", "bottom"}));
  LARARIUM_RETURN_IF_ERROR(view.Integer("schema", kSizesSchema, kSizesSchema).status());
  WindowSizes sizes;
  LARARIUM_ASSIGN_OR_RETURN(const JsonView window, view.Field("window"));
  LARARIUM_RETURN_IF_ERROR(window.CheckFields({"width", "height"}));
  const auto largest = static_cast<int64_t>(kLargest);
  LARARIUM_ASSIGN_OR_RETURN(const int64_t width, window.Integer("width", 1, largest));
  LARARIUM_ASSIGN_OR_RETURN(const int64_t height, window.Integer("height", 1, largest));
  sizes.width = static_cast<int>(width);
  sizes.height = static_cast<int>(height);
  LARARIUM_ASSIGN_OR_RETURN(const JsonView maximized, view.Field("maximized"));
  LARARIUM_ASSIGN_OR_RETURN(sizes.maximized, maximized.Boolean());
  LARARIUM_ASSIGN_OR_RETURN(sizes.panels.outliner, view.Number("outliner", 1.0, kLargest));
  LARARIUM_ASSIGN_OR_RETURN(sizes.panels.inspector, view.Number("inspector", 1.0, kLargest));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView bottom, view.Field("bottom"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> heights,
                            bottom.Array(sizes.panels.bottom.size()));
  if (heights.size() != sizes.panels.bottom.size()) {
    return bottom.Problem("must have a height for each tab");
  }
  for (size_t i = 0; i < heights.size(); ++i) {
    LARARIUM_ASSIGN_OR_RETURN(sizes.panels.bottom[i], heights[i].Number(1.0, kLargest));
  }
  return sizes;
}

}  // namespace

Result<WindowSizes> LoadWindowSizes(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return WindowSizes();
  }
  const Result<std::string> text = ReadText(file, kMaxFileBytes);
  Result<WindowSizes> sizes = text.ok() ? Parse(*text, file.string()) : text.status();
  if (!sizes.ok()) {
    return SetAside(file, sizes.status(), "the window has its usual size");
  }
  return sizes;
}

Status SaveWindowSizes(const std::filesystem::path& file, const WindowSizes& sizes) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  return SaveJson(file, {{"schema", kSizesSchema},
                         {"window", {{"width", sizes.width}, {"height", sizes.height}}},
                         {"maximized", sizes.maximized},
                         {"outliner", sizes.panels.outliner},
                         {"inspector", sizes.panels.inspector},
                         {"bottom", sizes.panels.bottom}});
}

}  // namespace lararium::editor
