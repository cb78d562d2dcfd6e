#pragma once

// Draws staged frames. Everything happens on the thread whose OpenGL context was
// current at creation.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/renderer.h"
#include "shared/show/evidence.h"
#include "shared/show/picture_camera.h"
#include "shared/show/show.h"
#include "shared/show/show_captions.h"

namespace lararium::show {

class ShowRenderer {
 public:
  // Uploads cast, objects, the occluders of all places and the letters of captions. Fails
  // where a texture cannot be decoded.
  static Result<std::unique_ptr<ShowRenderer>> Create(const ShowContent& content,
                                                      const render::Quality& quality = {});

  // Other occluders of places[index], while a designer stages.
  void SetPlace(size_t index, const stage::Place& place);

  // Only Lambert's reflection from now on and nothing of the camera, as path-traced references
  // have it.
  void SetMatte(bool matte) { matte_ = matte; }

  // Of the frames from now on.
  void SetQuality(const render::Quality& quality);

  // People and things in the colours of how certain they are, with a legend where the show
  // has letters.
  void SetEvidence(bool on) { shows_evidence_ = on; }
  bool shows_evidence() const { return shows_evidence_; }

  // For staff, over the picture: how tracking is, and more; nullopt: nothing.
  void SetStaff(std::optional<std::string> more) { captions_->SetStaff(std::move(more)); }

  // What a visitor chooses from, over the picture; nullopt: nothing.
  void SetMenu(std::optional<render::Menu> menu) { captions_->SetMenu(std::move(menu)); }

  // How captions and what guides visitors are written from now on.
  void SetCaptionStyle(const render::CaptionStyle& style) {
    caption_style_ = style;
    captions_->SetStyle(style);
  }

  // Other texts, of the same show in another language.
  Status SetTexts(const ShowContent& content);

  // Only this part of the camera's view is drawn from now on.
  void SetPart(const ViewPart& part) { part_ = part; }
  // The pinhole of a picture of that size.
  geometry::CameraModel PictureOf(const geometry::CameraModel& camera,
                                  int width,
                                  int height) const {
    return PictureCamera(camera, width, height, part_);
  }

  // Fills the target with the composite: image, the occluders of the frame's
  // place, people in its light, captions. eye: who sees it; the camera unless told otherwise, and
  // for the camera alone Quality::half_rate holds.
  Status Draw(const StagedFrame& staged,
              const render::RenderTarget& target,
              const PictureEye& eye = {});

  // Fills the target with people, things and captions alone, for a display that shows what is real
  // behind it (render::RenderScene::see_through).
  Status DrawSeeThrough(const StagedFrame& staged,
                        const FreeEye& eye,
                        const render::RenderTarget& target);

  // Fills the target with people and things alone, in one colour, where no occluder hides them:
  // sRGB-encoded, times ReadCoverage(), without shadows and captions.
  Status DrawGhosts(const StagedFrame& staged,
                    const render::SceneMark& mark,
                    const render::RenderTarget& target);

  // Of the frame drawn last: how much of each pixel people and props cover, CV_8UC1.
  void ReadCoverage(cv::Mat& coverage) const { renderer_->ReadCoverage(coverage); }

 private:
  struct PlaceScene {
    std::vector<render::SceneOccluder> occluders;
    std::optional<light::CameraTraits> camera;
    std::vector<light::GlossyMap> glossy;  // of each probe
  };

  explicit ShowRenderer(std::unique_ptr<render::Renderer> renderer)
      : renderer_(std::move(renderer)) {}

  Status AddObjects(const ShowContent& content);
  // Uploads who is drawn in another detail than before, in the place of what was.
  Status UploadFigures(const StagedFrame& staged);
  // All but from where it is seen.
  Result<render::RenderScene> SceneOf(const StagedFrame& staged, int height);
  // The image and from where it is seen, as a part of the scene.
  void SetCamera(const StagedFrame& staged,
                 const render::RenderTarget& target,
                 const PictureEye& eye,
                 render::RenderScene& scene) const;
  Status DrawWhole(const StagedFrame& staged,
                   const render::RenderTarget& target,
                   const PictureEye& eye);
  Status DrawHalf(const StagedFrame& staged,
                  const render::RenderScene& picture,
                  const render::RenderTarget& target);
  void CollectHumans(const StagedFrame& staged);
  void CollectProps(const StagedFrame& staged);
  void MarkByEvidence(const StagedFrame& staged, int height);
  void BlendReflections(const StagedFrame& staged);

  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<ShowCaptions> captions_;
  render::CaptionStyle caption_style_;
  struct CastModel {
    std::shared_ptr<const human::Human> figure;
    render::ModelHandle model;
  };
  std::vector<CastModel> cast_;
  std::vector<render::ModelHandle> objects_;  // of each object
  std::vector<PlaceScene> places_;
  bool matte_ = false;
  ViewPart part_;
  std::optional<Evidence> evidence_;  // set when created
  bool shows_evidence_ = false;
  bool half_rate_ = false;
  std::optional<uint32_t> layer_place_;  // of the people drawn last
  int64_t last_frame_ = 0;               // of which there was a picture
  bool shadows_are_drawn_ = false;       // of drawn_by_halves_, whose people are not yet
  StagedFrame drawn_by_halves_;          // a copy: others go on meanwhile
  // Of the frame being drawn.
  std::vector<render::SceneHuman> humans_;
  std::vector<render::SceneVertices> vertices_;
  std::vector<render::SceneProp> props_;
  // What is mirrored, blended for a place and for weights in steps that are not seen.
  std::vector<uint32_t> glossy_;
  uint64_t glossy_number_ = 0;
  uint32_t glossy_place_ = 0;
  std::vector<float> glossy_weights_;
  std::vector<float> new_weights_;
  std::vector<const light::GlossyMap*> glossy_maps_;
};

}  // namespace lararium::show
