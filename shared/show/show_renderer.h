#pragma once

// Draws staged frames. All functions run on the thread whose OpenGL context was current at
// creation.

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
  // Uploads the cast, the objects, the occluders of all places and the glyphs of captions. Fails if
  // a texture cannot be decoded.
  static Result<std::unique_ptr<ShowRenderer>> Create(const ShowContent& content,
                                                      const render::Quality& quality = {});

  // Replaces the occluders and the camera traits of places[index], while a designer stages.
  void SetPlace(size_t index, const stage::Place& place);

  // From now on draws only Lambertian reflection and no camera effects, like the path-traced
  // references.
  void SetMatte(bool matte) { matte_ = matte; }

  // Quality of all frames from now on.
  void SetQuality(const render::Quality& quality);

  // Colours people and objects by the certainty of their evidence, with a legend if the show has a
  // font.
  void SetEvidence(bool on) { shows_evidence_ = on; }
  bool shows_evidence() const { return shows_evidence_; }

  // Shows the tracking state and this text over the picture, for staff; nullopt: nothing.
  void SetStaff(std::optional<std::string> more) { captions_->SetStaff(std::move(more)); }

  // Shows the visitor's menu over the picture; nullopt: none.
  void SetMenu(std::optional<render::Menu> menu) { captions_->SetMenu(std::move(menu)); }

  // Style of captions and of guides for visitors from now on.
  void SetCaptionStyle(const render::CaptionStyle& style) {
    caption_style_ = style;
    captions_->SetStyle(style);
  }

  // Draws the objects of the same show that Show::SetObjects() has changed.
  Status SetObjects(const ShowContent& content);

  // Replaces the texts by those of the same show in another language.
  Status SetTexts(const ShowContent& content);

  // Draws only this part of the camera's view from now on.
  void SetPart(const ViewPart& part) { part_ = part; }
  // The pinhole camera of a picture of that size.
  geometry::CameraModel PictureOf(const geometry::CameraModel& camera,
                                  int width,
                                  int height) const {
    return PictureCamera(camera, width, height, part_);
  }

  // Fills the target with the composite: the camera image, the occluders of the frame's place,
  // people in its light, and captions. eye: position of the viewer; Quality::half_rate applies only
  // if it is the camera itself.
  Status Draw(const StagedFrame& staged,
              const render::RenderTarget& target,
              const PictureEye& eye = {});

  // Fills the target with people, objects and captions only, for a see-through display
  // (render::RenderScene::see_through).
  Status DrawSeeThrough(const StagedFrame& staged,
                        const FreeEye& eye,
                        const render::RenderTarget& target);

  // Fills the target with people and objects in one colour, where no occluder hides them:
  // sRGB-encoded, premultiplied by ReadCoverage(), without shadows and captions.
  Status DrawOverlays(const StagedFrame& staged,
                      const render::SceneMark& mark,
                      const render::RenderTarget& target);

  // Coverage of each pixel by people and props in the last drawn frame, CV_8UC1.
  void ReadCoverage(cv::Mat& coverage) const { renderer_->ReadCoverage(coverage); }

 private:
  struct PlaceScene {
    std::vector<render::SceneOccluder> occluders;
    std::optional<light::CameraTraits> camera;
    std::vector<light::GlossyMap> glossy;  // Parallel to the place's probes.
  };

  explicit ShowRenderer(std::unique_ptr<render::Renderer> renderer)
      : renderer_(std::move(renderer)) {}

  Status AddObjects(const ShowContent& content);
  // Uploads each actor whose level of detail has changed, and removes its old model.
  Status UploadFigures(const StagedFrame& staged);
  // The scene without camera and background.
  Result<render::RenderScene> SceneOf(const StagedFrame& staged, int height);
  // Sets the scene's background image, camera and look.
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
  void CollectHumans(const StagedPeople& people, const StagedLight& light);
  void CollectProps(const StagedThings& things, const StagedLight& light);
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
  std::vector<render::ModelHandle> objects_;  // Parallel to ShowContent::objects.
  std::vector<PlaceScene> places_;
  bool matte_ = false;
  ViewPart part_;
  std::optional<Evidence> evidence_;  // Set by Create().
  bool shows_evidence_ = false;
  bool half_rate_ = false;
  std::optional<uint32_t> layer_place_;  // Place of the people in the last drawn layer.
  int64_t last_frame_ = 0;               // Index of the last drawn frame.
  // Whether drawn_by_halves_ has its shadows but not yet its people.
  bool shadows_are_drawn_ = false;
  StagedFrame drawn_by_halves_;  // A copy, because later frames are staged meanwhile.
  // Data of the frame that is being drawn.
  std::vector<render::SceneHuman> humans_;
  std::vector<render::SceneVertices> vertices_;
  std::vector<render::SceneProp> props_;
  // Blended reflections for a place and for quantised probe weights.
  std::vector<uint32_t> glossy_;
  uint64_t glossy_number_ = 0;
  uint32_t glossy_place_ = 0;
  std::vector<float> glossy_weights_;
  std::vector<float> new_weights_;
  std::vector<const light::GlossyMap*> glossy_maps_;
};

}  // namespace lararium::show
