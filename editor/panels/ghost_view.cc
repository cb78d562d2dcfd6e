#include "editor/panels/ghost_view.h"

#include <algorithm>
#include <string>
#include <utility>

#include "editor/import/simplify.h"
#include "editor/panels/gizmo_view.h"
#include "editor/panels/theme.h"

namespace lararium::panels {

namespace {

const ImVec4 kPlain = {0.56f, 0.70f, 0.90f, 1.0f};
constexpr float kFaceOpacity = 0.28f;
constexpr float kEdgeOpacity = 0.75f;
constexpr size_t kMostIndices = 3 * 4000;  // of one occluder

Ghost GhostOf(const geometry::TriangleMesh& mesh) {
  if (mesh.indices.size() <= kMostIndices) {
    return MakeGhost(mesh);
  }
  geometry::TriangleMesh coarse{mesh.positions, {}, mesh.indices};
  for (human::LevelOfDetail& level :
       import::CoarserLevels(mesh.positions, mesh.indices, mesh.indices.size())) {
    if (coarse.indices.size() > kMostIndices) {
      coarse.indices = std::move(level.indices);
    }
  }
  return MakeGhost(coarse);
}

ImVec4 Shaded(ImVec4 colour, double shade) {
  const auto by = static_cast<float>(shade);
  return {colour.x * by, colour.y * by, colour.z * by, colour.w};
}

void DrawFace(const GhostFace& face, const ImVec4& colour, ImDrawList& draw) {
  ImVec2 outline[4];
  std::transform(face.outline.begin(), face.outline.begin() + face.corners, outline, ToImGui);
  draw.AddConvexPolyFilled(outline, face.corners, Packed(Shaded(colour, face.shade), kFaceOpacity));
}

}  // namespace

void GhostView::Update(const app::Workspace& workspace) {
  const std::shared_ptr<const stage::Place>& staged = workspace.loaded().staged;
  if (staged == staged_) {
    return;
  }
  std::vector<Ghost> ghosts;
  for (size_t i = 0; staged != nullptr && i < staged->occluders.size(); ++i) {
    const geometry::TriangleMesh& mesh = staged->occluders[i].mesh;
    const bool same = i < ghosts_.size() && SameMesh(mesh, staged_->occluders[i].mesh);
    ghosts.push_back(same ? std::move(ghosts_[i]) : GhostOf(mesh));
  }
  ghosts_ = std::move(ghosts);
  staged_ = staged;
}

void GhostView::Show(const app::Workspace& workspace,
                     const EditorState& state,
                     const ViewCamera& view,
                     ImDrawList& draw) {
  Update(workspace);
  std::vector<ImVec4> colours(ghosts_.size(), kPlain);
  std::vector<std::pair<size_t, geometry::Similarity3>> shown;
  faces_.clear();
  for (size_t i = 0; i < ghosts_.size(); ++i) {
    const std::string& name = staged_->occluders[i].name;
    const bool selected = state.selection == Selection{Selection::Kind::kOccluder, name};
    if (selected || state.show_occluders) {
      colours[i] = selected ? OverPicture().accent : kPlain;
      shown.emplace_back(i, WorldFromOccluder(workspace, name));
      AddFaces(ghosts_[i], shown.back().second, view, static_cast<int>(i), faces_);
    }
  }
  SortFarthestFirst(faces_);
  // Softened rims would show where two faces of one colour meet.
  const ImDrawListFlags flags = draw.Flags;
  draw.Flags &= ~ImDrawListFlags_AntiAliasedFill;
  for (const GhostFace& face : faces_) {
    DrawFace(face, colours[static_cast<size_t>(face.ghost)], draw);
  }
  draw.Flags = flags;
  for (const auto& [i, world_from_mesh] : shown) {
    for (const std::array<uint32_t, 2>& edge : ghosts_[i].edges) {
      DrawWorldLine(view, world_from_mesh * ghosts_[i].corners[edge[0]],
                    world_from_mesh * ghosts_[i].corners[edge[1]], Packed(colours[i], kEdgeOpacity),
                    Px(1.2f), draw);
    }
  }
}

}  // namespace lararium::panels
