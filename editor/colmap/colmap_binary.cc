#include "editor/colmap/colmap_binary.h"

#include <bit>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace lararium::train {
namespace {

static_assert(std::endian::native == std::endian::little, "COLMAP's files are little-endian");

// Minimum size of each record in bytes, which limits the counts.
constexpr size_t kCameraBytes = 24;
constexpr size_t kImageBytes = 4 + 7 * 8 + 4 + 1 + 8;
constexpr size_t kFeatureBytes = 24;
constexpr size_t kPointBytes = 8 + 3 * 8 + 3 + 8 + 8;
constexpr size_t kObservationBytes = 8;

// Takes numbers from the front of the bytes; remembers if there were too few.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  bool failed() const { return failed_; }
  bool at_end() const { return bytes_.empty(); }

  template <typename T>
  T Take() {
    static_assert(std::is_arithmetic_v<T>);
    T value{};
    if (bytes_.size() < sizeof(T)) {
      failed_ = true;
      bytes_ = {};
      return value;
    }
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    return value;
  }

  // Takes the number of records that follow, each of at least record_bytes. Fails and returns 0 if
  // the remaining bytes cannot hold them.
  size_t TakeCount(size_t record_bytes) {
    const auto count = Take<uint64_t>();
    if (count > bytes_.size() / record_bytes) {
      failed_ = true;
      bytes_ = {};
      return 0;
    }
    return static_cast<size_t>(count);
  }

  // Takes text up to a zero byte.
  std::string TakeText() {
    const size_t length = bytes_.find('\0');
    if (length == std::string_view::npos) {
      failed_ = true;
      bytes_ = {};
      return {};
    }
    std::string text(bytes_.substr(0, length));
    bytes_.remove_prefix(length + 1);
    return text;
  }

  Status Finish(const std::string& where) const {
    if (failed_) {
      return Status::Error(where, "is cut off or damaged", "copy the model again");
    }
    if (!bytes_.empty()) {
      return Status::Error(where, "has more bytes than its records need", "copy the model again");
    }
    return Status();
  }

 private:
  std::string_view bytes_;
  bool failed_ = false;
};

Status ParseBinaryCameras(std::string_view bytes, const std::string& where, ColmapModel& model) {
  Reader in(bytes);
  const size_t count = in.TakeCount(kCameraBytes);
  for (size_t i = 0; i < count && !in.failed(); ++i) {
    ColmapCamera& camera = model.cameras.emplace_back();
    camera.id = in.Take<uint32_t>();
    const auto number = in.Take<int32_t>();
    if (number < 0 || number >= kColmapCameraModels) {
      return Status::Error(
          where,
          "camera " + std::to_string(camera.id) + " has the unknown model " +
              std::to_string(number),
          "run `colmap image_undistorter`, and import its sparse model and images");
    }
    camera.model = static_cast<ColmapCameraModel>(number);
    camera.width = in.Take<uint64_t>();
    camera.height = in.Take<uint64_t>();
    for (size_t p = 0; p < ParameterCount(camera.model); ++p) {
      camera.parameters.push_back(in.Take<double>());
    }
  }
  return in.Finish(where);
}

Status ParseBinaryImages(std::string_view bytes, const std::string& where, ColmapModel& model) {
  Reader in(bytes);
  const size_t count = in.TakeCount(kImageBytes);
  for (size_t i = 0; i < count && !in.failed(); ++i) {
    ColmapImage& image = model.images.emplace_back();
    image.id = in.Take<uint32_t>();
    Eigen::Quaterniond& rotation = image.camera_from_map.rotation;
    rotation.w() = in.Take<double>();
    rotation.x() = in.Take<double>();
    rotation.y() = in.Take<double>();
    rotation.z() = in.Take<double>();
    for (double& t : image.camera_from_map.translation) {
      t = in.Take<double>();
    }
    image.camera = in.Take<uint32_t>();
    image.name = in.TakeText();
    image.features.resize(in.TakeCount(kFeatureBytes));
    for (ColmapFeature& feature : image.features) {
      feature.x = in.Take<double>();
      feature.y = in.Take<double>();
      feature.point = in.Take<uint64_t>();
    }
  }
  return in.Finish(where);
}

Status ParseBinaryPoints(std::string_view bytes, const std::string& where, ColmapModel& model) {
  Reader in(bytes);
  const size_t count = in.TakeCount(kPointBytes);
  for (size_t i = 0; i < count && !in.failed(); ++i) {
    ColmapPoint& point = model.points.emplace_back();
    point.id = in.Take<uint64_t>();
    for (double& x : point.position) {
      x = in.Take<double>();
    }
    for (uint8_t& channel : point.colour) {
      channel = in.Take<uint8_t>();
    }
    point.error = in.Take<double>();
    point.observations.resize(in.TakeCount(kObservationBytes));
    for (ColmapObservation& observation : point.observations) {
      observation.image = in.Take<uint32_t>();
      observation.feature = in.Take<uint32_t>();
    }
  }
  return in.Finish(where);
}

template <typename T>
void PutBinary(std::string& bytes, T value) {
  static_assert(std::is_arithmetic_v<T>);
  const size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

}  // namespace

Status ParseColmapBinary(const ColmapFiles& files, const std::string& where, ColmapModel& model) {
  LARARIUM_RETURN_IF_ERROR(ParseBinaryCameras(files.cameras, where + "/cameras.bin", model));
  LARARIUM_RETURN_IF_ERROR(ParseBinaryImages(files.images, where + "/images.bin", model));
  return ParseBinaryPoints(files.points, where + "/points3D.bin", model);
}

ColmapFiles SerializeColmapBinary(const ColmapModel& model) {
  ColmapFiles files;
  PutBinary<uint64_t>(files.cameras, model.cameras.size());
  for (const ColmapCamera& camera : model.cameras) {
    PutBinary(files.cameras, camera.id);
    PutBinary(files.cameras, static_cast<int32_t>(camera.model));
    PutBinary(files.cameras, camera.width);
    PutBinary(files.cameras, camera.height);
    for (const double parameter : camera.parameters) {
      PutBinary(files.cameras, parameter);
    }
  }
  PutBinary<uint64_t>(files.images, model.images.size());
  for (const ColmapImage& image : model.images) {
    PutBinary(files.images, image.id);
    const Eigen::Quaterniond& q = image.camera_from_map.rotation;
    for (const double component : {q.w(), q.x(), q.y(), q.z()}) {
      PutBinary(files.images, component);
    }
    for (const double t : image.camera_from_map.translation) {
      PutBinary(files.images, t);
    }
    PutBinary(files.images, image.camera);
    files.images.append(image.name.c_str(), image.name.size() + 1);
    PutBinary<uint64_t>(files.images, image.features.size());
    for (const ColmapFeature& feature : image.features) {
      PutBinary(files.images, feature.x);
      PutBinary(files.images, feature.y);
      PutBinary(files.images, feature.point);
    }
  }
  PutBinary<uint64_t>(files.points, model.points.size());
  for (const ColmapPoint& point : model.points) {
    PutBinary(files.points, point.id);
    for (const double x : point.position) {
      PutBinary(files.points, x);
    }
    for (const uint8_t channel : point.colour) {
      PutBinary(files.points, channel);
    }
    PutBinary(files.points, point.error);
    PutBinary<uint64_t>(files.points, point.observations.size());
    for (const ColmapObservation& observation : point.observations) {
      PutBinary(files.points, observation.image);
      PutBinary(files.points, observation.feature);
    }
  }
  return files;
}

}  // namespace lararium::train
