#include "editor/panels/widgets/widgets.h"

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <vector>

#include "editor/document/angles.h"
#include "editor/panels/widgets/file_chooser.h"
#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/key_state.h"
#include "editor/panels/widgets/keys.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "shared/core/srgb.h"
#include "shared/core/units.h"

namespace lararium::panels {

void Heading(const char* text) {
  ImGui::PushFont(ThemeFonts().strong);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

void DimText(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, Colours().dim);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void Tooltip(const std::string& text) {
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(Px(340));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
}

void Hint(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, Colours().dim);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

void DrawWarnings(std::span<const std::string> warnings) {
  ImGui::PushStyleColor(ImGuiCol_Text, Colours().warning);
  for (const std::string& warning : warnings) {
    ImGui::TextWrapped("%s", warning.c_str());
  }
  ImGui::PopStyleColor();
}

void DrawWarnings(editor::Workspace& workspace, const std::filesystem::path& product) {
  DrawWarnings(workspace.product_notes().Of(product));
}

void DrawModal(const char* title,
               float width,
               bool& open,
               const std::function<void()>& content,
               ImGuiWindowFlags flags) {
  const ImVec2 center = ImGui::GetMainViewport()->GetCenter();
  ImGui::OpenPopup(title);
  ImGui::SetNextWindowPos(center, ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
  const float widest = ImGui::GetMainViewport()->WorkSize.x - Px(16);
  ImGui::SetNextWindowSize(ImVec2(std::min(Px(width), widest), 0));
  bool kept = true;
  if (!ImGui::BeginPopupModal(
          title, &kept, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings | flags)) {
    open &= kept;  // The close button was pressed.
    return;
  }
  const bool walks = (flags & ImGuiWindowFlags_NoNavInputs) == 0;
  if (ImGui::IsWindowAppearing() && ImGui::GetIO().NavVisible && walks) {
    ImGui::SetKeyboardFocusHere();  // The dialog was opened by keys, so the user types next.
  }
  content();
  // Whether lists were open above the dialog in the last frame; Escape has already closed them in
  // this one.
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  bool& covered = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("covered"));
  const bool escape = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
  open &= kept && !(escape && !covered);
  covered = g.OpenPopupStack.Size > g.BeginPopupStack.Size;
  if (!open) {
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

namespace {

// Whether Enter confirms the dialog: it ends the input of a field, or no button has the keyboard
// focus, and no list is open above.
bool EnterConfirms() {
  constexpr ImGuiFocusedFlags kHere =
      ImGuiFocusedFlags_RootAndChildWindows | ImGuiFocusedFlags_NoPopupHierarchy;
  const ImGuiIO& io = ImGui::GetIO();
  return EnterIsPressed() && !ImGui::IsWindowAppearing() && ImGui::IsWindowFocused(kHere) &&
         (io.WantTextInput || !io.NavVisible);
}

// In a dialog without a field no button gets the keyboard focus, so that Enter confirms the dialog
// instead of pressing the first button. A dialog may request the focus for its first field;
// otherwise, after keyboard input, the first button would have it in the next frame.
void KeepRingOffButtons(const char* first, const char* second) {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  int& frames = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("frames"));
  frames = ImGui::IsWindowAppearing() ? 0 : frames + 1;
  if (frames == 0 && g.NavTabbingCounter > 0) {
    ImGui::NavMoveRequestCancel();
    g.NavDisableHighlight = true;
  } else if (frames == 1 && (g.NavId == ImGui::GetID(first) || g.NavId == ImGui::GetID(second))) {
    g.NavDisableHighlight = true;
  }
}

}  // namespace

DialogAnswer DialogButtons(const char* action, const DialogProblem& problem, const char* cancel) {
  ImGui::Dummy(ImVec2(0, Px(2)));
  ImGui::PushStyleColor(ImGuiCol_Text, problem.missing ? Colours().dim : Colours().warning);
  ImGui::TextUnformatted(problem.text.empty() ? " " : problem.text.c_str());
  ImGui::PopStyleColor();
  const char* const other = cancel != nullptr ? cancel : Tr("Cancel");
  const float width = WidestButton(std::array{other, action}, 110.0f);
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetCursorPosX(ImGui::GetContentRegionMax().x - 2 * width - spacing);
  KeepRingOffButtons(other, action);
  DialogAnswer answer = DialogAnswer::kNone;
  if (ImGui::Button(other, ImVec2(width, 0))) {
    answer = DialogAnswer::kCancel;
  }
  ImGui::SameLine();
  ImGui::BeginDisabled(problem.any());
  ImGui::PushStyleColor(ImGuiCol_Button, Colours().chosen);
  if (ImGui::Button(action, ImVec2(width, 0)) || (!problem.any() && EnterConfirms())) {
    answer = DialogAnswer::kAct;
  }
  ImGui::PopStyleColor();
  ImGui::EndDisabled();
  return answer;
}

std::string DateText(int64_t seconds) {
  const std::time_t time = static_cast<std::time_t>(seconds);
  std::tm parts = {};
  if (localtime_r(&time, &parts) == nullptr) {
    return "";
  }
  static constexpr const char* kMonths[] = {TrLater("Jan"), TrLater("Feb"), TrLater("Mar"),
                                            TrLater("Apr"), TrLater("May"), TrLater("Jun"),
                                            TrLater("Jul"), TrLater("Aug"), TrLater("Sep"),
                                            TrLater("Oct"), TrLater("Nov"), TrLater("Dec")};
  return Text("%d %s %d, %02d:%02d", parts.tm_mday, Tr(kMonths[parts.tm_mon]), parts.tm_year + 1900,
              parts.tm_hour, parts.tm_min);
}

std::string Elided(const std::string& text, float width) {
  std::string line = text.substr(0, text.find('\n'));
  if (line.size() == text.size() && ImGui::CalcTextSize(line.c_str()).x <= width) {
    return line;
  }
  const char* fits = nullptr;
  ImGui::GetFont()->CalcTextSizeA(ImGui::GetFontSize(), width - Px(16), 0.0f, line.c_str(), nullptr,
                                  &fits);
  return line.substr(0, static_cast<size_t>(fits - line.c_str())) + "\xe2\x80\xa6";
}

std::string ElidedFront(const std::string& text, float width) {
  const auto is_continuation = [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
  };
  std::string shown = text;
  for (size_t from = 1; ImGui::CalcTextSize(shown.c_str()).x > width && from < text.size();
       ++from) {
    if (!is_continuation(text[from])) {
      shown = "\xe2\x80\xa6" + text.substr(from);
    }
  }
  return shown;
}

bool FitsBeside(std::span<const char* const> labels, float gap) {
  const ImGuiStyle& style = ImGui::GetStyle();
  float width = gap < 0.0f ? style.ItemSpacing.x : gap;
  for (const char* label : labels) {
    width += ImGui::CalcTextSize(label).x + 2.0f * style.FramePadding.x;
  }
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  return ImGui::GetItemRectMax().x + width <= right;
}

void Tip(const std::string& text) {
  constexpr float kWidest = 440.0f;  // logical pixels
  if (!text.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(Px(kWidest));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
}

bool Segmented(const char* id,
               std::span<const char* const> labels,
               int& chosen,
               std::span<const std::string> tips) {
  ImGui::PushID(id);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(Px(1), 0));
  bool changed = false;
  for (int i = 0; i < static_cast<int>(labels.size()); ++i) {
    if (i > 0 && FitsBeside(labels.subspan(static_cast<size_t>(i), 1))) {
      ImGui::SameLine();
    } else if (i > 0) {
      ImGui::SetCursorPosY(ImGui::GetCursorPosY() + Px(2));
    }
    const bool active = i == chosen;
    ImGui::PushStyleColor(ImGuiCol_Button, active ? Colours().chosen : Colours().frame);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, active ? Colours().chosen : Colours().hover);
    ImGui::PushID(i);
    if (ImGui::Button(labels[static_cast<size_t>(i)]) && !active) {
      chosen = i;
      changed = true;
    }
    ImGui::PopID();
    ImGui::PopStyleColor(2);
    if (!tips.empty()) {
      Tip(tips[static_cast<size_t>(i)]);
    }
  }
  ImGui::PopStyleVar();
  ImGui::PopID();
  return changed;
}

void PlayButton(editor::Workspace& workspace) {
  const std::string play = WithIcon(Icon::kPlay, Tr("Play"));
  const std::string pause = WithIcon(Icon::kPause, Tr("Pause"));
  const float width = WidestButton(std::array{play.c_str(), pause.c_str()}, 0.0f);
  const std::string& shown = workspace.playback().playing() ? pause : play;
  if (ImGui::Button(Label(shown.c_str(), "play").c_str(), ImVec2(width, 0))) {
    workspace.playback().SetPlaying(!workspace.playback().playing());
  }
  Tip(WithKey(Tr("Plays the drama"), KeyAction::kPlay));
}

float WidestButton(std::span<const char* const> labels, float least) {
  float widest = 0.0f;
  for (const char* label : labels) {
    widest = std::max(widest, ImGui::CalcTextSize(label).x);
  }
  return std::max(Px(least), widest + 2.0f * ImGui::GetStyle().FramePadding.x);
}

void SameLineIfFits(std::span<const char* const> labels, float gap) {
  if (FitsBeside(labels, gap)) {
    ImGui::SameLine(0.0f, gap);
    return;
  }
  // A row of Segmented() leaves no space below it.
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float below = ImGui::GetItemRectMax().y + ImGui::GetStyle().ItemSpacing.y;
  ImGui::SetCursorScreenPos(ImVec2(at.x, std::max(at.y, below)));
}

bool CheckRow(const char* label, bool& on) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float taken = ImGui::GetFrameHeight() + style.ItemInnerSpacing.x;
  if (ImGui::CalcTextSize(label).x + taken <= ImGui::GetContentRegionAvail().x) {
    return ImGui::Checkbox(label, &on);
  }
  ImGui::PushID(label);
  ImGui::BeginGroup();
  bool changed = ImGui::Checkbox("##on", &on);
  ImGui::SameLine(0.0f, style.ItemInnerSpacing.x);
  ImGui::AlignTextToFramePadding();
  ImGui::TextWrapped("%s", label);
  if (ImGui::IsItemClicked()) {
    on = !on;
    changed = true;
  }
  ImGui::EndGroup();
  ImGui::PopID();
  return changed;
}

bool Fold(const std::string& title, bool open_at_first) {
  ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(0, 0, 0, 0));
  ImGui::PushStyleColor(ImGuiCol_HeaderActive, Colours().hover);
  const ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_SpanAvailWidth |
                                   ImGuiTreeNodeFlags_NoTreePushOnOpen |
                                   (open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  const bool open = ImGui::TreeNodeEx(title.c_str(), flags);
  ImGui::PopStyleColor(2);
  return open;
}

bool BeginProperties(const char* id, float label_width) {
  constexpr float kLeastValue = 130.0f;  // logical pixels
  if (ImGui::GetContentRegionAvail().x < Px(label_width + kLeastValue)) {
    return ImGui::BeginTable(id, 1, ImGuiTableFlags_SizingStretchProp);
  }
  if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingStretchProp)) {
    return false;
  }
  ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthFixed, Px(label_width));
  // The weight is needed: without it, the column is as narrow as an empty one in the first frame.
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 1.0f);
  return true;
}

void EndProperties() { ImGui::EndTable(); }

void PropertyLabel(const char* label) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  DimText(label);
  if (ImGui::TableGetColumnCount() == 1) {
    ImGui::TableNextRow();
  }
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-FLT_MIN);
}

void PropertyText(const char* label, const std::string& value) {
  PropertyLabel(label);
  ImGui::AlignTextToFramePadding();
  ImGui::TextWrapped("%s", value.c_str());
}

bool DragNumber(
    double& value, double speed, const double* min, const double* max, const char* format) {
  const bool nothing = Text(format, value).find_first_of("123456789") == std::string::npos;
  double shown = nothing ? 0.0 : value;
  if (!ImGui::DragScalar("##value", ImGuiDataType_Double, &shown, static_cast<float>(speed), min,
                         max, format, min != nullptr ? ImGuiSliderFlags_AlwaysClamp : 0)) {
    return false;
  }
  value = shown;
  return true;
}

bool NumberProperty(editor::Workspace& workspace,
                    const char* label,
                    double& value,
                    double speed,
                    double min,
                    double max,
                    const char* format) {
  PropertyLabel(label);
  ImGui::PushID(label);
  const bool changed = DragNumber(value, speed, &min, &max, format);
  EndGestureWithItem(workspace);
  ImGui::PopID();
  return changed;
}

bool SliderProperty(editor::Workspace& workspace,
                    const char* label,
                    double& value,
                    double min,
                    double max,
                    const char* format) {
  PropertyLabel(label);
  ImGui::PushID(label);
  const bool changed = ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &min, &max,
                                           format, ImGuiSliderFlags_AlwaysClamp);
  EndGestureWithItem(workspace);
  ImGui::PopID();
  return changed;
}

// Whether three numbers are readable in fields on one line.
bool FitInRow(const Eigen::Vector3d& value, const char* format) {
  // A typical width, so that fields keep their size during a drag.
  constexpr double kUsual = -8.88;
  const ImGuiStyle& style = ImGui::GetStyle();
  float widest = 0.0f;
  for (const double number : {value.x(), value.y(), value.z(), kUsual}) {
    widest = std::max(widest, ImGui::CalcTextSize(Text(format, number).c_str()).x);
  }
  return 3.0f * (widest + Px(8)) + 2.0f * style.ItemInnerSpacing.x <=
         ImGui::GetContentRegionAvail().x;
}

bool VectorProperty(editor::Workspace& workspace,
                    const char* label,
                    Eigen::Vector3d& value,
                    double speed,
                    const char* format) {
  PropertyLabel(label);
  ImGui::PushID(label);
  const bool row = FitInRow(value, format);
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float width = std::floor((ImGui::GetContentRegionAvail().x - 2.0f * gap) / 3.0f);
  bool changed = false;
  ImGui::BeginGroup();
  for (int i = 0; i < 3; ++i) {
    if (row && i > 0) {
      ImGui::SameLine(0.0f, gap);
    }
    ImGui::PushID(i);
    ImGui::SetNextItemWidth(row && i < 2 ? width : -FLT_MIN);
    changed |= DragNumber(value[i], speed, nullptr, nullptr, format);
    ImGui::PopID();
  }
  ImGui::EndGroup();
  EndGestureWithItem(workspace);
  ImGui::PopID();
  return changed;
}

bool RotationProperty(editor::Workspace& workspace,
                      const char* label,
                      Eigen::Quaterniond& rotation) {
  Eigen::Vector3d degrees = editor::HeadingTiltRoll(rotation) * kDegreesPerRadian;
  if (!VectorProperty(workspace, label, degrees, 0.5, "%.2f\xc2\xb0")) {
    return false;
  }
  rotation = editor::FromHeadingTiltRoll(degrees / kDegreesPerRadian);
  return true;
}

bool TransformProperties(editor::Workspace& workspace, geometry::Similarity3& transform) {
  bool changed = VectorProperty(workspace, Tr("Position"), transform.translation, 0.005, "%.3f");
  changed |= RotationProperty(workspace, Tr("Rotation"), transform.rotation);
  changed |= NumberProperty(workspace, Tr("Scale"), transform.scale, 0.005, editor::kMinStageScale,
                            editor::kMaxStageScale, "%.4f");
  return changed;
}

bool ColourProperty(editor::Workspace& workspace, const char* label, Eigen::Vector3d& albedo) {
  PropertyLabel(label);
  Eigen::Vector3f colour = albedo.unaryExpr(&SrgbFromLinear<double>).cast<float>();
  const bool changed = ImGui::ColorEdit3(label, colour.data(), ImGuiColorEditFlags_NoLabel);
  EndGestureWithItem(workspace);
  if (changed) {
    albedo = colour.cast<double>().unaryExpr(&LinearFromSrgb<double>).cwiseMax(0.0).cwiseMin(1.0);
  }
  return changed;
}

void EndGestureWithItem(editor::Workspace& workspace) {
  if (ImGui::IsItemDeactivated()) {
    workspace.project().EndGesture();
  }
}

bool NameCombo(const char* id,
               std::string& chosen,
               std::span<const std::string> names,
               const char* none) {
  const char* shown = chosen.empty() && none != nullptr ? none : chosen.c_str();
  if (!ImGui::BeginCombo(id, shown, ImGuiComboFlags_HeightLarge)) {
    return false;
  }
  const std::string before = chosen;
  if (none != nullptr && ImGui::Selectable(none, chosen.empty())) {
    chosen.clear();
  }
  for (size_t i = 0; i < names.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const bool selected = names[i] == before;
    if (ImGui::Selectable(names[i].empty() ? Tr("(no name)") : names[i].c_str(), selected)) {
      chosen = names[i];
    }
    if (selected && ImGui::IsWindowAppearing()) {
      ImGui::SetItemDefaultFocus();
      ImGui::SetScrollHereY();
    }
    ImGui::PopID();
  }
  ImGui::EndCombo();
  return chosen != before;
}

bool Swatch(editor::Workspace& workspace, const char* id, glm::vec3& srgb) {
  const bool changed =
      ImGui::ColorEdit3(id, &srgb.x,
                        ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel |
                            ImGuiColorEditFlags_DisplayHex | ImGuiColorEditFlags_PickerHueWheel);
  EndGestureWithItem(workspace);
  return changed;
}

bool PathField(const char* id,
               std::string& path,
               const std::filesystem::path& folder,
               FileType type,
               float right) {
  FileChooser& chooser = FileChooser::Current();
  ImGui::PushID(id);
  const ImGuiID field = ImGui::GetID("files");
  const char* const browse = Tr("Browse\xe2\x80\xa6");
  const float button = WidestButton(std::array{browse}, 0.0f);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - right - button -
                          ImGui::GetStyle().ItemSpacing.x);
  bool changed = ImGui::InputText("##path", &path);
  ImGui::SameLine();
  if (ImGui::Button(browse, ImVec2(button, 0))) {
    chooser.Ask(field, type, folder / path);
  }
  Tooltip(chooser.IsWaiting(field)
              ? Tr("The desktop's dialog is open. Once more opens a list in this window instead.")
              : Tr(SpecOf(type).title));
  std::optional<std::filesystem::path> chosen = chooser.Show(field);
  if (!chosen) {
    chosen = chooser.TakeDrop(type);
  }
  if (chosen) {
    path = chosen->string();
    changed = true;
  }
  if (changed) {
    chooser.ForgetProblem();
  }
  const std::string problem = chooser.Problem(field);
  ImGui::PopID();
  if (!problem.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, Colours().warning);
    ImGui::TextWrapped("%s", problem.c_str());
    ImGui::PopStyleColor();
  }
  return changed;
}

}  // namespace lararium::panels
