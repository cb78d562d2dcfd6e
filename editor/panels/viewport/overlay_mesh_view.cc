#include "editor/panels/viewport/overlay_mesh_view.h"

#include <algorithm>
#include <string>
#include <utility>

#include "editor/import/model/simplify.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/widgets/theme.h"

namespace lararium::panels {

namespace {

const ImVec4 kPlain = {0.56f, 0.70f, 0.90f, 1.0f};
constexpr float kFaceOpacity = 0.28f;
constexpr float kEdgeOpacity = 0.75f;
constexpr size_t kMostIndices = 3 * 4000;  // Limit for one occluder.

OverlayMesh GhostOf(const geometry::TriangleMesh& mesh) {
  if (mesh.indices.size() <= kMostIndices) {
    return MakeOverlayMesh(mesh);
  }
  geometry::TriangleMesh coarse{mesh.positions, {}, mesh.indices};
  for (human::LevelOfDetail& level :
       import::CoarserLevels(mesh.positions, mesh.indices, mesh.indices.size())) {
    if (coarse.indices.size() > kMostIndices) {
      coarse.indices = std::move(level.indices);
    }
  }
  return MakeOverlayMesh(coarse);
}

ImVec4 Shaded(ImVec4 colour, double shade) {
  const auto by = static_cast<float>(shade);
  return {colour.x * by, colour.y * by, colour.z * by, colour.w};
}

void DrawFace(const OverlayFace& face, const ImVec4& colour, ImDrawList& draw) {
  ImVec2 outline[4];
  std::transform(face.outline.begin(), face.outline.begin() + face.corners, outline, ToImGui);
  draw.AddConvexPolyFilled(outline, face.corners, Packed(Shaded(colour, face.shade), kFaceOpacity));
}

}  // namespace

void OverlayMeshView::Update(const editor::Workspace& workspace) {
  const std::shared_ptr<const stage::Place>& staged = workspace.preview().staged();
  if (staged == staged_) {
    return;
  }
  std::vector<OverlayMesh> overlays;
  for (size_t i = 0; staged != nullptr && i < staged->occluders.size(); ++i) {
    const geometry::TriangleMesh& mesh = staged->occluders[i].mesh;
    const bool same = i < overlays_.size() && SameMesh(mesh, staged_->occluders[i].mesh);
    overlays.push_back(same ? std::move(overlays_[i]) : GhostOf(mesh));
  }
  overlays_ = std::move(overlays);
  staged_ = staged;
}

void OverlayMeshView::Show(const editor::Workspace& workspace,
                           const Selection& selection,
                           const ViewOptions& options,
                           const ViewCamera& view,
                           ImDrawList& draw) {
  Update(workspace);
  std::vector<ImVec4> colours(overlays_.size(), kPlain);
  std::vector<std::pair<size_t, geometry::Similarity3>> shown;
  faces_.clear();
  for (size_t i = 0; i < overlays_.size(); ++i) {
    const std::string& name = staged_->occluders[i].name;
    const bool selected = selection == Selection{Selection::Kind::kOccluder, name};
    if (selected || options.show_occluders) {
      colours[i] = selected ? OverPicture().accent : kPlain;
      shown.emplace_back(i, WorldFromOccluder(workspace, name));
      AddFaces(overlays_[i], shown.back().second, view, static_cast<int>(i), faces_);
    }
  }
  SortFarthestFirst(faces_);
  // Anti-aliased borders would be visible between two faces of the same colour.
  const ImDrawListFlags flags = draw.Flags;
  draw.Flags &= ~ImDrawListFlags_AntiAliasedFill;
  for (const OverlayFace& face : faces_) {
    DrawFace(face, colours[static_cast<size_t>(face.overlay)], draw);
  }
  draw.Flags = flags;
  for (const auto& [i, world_from_mesh] : shown) {
    for (const std::array<uint32_t, 2>& edge : overlays_[i].edges) {
      DrawWorldLine(view, world_from_mesh * overlays_[i].corners[edge[0]],
                    world_from_mesh * overlays_[i].corners[edge[1]],
                    Packed(colours[i], kEdgeOpacity), Px(1.2f), draw);
    }
  }
}

}  // namespace lararium::panels
