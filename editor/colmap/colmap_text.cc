#include "editor/colmap/colmap_text.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace lararium::train {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::string_view kUndistort =
    "run `colmap image_undistorter`, and import its sparse model and images";

std::string_view Trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

class LineReader {
 public:
  LineReader(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  // The next line, which may be blank; nullopt at the end.
  std::optional<std::string_view> Next() {
    if (at_ >= text_.size()) {
      return std::nullopt;
    }
    const size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++number_;
    return Trimmed(line);
  }

  // Goes back to before the line that Next() has returned.
  void PutBack(std::string_view line) {
    at_ = static_cast<size_t>(line.data() - text_.data());
    at_ = text_.substr(0, at_).rfind('\n') + 1;
    --number_;
  }

  // The next line that is neither blank nor a comment.
  std::optional<std::string_view> NextRecord() {
    while (const std::optional<std::string_view> line = Next()) {
      if (!line->empty() && line->front() != '#') {
        return line;
      }
    }
    return std::nullopt;
  }

  Status Problem(std::string_view what,
                 std::string_view remedy = "write the model again with COLMAP") const {
    return Status::Error(file_ + ":" + std::to_string(number_), what, remedy);
  }

 private:
  std::string_view text_;
  std::string file_;
  size_t at_ = 0;
  size_t number_ = 0;
};

// Takes fields from the front of a line. Remembers if one was missing or not a number.
class FieldReader {
 public:
  explicit FieldReader(std::string_view line) : rest_(Trimmed(line)) {}

  bool failed() const { return failed_; }
  bool at_end() const { return rest_.empty(); }

  std::string_view TakeWord() {
    const size_t end = std::min(rest_.find_first_of(kBlanks), rest_.size());
    const std::string_view word = rest_.substr(0, end);
    rest_ = Trimmed(rest_.substr(end));
    failed_ = failed_ || word.empty();
    return word;
  }

  template <typename T>
  T Take() {
    std::string_view word = TakeWord();
    word.remove_prefix(word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0);
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    failed_ = failed_ || error != std::errc() || end != word.data() + word.size();
    if constexpr (std::is_floating_point_v<T>) {
      failed_ = failed_ || !std::isfinite(value);  // "nan" and "inf" are refused.
    }
    return value;
  }

  // Takes a point id; -1 means that there is no point.
  uint64_t TakePoint() {
    const std::string_view before = rest_;
    if (TakeWord() == "-1") {
      return ColmapFeature::kNoPoint;
    }
    rest_ = before;
    return Take<uint64_t>();
  }

  // Takes the rest of the line, because names may contain blanks.
  std::string TakeRest() {
    failed_ = failed_ || rest_.empty();
    return std::string(std::exchange(rest_, {}));
  }

 private:
  std::string_view rest_;
  bool failed_ = false;
};

// Whether the line behind that of an image is the next image, because a program left out the blank
// line of an image without features. A line of features consists of triples of numbers.
bool IsImage(std::string_view line) {
  FieldReader fields(line);
  for (int i = 0; i < 9; ++i) {
    fields.Take<double>();
  }
  if (fields.failed() || fields.at_end()) {
    return false;
  }
  size_t words = 9;
  while (!fields.at_end() && !fields.failed()) {
    fields.Take<double>();
    ++words;
  }
  return fields.failed() || words % 3 != 0;
}

std::optional<ColmapCameraModel> ModelOf(std::string_view name) {
  for (int i = 0; i < kColmapCameraModels; ++i) {
    if (Name(static_cast<ColmapCameraModel>(i)) == name) {
      return static_cast<ColmapCameraModel>(i);
    }
  }
  return std::nullopt;
}

Status ParseCameras(std::string_view text, const std::string& file, ColmapModel& model) {
  LineReader lines(text, file);
  while (const auto line = lines.NextRecord()) {
    FieldReader fields(*line);
    ColmapCamera camera;
    camera.id = fields.Take<uint32_t>();
    const std::string name(fields.TakeWord());
    const std::optional<ColmapCameraModel> kind = ModelOf(name);
    if (!kind) {
      return lines.Problem("has the unknown camera model \"" + name.substr(0, 64) + "\"",
                           kUndistort);
    }
    camera.model = *kind;
    camera.width = fields.Take<uint64_t>();
    camera.height = fields.Take<uint64_t>();
    for (size_t i = 0; i < ParameterCount(*kind); ++i) {
      camera.parameters.push_back(fields.Take<double>());
    }
    if (fields.failed() || !fields.at_end()) {
      return lines.Problem("is not CAMERA_ID, MODEL, WIDTH, HEIGHT and the parameters of " + name);
    }
    model.cameras.push_back(std::move(camera));
  }
  return Status();
}

Status ParseFeatures(const LineReader& lines, std::string_view line, ColmapImage& image) {
  FieldReader fields(line);
  while (!fields.at_end() && !fields.failed()) {
    ColmapFeature& feature = image.features.emplace_back();
    feature.x = fields.Take<double>();
    feature.y = fields.Take<double>();
    feature.point = fields.TakePoint();
  }
  return fields.failed() ? lines.Problem("is not X, Y and POINT3D_ID for each feature") : Status();
}

Status ParseImages(std::string_view text, const std::string& file, ColmapModel& model) {
  LineReader lines(text, file);
  while (const auto line = lines.NextRecord()) {
    FieldReader fields(*line);
    ColmapImage image;
    image.id = fields.Take<uint32_t>();
    Eigen::Quaterniond& rotation = image.camera_from_map.rotation;
    rotation.w() = fields.Take<double>();
    rotation.x() = fields.Take<double>();
    rotation.y() = fields.Take<double>();
    rotation.z() = fields.Take<double>();
    for (double& t : image.camera_from_map.translation) {
      t = fields.Take<double>();
    }
    image.camera = fields.Take<uint32_t>();
    image.name = fields.TakeRest();
    if (fields.failed()) {
      return lines.Problem(
          "is not IMAGE_ID, a quaternion (4), a translation (3), CAMERA_ID and NAME");
    }
    // The line after an image holds its features; it is blank if there are none.
    std::optional<std::string_view> features = lines.Next();
    while (features && features->starts_with('#')) {
      features = lines.Next();
    }
    if (features && IsImage(*features)) {
      lines.PutBack(*features);
    } else if (features) {
      LARARIUM_RETURN_IF_ERROR(ParseFeatures(lines, *features, image));
    }
    model.images.push_back(std::move(image));
  }
  return Status();
}

Status ParsePoints(std::string_view text, const std::string& file, ColmapModel& model) {
  LineReader lines(text, file);
  while (const auto line = lines.NextRecord()) {
    FieldReader fields(*line);
    ColmapPoint point;
    point.id = fields.Take<uint64_t>();
    for (double& x : point.position) {
      x = fields.Take<double>();
    }
    for (uint8_t& channel : point.colour) {
      channel = fields.Take<uint8_t>();
    }
    point.error = fields.Take<double>();
    while (!fields.at_end() && !fields.failed()) {
      ColmapObservation& observation = point.observations.emplace_back();
      observation.image = fields.Take<uint32_t>();
      observation.feature = fields.Take<uint32_t>();
    }
    if (fields.failed()) {
      return lines.Problem(
          "is not POINT3D_ID, X, Y, Z, R, G, B, ERROR, and IMAGE_ID and POINT2D_IDX for each "
          "observation");
    }
    model.points.push_back(std::move(point));
  }
  return Status();
}

// Appends a number with the fewest digits from which it can be read back unchanged.
template <typename T>
void Put(std::string& text, T value) {
  char digits[32];
  const auto [end, error] = std::to_chars(digits, digits + sizeof(digits), value);
  text.append(digits, end);
}

template <typename T>
void PutField(std::string& text, T value) {
  text += ' ';
  Put(text, value);
}

void PutFeatures(std::string& text, const ColmapImage& image) {
  bool first = true;
  for (const ColmapFeature& feature : image.features) {
    if (!std::exchange(first, false)) {
      text += ' ';
    }
    Put(text, feature.x);
    PutField(text, feature.y);
    if (feature.point == ColmapFeature::kNoPoint) {
      text += " -1";
    } else {
      PutField(text, feature.point);
    }
  }
  text += '\n';
}

}  // namespace

Status ParseColmapText(const ColmapFiles& files, const std::string& where, ColmapModel& model) {
  LARARIUM_RETURN_IF_ERROR(ParseCameras(files.cameras, where + "/cameras.txt", model));
  LARARIUM_RETURN_IF_ERROR(ParseImages(files.images, where + "/images.txt", model));
  return ParsePoints(files.points, where + "/points3D.txt", model);
}

ColmapFiles SerializeColmapText(const ColmapModel& model) {
  ColmapFiles files;
  files.cameras = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
  for (const ColmapCamera& camera : model.cameras) {
    Put(files.cameras, camera.id);
    files.cameras += ' ';
    files.cameras += Name(camera.model);
    PutField(files.cameras, camera.width);
    PutField(files.cameras, camera.height);
    for (const double parameter : camera.parameters) {
      PutField(files.cameras, parameter);
    }
    files.cameras += '\n';
  }
  files.images =
      "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
      "# POINTS2D[] as X, Y, POINT3D_ID\n";
  for (const ColmapImage& image : model.images) {
    Put(files.images, image.id);
    const Eigen::Quaterniond& q = image.camera_from_map.rotation;
    for (const double component : {q.w(), q.x(), q.y(), q.z()}) {
      PutField(files.images, component);
    }
    for (const double t : image.camera_from_map.translation) {
      PutField(files.images, t);
    }
    PutField(files.images, image.camera);
    files.images += ' ' + image.name + '\n';
    PutFeatures(files.images, image);
  }
  files.points = "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as IMAGE_ID, POINT2D_IDX\n";
  for (const ColmapPoint& point : model.points) {
    Put(files.points, point.id);
    for (const double x : point.position) {
      PutField(files.points, x);
    }
    for (const uint8_t channel : point.colour) {
      PutField(files.points, static_cast<unsigned>(channel));
    }
    PutField(files.points, point.error);
    for (const ColmapObservation& observation : point.observations) {
      PutField(files.points, observation.image);
      PutField(files.points, observation.feature);
    }
    files.points += '\n';
  }
  return files;
}

}  // namespace lararium::train
