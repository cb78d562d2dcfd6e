#include "editor/panels/inspector/light_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "editor/document/white_balance.h"
#include "editor/panels/inspector/light_maths.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/units.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::panels {

namespace {

using editor::ProbeDocument;
using ProbePicking = LightView::Picking;
constexpr int kPanoramaWidth = 256;
constexpr double kMinStops = -16.0;
constexpr double kMaxStops = 16.0;

glm::quat Rotation(const ProbeDocument& probe) { return geometry::ToGlm(probe.stage_from_probe); }

void EditProbe(editor::Workspace& workspace,
               const ProbeDocument& changed,
               const Sentence& name,
               std::string_view gesture = {}) {
  workspace.project().EditPlace(
      name,
      [&](editor::PlaceDocument& place) {
        for (ProbeDocument& probe : place.probes) {
          if (probe.name == changed.name) {
            probe = changed;
          }
        }
      },
      gesture);
}

// Handles a drag over the panorama: the point under the pointer follows it.
void DragPanorama(editor::Workspace& workspace,
                  LightView& light,
                  const ProbeDocument& probe,
                  const glm::vec3& under_pointer,
                  const glm::vec3& sun_in_probe,
                  bool at_sun) {
  const glm::quat now = Rotation(probe);
  if (ImGui::IsItemActivated()) {
    light.dragged_in_probe = at_sun ? sun_in_probe : glm::conjugate(now) * under_pointer;
  }
  const ImVec2 delta = ImGui::GetIO().MouseDelta;
  if (ImGui::IsItemActive() && light.dragged_in_probe && (delta.x != 0.0f || delta.y != 0.0f)) {
    const glm::quat turned = light.level
                                 ? bake::TurnedTo(now, *light.dragged_in_probe, under_pointer)
                                 : bake::DraggedTo(now, *light.dragged_in_probe, under_pointer);
    TurnProbe(workspace, probe, turned, Sentence("turn the light"), "probe panorama");
  }
  if (ImGui::IsItemDeactivated()) {
    light.dragged_in_probe.reset();
    workspace.project().EndGesture();
  }
}

void DrawSun(const ImVec2& at, bool is_sun, ImDrawList& draw) {
  const float radius = Px(is_sun ? 9.0f : 6.0f);
  draw.AddCircle(at, radius + Px(1.5f), Packed(OverPicture().window), 24, Px(2));
  draw.AddCircle(at, radius, Packed(OverPicture().accent), 24, Px(2));
  if (is_sun) {
    for (int i = 0; i < 8; ++i) {
      const float angle = static_cast<float>(i) * std::numbers::pi_v<float> / 4.0f;
      const ImVec2 out(std::cos(angle), std::sin(angle));
      draw.AddLine(ImVec2(at.x + (radius + Px(3)) * out.x, at.y + (radius + Px(3)) * out.y),
                   ImVec2(at.x + (radius + Px(7)) * out.x, at.y + (radius + Px(7)) * out.y),
                   Packed(OverPicture().accent), Px(2));
    }
  }
}

void ClickPanorama(ViewOptions& options,
                   LightView& light,
                   const ProbeDocument& probe,
                   const glm::vec3& in_stage) {
  light.in_probe = glm::conjugate(Rotation(probe)) * in_stage;
  light.picking = ProbePicking::kOnStage;
  options.view = ViewKind::kCamera;
}

// The panorama of the probe in stage directions, with straight ahead in the middle.
void DrawPanorama(editor::Workspace& workspace,
                  ViewOptions& options,
                  LightView& light,
                  PictureTextures& pictures,
                  const ProbeDocument& probe,
                  const editor::ProbePicture& picture) {
  const float width = ImGui::GetContentRegionAvail().x;
  const ImVec2 size(width, 0.5f * width);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("panorama", size);
  editor::ProbeLook look;
  look.stage_from_probe = Rotation(probe);
  look.exposure = glm::vec3(editor::ExposureFor(picture)) * geometry::ToGlm(probe.balance);
  const auto shown =
      std::make_shared<const cv::Mat>(editor::DrawPanorama(picture, look, kPanoramaWidth));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 end(corner.x + size.x, corner.y + size.y);
  draw.AddImageRounded(pictures.Show("panorama", shown), corner, end, ImVec2(0, 0), ImVec2(1, 1),
                       IM_COL32_WHITE, Px(4));
  const auto place = [&](const glm::vec3& in_stage) {
    const Eigen::Vector2d point = PanoramaPoint(in_stage);
    return ImVec2(corner.x + static_cast<float>(point.x()) * size.x,
                  corner.y + static_cast<float>(point.y()) * size.y);
  };
  draw.PushClipRect(corner, end, true);
  const ImVec2 sun = place(look.stage_from_probe * picture.brightest);
  DrawSun(sun, picture.is_sun, draw);
  for (const bake::DirectionPair& pair : light.pairs) {
    draw.AddCircle(place(look.stage_from_probe * pair.in_probe), Px(4),
                   Packed(OverPicture().warning), 0, Px(2));
  }
  if (light.in_probe) {
    draw.AddCircleFilled(place(look.stage_from_probe * *light.in_probe), Px(4),
                         Packed(OverPicture().warning));
  }
  draw.PopClipRect();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const glm::vec3 under = PanoramaDirection(std::clamp((mouse.x - corner.x) / size.x, 0.0f, 1.0f),
                                            std::clamp((mouse.y - corner.y) / size.y, 0.0f, 1.0f));
  if (light.picking == ProbePicking::kOnProbe) {
    if (ImGui::IsItemActivated()) {
      ClickPanorama(options, light, probe, under);
    }
    return;
  }
  if (!ImGui::IsItemActive()) {
    Tip(
        Tr("Drag the sun, or the picture, to where it is on the stage. The middle is straight "
           "ahead, the top the sky."));
  }
  const bool at_sun = std::hypot(mouse.x - sun.x, mouse.y - sun.y) < Px(14);
  DragPanorama(workspace, light, probe, under, picture.brightest, at_sun);
}

std::string SunText(const ProbeDocument& probe, const editor::ProbePicture& picture) {
  const glm::vec3 d = Rotation(probe) * picture.brightest;
  return Text(picture.is_sun ? Tr("Sun at %.0f\xc2\xb0, %.0f\xc2\xb0 high")
                             : Tr("Brightest at %.0f\xc2\xb0, %.0f\xc2\xb0 high"),
              kDegreesPerRadian * std::atan2(d.x, -d.z),
              kDegreesPerRadian * std::asin(std::clamp(d.y, -1.0f, 1.0f)));
}

bool PickButton(const LightView& light, const char* label, ProbePicking mode, const char* tip) {
  const bool on = light.picking == mode;
  if (on) {
    ImGui::PushStyleColor(ImGuiCol_Button, Colours().chosen);
  }
  const bool pressed = ImGui::Button(label, ImVec2(-FLT_MIN, 0));
  if (on) {
    ImGui::PopStyleColor();
  }
  Tip(tip);
  return pressed;
}

void BeginPicking(ViewOptions& options, LightView& light, ProbePicking mode) {
  light.picking = light.picking == mode ? ProbePicking::kNothing : mode;
  light.problem.clear();
  light.in_probe.reset();
  if (light.picking == ProbePicking::kGrey) {
    options.view = ViewKind::kCamera;
  }
}

void DrawDirections(editor::Workspace& workspace,
                    ViewOptions& options,
                    LightView& light,
                    const ProbeDocument& probe) {
  CheckRow(Tr("Keep the probe level"), light.level);
  Tip(Tr("Turn about the vertical only: for probes that were photographed level."));
  if (BeginProperties("turn")) {
    Eigen::Quaterniond rotation = probe.stage_from_probe;
    if (RotationProperty(workspace, Tr("Rotation"), rotation)) {
      TurnProbe(workspace, probe, geometry::ToGlm(rotation), Sentence("turn the light"),
                "probe rotation");
    }
    EndProperties();
  }
  const bool matching =
      light.picking == ProbePicking::kOnProbe || light.picking == ProbePicking::kOnStage;
  if (PickButton(light, Tr("Match a direction  (M)"),
                 matching ? light.picking : ProbePicking::kOnProbe,
                 Tr("Click the same thing on the probe's picture and in the camera view. One pair "
                    "turns the probe; two fix it, and say how far they disagree."))) {
    BeginPicking(options, light, matching ? light.picking : ProbePicking::kOnProbe);
  }
  if (light.picking == ProbePicking::kOnProbe) {
    Hint(Tr("1. Click something on the picture above that the camera sees too."));
  } else if (light.picking == ProbePicking::kOnStage) {
    Hint(Tr("2. Click the same thing in the camera view."));
  }
  if (light.direction_match) {
    Hint(Text(Tr("%zu directions, each %.1f\xc2\xb0 off"), light.pairs.size(),
              kDegreesPerRadian * light.direction_match->residual));
  } else if (light.pairs.size() == 1) {
    Hint(Tr("One direction. A second one fixes the tilt."));
  }
}

void DrawBrightness(editor::Workspace& workspace,
                    ViewOptions& options,
                    LightView& light,
                    const ProbeDocument& probe) {
  if (BeginProperties("brightness")) {
    ProbeDocument changed = probe;
    double stops = std::log2(std::max(probe.scale, 1e-9));
    if (SliderProperty(workspace, Tr("Exposure"), stops, kMinStops / 2, kMaxStops / 2,
                       Tr("%+.2f stops"))) {
      changed.scale = std::exp2(stops);
      EditProbe(workspace, changed, Sentence("the light's exposure"), "probe exposure");
    }
    editor::WhiteBalance white = editor::WhiteBalanceOf(geometry::ToGlm(probe.balance));
    bool balanced =
        SliderProperty(workspace, Tr("Warmth"), white.warmth, -2.0, 2.0, Tr("%+.2f stops"));
    balanced |= SliderProperty(workspace, Tr("Tint"), white.tint, -1.0, 1.0, Tr("%+.2f stops"));
    if (balanced) {
      const glm::vec3 balance = editor::BalanceOf(white);
      changed.balance = {balance.r, balance.g, balance.b};
      EditProbe(workspace, changed, Sentence("the light's white balance"), "probe balance");
    }
    double albedo = light.albedo;
    if (NumberProperty(workspace, Tr("Grey is"), albedo, 0.002, 0.02, 1.0, Tr("%.2f albedo"))) {
      light.albedo = static_cast<float>(albedo);
    }
    EndProperties();
  }
  if (PickButton(light, Tr("Pick a grey surface  (G)"), ProbePicking::kGrey,
                 Tr("Click a matte surface of that albedo in the camera view that nothing shades. "
                    "Several picks are matched together."))) {
    BeginPicking(options, light, ProbePicking::kGrey);
  }
  if (light.picking == ProbePicking::kGrey) {
    Hint(Tr("Click the surface in the camera view. Escape ends."));
  }
  if (light.scale_match) {
    DimText(Text(Tr("%zu picked, %.2f stops off"), light.patches.size(),
                 static_cast<double>(light.scale_match->residual)));
    ImGui::SameLine();
    if (ImGui::SmallButton(Tr("Forget"))) {
      light.patches.clear();
      light.scale_match.reset();
    }
    Tip(Tr("Start again with the next grey surface."));
  }
}

void DrawViews(editor::Workspace& workspace, ViewOptions& options, LightView& light) {
  CheckRow(Tr("Balls at the probe"), light.balls);
  Tip(Tr("A mirror ball and a grey one in the camera view. Drag the mirror to turn the probe."));
  CheckRow(Tr("Before and after  (B)"), options.show_compare);
  Tip(Tr("The camera's image alone to the left of a line that you drag."));
  CheckRow(Tr("Histogram"), light.histogram);
  Tip(Tr("How bright the camera's image is, and how bright people are in it."));
  bool look = workspace.preview().look().camera_traits;
  if (CheckRow(Tr("The camera's noise and blur"), look)) {
    workspace.preview().look().camera_traits = look;
  }
  Tip(Tr("People as the camera would have taken them; off: as they are drawn."));
  const std::optional<light::CameraTraits>& camera = workspace.project().place()->camera;
  Hint(camera ? Text(Tr("Edges %.2f px soft, noise %.2f %%"), camera->blur_px,
                     100.0 * std::sqrt(camera->noise_floor * camera->noise_floor +
                                       0.5f * camera->noise_slope))
              : std::string(Tr("Not measured yet")));
  ImGui::BeginDisabled(workspace.tasks().Running(editor::TaskKind::kCamera) ||
                       workspace.project().place()->training.empty());
  if (ImGui::Button(Tr("Measure the camera"), ImVec2(-FLT_MIN, 0))) {
    workspace.jobs().MeasureCameraTraits();
  }
  ImGui::EndDisabled();
  Tip(Tr("How noisy and how soft the images of the training recording are."));
}

// Discards picks that belong to another probe.
void KeepPicksOf(LightView& light, const ProbeDocument& probe) {
  if (light.probe != probe.name) {
    light.probe = probe.name;
    light.patches.clear();
    light.scale_match.reset();
    light.pairs.clear();
    light.direction_match.reset();
    light.in_probe.reset();
    light.picking = ProbePicking::kNothing;
    light.problem.clear();
  }
}

}  // namespace

const ProbeDocument* SelectedProbe(const editor::Workspace& workspace, const Selection& selection) {
  const editor::PlaceDocument* place = workspace.project().place();
  if (place == nullptr || selection.kind != Selection::Kind::kProbe) {
    return nullptr;
  }
  const auto found = std::find_if(place->probes.begin(), place->probes.end(),
                                  [&](const auto& p) { return p.name == selection.name; });
  return found == place->probes.end() ? nullptr : &*found;
}

void TurnProbe(editor::Workspace& workspace,
               const ProbeDocument& probe,
               const glm::quat& stage_from_probe,
               const Sentence& name,
               const char* gesture) {
  ProbeDocument changed = probe;
  const glm::quat q = glm::normalize(stage_from_probe);
  changed.stage_from_probe = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
  EditProbe(workspace, changed, name, gesture);
}

void AddGreyPatch(editor::Workspace& workspace,
                  LightView& light,
                  const ProbeDocument& probe,
                  const bake::GreyPatch& patch) {
  const editor::ProbePicture* picture = workspace.probe_pictures().Find(probe);
  if (picture == nullptr) {
    light.problem = Tr("The probe is still being read.");
    return;
  }
  std::vector<bake::GreyPatch> patches = light.patches;
  patches.push_back(patch);
  // Relative to the file's own brightness, so that the result is the scale itself.
  const Result<bake::ScaleMatch> match =
      bake::MatchScale(light::Balanced(light::Placed(picture->light, Rotation(probe), 1.0f),
                                       geometry::ToGlm(probe.balance)),
                       patches);
  if (!match.ok()) {
    light.problem = match.message();
    return;
  }
  light.problem.clear();
  light.patches = std::move(patches);
  light.scale_match = *match;
  ProbeDocument changed = probe;
  changed.scale = match->scale;
  EditProbe(workspace, changed, Sentence("brightness from a grey surface"));
}

void AddDirection(editor::Workspace& workspace,
                  LightView& light,
                  const ProbeDocument& probe,
                  const glm::vec3& in_stage) {
  if (!light.in_probe) {
    return;
  }
  if (light.pairs.size() == 2) {
    light.pairs.clear();  // A third pair starts again.
    light.direction_match.reset();
  }
  light.pairs.push_back({*light.in_probe, in_stage});
  light.in_probe.reset();
  light.picking = ProbePicking::kNothing;
  light.problem.clear();
  if (light.pairs.size() == 1) {
    const glm::quat now = Rotation(probe);
    const glm::quat turned = light.level ? bake::TurnedTo(now, light.pairs[0].in_probe, in_stage)
                                         : bake::DraggedTo(now, light.pairs[0].in_probe, in_stage);
    TurnProbe(workspace, probe, turned, Sentence("match the light's direction"), "");
    return;
  }
  const Result<bake::DirectionMatch> match = bake::MatchDirections(light.pairs[0], light.pairs[1]);
  if (!match.ok()) {
    light.pairs.pop_back();
    light.problem = match.message();
    return;
  }
  light.direction_match = *match;
  TurnProbe(workspace, probe, match->stage_from_probe, Sentence("match the light's directions"),
            "");
}

editor::ProbeLook LookAtProbe(const editor::Workspace& workspace, const ProbeDocument& probe) {
  editor::ProbeLook look;
  look.stage_from_probe = Rotation(probe);
  look.exposure = static_cast<float>(probe.scale) * geometry::ToGlm(probe.balance);
  if (workspace.preview().picture() != nullptr) {
    const std::array<float, 3>& gain = workspace.preview().picture()->gain;
    look.exposure *= glm::vec3(gain[0], gain[1], gain[2]);
  }
  if (workspace.project().place() != nullptr && workspace.project().place()->camera) {
    look.knee = workspace.project().place()->camera->knee;
    look.response = workspace.project().place()->camera->response;
  }
  return look;
}

void DrawLightPanel(editor::Workspace& workspace,
                    ViewOptions& options,
                    LightView& light,
                    PictureTextures& pictures,
                    const ProbeDocument& probe) {
  KeepPicksOf(light, probe);
  if (const editor::ProbePicture* picture = workspace.probe_pictures().Find(probe)) {
    DrawPanorama(workspace, options, light, pictures, probe, *picture);
    DimText(SunText(probe, *picture));
    for (const std::string& warning : picture->warnings) {
      Hint(warning);
    }
  } else if (!workspace.probe_pictures().problem().empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, Colours().error);
    ImGui::TextWrapped("%s", workspace.probe_pictures().problem().c_str());
    ImGui::PopStyleColor();
    Hint(Tr("People are lit evenly until then."));
  } else {
    Hint(Tr("Reading the probe\xe2\x80\xa6"));
  }
  DrawDirections(workspace, options, light, probe);
  DrawBrightness(workspace, options, light, probe);
  if (!light.problem.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, Colours().warning);
    ImGui::TextWrapped("%s", light.problem.c_str());
    ImGui::PopStyleColor();
  }
  DrawViews(workspace, options, light);
}

bool HandleLightKey(editor::Workspace& workspace,
                    const Selection& selection,
                    ViewOptions& options,
                    LightView& light,
                    const KeyPress& press) {
  const ProbeDocument* probe = SelectedProbe(workspace, selection);
  if (probe == nullptr) {
    return false;
  }
  const KeyAction action = ActionOf(KeyScope::kLight, press);
  const auto turn = [&](double degrees) {
    const glm::quat by = glm::angleAxis(static_cast<float>(degrees / kDegreesPerRadian),
                                        glm::vec3(0.0f, 1.0f, 0.0f));
    TurnProbe(workspace, *probe, by * Rotation(*probe), Sentence("turn the light"), "probe keys");
  };
  const auto brighten = [&](double stops) {
    ProbeDocument changed = *probe;
    changed.scale = std::max(probe->scale, 1e-9) * std::exp2(stops / 6.0);
    EditProbe(workspace, changed, Sentence("the light's exposure"), "probe exposure keys");
  };
  if (!press.repeats) {
    workspace.project().EndGesture();  // Each press is a separate command.
  }
  switch (action) {
    case KeyAction::kLightLeft:
      turn(1.0);
      return true;
    case KeyAction::kLightRight:
      turn(-1.0);
      return true;
    case KeyAction::kLightFarLeft:
      turn(10.0);
      return true;
    case KeyAction::kLightFarRight:
      turn(-10.0);
      return true;
    case KeyAction::kDarker:
      brighten(-1.0);
      return true;
    case KeyAction::kBrighter:
      brighten(1.0);
      return true;
    case KeyAction::kPickGrey:
      BeginPicking(options, light, ProbePicking::kGrey);
      return true;
    case KeyAction::kPickDirection:
      BeginPicking(options, light, ProbePicking::kOnProbe);
      return true;
    case KeyAction::kStopPicking:
      light.picking = ProbePicking::kNothing;
      light.in_probe.reset();
      return true;
    default:
      return false;
  }
}

}  // namespace lararium::panels
