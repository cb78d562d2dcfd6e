// The garments of a person, in the order in which they are put on.

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "editor/import/wardrobe/dye.h"
#include "editor/import/wardrobe/garment_pattern.h"
#include "editor/panels/inspector/recipe_panel.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/check.h"
#include "shared/core/lower_case.h"
#include "shared/core/srgb.h"

namespace lararium::panels {
namespace {

constexpr size_t kMostGarments = 16;  // Limit of a recipe.

using import::GarmentParameter;
using import::GarmentPattern;
using Garments = decltype(editor::CastCatalogue::garments);

// The labels that the files of the library give to parameters, for translation.
[[maybe_unused]] constexpr const char* kParameterLabels[] = {
    TrLater("Length"), TrLater("Sleeves"), TrLater("Belt"),  TrLater("Stripes"),
    TrLater("Wear"),   TrLater("Border"),  TrLater("Colour")};

std::string GarmentText(const Json& garment, const char* field) {
  const auto found = garment.find(field);
  return found == garment.end() ? ""
         : found->is_string()   ? found->get<std::string>()
         : found->is_number()   ? Tr("by number")
                                : "";
}

std::string NameOf(const Json& garment) { return GarmentText(garment, "name"); }

// The present values of a garment; the usual ones where the recipe has an error.
GarmentPattern PatternOf(const Json& garment,
                         const std::shared_ptr<const import::GarmentDesign>& design) {
  GarmentPattern pattern;
  const auto read = [&](const Json& json) {
    return ReadFields(JsonView(json, "garment"),
                      [&](Fields& fields) { DescribeFields(fields, design, pattern); });
  };
  if (!read(garment).ok()) {
    pattern = {};
    const Status plain = read(Json::object());
    DCHECK(plain.ok());
  }
  return pattern;
}

std::string HexOf(const glm::vec3& srgb) {
  char text[8];
  const auto byte = [](float v) {
    return static_cast<int>(std::lround(255.0f * std::clamp(v, 0.0f, 1.0f)));
  };
  std::snprintf(text, sizeof(text), "#%02x%02x%02x", byte(srgb.x), byte(srgb.y), byte(srgb.z));
  return text;
}

void Set(Json& garment, const char* field, const std::string& value) {
  if (value.empty()) {
    garment.erase(field);
  } else {
    garment[field] = value;
  }
}

// A row of the window for one parameter of a garment.
class ParameterRow {
 public:
  ParameterRow(editor::Workspace& workspace,
               const GarmentParameter& parameter,
               const GarmentPattern& pattern,
               Json& garment,
               RecipeChange& change)
      : workspace_(workspace),
        parameter_(parameter),
        pattern_(pattern),
        garment_(garment),
        change_(change) {}

  void Draw() {
    ImGui::PushID(parameter_.name.c_str());
    if (parameter_.type == GarmentParameter::Type::kColour) {
      DrawColour();
    } else if (parameter_.type == GarmentParameter::Type::kFlag) {
      DrawFlag();
    } else if (!parameter_.words.empty()) {
      DrawWords();
    } else {
      DrawNumber();
    }
    ImGui::PopID();
  }

 private:
  const char* Label() const { return Tr(parameter_.label.c_str()); }
  Sentence What() const { return Sentence("%s of the %s", {LowerCase(Label()), NameOf(garment_)}); }

  void DrawColour() {
    PropertyLabel(Label());
    std::string dye = GarmentText(garment_, parameter_.name.c_str());
    const std::vector<std::string> dyes = import::DyeNames();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() -
                            ImGui::GetStyle().ItemInnerSpacing.x);
    if (NameCombo("##dye", dye, dyes, Tr("as usual"))) {
      Set(garment_, parameter_.name.c_str(), dye);
      change_.Choose(What());
    }
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    const glm::vec3& linear = pattern_.Colour(parameter_.name);
    glm::vec3 colour(SrgbFromLinear(linear.x), SrgbFromLinear(linear.y), SrgbFromLinear(linear.z));
    if (Swatch(workspace_, "##colour", colour)) {
      garment_[parameter_.name] = HexOf(colour);
      change_.Drag(What());
    }
  }

  void DrawFlag() {
    bool flag = pattern_.numbers.find(parameter_.name)->second != 0.0f;
    PropertyLabel(Label());
    if (ImGui::Checkbox("##flag", &flag)) {
      garment_[parameter_.name] = flag;
      change_.Choose(What());
    }
  }

  void DrawWords() {
    PropertyLabel(Label());
    std::string word = GarmentText(garment_, parameter_.name.c_str());
    std::vector<std::string> words;
    for (const GarmentParameter::Word& known : parameter_.words) {
      words.push_back(known.word);
    }
    if (NameCombo("##word", word, words, Tr("as usual"))) {
      Set(garment_, parameter_.name.c_str(), word);
      change_.Choose(What());
    }
  }

  void DrawNumber() {
    double value = pattern_.numbers.find(parameter_.name)->second;
    if (SliderProperty(workspace_, Label(), value, parameter_.from, parameter_.to, "%.2f")) {
      garment_[parameter_.name] = std::round(value * 100.0) / 100.0;
      change_.Drag(What());
    }
  }

  editor::Workspace& workspace_;
  const GarmentParameter& parameter_;
  const GarmentPattern& pattern_;
  Json& garment_;
  RecipeChange& change_;
};

enum class Order { kStay, kUp, kTakeOff };

// Another kind of garment keeps only the colour, because its fields differ.
Order Header(const Garments& garments, Json& garment, bool first, RecipeChange& change) {
  std::vector<std::string> names;
  for (const auto& [known, design] : garments) {
    names.push_back(known);
  }
  std::string name = NameOf(garment);
  const float button = ImGui::GetFrameHeight();
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 2 * (button + gap));
  if (NameCombo("##kind", name, names, nullptr)) {
    Json other = {{"name", name}};
    if (garment.contains("colour")) {
      other["colour"] = garment["colour"];
    }
    change.Choose(Sentence("%s for the %s", {name, NameOf(garment)}));
    garment = std::move(other);
  }
  ImGui::SameLine(0, gap);
  ImGui::BeginDisabled(first);
  const bool up = ImGui::Button("\xe2\x86\x91", ImVec2(button, 0));
  ImGui::EndDisabled();
  Tooltip(Tr("Put on earlier: below what comes before"));
  ImGui::SameLine(0, gap);
  const bool off = ImGui::Button("\xc3\x97", ImVec2(button, 0));
  Tip(Text(Tr("Without the %s"), NameOf(garment).c_str()));
  return up ? Order::kUp : off ? Order::kTakeOff : Order::kStay;
}

Order DrawGarment(editor::Workspace& workspace,
                  const Garments& garments,
                  Json& garment,
                  bool first,
                  RecipeChange& change) {
  const Order order = Header(garments, garment, first, change);
  if (BeginProperties("garment")) {
    if (const auto found = garments.find(NameOf(garment)); found != garments.end()) {
      const GarmentPattern pattern = PatternOf(garment, found->second);
      for (const GarmentParameter& parameter : found->second->parameters) {
        if (!parameter.label.empty()) {
          ParameterRow(workspace, parameter, pattern, garment, change).Draw();
        }
      }
    }
    EndProperties();
  }
  ImGui::Separator();
  return order;
}

void AddGarment(const Garments& garments, import::CastRecipe& recipe, RecipeChange& change) {
  ImGui::BeginDisabled(recipe.garments.size() >= kMostGarments);
  if (ImGui::Button(Tr("Put something on\xe2\x80\xa6"), ImVec2(-FLT_MIN, 0))) {
    ImGui::OpenPopup("garments");
  }
  ImGui::EndDisabled();
  if (ImGui::BeginPopup("garments")) {
    for (const auto& [name, design] : garments) {
      if (ImGui::Selectable(name.c_str())) {
        recipe.garments.push_back({{"name", name}});
        change.Choose(name);
      }
    }
    ImGui::EndPopup();
  }
}

}  // namespace

void DrawWardrobe(editor::Workspace& workspace, import::CastRecipe& recipe, RecipeChange& change) {
  const editor::CastCatalogue* catalogue = workspace.cast().catalogue();
  if (catalogue == nullptr) {
    return;
  }
  for (size_t i = 0; i < recipe.garments.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const Order order =
        DrawGarment(workspace, catalogue->garments, recipe.garments[i], i == 0, change);
    ImGui::PopID();
    const auto at = recipe.garments.begin() + static_cast<std::ptrdiff_t>(i);
    if (order == Order::kUp) {
      change.Choose(Sentence("order of the %s", {NameOf(*at)}));
      std::iter_swap(at - 1, at);
    } else if (order == Order::kTakeOff) {
      change.Choose(Sentence("no %s", {NameOf(*at)}));
      recipe.garments.erase(at);
      break;
    }
  }
  AddGarment(catalogue->garments, recipe, change);
}

}  // namespace lararium::panels
