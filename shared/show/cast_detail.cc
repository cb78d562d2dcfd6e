#include "shared/show/cast_detail.h"

namespace lararium::show {
namespace {

// Distance beyond a person's head, feet and sides up to which hands, clothes and held objects may
// reach; metres.
constexpr float kReachBeyondBody = 0.75f;

}  // namespace

CastDetail::CastDetail(const ShowContent& content, Log& log)
    : lod_streamer_(content.finer, content.cast, log) {
  choice_.bodies.resize(content.cast.size());
  choice_.requests.resize(content.cast.size());
  for (const CastMember& member : content.cast) {
    levels_.push_back(render::FindDetailLevels(*member.human));
  }
}

void CastDetail::SetQuality(const render::Quality& quality) {
  const render::Quality clamped = render::Clamped(quality);
  const std::lock_guard lock(options_mutex_);
  options_.tolerance_px = clamped.detail_px;
  options_.triangle_budget = static_cast<size_t>(clamped.triangles);
}

void CastDetail::Choose(std::span<const VisibleActor> visible,
                        const geometry::CameraModel& camera,
                        const geometry::Rigid3& camera_from_stage) {
  geometry::CameraModel display = camera.DisplayPinhole();
  if (picture_width_ > 0 && picture_height_ > 0) {
    display = PictureCamera(camera, picture_width_, picture_height_, picture_part_)
                  .Resized(picture_width_, picture_height_);
  }
  std::vector<render::DetailRequest>& requests = choice_.requests;
  for (size_t cast = 0; cast < requests.size(); ++cast) {
    requests[cast].levels = levels_[cast];
    requests[cast].pixels_per_metre = 0.0f;
  }
  // With a larger drawing tolerance, people are simulated as if seen from further away.
  render::DetailOptions options;
  {
    const std::lock_guard lock(options_mutex_);
    options = options_;
  }
  const float share = render::Quality().detail_px / options.tolerance_px;
  for (const VisibleActor& actor : visible) {
    const glm::vec3 middle = actor.state->position + glm::vec3(0.0f, 0.5f * actor.height, 0.0f);
    const float scale = render::PixelsPerMetre(display, camera_from_stage, middle);
    const bool seen = seen_around_ || render::MaySee(display, camera_from_stage, middle,
                                                     0.5f * actor.height + kReachBeyondBody);
    BodyDetail& body = choice_.bodies[actor.cast];
    body = ChooseBodyDetail(actor.height * scale * share, !seen, body);
    requests[actor.cast].pixels_per_metre = seen ? scale : 0.0f;
  }
  choice_.chooser.SetOptions(options);
  choice_.chooser.Choose(requests);
  for (size_t cast = 0; cast < requests.size(); ++cast) {
    if (requests[cast].pixels_per_metre > 0.0f) {
      lod_streamer_.Want(cast, requests[cast].detail);
    }
  }
}

std::optional<LodStreamer::Person> CastDetail::TakeFiner() {
  std::optional<LodStreamer::Person> person = lod_streamer_.Take();
  if (person) {
    SetLevels(person->cast, *person->figure.human);
  }
  return person;
}

}  // namespace lararium::show
