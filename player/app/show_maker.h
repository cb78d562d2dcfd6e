#pragma once

// Reads a bundle and creates its show; also creates the same show in other languages while the
// first is played.

#include <memory>
#include <optional>
#include <utility>

#include "player/app/device_file.h"
#include "player/app/options.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/drama/visitor.h"
#include "shared/show/picture_camera.h"
#include "shared/show/show.h"
#include "shared/show/show_content.h"

namespace lararium::player {

// Call the Set functions before the first show is created. The other functions may be called on any
// thread.
class ShowMaker {
 public:
  // options and log must outlive the object.
  ShowMaker(const PlayOptions& options, Log& log) : options_(options), log_(log) {}

  // The look in the device file takes precedence over that of the places in the bundle.
  void SetDevice(const Device& device);
  // size: size of pictures. part: part of the camera's view that they show. around: people are also
  // visible outside the borders of the camera's view.
  void SetPicture(const PictureSize& size, const show::ViewPart& part, bool around);
  // Replays a recorded visitor instead of observing the real one.
  void SetVisitor(drama::VisitorLog visitor) { visitor_ = std::move(visitor); }

  // Reads and checks the bundle. finest: see show::LoadShowContent.
  Result<show::ShowContent> Load(const show::LanguageChoice& languages, float finest) const;
  // Creates a show at the beginning of its drama.
  Result<std::unique_ptr<show::Show>> Make(show::ShowContent content) const;
  // Loads the content and creates a show at a time of its drama, seconds.
  Result<std::unique_ptr<show::Show>> MakeAt(double time,
                                             const show::LanguageChoice& languages,
                                             float finest) const;

 private:
  const PlayOptions& options_;
  Log& log_;
  std::optional<light::CameraTraits> look_;
  show::TrackingLossFaderOptions lost_;
  PictureSize size_;
  show::ViewPart part_;
  bool around_ = false;
  std::optional<drama::VisitorLog> visitor_;
};

}  // namespace lararium::player
