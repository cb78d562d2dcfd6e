#include "editor/app/portrait.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "editor/app/studio.h"
#include "shared/core/file.h"

namespace lararium::app {
namespace {

// What a contact sheet shows of a face; those that a person lacks are left out.
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

// NAME=weight, or NAME.
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
      return Status::Error("--shape " + text, "has no possible weight", "use NAME=0.5");
    }
  }
  return StudioPose::Shape{*shape, weight};
}

Result<StudioPose> ParsePose(const PortraitOptions& options, const human::Human& human) {
  StudioPose pose;
  pose.time = options.time;
  if (!options.clip.empty()) {
    const std::optional<size_t> clip = FindByName(human.clips, options.clip);
    if (!clip) {
      return Status::Error("--clip " + options.clip, human.name + " has no such clip",
                           Names(human.clips));
    }
    pose.clip = static_cast<int>(*clip);
  } else if (options.sheet) {
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

// Pictures in rows, at the top left of one that grows with them.
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

// Each person from head to foot and their face.
Status AddPeople(const std::vector<human::Human>& people,
                 const std::vector<StudioPose>& poses,
                 Studio& studio,
                 Sheet& sheet) {
  for (const char* name : kSheetViews) {
    LARARIUM_ASSIGN_OR_RETURN(const StudioView view, ParseStudioView(name));
    for (size_t i = 0; i < people.size(); ++i) {
      LARARIUM_ASSIGN_OR_RETURN(cv::Mat picture,
                                studio.Shoot(people[i], poses[i], view, kFigureCell));
      Caption(people[i].name, picture);
      sheet.Add(picture);
    }
    sheet.EndRow();
  }
  for (const float azimuth : {0.0f, 0.9f}) {
    for (size_t i = 0; i < people.size(); ++i) {
      const StudioView view = {.azimuth = azimuth, .frame = StudioFrame::kFace};
      LARARIUM_ASSIGN_OR_RETURN(const cv::Mat picture,
                                studio.Shoot(people[i], poses[i], view, kHeadCell));
      sheet.Add(picture);
    }
    sheet.EndRow();
  }
  return Status();
}

// One face at rest, and with each shape in turn.
Status AddShapes(const human::Human& human, const StudioPose& pose, Studio& studio, Sheet& sheet) {
  const StudioView view = {.frame = StudioFrame::kFace};
  int count = 0;
  const auto add = [&](const StudioPose& shown, const std::string& caption) -> Status {
    LARARIUM_ASSIGN_OR_RETURN(cv::Mat picture, studio.Shoot(human, shown, view, kShapeCell));
    Caption(caption, picture);
    sheet.Add(picture);
    if (++count % kShapesPerRow == 0) {
      sheet.EndRow();
    }
    return Status();
  };
  LARARIUM_RETURN_IF_ERROR(add(pose, "neutral"));
  for (const char* name : kSheetShapes) {
    if (const std::optional<size_t> shape = FindByName(human.face, name)) {
      StudioPose shown = pose;
      shown.shapes.push_back({*shape, 1.0f});
      LARARIUM_RETURN_IF_ERROR(add(shown, name));
    }
  }
  return Status();
}

Result<cv::Mat> ShootSheet(const std::vector<human::Human>& people,
                           const std::vector<StudioPose>& poses,
                           Studio& studio) {
  Sheet sheet;
  LARARIUM_RETURN_IF_ERROR(AddPeople(people, poses, studio, sheet));
  for (size_t i = 0; i < people.size(); ++i) {
    if (!people[i].face.empty()) {
      LARARIUM_RETURN_IF_ERROR(AddShapes(people[i], poses[i], studio, sheet));
      break;
    }
  }
  return sheet.Finish();
}

Status WritePicture(const std::filesystem::path& file, const cv::Mat& picture) {
  std::vector<uint8_t> bytes;
  try {
    cv::imencode(file.extension().string(), picture, bytes, {cv::IMWRITE_JPEG_QUALITY, 92});
  } catch (const cv::Exception&) {
    bytes.clear();
  }
  if (bytes.empty()) {
    return Status::Error(file.string(), "no picture can be written as this", "use .png or .jpg");
  }
  return WriteFileAtomically(file, std::as_bytes(std::span(bytes)));
}

}  // namespace

Result<CommandResult> RunPortrait(const PortraitOptions& options) {
  std::vector<human::Human> people;
  std::vector<StudioPose> poses;
  for (const std::filesystem::path& file : options.humans) {
    LARARIUM_ASSIGN_OR_RETURN(human::Human human, human::LoadHuman(file));
    LARARIUM_ASSIGN_OR_RETURN(StudioPose pose, ParsePose(options, human));
    people.push_back(std::move(human));
    poses.push_back(std::move(pose));
  }
  LARARIUM_ASSIGN_OR_RETURN(const StudioView view, ParseStudioView(options.view));
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<Studio> studio, Studio::Create());
  cv::Mat picture;
  if (options.sheet) {
    LARARIUM_ASSIGN_OR_RETURN(picture, ShootSheet(people, poses, *studio));
  } else {
    std::vector<cv::Mat> pictures;
    for (size_t i = 0; i < people.size(); ++i) {
      LARARIUM_ASSIGN_OR_RETURN(
          const cv::Mat shot,
          studio->Shoot(people[i], poses[i], view, cv::Size(options.width, options.height)));
      pictures.push_back(shot);
    }
    cv::hconcat(pictures, picture);
  }
  LARARIUM_RETURN_IF_ERROR(WritePicture(options.out, picture));
  return CommandResult{
      "wrote " + options.out.string() + "\n",
      {{"out", options.out.string()}, {"width", picture.cols}, {"height", picture.rows}}};
}

}  // namespace lararium::app
