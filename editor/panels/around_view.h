#pragma once

// Around the place: the map's points, the cameras that filmed it, the stage, the
// occluders and the actors, seen from anywhere. The world is the stage that the
// picks give. Points and cameras tell of themselves where they are clicked or pointed at.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/workspace.h"
#include "editor/panels/editor_state.h"
#include "editor/panels/place_cards.h"
#include "editor/panels/place_picking.h"
#include "editor/panels/walk_view.h"
#include "shared/render/overlay.h"
#include "shared/render/render_target.h"

namespace lararium::panels {

class AroundView {
 public:
  // Needs the window's OpenGL context.
  static Result<std::unique_ptr<AroundView>> Create();
  ~AroundView();

  // Fills the current window.
  void Show(app::Workspace& workspace, EditorState& state);

 private:
  explicit AroundView(std::unique_ptr<render::Overlay> overlay);

  // Brings what is uploaded up to date with what is loaded.
  void UpdateMap(const app::LoadedPlace& loaded, EditorState& state);
  void UpdateColours(const app::LoadedPlace& loaded, PlaceView& place);
  void AddCameras(const app::LoadedPlace& loaded, PointColour colours);
  void UpdateOccluders(const app::Workspace& workspace);
  void UpdateActors(const app::Workspace& workspace);

  // Brings what is in the target up to date with what is to be seen.
  Status Draw(const app::Workspace& workspace,
              const EditorState& state,
              const ViewCamera& view,
              int width,
              int height);
  void AddMeshes(const app::Workspace& workspace, const EditorState& state);
  void AddFloor(const app::LoadedPlace& loaded);
  // points: so many of them.
  void DrawScene(size_t points);
  // How many points may be drawn while the view moves, by how long they take here.
  void MeasurePoints();
  // The keyframe whose centre or frustum lies below the pointer.
  std::optional<uint32_t> KeyframeBelow(const ViewCamera& view, const Eigen::Vector2d& pixel) const;
  // Points at keyframes; a click on one, or on a point of the map.
  void Point(app::Workspace& workspace,
             EditorState& state,
             const ViewCamera& view,
             bool hovered,
             ImDrawList& draw);
  void Interact(EditorState& state, bool hovered, bool active, const Eigen::Vector2d& size);

  std::unique_ptr<render::Overlay> overlay_;
  std::optional<render::RenderTarget> target_;

  std::shared_ptr<const vision::SceneDatabase> database_;
  geometry::Similarity3 map_from_picked_;
  std::vector<Eigen::Vector3f> points_;  // of the map, in the world
  std::vector<uint32_t> order_;          // in which they are drawn: the first ones stand for all
  std::optional<PointColour> colours_;   // that are uploaded
  std::optional<render::PointsHandle> uploaded_;
  struct Camera {
    uint32_t keyframe;
    Eigen::Vector3d center;
    std::optional<Frustum> frustum;  // drawn for some of them
  };
  std::vector<Camera> keyframes_;
  std::vector<render::OverlayLine> cameras_;
  KeyframeCard card_;
  WalkView walks_;
  // Where a press began that may become a click.
  std::optional<Eigen::Vector2d> pressed_;

  struct MeshDraw {
    render::MeshHandle mesh;
    glm::mat4 world_from_mesh;
    glm::u8vec4 colour;

    friend bool operator==(const MeshDraw&, const MeshDraw&) = default;
  };
  // All that the picture depends on: it is drawn anew where this differs.
  struct Scene {
    render::OverlayView view;
    float pixel = 1.0f;  // Px(1)
    bool has_place = false;
    bool points = false;
    std::vector<render::OverlayLine> lines;
    std::vector<MeshDraw> meshes;

    friend bool operator==(const Scene&, const Scene&) = default;
  };
  Scene scene_;
  Scene drawn_;
  bool outdated_ = true;                 // other points or cameras came since
  bool thinned_ = false;                 // not all points were drawn
  std::optional<size_t> moving_points_;  // of the map at hand; nullopt: not measured yet
  uint32_t version_ = 0;                 // of the target's picture

  struct Ghost {
    std::string name;
    render::MeshHandle mesh;
  };
  std::vector<Ghost> occluders_;
  std::shared_ptr<const stage::Place> staged_;  // whose they are
  std::optional<render::MeshHandle> floor_;     // a square from -1 to 1 on y = 0
  std::shared_ptr<const app::PreviewPicture> actors_of_;
  std::vector<std::pair<render::MeshHandle, glm::mat4>> actors_;
  bool framed_ = false;  // the orbit was set to show the whole place
};

}  // namespace lararium::panels
