#pragma once

// Draws people and props into the camera's image. OpenGL 3.3 core, or ES 3.0.
//
// Passes: occluders into depth only; people and props, skinned on the GPU and lit by
// spherical harmonics, in linear light with 16-bit floats and several samples; the shadows
// that real surfaces catch; the camera's image, undistorted; then people and shadows over
// it where there are any. What lies outside the picture is not drawn.

#include <memory>

#include "shared/core/status.h"
#include "shared/geometry/triangle_mesh.h"
#include "shared/human/human.h"
#include "shared/render/quality.h"
#include "shared/render/render_scene.h"
#include "shared/render/render_target.h"
#include "shared/stage/prop.h"

namespace lararium::render {

class Renderer {
 public:
  // Needs a current context; everything else happens on its thread.
  static Result<std::unique_ptr<Renderer>> Create(const Quality& quality = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // What is added must be valid (TriangleMesh::Validate, Human::Validate,
  // Prop::Validate). A person or prop fails where a texture cannot be decoded; those are kept,
  // since finer ones may be wanted later.
  MeshHandle AddMesh(const geometry::TriangleMesh& mesh);
  Result<ModelHandle> AddHuman(const std::shared_ptr<const human::Human>& human);
  Result<ModelHandle> AddProp(const std::shared_ptr<const stage::Prop>& prop);
  void RemoveMesh(MeshHandle mesh);
  void RemoveModel(ModelHandle model);

  // Compiles now what shadows on real surfaces are drawn with, for whoever has such and can wait:
  // otherwise that is done in the picture that shows the first, which takes as much longer.
  Status PrepareCaughtShadows();

  // Of the pictures from now on.
  void SetQuality(const Quality& quality);

  // Fills the whole target. On error (a stale handle, matrices missing, out of
  // memory) the target's content is undefined.
  Status Draw(const RenderScene& scene, const RenderTarget& target);

  // Quality::half_rate: half of a layer of people and shadows, then a picture with the layer that
  // was ready last, where its camera sees it now. people: the same scene twice in a row, for one
  // half after the other. picture: its image, cameras and opacity count.
  enum class Half { kShadows, kPeople };
  Status DrawHalf(Half half,
                  const RenderScene& people,
                  const RenderScene& picture,
                  const RenderTarget& target);
  // Whether the layer that was ready last would do for a picture: it was drawn for one like it,
  // from nearly there.
  bool CanCarryLayer(const RenderScene& picture, const RenderTarget& target) const;

  // Of the layer that was drawn last: how much of each pixel people and props cover,
  // 0 to 255, CV_8UC1, before the camera's look softens them.
  void ReadCoverage(cv::Mat& coverage) const;

  // For comparisons with other light: people and props alone, hidden by occluders, at
  // the display's size. rgba: CV_32FC4, linear radiance times coverage, coverage, before
  // exposure, gain and the camera's response; in steps of 16-bit floats.
  Status DrawLinear(const RenderScene& scene, cv::Mat& rgba);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace lararium::render
