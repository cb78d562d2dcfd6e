#include "shared/vision/scene_database.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "shared/core/check.h"
#include "shared/core/file.h"
#include "shared/core/parallel.h"
#include "shared/image/decode.h"
#include "shared/image/encode.h"
#include "shared/image/image_header.h"
#include "shared/vision/rolling_shutter.h"
#include "shared/vision/scene_database_generated.h"

namespace lararium::vision {
namespace {

constexpr uint32_t kVersion = 1;
constexpr size_t kMaxPoints = 10'000'000;
constexpr size_t kMaxDescriptors = 50'000'000;
constexpr size_t kMaxKeyframes = 20'000;
constexpr size_t kMaxNameBytes = 4096;

// Limit of a coordinate in map units, far beyond any that training produces.
constexpr double kMaxCoordinate = 1e9;

// Limits far beyond the exposure range of any camera.
constexpr float kMaxColour = 1e4f;
constexpr float kMaxGain = 1e4f;
constexpr double kMostMotion = 1e4;   // Radians or map units per frame time.
constexpr double kMostReadout = 2.0;  // Frame times.

// Returns false for NaN, too.
bool Plausible(double value) { return std::abs(value) < kMaxCoordinate; }

template <typename Vector>
bool AllPlausible(const Vector& v) {
  return Plausible(v.x()) && Plausible(v.y()) && Plausible(v.z());
}

// ------------------------------------------------------------ invariants

Status Broken(std::string_view what) {
  return Status::Error("scene database", what, "train the place again");
}

Status ValidatePoints(const SceneDatabase& db) {
  const size_t count = db.points.size();
  if (count > kMaxPoints || db.descriptors.size() > kMaxDescriptors) {
    return Broken("has too many points or descriptors");
  }
  if (db.normals.size() != count || db.observation_counts.size() != count ||
      db.session_masks.size() != count) {
    return Broken("the arrays over points differ in length");
  }
  for (size_t i = 0; i < count; ++i) {
    if (!AllPlausible(db.points[i])) {
      return Broken("a point is not finite");
    }
    if (!(std::abs(db.normals[i].squaredNorm() - 1.0f) < 1e-3f)) {
      return Broken("a normal does not have unit length");
    }
  }
  if (!db.colours.empty() && db.colours.size() != count) {
    return Broken("the number of colours differs from the number of points");
  }
  if (!db.lookalikes.empty() && db.lookalikes.size() != count) {
    return Broken("the number of look-alike marks differs from the number of points");
  }
  for (const Eigen::Vector3f& colour : db.colours) {
    if (!(colour.array().abs() <= kMaxColour).all()) {
      return Broken("a point's colour is out of range");
    }
  }
  return Status();
}

Status ValidateDescriptors(const SceneDatabase& db) {
  const auto& begin = db.descriptor_begin;
  if (begin.size() != db.points.size() + 1 || begin.front() != 0 ||
      begin.back() != db.descriptors.size() || !std::is_sorted(begin.begin(), begin.end())) {
    return Broken("the descriptor ranges of the points are inconsistent");
  }
  if (db.descriptor_point.size() != db.descriptors.size()) {
    return Broken("descriptor_point has the wrong length");
  }
  for (size_t point = 0; point < db.points.size(); ++point) {
    for (uint32_t d = begin[point]; d < begin[point + 1]; ++d) {
      if (db.descriptor_point[d] != point) {
        return Broken("descriptor_point disagrees with the descriptor ranges");
      }
    }
  }
  if (!db.descriptor_sessions.empty() && db.descriptor_sessions.size() != db.descriptors.size()) {
    return Broken("the number of descriptor sessions differs from the number of descriptors");
  }
  if (std::find(db.descriptor_sessions.begin(), db.descriptor_sessions.end(), 0u) !=
      db.descriptor_sessions.end()) {
    return Broken("a descriptor belongs to no session");
  }
  return db.forest.Validate(db.descriptors.size());
}

Status ValidateKeyframes(const SceneDatabase& db) {
  if (db.keyframes.size() > kMaxKeyframes) {
    return Broken("has too many keyframes");
  }
  for (const Keyframe& keyframe : db.keyframes) {
    const geometry::Rigid3& pose = keyframe.camera_from_map;
    if (!(std::abs(pose.rotation.squaredNorm() - 1.0) < 1e-6) || !AllPlausible(pose.translation)) {
      return Broken("a keyframe's pose is not a rigid motion");
    }
    if (!(keyframe.motion.array().abs() <= kMostMotion).all()) {
      return Broken("a keyframe's motion is out of range");
    }
    if (keyframe.session >= 32) {
      return Broken("a keyframe's session is above 31");
    }
    if (keyframe.name.size() > kMaxNameBytes) {
      return Broken("a keyframe's name is too long");
    }
    for (const float gain : keyframe.gain) {
      if (!(gain >= 1.0f / kMaxGain && gain <= kMaxGain)) {
        return Broken("a keyframe's gain is out of range");
      }
    }
    if (!keyframe.grey.empty() &&
        (keyframe.grey.type() != CV_8UC1 || keyframe.grey.cols != db.camera.width ||
         keyframe.grey.rows != db.camera.height)) {
      return Broken("a keyframe's image does not have the camera's size");
    }
  }
  return Status();
}

Status ValidateObservations(const SceneDatabase& db) {
  const Observation* previous = nullptr;
  for (const Observation& o : db.observations) {
    if (o.point >= db.points.size() || o.keyframe >= db.keyframes.size()) {
      return Broken("an observation's point or keyframe does not exist");
    }
    if (!Plausible(o.x) || !Plausible(o.y) || !(o.scale > 0.0f && Plausible(o.scale))) {
      return Broken("an observation's position or scale is out of range");
    }
    if (previous != nullptr && (previous->keyframe > o.keyframe ||
                                (previous->keyframe == o.keyframe && previous->point > o.point))) {
      return Broken("the observations are not sorted by keyframe and point");
    }
    previous = &o;
  }
  return Status();
}

// ------------------------------------------------------------ keyframe images

Result<cv::Mat> DecodeGrey(std::span<const uint8_t> jpeg, cv::Size size, const std::string& where) {
  const Status bad = Status::Error(where, "a keyframe's image is damaged", "train the place again");
  // A block of 8 x 8 pixels takes at least two bits; a smaller file is a decompression bomb.
  constexpr int64_t kPixelsPerByte = 256;
  const auto encoded = std::as_bytes(jpeg);
  const std::optional<image::ImageHeader> header = image::ReadImageHeader(encoded);
  const image::ImageHeader wanted = {image::ImageHeader::Format::kJpeg,
                                     static_cast<uint32_t>(size.width),
                                     static_cast<uint32_t>(size.height)};
  if (header != wanted ||
      static_cast<int64_t>(jpeg.size()) * kPixelsPerByte < static_cast<int64_t>(size.area())) {
    return bad;
  }
  auto grey = image::DecodeImage(encoded, image::Channels::kGrey, where);
  return grey.ok() && grey->size() == size ? std::move(grey) : bad;
}

// Returns an empty vector for a keyframe without an image.
std::vector<std::byte> EncodeGrey(const cv::Mat& grey, int quality) {
  if (grey.empty()) {
    return {};
  }
  auto jpeg = image::EncodeJpeg(grey, quality);
  CHECK(jpeg.ok());
  return std::move(*jpeg);
}

// ------------------------------------------------------------ from file form

geometry::CameraModel CameraFrom(const fb::Camera& c) {
  return {.width = c.width(),
          .height = c.height(),
          .fx = c.fx(),
          .fy = c.fy(),
          .cx = c.cx(),
          .cy = c.cy(),
          .k1 = c.k1(),
          .k2 = c.k2(),
          .p1 = c.p1(),
          .p2 = c.p2()};
}

std::vector<Eigen::Vector3f> VectorsFrom(const flatbuffers::Vector<const fb::Vector3*>& from) {
  std::vector<Eigen::Vector3f> to;
  to.reserve(from.size());
  for (const fb::Vector3* v : from) {
    to.emplace_back(v->x(), v->y(), v->z());
  }
  return to;
}

template <typename T>
std::vector<T> NumbersFrom(const flatbuffers::Vector<T>& from) {
  return {from.begin(), from.end()};
}

void ReadForest(const fb::Scene& scene, DescriptorForest& forest) {
  forest.roots = NumbersFrom(*scene.forest_roots());
  forest.order = NumbersFrom(*scene.forest_order());
  forest.nodes.reserve(scene.forest_nodes()->size());
  for (const fb::ForestNode* n : *scene.forest_nodes()) {
    forest.nodes.push_back({n->dimension(), n->threshold(), n->first(), n->count()});
  }
}

// Reads the descriptors and fills in the point to which each belongs.
Status ReadDescriptors(const fb::Scene& scene, const std::string& where, SceneDatabase& db) {
  const auto& bytes = *scene.descriptors();
  if (bytes.size() % kDescriptorSize != 0) {
    return Status::Error(where, "the descriptors are cut off", "train the place again");
  }
  db.descriptors.resize(bytes.size() / kDescriptorSize);
  for (size_t i = 0; i < db.descriptors.size(); ++i) {
    std::copy_n(bytes.data() + i * kDescriptorSize, kDescriptorSize, db.descriptors[i].begin());
  }
  db.descriptor_begin = NumbersFrom(*scene.descriptor_begin());
  if (!std::is_sorted(db.descriptor_begin.begin(), db.descriptor_begin.end())) {
    return Status::Error(where, "the descriptor ranges of the points are inconsistent",
                         "train the place again");
  }
  db.descriptor_point.assign(db.descriptors.size(), 0);
  for (size_t point = 0; point + 1 < db.descriptor_begin.size(); ++point) {
    const size_t end = std::min<size_t>(db.descriptor_begin[point + 1], db.descriptors.size());
    for (size_t d = db.descriptor_begin[point]; d < end; ++d) {
      db.descriptor_point[d] = static_cast<uint32_t>(point);
    }
  }
  return Status();
}

Status ReadKeyframes(const fb::Scene& scene, const std::string& where, SceneDatabase& db) {
  const auto& from = *scene.keyframes();
  if (from.size() > kMaxKeyframes) {
    return Status::Error(where, "has too many keyframes");
  }
  const cv::Size size(db.camera.width, db.camera.height);
  db.keyframes.resize(from.size());
  std::vector<Status> problems(from.size());
  ParallelFor(from.size(), [&](size_t i) {
    const fb::Keyframe& source = *from.Get(static_cast<uint32_t>(i));
    const fb::Pose& pose = *source.camera_from_map();
    Keyframe& keyframe = db.keyframes[i];
    keyframe.frame_index = source.frame_index();
    keyframe.name = source.name() != nullptr ? source.name()->str() : std::string();
    keyframe.session = source.session();
    keyframe.camera_from_map.rotation =
        Eigen::Quaterniond(pose.qw(), pose.qx(), pose.qy(), pose.qz());
    keyframe.camera_from_map.translation = {pose.tx(), pose.ty(), pose.tz()};
    if (const fb::Motion* m = source.motion(); m != nullptr) {
      keyframe.motion << m->wx(), m->wy(), m->wz(), m->vx(), m->vy(), m->vz();
    }
    if (const fb::Gain* gain = source.gain(); gain != nullptr) {
      keyframe.gain = {gain->r(), gain->g(), gain->b()};
    }
    if (source.grey_jpeg()->size() == 0) {
      return;
    }
    auto grey = DecodeGrey({source.grey_jpeg()->data(), source.grey_jpeg()->size()}, size, where);
    if (grey) {
      keyframe.grey = *grey;
    } else {
      problems[i] = grey.status();
    }
  });
  for (const Status& problem : problems) {
    LARARIUM_RETURN_IF_ERROR(problem);
  }
  return Status();
}

// ------------------------------------------------------------ to file form

std::vector<fb::Vector3> VectorsTo(const std::vector<Eigen::Vector3f>& from) {
  std::vector<fb::Vector3> to;
  to.reserve(from.size());
  for (const Eigen::Vector3f& v : from) {
    to.emplace_back(v.x(), v.y(), v.z());
  }
  return to;
}

fb::Camera CameraTo(const geometry::CameraModel& c) {
  return fb::Camera(c.width, c.height, c.fx, c.fy, c.cx, c.cy, c.k1, c.k2, c.p1, c.p2);
}

fb::Pose PoseTo(const geometry::Rigid3& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  const Eigen::Vector3d& t = pose.translation;
  return fb::Pose(q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z());
}

flatbuffers::Offset<flatbuffers::Vector<flatbuffers::Offset<fb::Keyframe>>> WriteKeyframes(
    const SceneDatabase& db, int jpeg_quality, flatbuffers::FlatBufferBuilder& builder) {
  std::vector<std::vector<std::byte>> images(db.keyframes.size());
  ParallelFor(images.size(),
              [&](size_t i) { images[i] = EncodeGrey(db.keyframes[i].grey, jpeg_quality); });
  std::vector<flatbuffers::Offset<fb::Keyframe>> keyframes;
  for (size_t i = 0; i < images.size(); ++i) {
    const Keyframe& keyframe = db.keyframes[i];
    const auto name = builder.CreateString(keyframe.name);
    const auto jpeg =
        builder.CreateVector(reinterpret_cast<const uint8_t*>(images[i].data()), images[i].size());
    const fb::Pose pose = PoseTo(keyframe.camera_from_map);
    const fb::Gain gain(keyframe.gain[0], keyframe.gain[1], keyframe.gain[2]);
    const auto& m = keyframe.motion;
    const fb::Motion motion(m[0], m[1], m[2], m[3], m[4], m[5]);
    keyframes.push_back(fb::CreateKeyframe(builder, keyframe.frame_index, name, keyframe.session,
                                           &pose, jpeg, &gain, m.isZero(0.0) ? nullptr : &motion));
  }
  return builder.CreateVector(keyframes);
}

std::vector<fb::Observation> ObservationsTo(const std::vector<Observation>& from) {
  std::vector<fb::Observation> to;
  to.reserve(from.size());
  for (const Observation& o : from) {
    to.emplace_back(o.point, o.keyframe, o.x, o.y, o.scale);
  }
  return to;
}

std::vector<fb::ForestNode> NodesTo(const std::vector<ForestNode>& from) {
  std::vector<fb::ForestNode> to;
  to.reserve(from.size());
  for (const ForestNode& n : from) {
    to.emplace_back(n.dimension, n.threshold, n.first, n.count);
  }
  return to;
}

}  // namespace

geometry::Rigid3 SceneDatabase::PoseAt(uint32_t keyframe, const Eigen::Vector2d& pixel) const {
  const Keyframe& seen = keyframes[keyframe];
  return readout.isZero(0.0) ? seen.camera_from_map
                             : PoseAfter(seen.camera_from_map, seen.motion,
                                         readout.dot(ReadoutOrder(camera, pixel)));
}

std::optional<Eigen::Vector2d> SceneDatabase::PixelIn(uint32_t keyframe,
                                                      const Eigen::Vector3d& point) const {
  std::optional<Eigen::Vector2d> pixel =
      camera.Project(keyframes[keyframe].camera_from_map * point);
  constexpr int kRounds = 3;  // Each leaves a few hundredths of the error.
  for (int i = 0; i < kRounds && pixel && !readout.isZero(0.0); ++i) {
    pixel = camera.Project(PoseAt(keyframe, *pixel) * point);
  }
  return pixel;
}

Status SceneDatabase::Validate() const {
  LARARIUM_RETURN_IF_ERROR(camera.Validate());
  if (!(readout.array().abs() <= kMostReadout).all()) {
    return Broken("the readout time is out of range");
  }
  if (!(mean_reprojection_error_px >= 0.0 && Plausible(mean_reprojection_error_px))) {
    return Broken("the mean reprojection error is out of range");
  }
  LARARIUM_RETURN_IF_ERROR(ValidatePoints(*this));
  LARARIUM_RETURN_IF_ERROR(ValidateDescriptors(*this));
  LARARIUM_RETURN_IF_ERROR(ValidateKeyframes(*this));
  return ValidateObservations(*this);
}

Result<SceneDatabase> ParseSceneDatabase(std::span<const std::byte> bytes,
                                         const std::string& where) {
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  constexpr std::string_view kRemedy = "train the place again, or copy the file again";
  constexpr size_t kSmallest = 8;  // Root offset and identifier.
  if (bytes.size() < kSmallest || bytes.size() > FLATBUFFERS_MAX_BUFFER_SIZE ||
      !fb::SceneBufferHasIdentifier(data)) {
    return Status::Error(where, "is not a scene database", kRemedy);
  }
  flatbuffers::Verifier verifier(data, bytes.size(), 64, kMaxKeyframes + 64);
  if (!fb::VerifySceneBuffer(verifier)) {
    return Status::Error(where, "is damaged or cut off", kRemedy);
  }
  const fb::Scene& scene = *fb::GetScene(data);
  if (scene.version() != kVersion) {
    return Status::Error(where,
                         "has format version " + std::to_string(scene.version()) +
                             ", this program reads version " + std::to_string(kVersion),
                         "train the place with this version");
  }
  SceneDatabase db;
  db.camera = CameraFrom(*scene.camera());
  if (const Status status = db.camera.Validate(); !status.ok()) {
    return status.At(where);
  }
  if (const fb::Readout* readout = scene.readout(); readout != nullptr) {
    db.readout = {readout->x(), readout->y()};
  }
  db.mean_reprojection_error_px = scene.mean_reprojection_error_px();
  db.points = VectorsFrom(*scene.points());
  db.normals = VectorsFrom(*scene.normals());
  db.observation_counts = NumbersFrom(*scene.observation_counts());
  db.session_masks = NumbersFrom(*scene.session_masks());
  if (scene.colours() != nullptr) {
    db.colours = VectorsFrom(*scene.colours());
  }
  if (scene.lookalikes() != nullptr) {
    db.lookalikes.assign(scene.lookalikes()->begin(), scene.lookalikes()->end());
  }
  if (scene.descriptor_sessions() != nullptr) {
    db.descriptor_sessions = NumbersFrom(*scene.descriptor_sessions());
  }
  LARARIUM_RETURN_IF_ERROR(ReadDescriptors(scene, where, db));
  ReadForest(scene, db.forest);
  db.observations.reserve(scene.observations()->size());
  for (const fb::Observation* o : *scene.observations()) {
    db.observations.push_back({o->point(), o->keyframe(), o->x(), o->y(), o->scale()});
  }
  LARARIUM_RETURN_IF_ERROR(ReadKeyframes(scene, where, db));
  if (const Status status = db.Validate(); !status.ok()) {
    return status.At(where);
  }
  return db;
}

Result<SceneDatabase> LoadSceneDatabase(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const MappedFile mapped, MappedFile::Open(file));
  return ParseSceneDatabase(mapped.bytes(), file.string());
}

std::vector<std::byte> SerializeSceneDatabase(const SceneDatabase& db, int jpeg_quality) {
  flatbuffers::FlatBufferBuilder builder(1 << 20);
  const fb::Camera camera = CameraTo(db.camera);
  const fb::Readout readout(db.readout.x(), db.readout.y());
  const auto points = builder.CreateVectorOfStructs(VectorsTo(db.points));
  const auto normals = builder.CreateVectorOfStructs(VectorsTo(db.normals));
  const auto counts = builder.CreateVector(db.observation_counts);
  const auto sessions = builder.CreateVector(db.session_masks);
  const auto descriptor_begin = builder.CreateVector(db.descriptor_begin);
  const auto descriptors =
      builder.CreateVector(db.descriptors.empty() ? nullptr : db.descriptors.front().data(),
                           db.descriptors.size() * kDescriptorSize);
  const auto keyframes = WriteKeyframes(db, jpeg_quality, builder);
  const auto observations = builder.CreateVectorOfStructs(ObservationsTo(db.observations));
  const auto roots = builder.CreateVector(db.forest.roots);
  const auto nodes = builder.CreateVectorOfStructs(NodesTo(db.forest.nodes));
  const auto order = builder.CreateVector(db.forest.order);
  flatbuffers::Offset<flatbuffers::Vector<const fb::Vector3*>> colours;
  if (!db.colours.empty()) {
    colours = builder.CreateVectorOfStructs(VectorsTo(db.colours));
  }
  flatbuffers::Offset<flatbuffers::Vector<uint32_t>> descriptor_sessions;
  if (!db.descriptor_sessions.empty()) {
    descriptor_sessions = builder.CreateVector(db.descriptor_sessions);
  }
  flatbuffers::Offset<flatbuffers::Vector<uint8_t>> lookalikes;
  if (!db.lookalikes.empty()) {
    lookalikes = builder.CreateVector(db.lookalikes);
  }
  fb::FinishSceneBuffer(
      builder, fb::CreateScene(builder, kVersion, &camera, db.mean_reprojection_error_px, points,
                               normals, counts, sessions, descriptor_begin, descriptors, keyframes,
                               observations, roots, nodes, order, colours, descriptor_sessions,
                               db.readout.isZero(0.0) ? nullptr : &readout, lookalikes));
  const auto* begin = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  return {begin, begin + builder.GetSize()};
}

Status SaveSceneDatabase(const std::filesystem::path& file, const SceneDatabase& database) {
  if (const Status status = database.Validate(); !status.ok()) {
    return status.At(file.string());
  }
  return WriteFileAtomically(file, SerializeSceneDatabase(database));
}

}  // namespace lararium::vision
