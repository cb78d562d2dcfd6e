#include "player/app/show_maker.h"

#include <chrono>
#include <utility>

#include "shared/bundle/show_manifest.h"
#include "shared/bundle/signature.h"

namespace lararium::player {

void ShowMaker::SetDevice(const Device& device, bool camera_look) {
  camera_look_ = camera_look;
  look_ = device.look;
  lost_ = device.lost;
}

void ShowMaker::SetPicture(const PictureSize& size, const show::ViewPart& part, bool around) {
  size_ = size;
  part_ = part;
  around_ = around;
}

Result<show::ShowContent> ShowMaker::Load(const show::LanguageChoice& languages, float finest) {
  languages_ = languages;
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, Open());
  version_ = bundle::ShowVersion(bundle.manifest());
  drama_version_ = bundle::DramaVersion(bundle.manifest());
  return Read(bundle, languages, finest);
}

Result<bundle::Bundle> ShowMaker::Open() const {
  bundle::OpenOptions opening;
  if (!bundle_.trust.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(opening.trusted, bundle::LoadPublicKey(bundle_.trust));
  }
  return bundle::Bundle::Open(bundle_.show, opening);
}

Result<show::ShowContent> ShowMaker::Read(const bundle::Bundle& bundle,
                                          const show::LanguageChoice& languages,
                                          float finest) const {
  show::LanguageChoice choice = languages;
  choice.in_step = group_ != nullptr;
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content,
                            show::LoadShowContent(bundle, bundle_.place, choice, finest));
  for (show::ShowPlace& place : content.places) {
    if (!camera_look_) {
      place.stage.camera.reset();
    } else if (look_) {
      place.stage.camera = look_;
    }
  }
  return content;
}

Result<std::unique_ptr<show::Show>> ShowMaker::Make(show::ShowContent content) const {
  Result<std::unique_ptr<show::Show>> made = show::Show::Create(std::move(content), drama_, log_);
  if (!made.ok()) {
    return made.status().At(bundle_.show.string());
  }
  show::Show& show = **made;
  show.SetTrackingLossFader(lost_);
  show.detail().SetPictureSize(size_.width, size_.height, part_);
  show.detail().SetSeenAround(around_);
  if (visitor_) {
    show.drama().SetVisitorLog(*visitor_);
  }
  if (group_ != nullptr) {
    show.Join(*group_);
  }
  return made;
}

Result<std::unique_ptr<show::Show>> ShowMaker::MakeAt(double time,
                                                      const show::LanguageChoice& languages,
                                                      float finest) const {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, Open());
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content, Read(bundle, languages, finest));
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<show::Show> show, Make(std::move(content)));
  if (group_ != nullptr) {
    LARARIUM_RETURN_IF_ERROR(show->CatchUpWithGroup());
  } else if (drama_.past == drama::Past::kForgotten) {  // A recording needs the earlier actions.
    LARARIUM_RETURN_IF_ERROR(show->PrepareAt(time));
  }
  return show;
}

void ShowMaker::BeginOther(const show::LanguageChoice& languages, double time, float finest) {
  if (!other_.valid() && languages != languages_) {
    other_languages_ = languages;
    other_ = std::async(std::launch::async, [this, languages, time, finest] {
      return MakeAt(time, languages, finest);
    });
  }
}

bool ShowMaker::OtherIsReady(bool wait) const {
  return other_.valid() &&
         (wait || other_.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
}

Result<std::unique_ptr<show::Show>> ShowMaker::TakeOther() {
  Result<std::unique_ptr<show::Show>> other = other_.get();
  if (other.ok()) {
    languages_ = other_languages_;
  }
  return other;
}

}  // namespace lararium::player
