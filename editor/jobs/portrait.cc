#include "editor/jobs/portrait.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "editor/import/model/model_import.h"
#include "editor/import/objects/object_import.h"
#include "editor/jobs/studio.h"
#include "shared/core/file.h"
#include "shared/core/lower_case.h"
#include "shared/image/encode.h"

namespace lararium::editor {
namespace {

// The face shapes of a contact sheet; those that a person lacks are skipped.
constexpr std::array kSheetShapes = {"joy",     "sadness", "anger", "fear", "disgust", "surprise",
                                     "blink_l", "blink_r", "sil",   "PP",   "FF",      "TH",
                                     "DD",      "kk",      "CH",    "SS",   "nn",      "RR",
                                     "aa",      "E",       "ih",    "oh",   "ou"};
constexpr std::array kSheetViews = {"front", "side", "three-quarter"};
const cv::Size kFigureCell(304, 560);
const cv::Size kHeadCell(304, 304);
const cv::Size kShapeCell(190, 200);
constexpr int kShapesPerRow = 8;

template <typename T>
std::optional<size_t> FindByName(const std::vector<T>& all, std::string_view name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [name](const T& one) { return one.name == name; });
  return found == all.end() ? std::nullopt
                            : std::optional(static_cast<size_t>(found - all.begin()));
}

template <typename T>
std::string Names(const std::vector<T>& all) {
  std::string names;
  for (const T& one : all) {
    names += (names.empty() ? "" : ", ") + one.name;
  }
  return names.empty() ? "it has none" : "it has " + names;
}

// Parses NAME=weight or NAME.
Result<StudioPose::Shape> ParseShape(const std::string& text, const human::Human& human) {
  const size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::optional<size_t> shape = FindByName(human.face, name);
  if (!shape) {
    return Status::Error("--shape " + text, human.name + " has no face shape '" + name + "'",
                         Names(human.face));
  }
  float weight = 1.0f;
  if (equals != std::string::npos) {
    const char* begin = text.data() + equals + 1;
    const char* end = text.data() + text.size();
    const auto parsed = std::from_chars(begin, end, weight);
    if (parsed.ec != std::errc() || parsed.ptr != end || !(std::abs(weight) <= 4.0f)) {
      return Status::Error("--shape " + text, "has no valid weight", "use NAME=0.5");
    }
  }
  return StudioPose::Shape{*shape, weight};
}

Result<StudioPose> ParsePose(const PortraitOptions& options, const human::Human& human) {
  StudioPose pose;
  pose.time = options.time;
  pose.walk = options.walk;
  if (!options.clip.empty()) {
    const std::optional<size_t> clip = FindByName(human.clips, options.clip);
    if (!clip) {
      return Status::Error("--clip " + options.clip, human.name + " has no such clip",
                           Names(human.clips));
    }
    pose.clip = static_cast<int>(*clip);
  } else if (options.walk == 0.0) {
    pose.clip = CalmPose(human).clip;
  }
  for (const std::string& text : options.shapes) {
    LARARIUM_ASSIGN_OR_RETURN(const StudioPose::Shape shape, ParseShape(text, human));
    pose.shapes.push_back(shape);
  }
  return pose;
}

void Caption(const std::string& text, cv::Mat& picture) {
  const cv::Point at(6, picture.rows - 7);
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.45, cv::Scalar::all(25), 1,
              cv::LINE_AA);
}

// Arranges pictures in rows, from the top left.
class Sheet {
 public:
  void Add(const cv::Mat& picture) { row_.push_back(picture); }
  void EndRow() {
    if (!row_.empty()) {
      cv::Mat row;
      cv::hconcat(row_, row);
      width_ = std::max(width_, row.cols);
      rows_.push_back(row);
      row_.clear();
    }
  }
  cv::Mat Finish() {
    EndRow();
    for (cv::Mat& row : rows_) {
      cv::copyMakeBorder(row, row, 0, 0, 0, width_ - row.cols, cv::BORDER_CONSTANT,
                         cv::Scalar::all(150));
    }
    cv::Mat sheet;
    cv::vconcat(rows_, sheet);
    return sheet;
  }

 private:
  std::vector<cv::Mat> row_;
  std::vector<cv::Mat> rows_;
  int width_ = 0;
};

struct Sitter {
  std::shared_ptr<const human::Human> human;  // Null for a thing.
  StudioPose pose;
  std::shared_ptr<const stage::ObjectModel> thing;  // Null for a person.
};

// One picture of each person on a sheet.
struct SheetCell {
  StudioView view;
  cv::Size size;
};

std::vector<SheetCell> SheetCells() {
  std::vector<SheetCell> cells;
  for (const char* name : kSheetViews) {
    cells.push_back({*ParseStudioView(name), kFigureCell});
  }
  for (const float azimuth : {0.0f, 0.9f}) {
    cells.push_back({{.azimuth = azimuth, .frame = StudioFrame::kFace}, kHeadCell});
  }
  return cells;
}

// Takes the pictures of a person, one below the other.
Result<cv::Mat> ShootColumn(const Sitter& sitter, Studio& studio) {
  LARARIUM_RETURN_IF_ERROR(studio.Seat(sitter.human, sitter.pose));
  std::vector<cv::Mat> pictures;
  for (const SheetCell& cell : SheetCells()) {
    LARARIUM_ASSIGN_OR_RETURN(StudioShot shot, studio.Shoot(cell.view, cell.size));
    if (pictures.empty()) {
      Caption(sitter.human->name, shot.picture);
    }
    pictures.push_back(shot.picture);
  }
  cv::Mat column;
  cv::vconcat(pictures, column);
  return column;
}

// Adds the face at rest, then with each shape.
Status AddShapes(const Sitter& sitter, Studio& studio, Sheet& sheet) {
  LARARIUM_RETURN_IF_ERROR(studio.Seat(sitter.human, sitter.pose));
  int count = 0;
  const auto add = [&](std::span<const StudioPose::Shape> shapes, const char* caption) -> Status {
    studio.SetShapes(shapes);
    LARARIUM_ASSIGN_OR_RETURN(StudioShot shot,
                              studio.Shoot({.frame = StudioFrame::kFace}, kShapeCell));
    Caption(caption, shot.picture);
    sheet.Add(shot.picture);
    if (++count % kShapesPerRow == 0) {
      sheet.EndRow();
    }
    return Status();
  };
  LARARIUM_RETURN_IF_ERROR(add(sitter.pose.shapes, "neutral"));
  for (const char* name : kSheetShapes) {
    if (const std::optional<size_t> shape = FindByName(sitter.human->face, name)) {
      std::vector<StudioPose::Shape> shapes = sitter.pose.shapes;
      shapes.push_back({*shape, 1.0f});
      LARARIUM_RETURN_IF_ERROR(add(shapes, name));
    }
  }
  return Status();
}

Result<cv::Mat> ShootSheet(std::span<const Sitter> sitters, Studio& studio) {
  Sheet sheet;
  for (const Sitter& sitter : sitters) {
    LARARIUM_ASSIGN_OR_RETURN(const cv::Mat column, ShootColumn(sitter, studio));
    sheet.Add(column);
  }
  sheet.EndRow();
  const auto talker = std::find_if(sitters.begin(), sitters.end(), [](const Sitter& sitter) {
    return !sitter.human->face.empty();
  });
  if (talker != sitters.end()) {
    LARARIUM_RETURN_IF_ERROR(AddShapes(*talker, studio, sheet));
  }
  return sheet.Finish();
}

Result<stage::Prop> ReadThing(const std::filesystem::path& file, std::vector<std::string>& notes) {
  if (LowerCase(file.extension().string()) != ".larprop") {
    return import::ImportObject(file, notes);
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
  return stage::ParseProp(bytes, file.string());
}

Result<human::Human> ReadPerson(const std::filesystem::path& file,
                                std::vector<std::string>& notes) {
  if (LowerCase(file.extension().string()) == ".larhuman") {
    return human::LoadHuman(file);
  }
  LARARIUM_ASSIGN_OR_RETURN(import::ImportedHuman imported, import::ImportPerson(file));
  notes = std::move(imported.notes);
  return std::move(imported.human);
}

Result<Sitter> ReadSitter(const std::filesystem::path& file,
                          const PortraitOptions& options,
                          std::vector<std::string>& warnings) {
  const std::string extension = LowerCase(file.extension().string());
  Sitter sitter;
  std::vector<std::string> notes;
  if (extension == ".larprop" || (options.thing && extension != ".larhuman")) {
    LARARIUM_ASSIGN_OR_RETURN(stage::Prop prop, ReadThing(file, notes));
    LARARIUM_ASSIGN_OR_RETURN(sitter.thing,
                              stage::ObjectModel::Create(std::move(prop), file.string()));
  } else {
    LARARIUM_ASSIGN_OR_RETURN(human::Human human, ReadPerson(file, notes));
    LARARIUM_ASSIGN_OR_RETURN(sitter.pose, ParsePose(options, human));
    sitter.human = std::make_shared<const human::Human>(std::move(human));
  }
  for (const std::string& note : notes) {
    warnings.push_back(file.filename().string() + ": " + note);
  }
  return sitter;
}

Result<cv::Mat> ShootSideBySide(std::span<const Sitter> sitters,
                                const std::string& view_name,
                                cv::Size size,
                                Studio& studio) {
  StudioView view;
  if (!view_name.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(view, ParseStudioView(view_name));
  }
  std::vector<cv::Mat> pictures;
  for (const Sitter& sitter : sitters) {
    if (sitter.thing != nullptr) {
      LARARIUM_ASSIGN_OR_RETURN(
          const cv::Mat picture,
          studio.ShootThing(sitter.thing, size, view_name.empty() ? kObliquely : view));
      pictures.push_back(picture);
      continue;
    }
    LARARIUM_RETURN_IF_ERROR(studio.Seat(sitter.human, sitter.pose));
    LARARIUM_ASSIGN_OR_RETURN(const StudioShot shot, studio.Shoot(view, size));
    pictures.push_back(shot.picture);
  }
  cv::Mat picture;
  cv::hconcat(pictures, picture);
  return picture;
}

}  // namespace

Result<CommandResult> RunPortrait(const PortraitOptions& options) {
  std::vector<Sitter> sitters;
  std::vector<std::string> warnings;
  for (const std::filesystem::path& file : options.files) {
    LARARIUM_ASSIGN_OR_RETURN(Sitter sitter, ReadSitter(file, options, warnings));
    if (sitter.thing != nullptr && options.sheet) {
      return Status::Error("--sheet", "shows people, and " + file.string() + " is a thing",
                           "leave one of them out");
    }
    sitters.push_back(std::move(sitter));
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<Studio> studio, Studio::Create());
  cv::Mat picture;
  if (options.sheet) {
    LARARIUM_ASSIGN_OR_RETURN(picture, ShootSheet(sitters, *studio));
  } else {
    const cv::Size size(options.width, options.height);
    LARARIUM_ASSIGN_OR_RETURN(picture, ShootSideBySide(sitters, options.view, size, *studio));
  }
  LARARIUM_RETURN_IF_ERROR(image::WriteImage(options.out, picture));
  CommandResult result{
      "wrote " + options.out.string() + "\n",
      {{"out", options.out.string()}, {"width", picture.cols}, {"height", picture.rows}}};
  AddWarnings(warnings, result);
  return result;
}

}  // namespace lararium::editor
