#pragma once

// The scene view: the map's points, the cameras of the recordings, the stage, the occluders and the
// actors, from a free viewpoint. The world frame is the stage that the picks give. Clicking or
// pointing at points and cameras shows information about them.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/panels/viewport/place_cards.h"
#include "editor/panels/viewport/place_picking.h"
#include "editor/panels/viewport/view_tools.h"
#include "editor/panels/viewport/walk_view.h"
#include "editor/session/workspace.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/overlay.h"

namespace lararium::panels {

class SceneView {
 public:
  // Needs the window's OpenGL context.
  static Result<std::unique_ptr<SceneView>> Create();
  ~SceneView();

  // Fills the current window.
  void Show(const PanelContext& context);

 private:
  explicit SceneView(std::unique_ptr<render::Overlay> overlay);

  // Uploads what has changed in the loaded place.
  void UpdateMap(const editor::LoadedMap& loaded, PlaceView& place_view);
  void UpdateColours(const editor::LoadedMap& loaded, PlaceView& place);
  void AddCameras(const editor::LoadedMap& loaded, PointColour colours);
  void UpdateOccluders(const editor::Workspace& workspace);
  void UpdateActors(const editor::Workspace& workspace);

  // Redraws the target if the scene has changed.
  Status Draw(const editor::Workspace& workspace,
              const Selection& selection,
              const ViewOptions& options,
              const PlaceView& place_view,
              const ViewCamera& view,
              int width,
              int height);
  void AddMeshes(const editor::Workspace& workspace, const Selection& selection);
  void AddFloor(const editor::LoadedMap& loaded);
  // points: the number of points to draw.
  void DrawScene(size_t points);
  // Measures drawing to determine how many points can be drawn while the view moves.
  void MeasurePoints();
  // The keyframe whose centre or frustum is under the pointer.
  std::optional<uint32_t> KeyframeBelow(const ViewCamera& view, const Eigen::Vector2d& pixel) const;
  // Handles pointing at keyframes, and clicks on keyframes and points of the map.
  void Point(editor::Workspace& workspace,
             ViewOptions& options,
             PickTarget& picks,
             PlaceView& place_view,
             PictureTextures& pictures,
             const ViewCamera& view,
             bool hovered,
             ImDrawList& draw);
  void Interact(PlaceView& place_view, bool hovered, bool active, const Eigen::Vector2d& size);

  std::unique_ptr<render::Overlay> overlay_;
  std::optional<render::RenderTarget> target_;

  std::shared_ptr<const vision::SceneDatabase> database_;
  geometry::Similarity3 map_from_picked_;
  std::vector<Eigen::Vector3f> points_;  // The map's points in the world frame.
  // The order in which points are drawn: any number of first points is a fair sample.
  std::vector<uint32_t> order_;
  std::optional<PointColour> colours_;  // The colours that are uploaded.
  std::optional<render::PointsHandle> uploaded_;
  struct Camera {
    uint32_t keyframe;
    Eigen::Vector3d center;
    std::optional<Frustum> frustum;  // Drawn only for some cameras.
  };
  std::vector<Camera> keyframes_;
  std::vector<render::OverlayLine> cameras_;
  KeyframeCard card_;
  WalkView walks_;
  // Where a press began that can become a click.
  std::optional<Eigen::Vector2d> pressed_;

  struct MeshDraw {
    render::MeshHandle mesh;
    glm::mat4 world_from_mesh;
    glm::u8vec4 colour;

    friend bool operator==(const MeshDraw&, const MeshDraw&) = default;
  };
  // Everything that the picture depends on. It is drawn again where this has changed.
  struct Scene {
    render::OverlayView view;
    float pixel = 1.0f;  // Px(1).
    bool has_place = false;
    bool points = false;
    std::vector<render::OverlayLine> lines;
    std::vector<MeshDraw> meshes;

    friend bool operator==(const Scene&, const Scene&) = default;
  };
  Scene scene_;
  Scene drawn_;
  bool outdated_ = true;                 // Points or cameras have changed since.
  bool thinned_ = false;                 // Not all points were drawn.
  std::optional<size_t> moving_points_;  // Limit for the current map; nullopt: not measured yet.
  uint32_t version_ = 0;                 // Version of the target's picture.

  struct OverlayMesh {
    std::string name;
    render::MeshHandle mesh;
  };
  std::vector<OverlayMesh> occluders_;
  std::shared_ptr<const stage::Place> staged_;  // The place that occluders_ belong to.
  std::optional<render::MeshHandle> floor_;     // A square from -1 to 1 on y = 0.
  std::shared_ptr<const editor::PreviewPicture> actors_of_;
  std::vector<std::pair<render::MeshHandle, glm::mat4>> actors_;
  bool framed_ = false;  // The orbit was set to show the whole place.
};

}  // namespace lararium::panels
