#pragma once

// Chooses, from the size of each actor on screen, which parts of the body are simulated and at
// which level of detail it is drawn. Finer levels are read when they are needed.

#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/render/detail.h"
#include "shared/render/quality.h"
#include "shared/show/character_instance.h"
#include "shared/show/lod_streamer.h"
#include "shared/show/picture_camera.h"
#include "shared/show/show_content.h"

namespace lararium::show {

// A visible actor at the moment of a frame.
struct VisibleActor {
  uint32_t cast = 0;  // Index into ShowContent::cast.
  const stage::ActorState* state = nullptr;
  float height = 0.0f;  // CharacterInstance::height()
};

class CastDetail {
 public:
  // What was chosen for the last picture, and what the next choice depends on.
  struct Choice {
    std::vector<BodyDetail> bodies;               // Parallel to ShowContent::cast.
    std::vector<render::DetailRequest> requests;  // Parallel to ShowContent::cast.
    render::DetailChooser chooser;
  };

  // Borrows log.
  CastDetail(const ShowContent& content, Log& log);

  // Quality of simulation, light and drawing of people from the next frame on. From any thread.
  void SetQuality(const render::Quality& quality);

  // Size of the drawn pictures and the part of the view that they show. Default: the size of the
  // camera's images. Do not call while a frame is being staged, like SetSeenAround().
  void SetPictureSize(int width, int height, const ViewPart& part = {}) {
    picture_width_ = width;
    picture_height_ = height;
    picture_part_ = part;
  }
  // Also simulates people outside the camera's image, for eyes that see more than the camera.
  void SetSeenAround(bool around) { seen_around_ = around; }

  // Chooses for the actors of a picture, and requests finer levels where they are missing.
  void Choose(std::span<const VisibleActor> visible,
              const geometry::CameraModel& camera,
              const geometry::Rigid3& camera_from_stage);
  const BodyDetail& body(uint32_t cast) const { return choice_.bodies[cast]; }
  // Value for StagedActor::detail.
  float error(uint32_t cast) const { return choice_.requests[cast].detail; }

  const Choice& choice() const { return choice_; }
  void SetChoice(Choice choice) { choice_ = std::move(choice); }

  // From now on the levels of a member of the cast are those of this mesh.
  void SetLevels(size_t cast, const human::Human& human) {
    levels_[cast] = render::FindDetailLevels(human);
  }

  // State of the level of detail that is being read; when done, the next frame uses it.
  LodStreamer::Reading reading_finer() const { return lod_streamer_.reading(); }
  // Returns a person whose finer level has been read; from now on the levels are those of it.
  std::optional<LodStreamer::Person> TakeFiner();

 private:
  std::vector<std::vector<render::DetailLevel>> levels_;  // Parallel to ShowContent::cast.
  Choice choice_;
  LodStreamer lod_streamer_;
  int picture_width_ = 0;   // 0: as wide as the camera's image.
  int picture_height_ = 0;  // 0: as high as the camera's image.
  ViewPart picture_part_;
  bool seen_around_ = false;
  std::mutex options_mutex_;
  render::DetailOptions options_;
};

}  // namespace lararium::show
