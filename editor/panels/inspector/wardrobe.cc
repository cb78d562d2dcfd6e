// The garments of a person, in the order in which they are put on.

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "editor/import/wardrobe/garment_pattern.h"
#include "editor/panels/inspector/recipe_panel.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/lower_case.h"
#include "shared/core/srgb.h"

namespace lararium::panels {
namespace {

constexpr size_t kMostGarments = 16;  // Limit of a recipe.

// Fields with a fixed set of values, and the garments that have them (how-to-dress-the-cast.md).
struct WordField {
  const char* field;
  const char* label;
  std::initializer_list<std::string_view> garments;
};
const WordField kWordFields[] = {
    {"length", TrLater("Length"), {"tunic", "stola", "apron", "toga", "palla"}},
    {"sleeve", TrLater("Sleeves"), {"tunic", "stola"}},
    {"belt", TrLater("Belt"), {"tunic", "stola"}},
    {"stripes", TrLater("Stripes"), {"tunic"}}};

bool Has(const WordField& field, const std::string& garment) {
  return std::find(field.garments.begin(), field.garments.end(), garment) != field.garments.end();
}

std::string GarmentText(const Json& garment, const char* field) {
  const auto found = garment.find(field);
  return found == garment.end() ? ""
         : found->is_string()   ? found->get<std::string>()
         : found->is_number()   ? Tr("by number")
                                : "";
}

std::string NameOf(const Json& garment) { return GarmentText(garment, "name"); }

// The present colour of a garment, sRGB; the default of its kind where none is set.
glm::vec3 ColourOf(const Json& garment) {
  const auto pattern = ParseFields<import::GarmentPattern>(JsonView(garment, "garment"));
  const glm::vec3 linear = pattern.ok() ? pattern->colour : glm::vec3(0.5f);
  return {SrgbFromLinear(linear.x), SrgbFromLinear(linear.y), SrgbFromLinear(linear.z)};
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

void ColourRow(editor::Workspace& workspace, Json& garment, RecipeChange& change) {
  const std::string what = Text(Tr("colour of the %s"), NameOf(garment).c_str());
  PropertyLabel(Tr("Colour"));
  std::string dye = GarmentText(garment, "colour");
  const std::vector<std::string> dyes = import::GarmentWords("colour");
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() -
                          ImGui::GetStyle().ItemInnerSpacing.x);
  if (NameCombo("##dye", dye, dyes, Tr("as usual"))) {
    Set(garment, "colour", dye);
    change.Choose(what);
  }
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  glm::vec3 colour = ColourOf(garment);
  if (Swatch(workspace, "##colour", colour)) {
    garment["colour"] = HexOf(colour);
    change.Drag(what);
  }
}

void WordRows(Json& garment, RecipeChange& change) {
  for (const WordField& field : kWordFields) {
    if (!Has(field, NameOf(garment))) {
      continue;
    }
    PropertyLabel(Tr(field.label));
    ImGui::PushID(field.field);
    std::string word = GarmentText(garment, field.field);
    const std::vector<std::string> words = import::GarmentWords(field.field);
    if (NameCombo("##word", word, words, Tr("as usual"))) {
      Set(garment, field.field, word);
      change.Choose(Sentence("%s of the %s", {LowerCase(Tr(field.label)), NameOf(garment)}));
    }
    ImGui::PopID();
  }
}

void WearRow(editor::Workspace& workspace, Json& garment, RecipeChange& change) {
  if (NameOf(garment) == "sandals") {
    return;
  }
  const auto pattern = ParseFields<import::GarmentPattern>(JsonView(garment, "garment"));
  double wear = pattern.ok() ? pattern->wear : 0.3;
  if (SliderProperty(workspace, Tr("Wear"), wear, 0.0, 1.0, "%.2f")) {
    garment["wear"] = std::round(wear * 100.0) / 100.0;
    change.Drag(Sentence("wear of the %s", {NameOf(garment)}));
  }
  bool border = pattern.ok() && pattern->border;
  PropertyLabel(Tr("Border"));
  if (ImGui::Checkbox("##border", &border)) {
    garment["border"] = border;
    change.Choose(Sentence("border of the %s", {NameOf(garment)}));
  }
}

enum class Order { kStay, kUp, kTakeOff };

// Another kind of garment keeps only the colour, because its fields differ.
Order Header(Json& garment, bool first, RecipeChange& change) {
  const std::vector<std::string> names = import::GarmentNames();
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

Order DrawGarment(editor::Workspace& workspace, Json& garment, bool first, RecipeChange& change) {
  const Order order = Header(garment, first, change);
  if (BeginProperties("garment")) {
    ColourRow(workspace, garment, change);
    WordRows(garment, change);
    WearRow(workspace, garment, change);
    EndProperties();
  }
  ImGui::Separator();
  return order;
}

void AddGarment(import::CastRecipe& recipe, RecipeChange& change) {
  ImGui::BeginDisabled(recipe.garments.size() >= kMostGarments);
  if (ImGui::Button(Tr("Put something on\xe2\x80\xa6"), ImVec2(-FLT_MIN, 0))) {
    ImGui::OpenPopup("garments");
  }
  ImGui::EndDisabled();
  if (ImGui::BeginPopup("garments")) {
    for (const std::string& name : import::GarmentNames()) {
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
  for (size_t i = 0; i < recipe.garments.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const Order order = DrawGarment(workspace, recipe.garments[i], i == 0, change);
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
  AddGarment(recipe, change);
}

}  // namespace lararium::panels
