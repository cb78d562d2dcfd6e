#include "player/app/picture_output.h"

#include <algorithm>
#include <utility>

namespace lararium::player {

Result<PictureLayout> ChooseLayout(const DisplayOptions& options,
                                   const std::optional<Headset>& headset,
                                   const geometry::CameraModel& camera) {
  PictureLayout layout;
  layout.camera = camera;
  const bool has_panel = headset && headset->panel;
  const Display mode = options.mode.value_or(has_panel ? Display::kSideBySide : Display::kMono);
  if (mode == Display::kOpenXr) {
    layout.headset = headset.value_or(Headset());
    layout.headset->panel.reset();  // The runtime knows the panel.
  } else if (mode == Display::kSideBySide) {
    if (!has_panel) {
      return Status::Error("--display side-by-side", "the headset's panel is not known",
                           "give a device file (--device) whose \"headset\" has a \"panel\"");
    }
    layout.headset = headset;
    layout.part = headset->SeenPart();
  }
  const geometry::CameraModel seen = show::PartOfView(camera, layout.part);
  // Width and height of videos must be even.
  layout.size = options.size.value_or(
      PictureSize{std::max(seen.width & ~1, 16), std::max(seen.height & ~1, 16)});
  return layout;
}

Result<std::unique_ptr<PictureOutput>> PictureOutput::Open(const DisplayOptions& options,
                                                           const PictureLayout& layout,
                                                           const show::ShowContent& content,
                                                           const render::Quality& quality,
                                                           const std::string& bundle,
                                                           Log& log) {
  std::unique_ptr<PictureOutput> output(new PictureOutput(layout.camera));
  LARARIUM_ASSIGN_OR_RETURN(output->screen_, Screen::Open(options, content.title));
  LARARIUM_ASSIGN_OR_RETURN(output->target_,
                            render::RenderTarget::Create(layout.size.width, layout.size.height));
  Result<std::unique_ptr<show::ShowRenderer>> renderer =
      show::ShowRenderer::Create(content, quality);
  if (!renderer.ok()) {
    return renderer.status().At(bundle);
  }
  output->renderer_ = *std::move(renderer);
  output->renderer_->SetPart(layout.part);
  if (layout.headset && layout.headset->panel) {
    LARARIUM_ASSIGN_OR_RETURN(output->stereo_, StereoDisplay::Create(*layout.headset));
    output->screen_->CheckSize(output->stereo_->panel(), log);
  } else if (layout.headset) {
    LARARIUM_ASSIGN_OR_RETURN(output->openxr_,
                              OpenXrDisplay::Open(*layout.headset, content.title, log));
  }
  return output;
}

Status PictureOutput::Draw(const show::StagedFrame& staged,
                           double now,
                           float opacity,
                           const std::function<void(const geometry::CameraModel&)>& before) {
  if (openxr_ != nullptr) {
    LARARIUM_RETURN_IF_ERROR(openxr_->Draw(staged, *renderer_, *target_, now, opacity, before));
  } else if (stereo_) {
    LARARIUM_RETURN_IF_ERROR(stereo_->Draw(staged, *renderer_, *target_));
  } else {
    LARARIUM_RETURN_IF_ERROR(renderer_->Draw(staged, *target_));
  }
  target_->Finish();
  return Status();
}

}  // namespace lararium::player
