#include "editor/train/colmap_binary.h"

#include <bit>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace lararium::train {
namespace {

static_assert(std::endian::native == std::endian::little, "COLMAP's files are little-endian");

// The bytes of each record at least, to bound counts.
constexpr size_t kCameraBytes = 24;
constexpr size_t kImageBytes = 4 + 7 * 8 + 4 + 1 + 8;
constexpr size_t kFeatureBytes = 24;
constexpr size_t kPointBytes = 8 + 3 * 8 + 3 + 8 + 8;
constexpr size_t kSightBytes = 8;

// Takes numbers from the front of bytes; remembers when they ran out.
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

  // How many records of at least record_bytes follow; 0 and failed where so many cannot.
  size_t TakeCount(size_t record_bytes) {
    const auto count = Take<uint64_t>();
    if (count > bytes_.size() / record_bytes) {
      failed_ = true;
      bytes_ = {};
      return 0;
    }
    return static_cast<size_t>(count);
  }

  // Up to a zero byte.
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

  Status Finish(const std::string& place) const {
    if (failed_) {
      return Status::Error(place, "is cut off or damaged", "copy the model again");
    }
    if (!bytes_.empty()) {
      return Status::Error(place, "has more bytes than its records need", "copy the model again");
    }
    return Status();
  }

 private:
  std::string_view bytes_;
  bool failed_ = false;
};

Status ParseCameras(std::string_view bytes, const std::string& place, ColmapModel& model) {
  Reader in(bytes);
  const size_t count = in.TakeCount(kCameraBytes);
  for (size_t i = 0; i < count && !in.failed(); ++i) {
    ColmapCamera& camera = model.cameras.emplace_back();
    camera.id = in.Take<uint32_t>();
    const auto number = in.Take<int32_t>();
    if (number < 0 || number >= kColmapCameraModels) {
      return Status::Error(
          place,
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
  return in.Finish(place);
}

Status ParseImages(std::string_view bytes, const std::string& place, ColmapModel& model) {
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
  return in.Finish(place);
}

Status ParsePoints(std::string_view bytes, const std::string& place, ColmapModel& model) {
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
    point.sights.resize(in.TakeCount(kSightBytes));
    for (ColmapSight& sight : point.sights) {
      sight.image = in.Take<uint32_t>();
      sight.feature = in.Take<uint32_t>();
    }
  }
  return in.Finish(place);
}

template <typename T>
void Put(std::string& bytes, T value) {
  static_assert(std::is_arithmetic_v<T>);
  const size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

}  // namespace

Status ParseColmapBinary(const ColmapFiles& files, const std::string& place, ColmapModel& model) {
  LARARIUM_RETURN_IF_ERROR(ParseCameras(files.cameras, place + "/cameras.bin", model));
  LARARIUM_RETURN_IF_ERROR(ParseImages(files.images, place + "/images.bin", model));
  return ParsePoints(files.points, place + "/points3D.bin", model);
}

ColmapFiles SerializeColmapBinary(const ColmapModel& model) {
  ColmapFiles files;
  Put<uint64_t>(files.cameras, model.cameras.size());
  for (const ColmapCamera& camera : model.cameras) {
    Put(files.cameras, camera.id);
    Put(files.cameras, static_cast<int32_t>(camera.model));
    Put(files.cameras, camera.width);
    Put(files.cameras, camera.height);
    for (const double parameter : camera.parameters) {
      Put(files.cameras, parameter);
    }
  }
  Put<uint64_t>(files.images, model.images.size());
  for (const ColmapImage& image : model.images) {
    Put(files.images, image.id);
    const Eigen::Quaterniond& q = image.camera_from_map.rotation;
    for (const double component : {q.w(), q.x(), q.y(), q.z()}) {
      Put(files.images, component);
    }
    for (const double t : image.camera_from_map.translation) {
      Put(files.images, t);
    }
    Put(files.images, image.camera);
    files.images.append(image.name.c_str(), image.name.size() + 1);
    Put<uint64_t>(files.images, image.features.size());
    for (const ColmapFeature& feature : image.features) {
      Put(files.images, feature.x);
      Put(files.images, feature.y);
      Put(files.images, feature.point);
    }
  }
  Put<uint64_t>(files.points, model.points.size());
  for (const ColmapPoint& point : model.points) {
    Put(files.points, point.id);
    for (const double x : point.position) {
      Put(files.points, x);
    }
    for (const uint8_t channel : point.colour) {
      Put(files.points, channel);
    }
    Put(files.points, point.error);
    Put<uint64_t>(files.points, point.sights.size());
    for (const ColmapSight& sight : point.sights) {
      Put(files.points, sight.image);
      Put(files.points, sight.feature);
    }
  }
  return files;
}

}  // namespace lararium::train
