#pragma once

// Reads a bundle and makes the show that is played of it: also the same show in other languages,
// while the first is played.

#include <memory>
#include <optional>
#include <utility>

#include "player/device_file.h"
#include "player/options.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/drama/visitor.h"
#include "shared/show/picture_camera.h"
#include "shared/show/show.h"
#include "shared/show/show_content.h"

namespace lararium::player {

// What is set is set before the first show is made; all else may be called on any thread.
class ShowMaker {
 public:
  // Both outlive it.
  ShowMaker(const PlayOptions& options, Log& log) : options_(options), log_(log) {}

  // Its look goes before what the bundle says of each place's camera.
  void SetDevice(const Device& device);
  // What of the camera's view is drawn how large. around: people are seen past its borders too.
  void SetPicture(const PictureSize& size, const show::ViewPart& part, bool around);
  // Whom the drama is told of, in place of who watches.
  void SetVisitor(drama::VisitorLog visitor) { visitor_ = std::move(visitor); }

  // Reads and checks the bundle. finest: as show::LoadShowContent takes it.
  Result<show::ShowContent> Load(const show::LanguageChoice& languages, float finest) const;
  // At the beginning of its drama.
  Result<std::unique_ptr<show::Show>> Make(show::ShowContent content) const;
  // Both, at a time of its drama, seconds.
  Result<std::unique_ptr<show::Show>> MakeAt(double time,
                                             const show::LanguageChoice& languages,
                                             float finest) const;

 private:
  const PlayOptions& options_;
  Log& log_;
  std::optional<light::CameraTraits> look_;
  show::LostLadderOptions lost_;
  PictureSize size_;
  show::ViewPart part_;
  bool around_ = false;
  std::optional<drama::VisitorLog> visitor_;
};

}  // namespace lararium::player
