#include "player/kiosk/visitor_actions.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>

#include "shared/render/gl/window.h"
#include "shared/show/show_content.h"

namespace lararium::player {
namespace {

constexpr double kVolumeStep = 0.1;
constexpr size_t kMostButtons = 16;  // limit for one action

struct Named {
  std::string_view name;
  Action action;
  std::array<std::string_view, 3> buttons;  // unused entries are empty
};
constexpr Named kActions[] = {{"louder", Action::kLouder, {"page_up", "pad_up"}},
                              {"quieter", Action::kQuieter, {"page_down", "pad_down"}},
                              {"language", Action::kLanguage, {"l", "pad_left"}},
                              {"captions", Action::kCaptions, {"c", "pad_right"}},
                              {"caption_size", Action::kCaptionSize, {"s"}},
                              {"caption_contrast", Action::kCaptionContrast, {"k"}},
                              {"descriptions", Action::kDescriptions, {"d"}},
                              {"reduced_motion", Action::kReducedMotion, {"v"}},
                              {"restart", Action::kRestart, {"home", "pad_back"}},
                              {"find_anew", Action::kFindAnew, {"r", "pad_left_bumper"}},
                              {"menu", Action::kMenu, {"m", "pad_start", kHandMenu}}};

// The choice after a chosen one; "" stands for the first.
std::string After(const std::string& chosen, const std::vector<std::string>& all) {
  if (all.empty()) {
    return chosen;
  }
  const auto found = std::find(all.begin(), all.end(), chosen);
  const size_t index = found == all.end() ? 0 : static_cast<size_t>(found - all.begin());
  return all[(index + 1) % all.size()];
}

// The choice after a chosen one; after the last comes the first. The array gives the number.
template <typename Choice, size_t n>
Choice After(Choice chosen, const std::array<std::string_view, n>& /*names*/) {
  return static_cast<Choice>((static_cast<size_t>(chosen) + 1) % n);
}

bool IsButton(std::string_view name) {
  return render::IsButtonName(name) || name == kHandSelect || name == kHandMenu;
}

}  // namespace

Buttons::Buttons() {
  for (const Named& named : kActions) {
    for (const std::string_view button : named.buttons) {
      if (!button.empty()) {
        actions_.emplace_back(button, named.action);
      }
    }
  }
}

std::optional<Action> Buttons::ActionOf(std::string_view button) const {
  const auto found = std::find_if(actions_.begin(), actions_.end(),
                                  [&](const auto& entry) { return entry.first == button; });
  return found == actions_.end() ? std::nullopt : std::optional(found->second);
}

void Buttons::Set(Action action, const std::vector<std::string>& buttons) {
  std::erase_if(actions_, [&](const auto& entry) {
    return entry.second == action ||
           std::find(buttons.begin(), buttons.end(), entry.first) != buttons.end();
  });
  for (const std::string& button : buttons) {
    actions_.emplace_back(button, action);
  }
}

void DescribeButtons(Fields& fields, const FieldKey& key, Buttons& buttons) {
  std::map<std::string, std::vector<std::string>> actions;
  std::vector<std::string> taken;
  const auto describe = [&](const FieldKey& action, std::vector<std::string>& names) {
    const auto* named = std::find_if(std::begin(kActions), std::end(kActions),
                                     [&](const Named& n) { return n.name == action.name; });
    fields.Require(named != std::end(kActions),
                   "there is no action \"" + std::string(action.name) + "\"",
                   "docs/player.md names them");
    fields.List(action, names, kMostButtons, [&](const FieldKey& entry, std::string& name) {
      fields.Text(entry, name, 32);
      fields.RequireAt(entry, IsButton(name), "there is no button \"" + name + "\"",
                       "docs/player.md names them");
    });
    for (const std::string& button : names) {
      fields.RequireAt(action, std::find(taken.begin(), taken.end(), button) == taken.end(),
                       "\"" + button + "\" is another action's too", "give it to one");
      taken.push_back(button);
    }
    if (named != std::end(kActions)) {
      buttons.Set(named->action, names);
    }
  };
  fields.Entries(key, actions, std::numeric_limits<size_t>::max(),
                 "must be an object; as {\"menu\": [\"m\", \"pad_start\"]}", describe);
}

void Choose(Action action, const Offer& offer, Choices& choices) {
  if (action == Action::kLouder || action == Action::kQuieter) {
    const double step = action == Action::kLouder ? kVolumeStep : -kVolumeStep;
    choices.volume = std::clamp(choices.volume + step, 0.0, 1.0);
  } else if (action == Action::kLanguage) {
    choices.language = After(choices.language, offer.spoken);
  } else if (action == Action::kCaptions && !offer.captions.empty()) {
    std::vector<std::string> all = offer.captions;
    all.emplace_back(show::kNoCaptions);
    choices.captions = After(choices.captions, all);
  } else if (action == Action::kCaptionSize) {
    choices.caption_style.size = After(choices.caption_style.size, render::kCaptionSizes);
  } else if (action == Action::kCaptionContrast) {
    choices.caption_style.contrast =
        After(choices.caption_style.contrast, render::kCaptionContrasts);
  } else if (action == Action::kDescriptions && offer.descriptions) {
    choices.descriptions = !choices.descriptions;
  } else if (action == Action::kReducedMotion) {
    choices.reduced_motion = !choices.reduced_motion;
  }
}

}  // namespace lararium::player
