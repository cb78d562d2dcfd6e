#include "player/app/show_maker.h"

#include <utility>

#include "shared/bundle/bundle.h"
#include "shared/bundle/signature.h"

namespace lararium::player {

void ShowMaker::SetDevice(const Device& device) {
  look_ = device.look;
  lost_ = device.lost;
}

void ShowMaker::SetPicture(const PictureSize& size, const show::ViewPart& part, bool around) {
  size_ = size;
  part_ = part;
  around_ = around;
}

Result<show::ShowContent> ShowMaker::Load(const show::LanguageChoice& languages,
                                          float finest) const {
  bundle::OpenOptions opening;
  if (!options_.trust.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(opening.trusted, bundle::LoadPublicKey(options_.trust));
  }
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle,
                            bundle::Bundle::Open(options_.show, opening));
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content,
                            show::LoadShowContent(bundle, options_.place, languages, finest));
  for (show::ShowPlace& place : content.places) {
    if (!options_.camera_look) {
      place.stage.camera.reset();
    } else if (look_) {
      place.stage.camera = look_;
    }
  }
  return content;
}

Result<std::unique_ptr<show::Show>> ShowMaker::Make(show::ShowContent content) const {
  drama::DramaOptions drama;
  drama.seed = options_.seed;
  // A player only ever goes back to the beginning, and plays for days: it needs no past.
  drama.past = options_.visitor_log.empty() ? drama::Past::kForgotten : drama::Past::kKept;
  Result<std::unique_ptr<show::Show>> made = show::Show::Create(std::move(content), drama, log_);
  if (!made.ok()) {
    return made.status().At(options_.show.string());
  }
  show::Show& show = **made;
  show.SetTrackingLossFader(lost_);
  show.detail().SetPictureSize(size_.width, size_.height, part_);
  show.detail().SetSeenAround(around_);
  if (visitor_) {
    show.drama().SetVisitorLog(*visitor_);
  }
  return made;
}

Result<std::unique_ptr<show::Show>> ShowMaker::MakeAt(double time,
                                                      const show::LanguageChoice& languages,
                                                      float finest) const {
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content, Load(languages, finest));
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<show::Show> show, Make(std::move(content)));
  if (options_.visitor_log.empty()) {  // a recording first needs the visitor's earlier actions
    LARARIUM_RETURN_IF_ERROR(show->PrepareAt(time));
  }
  return show;
}

}  // namespace lararium::player
