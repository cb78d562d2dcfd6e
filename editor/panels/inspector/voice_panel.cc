#include "editor/panels/inspector/voice_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <string>
#include <vector>

#include "editor/jobs/voice_sample.h"
#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/lower_case.h"

namespace lararium::panels {
namespace {

constexpr const char* kResetLabel = "\xc3\x97";

struct VoiceSlider {
  const char* label;
  int bake::VoiceSettings::*value;
  int min;
  int max;
  const char* format;
  const char* tip;
};

constexpr VoiceSlider kSliders[] = {
    {TrLater("Pitch"), &bake::VoiceSettings::pitch, 0, editor::kMaxVoicePitch, "%d",
     TrLater("How high they speak: 50 is as the voice was made")},
    {TrLater("Pitch range"), &bake::VoiceSettings::range, 0, editor::kMaxVoicePitch, "%d",
     TrLater("How far the voice goes up and down: 0 is monotone, 50 as the voice was made")},
    {TrLater("Rate"), &bake::VoiceSettings::rate, editor::kMinVoiceRate, editor::kMaxVoiceRate,
     TrLater("%d words/min"), TrLater("How fast they speak")},
};

// Leaves space for the button that resets the value.
void LeaveRoomForReset() {
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() -
                          ImGui::GetStyle().ItemInnerSpacing.x);
}

bool ResetButton(const std::string& tip) {
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  const bool pressed = ImGui::Button(kResetLabel, ImVec2(ImGui::GetFrameHeight(), 0));
  Tip(tip);
  return pressed;
}

std::string WhatOf(const char* label) {
  return Text(Tr("%s of the voice"), LowerCase(Tr(label)).c_str());
}

void VariantRow(bake::VoiceSettings& voice, RecipeChange& change) {
  PropertyLabel(Tr("Voice"));
  std::vector<std::string> names = editor::VoiceVariants();
  if (!voice.variant.empty() &&
      std::find(names.begin(), names.end(), voice.variant) == names.end()) {
    names.push_back(voice.variant);
  }
  if (NameCombo("##variant", voice.variant, names, Tr("the language's own"))) {
    change.Choose(Sentence("voice"));
  }
  Tip(Tr("m1 to m8 are men, f1 to f5 women"));
}

void SliderRow(editor::Workspace& workspace,
               const VoiceSlider& slider,
               bake::VoiceSettings& voice,
               RecipeChange& change) {
  int& value = voice.*slider.value;
  const int usual = bake::VoiceSettings().*slider.value;
  PropertyLabel(Tr(slider.label));
  ImGui::PushID(slider.label);
  LeaveRoomForReset();
  if (ImGui::SliderInt("##value", &value, slider.min, slider.max, Tr(slider.format),
                       ImGuiSliderFlags_AlwaysClamp)) {
    change.Drag(WhatOf(slider.label));
  }
  EndGestureWithItem(workspace);
  Tip(Tr(slider.tip));
  if (value != usual && ResetButton(Text(Tr("As it was: %d"), usual))) {
    value = usual;
    change.Choose(Sentence("reset of %s", {WhatOf(slider.label)}));
  }
  ImGui::PopID();
}

void Listen(editor::Workspace& workspace, const editor::CastDocument& member) {
  const auto lines = workspace.project().document().lines;
  const editor::VoiceSample sample = editor::SampleOf(
      lines != nullptr ? *lines : bake::LineTable(), workspace.project().document().speech, member);
  workspace.tasks().Start(
      editor::TaskKind::kSpeaking,
      [sample, voice = member.voice](Progress& progress) {
        return editor::PlaySample(sample, voice, progress);
      },
      [&workspace](const Status& status, bool cancelled) {
        if (!status.ok() && !cancelled) {
          workspace.messages().Tell(editor::Message::Level::kError, status.message());
        }
      });
}

// Plays the voice, or stops it.
void ListenButton(editor::Workspace& workspace, const editor::CastDocument& member) {
  const bool speaking = workspace.tasks().Running(editor::TaskKind::kSpeaking);
  const std::string text =
      speaking ? WithIcon(Icon::kPause, Tr("Stop")) : WithIcon(Icon::kPlay, Tr("Listen"));
  if (ImGui::Button(Label(text.c_str(), "listen").c_str(), ImVec2(-FLT_MIN, 0))) {
    if (speaking) {
      workspace.tasks().Cancel(editor::TaskKind::kSpeaking);
    } else {
      Listen(workspace, member);
    }
  }
  Tip(Tr("Says their first line in this voice, or a sentence where they have none"));
}

}  // namespace

void DrawVoice(editor::Workspace& workspace, editor::CastDocument& member, RecipeChange& change) {
  if (!Fold(Label(Tr("Voice"), "voice"), false)) {
    return;
  }
  if (BeginProperties("voice", 110.0f)) {
    VariantRow(member.voice, change);
    for (const VoiceSlider& slider : kSliders) {
      SliderRow(workspace, slider, member.voice, change);
    }
    EndProperties();
  }
  ListenButton(workspace, member);
  Hint(Tr("For lines that are not recorded."));
}

}  // namespace lararium::panels
