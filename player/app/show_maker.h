#pragma once

// Reads a bundle and creates its show; also creates the same show in other languages while the
// first is played.

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "player/app/device_file.h"
#include "player/app/options.h"
#include "shared/bundle/bundle.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/drama/visitor.h"
#include "shared/show/picture_camera.h"
#include "shared/show/show.h"
#include "shared/show/show_content.h"

namespace lararium::player {

// Call the Set functions before the first show is created.
class ShowMaker {
 public:
  // bundle and log must outlive the object.
  ShowMaker(const BundleOptions& bundle, const drama::DramaOptions& drama, Log& log)
      : bundle_(bundle), drama_(drama), log_(log) {}

  // camera_look: people get the look of the camera's images. The look in the device file takes
  // precedence over that of the places in the bundle.
  void SetDevice(const Device& device, bool camera_look);
  // size: size of pictures. part: part of the camera's view that they show. around: people are also
  // visible outside the borders of the camera's view.
  void SetPicture(const PictureSize& size, const show::ViewPart& part, bool around);
  // Replays a recorded visitor instead of observing the real one.
  void SetVisitor(drama::VisitorLog visitor) { visitor_ = std::move(visitor); }

  // Shows play their dramas together with others. Borrows the group.
  void SetGroup(show::DramaGroup& group) { group_ = &group; }

  // Reads and checks the bundle. finest: see show::LoadShowContent.
  Result<show::ShowContent> Load(const show::LanguageChoice& languages, float finest);
  // bundle::ShowVersion() and bundle::DramaVersion() of the bundle that was loaded.
  const std::string& version() const { return version_; }
  const std::string& drama_version() const { return drama_version_; }
  // Creates a show at the beginning of its drama.
  Result<std::unique_ptr<show::Show>> Make(show::ShowContent content) const;

  // The languages that were loaded or taken last.
  const show::LanguageChoice& languages() const { return languages_; }
  // Begins to create the show in other languages at a time of its drama, seconds, on another
  // thread. Does nothing while that is being done, or if it has these languages already.
  void BeginOther(const show::LanguageChoice& languages, double time, float finest);
  // Returns whether the other show, or its failure, can be taken. wait: waits for it.
  bool OtherIsReady(bool wait) const;
  // Requires OtherIsReady(). After an error the languages are those of before.
  Result<std::unique_ptr<show::Show>> TakeOther();

 private:
  Result<bundle::Bundle> Open() const;
  Result<show::ShowContent> Read(const bundle::Bundle& bundle,
                                 const show::LanguageChoice& languages,
                                 float finest) const;
  Result<std::unique_ptr<show::Show>> MakeAt(double time,
                                             const show::LanguageChoice& languages,
                                             float finest) const;

  const BundleOptions& bundle_;
  drama::DramaOptions drama_;
  Log& log_;
  bool camera_look_ = true;
  std::optional<light::CameraTraits> look_;
  show::TrackingLossFaderOptions lost_;
  PictureSize size_;
  show::ViewPart part_;
  bool around_ = false;
  std::optional<drama::VisitorLog> visitor_;
  show::DramaGroup* group_ = nullptr;  // nullptr: shows play alone.
  show::LanguageChoice languages_;
  std::string version_;
  std::string drama_version_;
  // The show in other languages, and these. Declared last, because its thread uses the other
  // members.
  show::LanguageChoice other_languages_;
  std::future<Result<std::unique_ptr<show::Show>>> other_;
};

}  // namespace lararium::player
