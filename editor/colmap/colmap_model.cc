#include "editor/colmap/colmap_model.h"

#include <algorithm>
#include <cmath>

#include "editor/colmap/colmap_binary.h"
#include "editor/colmap/colmap_repair.h"
#include "editor/colmap/colmap_text.h"
#include "shared/core/file.h"
#include "shared/core/plain_text.h"

namespace lararium::train {
namespace {

using geometry::CameraModel;

constexpr std::string_view kRemedy = "write the model again with COLMAP";

struct ModelFacts {
  std::string_view name;
  size_t parameters;
};

constexpr std::array<ModelFacts, kColmapCameraModels> kModelFacts = {{
    {"SIMPLE_PINHOLE", 3},
    {"PINHOLE", 4},
    {"SIMPLE_RADIAL", 4},
    {"RADIAL", 5},
    {"OPENCV", 8},
    {"OPENCV_FISHEYE", 8},
    {"FULL_OPENCV", 12},
    {"FOV", 5},
    {"SIMPLE_RADIAL_FISHEYE", 4},
    {"RADIAL_FISHEYE", 5},
    {"THIN_PRISM_FISHEYE", 12},
    {"RAD_TAN_THIN_PRISM_FISHEYE", 16},
    {"SIMPLE_DIVISION", 4},
    {"DIVISION", 5},
    {"SIMPLE_FISHEYE", 3},
    {"FISHEYE", 4},
    {"EUCM", 6},
    {"EQUIRECTANGULAR", 2},
}};

std::string Called(std::string_view kind, uint64_t id) {
  return std::string(kind) + " " + std::to_string(id);
}

// The same limit as in our maps. Returns false for NaN, too.
bool Plausible(double value) { return std::abs(value) < 1e9; }

bool Plausible(const Eigen::Vector3d& v) {
  return Plausible(v.x()) && Plausible(v.y()) && Plausible(v.z());
}

template <typename T>
const T* Find(const std::vector<T>& sorted, uint64_t id) {
  const auto found = std::lower_bound(sorted.begin(), sorted.end(), id,
                                      [](const T& item, uint64_t key) { return item.id < key; });
  return found != sorted.end() && found->id == id ? &*found : nullptr;
}

template <typename T>
Status CheckIds(const std::vector<T>& items, std::string_view kind) {
  for (size_t i = 1; i < items.size(); ++i) {
    if (items[i].id == items[i - 1].id) {
      return Status::Error(Called(kind, items[i].id), "appears twice", kRemedy);
    }
    if (items[i].id < items[i - 1].id) {
      return Status::Error(Called(kind, items[i].id), "is not in order of ids", kRemedy);
    }
  }
  return Status();
}

Status CheckCamera(const ColmapCamera& camera) {
  const auto index = static_cast<int32_t>(camera.model);
  const std::string place = Called("camera", camera.id);
  if (index < 0 || index >= kColmapCameraModels) {
    return Status::Error(place, "has an unknown model", kRemedy);
  }
  if (camera.parameters.size() != ParameterCount(camera.model)) {
    return Status::Error(place, "has the wrong number of parameters", kRemedy);
  }
  if (!std::all_of(camera.parameters.begin(), camera.parameters.end(),
                   [](double p) { return std::isfinite(p); })) {
    return Status::Error(place, "has a parameter that is not a finite number", kRemedy);
  }
  return Status();
}

Status CheckImage(const ColmapModel& model, const ColmapImage& image) {
  const std::string place = Called("image", image.id);
  if (Find(model.cameras, image.camera) == nullptr) {
    return Status::Error(
        place, "refers to " + Called("camera", image.camera) + ", which is missing", kRemedy);
  }
  if (!(std::abs(image.camera_from_map.rotation.squaredNorm() - 1.0) < 1e-9) ||
      !Plausible(image.camera_from_map.translation)) {
    return Status::Error(place, "has a pose that is not a rigid motion", kRemedy);
  }
  const bool has_control = std::any_of(image.name.begin(), image.name.end(),
                                       [](char c) { return static_cast<unsigned char>(c) < ' '; });
  if (image.name.empty() || image.name.size() > 4096 || has_control) {
    return Status::Error(place, "has no usable name", kRemedy);
  }
  for (const ColmapFeature& feature : image.features) {
    if (!Plausible(feature.x) || !Plausible(feature.y)) {
      return Status::Error(place, "has a feature at an invalid position", kRemedy);
    }
    if (feature.point != ColmapFeature::kNoPoint && Find(model.points, feature.point) == nullptr) {
      return Status::Error(place, "shows " + Called("point", feature.point) + ", which is missing",
                           kRemedy);
    }
  }
  return Status();
}

// The model that can express the camera with the fewest parameters, if that is one of ours. Other
// programs write FULL_OPENCV for cameras that need only its first eight parameters.
ColmapCameraModel SimplestModel(const ColmapCamera& camera) {
  const bool plain = camera.model == ColmapCameraModel::kFullOpenCv &&
                     std::all_of(camera.parameters.begin() + 8, camera.parameters.end(),
                                 [](double p) { return p == 0.0; });
  return plain ? ColmapCameraModel::kOpenCv : camera.model;
}

Status CheckPoint(const ColmapModel& model, const ColmapPoint& point) {
  const std::string place = Called("point", point.id);
  if (point.id == ColmapFeature::kNoPoint) {
    return Status::Error(place, "has the id that is reserved for features without a point",
                         kRemedy);
  }
  if (!Plausible(point.position)) {
    return Status::Error(place, "lies at an invalid position", kRemedy);
  }
  if (!std::isfinite(point.error)) {
    return Status::Error(place, "has an error that is not a finite number", kRemedy);
  }
  for (const ColmapObservation& observation : point.observations) {
    const ColmapImage* image = Find(model.images, observation.image);
    if (image == nullptr || observation.feature >= image->features.size() ||
        image->features[observation.feature].point != point.id) {
      return Status::Error(place,
                           "is not what feature " + std::to_string(observation.feature) + " of " +
                               Called("image", observation.image) + " shows",
                           kRemedy);
    }
  }
  return Status();
}

// Checks that the observations of the points and the features that show points correspond one to
// one. CheckPoint has found every observation in its image already.
Status CheckObservationsAreAll(const ColmapModel& model) {
  std::vector<ColmapObservation> observations;
  for (const ColmapPoint& point : model.points) {
    observations.insert(observations.end(), point.observations.begin(), point.observations.end());
  }
  const auto key = [](const ColmapObservation& s) { return uint64_t{s.image} << 32 | s.feature; };
  std::sort(
      observations.begin(), observations.end(),
      [&](const ColmapObservation& a, const ColmapObservation& b) { return key(a) < key(b); });
  for (size_t i = 1; i < observations.size(); ++i) {
    if (key(observations[i]) == key(observations[i - 1])) {
      return Status::Error(Called("image", observations[i].image),
                           "has a feature that a point lists twice", kRemedy);
    }
  }
  size_t next = 0;
  for (const ColmapImage& image : model.images) {
    for (size_t f = 0; f < image.features.size(); ++f) {
      if (image.features[f].point == ColmapFeature::kNoPoint) {
        continue;
      }
      if (next == observations.size() || observations[next].image != image.id ||
          observations[next].feature != f) {
        return Status::Error(
            Called("point", image.features[f].point),
            "does not list feature " + std::to_string(f) + " of " + Called("image", image.id),
            kRemedy);
      }
      ++next;
    }
  }
  return Status();
}

void SortById(ColmapModel& model) {
  const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
  std::stable_sort(model.cameras.begin(), model.cameras.end(), by_id);
  std::stable_sort(model.images.begin(), model.images.end(), by_id);
  std::stable_sort(model.points.begin(), model.points.end(), by_id);
}

// Normalises rotations whose length differs from 1 by rounding only. Others are not rotations; they
// stay unchanged, so that Validate() rejects them.
void NormaliseRotations(ColmapModel& model) {
  for (ColmapImage& image : model.images) {
    Eigen::Quaterniond& rotation = image.camera_from_map.rotation;
    if (std::abs(rotation.squaredNorm() - 1.0) < 1e-3) {
      rotation.normalize();
    }
  }
}

}  // namespace

std::string_view Name(ColmapCameraModel model) {
  return kModelFacts[static_cast<size_t>(model)].name;
}

size_t ParameterCount(ColmapCameraModel model) {
  return kModelFacts[static_cast<size_t>(model)].parameters;
}

Status ColmapModel::Validate() const {
  LARARIUM_RETURN_IF_ERROR(CheckIds(cameras, "camera"));
  LARARIUM_RETURN_IF_ERROR(CheckIds(images, "image"));
  LARARIUM_RETURN_IF_ERROR(CheckIds(points, "point"));
  for (const ColmapCamera& camera : cameras) {
    LARARIUM_RETURN_IF_ERROR(CheckCamera(camera));
  }
  for (const ColmapImage& image : images) {
    LARARIUM_RETURN_IF_ERROR(CheckImage(*this, image));
  }
  for (const ColmapPoint& point : points) {
    LARARIUM_RETURN_IF_ERROR(CheckPoint(*this, point));
  }
  return CheckObservationsAreAll(*this);
}

Result<CameraModel> CameraFromColmap(const ColmapCamera& camera) {
  const std::string place = Called("camera", camera.id);
  constexpr uint64_t kMaxSide = 16384;
  if (camera.width > kMaxSide || camera.height > kMaxSide) {
    return Status::Error(place, "has images of an invalid size", kRemedy);
  }
  const std::vector<double>& p = camera.parameters;
  CameraModel ours;
  ours.width = static_cast<int>(camera.width);
  ours.height = static_cast<int>(camera.height);
  size_t center = 1;  // Index of the parameter cx.
  switch (SimplestModel(camera)) {
    case ColmapCameraModel::kSimplePinhole:
    case ColmapCameraModel::kSimpleRadial:
    case ColmapCameraModel::kRadial:
      ours.fx = ours.fy = p[0];
      break;
    case ColmapCameraModel::kPinhole:
    case ColmapCameraModel::kOpenCv:
      ours.fx = p[0];
      ours.fy = p[1];
      center = 2;
      break;
    default:
      return Status::Error(
          place,
          "has the model " + std::string(Name(camera.model)) +
              ", which Lararium does not track with",
          "run `colmap image_undistorter`, and import its sparse model and images");
  }
  ours.cx = p[center] - 0.5;
  ours.cy = p[center + 1] - 0.5;
  const size_t distortion = center + 2;
  ours.k1 = p.size() > distortion ? p[distortion] : 0.0;
  ours.k2 = p.size() > distortion + 1 ? p[distortion + 1] : 0.0;
  ours.p1 = p.size() > distortion + 2 ? p[distortion + 2] : 0.0;
  ours.p2 = p.size() > distortion + 3 ? p[distortion + 3] : 0.0;
  if (const Status status = ours.Validate(); !status.ok()) {
    return status.At(place);
  }
  return ours;
}

ColmapCamera ColmapFromCamera(const CameraModel& camera, uint32_t id) {
  ColmapCamera colmap;
  colmap.id = id;
  colmap.width = static_cast<uint64_t>(camera.width);
  colmap.height = static_cast<uint64_t>(camera.height);
  const double cx = camera.cx + 0.5;
  const double cy = camera.cy + 0.5;
  if (!camera.HasDistortion()) {
    colmap.model = ColmapCameraModel::kPinhole;
    colmap.parameters = {camera.fx, camera.fy, cx, cy};
  } else if (camera.fx == camera.fy && camera.p1 == 0.0 && camera.p2 == 0.0) {
    colmap.model = ColmapCameraModel::kRadial;
    colmap.parameters = {camera.fx, cx, cy, camera.k1, camera.k2};
  } else {
    colmap.model = ColmapCameraModel::kOpenCv;
    colmap.parameters = {camera.fx, camera.fy, cx, cy, camera.k1, camera.k2, camera.p1, camera.p2};
  }
  return colmap;
}

Result<ColmapModel> ParseColmapModel(const ColmapFiles& files,
                                     ColmapFormat format,
                                     const std::string& where) {
  ColmapModel model;
  const Status parsed = format == ColmapFormat::kText
                            ? ParseColmapText({PlainText(files.cameras), PlainText(files.images),
                                               PlainText(files.points)},
                                              where, model)
                            : ParseColmapBinary(files, where, model);
  LARARIUM_RETURN_IF_ERROR(parsed);
  SortById(model);
  NormaliseRotations(model);
  model.notes = RepairColmapModel(model);
  if (const Status status = model.Validate(); !status.ok()) {
    return status.At(where);
  }
  return model;
}

ColmapFiles SerializeColmapModel(const ColmapModel& model, ColmapFormat format) {
  return format == ColmapFormat::kText ? SerializeColmapText(model) : SerializeColmapBinary(model);
}

Result<ColmapModel> LoadColmapModel(const std::filesystem::path& folder) {
  const auto file = [&](std::string_view stem, ColmapFormat format) {
    return folder / (std::string(stem) + (format == ColmapFormat::kText ? ".txt" : ".bin"));
  };
  ColmapFormat format = ColmapFormat::kBinary;
  if (!FileExists(file("cameras", format))) {
    format = ColmapFormat::kText;
  }
  if (!FileExists(file("cameras", format))) {
    return Status::Error(folder.string(), "has no cameras.bin or cameras.txt",
                         "name the folder of a COLMAP model, such as sparse/0");
  }
  ColmapFiles files;
  LARARIUM_ASSIGN_OR_RETURN(files.cameras, ReadText(file("cameras", format)));
  LARARIUM_ASSIGN_OR_RETURN(files.images, ReadText(file("images", format)));
  // Programs that know no points leave out their file.
  const bool has_points = FileExists(file("points3D", format));
  if (has_points) {
    LARARIUM_ASSIGN_OR_RETURN(files.points, ReadText(file("points3D", format)));
  } else if (format == ColmapFormat::kBinary) {
    files.points.assign(sizeof(uint64_t), '\0');  // A count of zero.
  }
  LARARIUM_ASSIGN_OR_RETURN(ColmapModel model, ParseColmapModel(files, format, folder.string()));
  if (!has_points) {
    model.notes.insert(model.notes.begin(), "it has no file points3D");
  }
  return model;
}

}  // namespace lararium::train
