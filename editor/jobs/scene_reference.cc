#include "editor/jobs/scene_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "editor/bake/environment.h"
#include "editor/bake/path_tracer.h"
#include "editor/bake/posed_surface.h"
#include "editor/document/project.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/staging.h"
#include "shared/capture/frame_source.h"
#include "shared/core/srgb.h"
#include "shared/geometry/glm_convert.h"
#include "shared/human/skinning.h"
#include "shared/image/encode.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"
#include "shared/show/show.h"
#include "shared/show/show_renderer.h"
#include "shared/vision/occluders.h"
#include "shared/vision/photometry.h"
#include "shared/vision/poses_file.h"
#include "shared/vision/tracker.h"

namespace lararium::editor {
namespace {

constexpr double kSettling = 2.0;     // Seconds of the drama during which cloth settles.
constexpr double kStep = 1.0 / 30.0;  // Seconds between staged moments.
constexpr int kFramesBefore = 30;     // Frames that the tracker sees before the requested one.
// Albedo of real surfaces that are not visible in the image.
constexpr float kGuessedAlbedo = 0.3f;
constexpr int kRoughSamples = 8;  // Samples for estimating the albedo.
const float kKnee = render::RenderScene().knee;

// A tracked frame without an image, for a view that only a camera file defines.
Result<vision::TrackedFrame> CameraAlone(const ReferenceView& view, const stage::Place& place) {
  const geometry::Rigid3& c = view.camera_from_stage;
  const geometry::Similarity3& m = place.map_from_stage;
  vision::TrackedFrame tracked;
  tracked.camera = view.pinhole;
  geometry::Rigid3 camera_from_map;
  camera_from_map.rotation = (c.rotation * m.rotation.conjugate()).normalized();
  camera_from_map.translation =
      m.scale * (c.translation + place.camera_nudge) - camera_from_map.rotation * m.translation;
  tracked.camera_from_map = camera_from_map;
  tracked.state = vision::TrackState::kTracking;
  return tracked;
}

Result<vision::TrackedFrame> TrackVideo(const ReferenceOptions& options,
                                        const show::ShowContent& content,
                                        Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const auto source, capture::OpenVideo(options.video));
  LARARIUM_ASSIGN_OR_RETURN(
      const geometry::CameraModel camera,
      content.places.front().map->camera.ForImages(source->width(), source->height()));
  LARARIUM_ASSIGN_OR_RETURN(const auto poses,
                            vision::CreateTracker(show::Maps(content.places), camera, {}));
  show::SetOccluders(content.places, *poses);
  const int first = std::max(options.frame - kFramesBefore, 0);
  LARARIUM_RETURN_IF_ERROR(source->Seek(first));
  vision::TrackedFrame tracked;
  for (int index = first; index <= options.frame; ++index) {
    progress.Report("tracking", static_cast<double>(index - first) / (kFramesBefore + 1));
    LARARIUM_ASSIGN_OR_RETURN(const auto frame, source->Next());
    if (!frame) {
      return Status::Error(options.video.string(), "has no frame " + std::to_string(options.frame));
    }
    tracked = poses->Track(*frame);
  }
  if (!tracked.camera_from_map) {
    return Status::Error(options.video.string(),
                         "frame " + std::to_string(options.frame) + " was not recognised",
                         "choose another with --frame");
  }
  return tracked;
}

// Stages the moment, after the same view has run for long enough that hair and cloth are at rest.
void StageMoment(const vision::TrackedFrame& tracked,
                 double time,
                 show::Show& show,
                 show::StagedFrame& staged) {
  for (double before = std::min(kSettling, time); before > 0.0; before -= kStep) {
    show.StageFrame(tracked, time - before, staged);
  }
  show.StageFrame(tracked, time, staged);
  staged.lines.clear();  // Captions are not part of the scene.
}

// All virtual objects at the moment, stage axes.
class VirtualScene {
 public:
  static Result<std::vector<bake::SurfaceMesh>> Collect(const show::ShowContent& content,
                                                        const show::StagedFrame& staged) {
    std::vector<bake::SurfaceMesh> meshes;
    for (const show::StagedActor& actor : staged.people.actors) {
      LARARIUM_RETURN_IF_ERROR(AddActor(*actor.figure, actor, staged, meshes));
    }
    for (const show::StagedObject& object : staged.things.objects) {
      LARARIUM_RETURN_IF_ERROR(
          AddObject(content.objects[object.object].model->prop(), object, staged, meshes));
    }
    return meshes;
  }

 private:
  static Status AddActor(const human::Human& human,
                         const show::StagedActor& actor,
                         const show::StagedFrame& staged,
                         std::vector<bake::SurfaceMesh>& meshes) {
    LARARIUM_ASSIGN_OR_RETURN(const bake::PosableSurface posable,
                              bake::PosableSurface::Create(human));
    const std::span skin =
        std::span(staged.people.skin).subspan(actor.skin_begin, actor.skin_count);
    std::vector<bake::SurfaceMesh> posed = posable.Pose(skin);
    for (uint32_t m = actor.mesh_begin; m < actor.mesh_begin + actor.mesh_count; ++m) {
      const show::StagedMesh& moving = staged.people.meshes[m];
      const std::span positions =
          std::span(staged.people.positions).subspan(moving.vertex_begin, moving.vertex_count);
      const std::span normals =
          std::span(staged.people.normals).subspan(moving.vertex_begin, moving.vertex_count);
      const uint32_t mesh = moving.mesh.mesh;
      if (moving.mesh.posed) {
        posed[mesh] = posable.PoseMesh(mesh, positions, normals);
        continue;
      }
      human::SkinnedMesh morphed = human.meshes[mesh];
      morphed.positions.assign(positions.begin(), positions.end());
      morphed.normals.assign(normals.begin(), normals.end());
      std::vector<glm::vec3> skinned(morphed.positions.size());
      std::vector<glm::vec3> turned(morphed.positions.size());
      human::SkinMesh(morphed, skin, skinned, turned, human.skinning);
      posed[mesh] = posable.PoseMesh(mesh, skinned, turned);
    }
    for (const bake::SurfaceMesh& mesh : posed) {
      meshes.push_back(bake::Moved(actor.stage_from_actor, mesh));
    }
    return Status();
  }

  static Status AddObject(const stage::Prop& prop,
                          const show::StagedObject& object,
                          const show::StagedFrame& staged,
                          std::vector<bake::SurfaceMesh>& meshes) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<bake::SurfaceMesh> surfaces,
                              bake::SurfacesOf(prop));
    size_t next = 0;
    for (size_t part = 0; part < prop.parts.size(); ++part) {
      for (size_t m = 0; m < prop.parts[part].meshes.size(); ++m, ++next) {
        if (staged.things.part_shown[object.part_begin + part] != 0) {
          meshes.push_back(
              bake::Moved(staged.things.stage_from_part[object.part_begin + part], surfaces[next]));
          meshes.back().emission *= object.glow;
        }
      }
    }
    return Status();
  }
};

std::vector<bake::SurfaceMesh> RealSurfaces(const stage::Place& place) {
  std::vector<bake::SurfaceMesh> surfaces;
  for (const stage::Occluder& occluder : place.occluders) {
    geometry::TriangleMesh mesh = occluder.mesh;
    const glm::mat4 stage_from_mesh = geometry::ToGlm(occluder.stage_from_mesh);
    for (glm::vec3& position : mesh.positions) {
      position = stage_from_mesh * glm::vec4(position, 1.0f);
    }
    geometry::ComputeNormals(mesh);
    bake::SurfaceMesh& surface = surfaces.emplace_back();
    surface.positions = std::move(mesh.positions);
    surface.normals = std::move(mesh.normals);
    surface.indices = std::move(mesh.indices);
    surface.albedo.assign(surface.positions.size(), glm::vec3(kGuessedAlbedo));
  }
  return surfaces;
}

// 0 at pixels whose first real surface receives no shadow, 255 elsewhere.
cv::Mat ShadowMask(const stage::Place& place, const ReferenceView& view) {
  cv::Mat mask(view.pinhole.height, view.pinhole.width, CV_8UC1, cv::Scalar(255));
  if (std::all_of(place.occluders.begin(), place.occluders.end(),
                  [](const stage::Occluder& occluder) { return occluder.receives_shadow; })) {
    return mask;
  }
  std::vector<vision::OccluderTree> trees;
  for (const stage::Occluder& occluder : place.occluders) {
    trees.emplace_back(vision::Placed(occluder.mesh, occluder.stage_from_mesh));
  }
  const Eigen::Quaterniond stage_from_camera = view.camera_from_stage.rotation.conjugate();
  const Eigen::Vector3f eye = view.camera_from_stage.Center().cast<float>();
  for (int row = 0; row < mask.rows; ++row) {
    for (int column = 0; column < mask.cols; ++column) {
      const Eigen::Vector2d plane =
          view.pinhole.PlaneFromPixel({static_cast<double>(column), static_cast<double>(row)});
      const Eigen::Vector3d way = stage_from_camera * plane.homogeneous().normalized();
      float nearest = std::numeric_limits<float>::max();
      for (size_t i = 0; i < trees.size(); ++i) {
        if (const auto hit = trees[i].FirstHit(eye, way.cast<float>(), 0.0f, nearest)) {
          nearest = hit->distance;
          mask.at<uint8_t>(row, column) = place.occluders[i].receives_shadow ? 255 : 0;
        }
      }
    }
  }
  return mask;
}

uint8_t EncodeSrgb(float c) {
  return static_cast<uint8_t>(std::lround(255.0f * SrgbFromLinear(std::clamp(c, 0.0f, 1.0f))));
}

cv::Mat Encoded(const cv::Mat& linear) {
  cv::Mat bgr(linear.size(), CV_8UC3);
  for (int row = 0; row < linear.rows; ++row) {
    for (int column = 0; column < linear.cols; ++column) {
      const cv::Vec3f& pixel = linear.at<cv::Vec3f>(row, column);
      bgr.at<cv::Vec3b>(row, column) = {EncodeSrgb(pixel[2]), EncodeSrgb(pixel[1]),
                                        EncodeSrgb(pixel[0])};
    }
  }
  return bgr;
}

// The same function as in shaders/pass/model.frag.
float CameraResponse(float x) {
  const float range = std::max(1.0f - kKnee, 1e-4f);
  return std::min(x, kKnee) + range * (1.0f - std::exp(-std::max(x - kKnee, 0.0f) / range));
}

glm::vec4 PixelOf(const std::vector<glm::vec4>& pixels, const cv::Mat& like, int row, int column) {
  return pixels[static_cast<size_t>(row) * static_cast<size_t>(like.cols) +
                static_cast<size_t>(column)];
}

// The scene and its light, for path tracing.
struct Tracing {
  // Virtual meshes first; real ones from index first_real.
  std::vector<bake::SurfaceMesh> meshes;
  size_t first_real = 0;
  const bake::Environment& environment;
  const ReferenceView& view;
  bake::PathTracing settings;

  Result<bake::RadianceImage> Trace(bool with_virtual, int samples, Progress& progress) const {
    bake::PathTracing tracing = settings;
    tracing.samples = samples;
    const size_t left_out = with_virtual ? 0 : first_real;
    tracing.first_real = first_real - left_out;
    return bake::TracePaths(std::span(meshes).subspan(left_out), environment, view.pinhole,
                            view.camera_from_stage, tracing, progress);
  }

  bool has_real() const { return first_real < meshes.size(); }
};

// Finds the one albedo with which real surfaces are on average as bright as in the image. image:
// linear. gain: exposure of the image relative to the map's reference.
Status FitAlbedo(const cv::Mat& image,
                 const std::array<float, 3>& gain,
                 Tracing& tracing,
                 Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const bake::RadianceImage rough,
                            tracing.Trace(false, kRoughSamples, progress));
  glm::dvec3 seen(0.0);
  glm::dvec3 traced(0.0);
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const glm::vec4 pixel = PixelOf(rough.real, image, row, column);
      const cv::Vec3f& colour = image.at<cv::Vec3f>(row, column);
      if (pixel.a > 0.999f) {
        seen += glm::dvec3(colour[0] / gain[0], colour[1] / gain[1], colour[2] / gain[2]);
        traced += glm::dvec3(pixel);
      }
    }
  }
  if (traced == glm::dvec3(0.0)) {
    return Status();  // The image shows no real surface.
  }
  const glm::vec3 ratio(seen / glm::max(traced, glm::dvec3(1e-9)));
  const glm::vec3 albedo = glm::clamp(kGuessedAlbedo * ratio, 0.02f, 0.9f);
  for (size_t m = tracing.first_real; m < tracing.meshes.size(); ++m) {
    std::fill(tracing.meshes[m].albedo.begin(), tracing.meshes[m].albedo.end(), albedo);
  }
  return Status();
}

// The path-traced picture. image: that of the camera, linear. mask: see ShadowMask.
Result<cv::Mat> TracedPicture(const cv::Mat& image,
                              const cv::Mat& mask,
                              const std::array<float, 3>& gain,
                              const Tracing& tracing,
                              Progress& progress,
                              cv::Mat& coverage) {
  LARARIUM_ASSIGN_OR_RETURN(const bake::RadianceImage with,
                            tracing.Trace(true, tracing.settings.samples, progress));
  bake::RadianceImage without;
  if (tracing.has_real()) {
    LARARIUM_ASSIGN_OR_RETURN(without, tracing.Trace(false, tracing.settings.samples, progress));
  }
  cv::Mat picture = image.clone();
  coverage.create(image.size(), CV_32FC1);
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      cv::Vec3f& pixel = picture.at<cv::Vec3f>(row, column);
      if (tracing.has_real() && mask.at<uint8_t>(row, column) != 0) {
        const glm::vec4 lit = PixelOf(with.real, image, row, column);
        const glm::vec4 open = PixelOf(without.real, image, row, column);
        for (int c = 0; lit.a > 0.0f && c < 3; ++c) {
          pixel[c] *= (lit[c] / lit.a) / std::max(open[c] / open.a, 1e-6f);
        }
      }
      const glm::vec4 drawn = PixelOf(with.pixels, image, row, column);
      coverage.at<float>(row, column) = drawn.a;
      for (int c = 0; drawn.a > 0.0f && c < 3; ++c) {
        const float seen = CameraResponse(drawn[c] / drawn.a * gain[static_cast<size_t>(c)]);
        pixel[c] = pixel[c] * (1.0f - drawn.a) + seen * drawn.a;
      }
    }
  }
  return picture;
}

// Relative RMSE of linear pixels where mask is not 0.
double RelativeError(const cv::Mat& a, const cv::Mat& reference, const cv::Mat& mask) {
  double squares = 0.0;
  double all = 0.0;
  for (int row = 0; row < a.rows; ++row) {
    for (int column = 0; column < a.cols; ++column) {
      if (mask.at<uint8_t>(row, column) != 0) {
        const cv::Vec3f& of = reference.at<cv::Vec3f>(row, column);
        const cv::Vec3f off = a.at<cv::Vec3f>(row, column) - of;
        squares += double{off.dot(off)};
        all += double{of.dot(of)};
      }
    }
  }
  return all > 0.0 ? std::sqrt(squares / all) : 0.0;
}

// The renderer's output.
struct Drawn {
  cv::Mat picture;  // 8-bit BGR.
  cv::Mat image;    // The camera's image alone, 8-bit BGR.
};

Result<Drawn> Draw(const show::ShowContent& content,
                   show::StagedFrame& staged,
                   const geometry::CameraModel& pinhole) {
  LARARIUM_ASSIGN_OR_RETURN(const auto context, render::CreateOffscreenContext());
  LARARIUM_ASSIGN_OR_RETURN(const auto renderer, show::ShowRenderer::Create(content));
  LARARIUM_ASSIGN_OR_RETURN(const auto target,
                            render::RenderTarget::Create(pinhole.width, pinhole.height));
  renderer->SetMatte(true);
  Drawn drawn;
  LARARIUM_RETURN_IF_ERROR(renderer->Draw(staged, target));
  target.ReadPixels(drawn.picture);
  const auto pose = std::exchange(staged.camera.camera_from_stage, std::nullopt);
  LARARIUM_RETURN_IF_ERROR(renderer->Draw(staged, target));
  target.ReadPixels(drawn.image);
  staged.camera.camera_from_stage = pose;
  return drawn;
}

Result<bake::Environment> LoadEnvironment(const ProjectPaths& paths, const PlaceDocument& place) {
  if (place.probes.empty()) {
    return Status::Error(paths.Project().string(), "the place \"" + place.name + "\" has no probe",
                         "path tracing needs one: see docs/how-to-light-a-place.md");
  }
  const ProbeDocument& probe = place.probes.front();
  LARARIUM_ASSIGN_OR_RETURN(bake::ProbeImage image,
                            bake::ReadProbeImage(paths.Resolve(probe.file)));
  return bake::Environment(
      std::move(image), {geometry::ToGlm(probe.stage_from_probe), static_cast<float>(probe.scale)});
}

}  // namespace

Result<ReferenceView> LoadReferenceView(const ReferenceOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<vision::PoseRecord> records,
                            vision::LoadPoses(options.camera));
  const auto index = static_cast<size_t>(options.frame);
  if (index >= records.size() || !records[index].camera_from_world) {
    return Status::Error(options.camera.string(),
                         "has no pose of frame " + std::to_string(options.frame),
                         "it has " + std::to_string(records.size()) + " frames");
  }
  if (records[index].camera.HasDistortion()) {
    return Status::Error(options.camera.string(), "the camera has distortion",
                         "use a pinhole camera: K only");
  }
  return ReferenceView{records[index].camera, *records[index].camera_from_world};
}

Result<CommandResult> RunSceneReference(const ReferenceOptions& options,
                                        Progress& progress,
                                        Log& log) {
  const ProjectPaths paths{options.human};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, ChoosePlace(paths, document, options.place));
  LARARIUM_RETURN_IF_ERROR(Bake(paths, document, progress).status());
  LARARIUM_ASSIGN_OR_RETURN(const bake::Environment environment,
                            LoadEnvironment(paths, *document.FindPlace(name)));
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content, LoadShowContent(paths, document, name));
  if (options.camera.empty() == options.video.empty()) {
    return Status::Error("reference", "a project needs --camera or --video");
  }
  vision::TrackedFrame tracked;
  if (options.video.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const ReferenceView from, LoadReferenceView(options));
    LARARIUM_ASSIGN_OR_RETURN(tracked, CameraAlone(from, content.places.front().stage));
  } else {
    LARARIUM_ASSIGN_OR_RETURN(tracked, TrackVideo(options, content, progress));
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto show, show::Show::Create(std::move(content), {}, log));
  show::StagedFrame staged;
  StageMoment(tracked, options.time, *show, staged);

  const ReferenceView view = {tracked.camera.DisplayPinhole(), *staged.camera.camera_from_stage};
  LARARIUM_ASSIGN_OR_RETURN(const Drawn drawn, Draw(show->content(), staged, view.pinhole));
  LARARIUM_ASSIGN_OR_RETURN(std::vector<bake::SurfaceMesh> meshes,
                            VirtualScene::Collect(show->content(), staged));
  Tracing tracing{
      std::move(meshes), 0, environment, view, {options.samples, options.bounces, options.seed}};
  tracing.first_real = tracing.meshes.size();
  for (bake::SurfaceMesh& surface : RealSurfaces(show->content().places.front().stage)) {
    tracing.meshes.push_back(std::move(surface));
  }
  if (tracing.meshes.empty()) {
    return Status::Error(options.human.string(), "nothing is on stage at this time");
  }
  const cv::Mat image = vision::LinearFromSrgb(drawn.image);
  if (tracing.has_real() && !options.video.empty()) {
    LARARIUM_RETURN_IF_ERROR(FitAlbedo(image, staged.camera.gain, tracing, progress));
  }
  cv::Mat coverage;
  LARARIUM_ASSIGN_OR_RETURN(
      const cv::Mat traced,
      TracedPicture(image, ShadowMask(show->content().places.front().stage, view),
                    staged.camera.gain, tracing, progress, coverage));
  const cv::Mat ours = vision::LinearFromSrgb(drawn.picture);
  const cv::Mat error = cv::abs(ours - traced) * 2.0;
  cv::Mat side_by_side;
  cv::hconcat(std::vector<cv::Mat>{Encoded(traced), drawn.picture, Encoded(error)}, side_by_side);
  LARARIUM_RETURN_IF_ERROR(image::WriteImage(options.out, side_by_side));
  const double on_virtual = RelativeError(ours, traced, coverage > 0.999);
  const double on_real = RelativeError(ours, traced, coverage < 0.001);
  CommandResult result;
  result.text = "wrote " + options.out.string() + "; relative RMSE of people and things " +
                std::to_string(on_virtual) + ", of real surfaces " + std::to_string(on_real) + "\n";
  result.json = {{"out", options.out.string()},
                 {"relative_rmse", on_virtual},
                 {"relative_rmse_of_real", on_real}};
  return result;
}

}  // namespace lararium::editor
