#include "editor/panels/viewport/light_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "editor/panels/inspector/light_maths.h"
#include "editor/panels/viewport/gizmo_view.h"
#include "editor/panels/viewport/view_tools.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::panels {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Picking = LightView::Picking;

constexpr double kBallRadius = 0.12;  // metres
constexpr double kBallGap = 0.34;     // Between the centres of the two balls.
constexpr int kMirrorPixels = 128;
constexpr int kGreyPixels = 48;  // A grey ball has no fine detail.
constexpr float kGreyBallAlbedo = 0.5f;
constexpr int kPatchHalf = 4;  // Pixels around a grey pick.

// The picture's camera in stage axes.
ViewCamera StageView(const editor::PreviewPicture& picture,
                     const ImVec2& origin,
                     const ImVec2& size) {
  const double scale = size.x / static_cast<double>(picture.display.width);
  ViewCamera view;
  view.camera_from_world = *picture.camera_from_stage;
  view.focal_x = picture.display.fx * scale;
  view.focal_y = picture.display.fy * scale;
  view.center = {origin.x + scale * (picture.display.cx + 0.5),
                 origin.y + scale * (picture.display.cy + 0.5)};
  return view;
}

struct ProbeBall {
  Vector2d centre;              // Screen position.
  float radius = 0.0f;          // Screen pixels.
  glm::quat camera_from_stage;  // Camera axes with z towards the ball.
};

std::optional<ProbeBall> PlaceBall(const ViewCamera& view, const Vector3d& in_stage) {
  const std::optional<Vector2d> centre = view.Project(in_stage);
  if (!centre) {
    return std::nullopt;
  }
  const Vector3d towards = (view.camera_from_world * in_stage).normalized();
  const double radius = kBallRadius / view.UnitsPerPixel(in_stage);
  return ProbeBall{*centre, std::clamp(static_cast<float>(radius), Px(22), Px(96)),
                   bake::LeastRotation(geometry::ToGlm(towards), glm::vec3(0.0f, 0.0f, 1.0f)) *
                       geometry::ToGlm(view.camera_from_world.rotation)};
}

void DrawBallAt(PictureTextures& pictures,
                const char* key,
                const ProbeBall& ball,
                const editor::ProbePicture& picture,
                const editor::ProbeLook& look,
                editor::BallSurface surface,
                ImDrawList& draw) {
  const auto shown = std::make_shared<const cv::Mat>(
      editor::DrawBall(picture, look, ball.camera_from_stage, surface, kGreyBallAlbedo,
                       surface == editor::BallSurface::kMirror ? kMirrorPixels : kGreyPixels));
  const ImVec2 centre = ToImGui(ball.centre);
  draw.AddImageRounded(pictures.Show(key, shown),
                       ImVec2(centre.x - ball.radius, centre.y - ball.radius),
                       ImVec2(centre.x + ball.radius, centre.y + ball.radius), ImVec2(0, 0),
                       ImVec2(1, 1), IM_COL32_WHITE, ball.radius);
}

glm::vec3 MirroredAt(const ProbeBall& ball, const ImVec2& mouse) {
  return editor::MirroredDirection(ball.camera_from_stage,
                                   static_cast<float>(mouse.x - ball.centre.x()) / ball.radius,
                                   static_cast<float>(mouse.y - ball.centre.y()) / ball.radius);
}

bool Over(const ProbeBall& ball, const ImVec2& mouse) {
  return std::hypot(mouse.x - ball.centre.x(), mouse.y - ball.centre.y()) < ball.radius;
}

// Rotates the probe so that the reflection under the pointer follows it.
void TurnByMirror(editor::Workspace& workspace,
                  const LightView& light,
                  const editor::ProbeDocument& probe,
                  const ProbeBall& ball) {
  const ImVec2 delta = ImGui::GetIO().MouseDelta;
  if (!light.dragged_in_probe || (delta.x == 0.0f && delta.y == 0.0f)) {
    return;
  }
  const glm::quat now = geometry::ToGlm(probe.stage_from_probe);
  const glm::vec3 target = MirroredAt(ball, ImGui::GetIO().MousePos);
  TurnProbe(workspace, probe,
            light.level ? bake::TurnedTo(now, *light.dragged_in_probe, target)
                        : bake::DraggedTo(now, *light.dragged_in_probe, target),
            Sentence("turn the light"), "probe ball");
}

float LinearBeforeShoulder(float shown, float knee) {
  const float range = 1.0f - knee;
  if (shown <= knee || range < 1e-4f) {
    return shown;
  }
  return knee - range * std::log1p(-std::min((shown - knee) / range, 0.998f));
}

void PickOnStage(editor::Workspace& workspace,
                 LightView& light,
                 const editor::ProbeDocument& probe,
                 const editor::PreviewPicture& picture,
                 const ViewCamera& view,
                 const Vector2d& screen,
                 const Vector2d& pixel) {
  const Ray ray = view.RayThrough(screen);
  const auto surface = FindSurface(ray, workspace.preview().staged()->occluders);
  if (light.picking == Picking::kOnStage) {
    const glm::vec3 from = geometry::ToGlm(probe.position);
    const glm::vec3 to = surface ? surface->point - from : geometry::ToGlm(ray.direction);
    AddDirection(workspace, light, probe, glm::normalize(to));
    return;
  }
  const auto mean = MeanLinear(picture.plain, pixel, kPatchHalf);
  if (!mean) {
    light.problem = Tr("The picture is still being drawn. Click once more.");
    return;
  }
  const editor::ProbeLook look = LookAtProbe(workspace, probe);
  bake::GreyPatch patch;
  for (int c = 0; c < 3; ++c) {
    patch.linear[c] = LinearBeforeShoulder((*mean)[c], look.knee);
    patch.gain[c] = picture.gain[static_cast<size_t>(c)];
  }
  patch.albedo = glm::vec3(light.albedo);
  patch.normal = surface ? surface->normal : glm::vec3(0.0f, 1.0f, 0.0f);
  AddGreyPatch(workspace, light, probe, patch);
}

void DrawCurve(const BrightnessHistogram& histogram,
               const ImVec2& low,
               const ImVec2& size,
               const ImVec4& shade,
               ImDrawList& draw) {
  const int most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
  if (most == 0) {
    return;
  }
  const float bar = size.x / BrightnessHistogram::kBins;
  for (int i = 0; i < BrightnessHistogram::kBins; ++i) {
    // Square roots make small counts visible beside large ones.
    const float height =
        size.y * std::sqrt(static_cast<float>(histogram.counts[i]) / static_cast<float>(most));
    draw.AddRectFilled(ImVec2(low.x + static_cast<float>(i) * bar, low.y - height),
                       ImVec2(low.x + static_cast<float>(i + 1) * bar, low.y), Packed(shade, 0.6f));
  }
}

void DrawHistogram(const editor::PreviewPicture& picture,
                   const ImVec2& origin,
                   const ImVec2& size,
                   ImDrawList& draw) {
  const BrightnessComparison comparison =
      CompareBrightness(picture.plain, picture.bgr, picture.coverage);
  const ImVec2 box(Px(280), Px(120));
  const ImVec2 corner(origin.x + size.x - box.x - Px(12), origin.y + size.y - box.y - Px(12));
  const float text = ImGui::GetTextLineHeight();
  draw.AddRectFilled(corner, ImVec2(corner.x + box.x, corner.y + box.y),
                     Packed(OverPicture().window, 0.85f), Px(4));
  const ImVec2 low(corner.x + Px(10), corner.y + box.y - Px(10));
  const ImVec2 plot(box.x - Px(20), box.y - text - Px(28));
  DrawCurve(comparison.real, low, plot, OverPicture().dim, draw);
  DrawCurve(comparison.people, low, plot, OverPicture().accent, draw);
  std::string legend = Text(Tr("Camera %.0f %%"), 100.0 * comparison.real.Median());
  draw.AddText(ImVec2(corner.x + Px(10), corner.y + Px(7)), Packed(OverPicture().text),
               legend.c_str());
  const float half = 0.5f * box.x;
  legend = comparison.people.total > 0
               ? Text(Tr("People %.0f %%"), 100.0 * comparison.people.Median())
               : Tr("Nobody in view");
  draw.AddText(ImVec2(corner.x + half, corner.y + Px(7)), Packed(OverPicture().accent),
               legend.c_str());
}

}  // namespace

bool LightOverlay::ComparesPictures(const editor::Workspace& workspace,
                                    const Selection& selection,
                                    const LightView& light) {
  return SelectedProbe(workspace, selection) != nullptr &&
         (light.histogram || light.picking == Picking::kGrey);
}

void LightOverlay::Show(const PanelContext& context,
                        const editor::PreviewPicture& picture,
                        const ImVec2& origin,
                        const ImVec2& size,
                        bool hovered,
                        ImDrawList& draw) {
  auto [workspace, selection, options, tools, cast, pictures, input, dialogs, actions] = context;
  LightView& light = tools.light;
  const editor::ProbeDocument* probe = SelectedProbe(workspace, selection);
  if (drags_ball_ && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    drags_ball_ = false;
    light.dragged_in_probe.reset();
    workspace.project().EndGesture();
  }
  if (probe == nullptr || workspace.preview().staged() == nullptr) {
    return;
  }
  if (light.histogram && !picture.plain.empty()) {
    DrawHistogram(picture, origin, size, draw);
  }
  if (!picture.camera_from_stage) {
    return;
  }
  const ViewCamera view = StageView(picture, origin, size);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool clicked = hovered && !drags_ball_ && ImGui::IsMouseClicked(ImGuiMouseButton_Left);
  if (light.picking == Picking::kGrey || light.picking == Picking::kOnStage) {
    draw.AddCircle(mouse, Px(9), Packed(OverPicture().accent), 0, Px(2));
    if (clicked) {
      const double scale = picture.bgr.cols / static_cast<double>(size.x);
      const Vector2d pixel =
          scale * Vector2d(mouse.x - origin.x, mouse.y - origin.y) - Vector2d(0.5, 0.5);
      PickOnStage(workspace, light, *probe, picture, view, ToEigen(mouse), pixel);
    }
    return;
  }
  const editor::ProbePicture* image = workspace.probe_pictures().Find(*probe);
  if (!light.balls || image == nullptr) {
    return;
  }
  const editor::ProbeLook look = LookAtProbe(workspace, *probe);
  const Vector3d right = view.camera_from_world.rotation.conjugate() * Vector3d(kBallGap, 0.0, 0.0);
  if (const auto grey = PlaceBall(view, probe->position + right)) {
    DrawBallAt(pictures, "grey ball", *grey, *image, look, editor::BallSurface::kGrey, draw);
  }
  if (const auto mirror = PlaceBall(view, probe->position)) {
    DrawBallAt(pictures, "mirror ball", *mirror, *image, look, editor::BallSurface::kMirror, draw);
    const bool over = hovered && Over(*mirror, mouse);
    if (clicked && over) {
      drags_ball_ = true;
      light.dragged_in_probe = glm::conjugate(look.stage_from_probe) * MirroredAt(*mirror, mouse);
    }
    if (over || drags_ball_) {
      draw.AddCircle(ToImGui(mirror->centre), mirror->radius, Packed(OverPicture().accent), 48,
                     Px(2));
    }
    if (drags_ball_) {
      TurnByMirror(workspace, light, *probe, *mirror);
    } else if (over) {
      ImGui::SetTooltip("%s", Tr("Drag to turn the light"));
    }
  }
}

}  // namespace lararium::panels
