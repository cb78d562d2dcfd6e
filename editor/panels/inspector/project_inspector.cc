#include "editor/panels/inspector/project_inspector.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "editor/document/titles.h"
#include "editor/jobs/sounds.h"
#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/dialogs/inspector_dialog.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

using Languages = std::vector<std::string>;

std::string Joined(const Languages& languages) {
  std::string text;
  for (const std::string& language : languages) {
    text += (text.empty() ? "" : ", ") + language;
  }
  return text;
}

// The chosen languages in their order, then the others of the lines.
Languages Offered(const Languages& chosen, const Languages& of_lines) {
  Languages offered = chosen;
  std::copy_if(of_lines.begin(), of_lines.end(), std::back_inserter(offered),
               [&](const std::string& language) {
                 return std::find(chosen.begin(), chosen.end(), language) == chosen.end();
               });
  return offered;
}

// A row with a list of languages to check; the first checked one comes first. none: the meaning of
// an empty choice. Returns true when the choice has changed.
bool LanguageRow(const char* label,
                 Languages& chosen,
                 const Languages& of_lines,
                 const std::string& none,
                 const std::string& tip) {
  PropertyLabel(label);
  ImGui::PushID(label);
  bool changed = false;
  const std::string shown = chosen.empty() ? none : Joined(chosen);
  if (ImGui::BeginCombo("##languages", shown.c_str())) {
    const Languages offered = Offered(chosen, of_lines);
    for (const std::string& language : offered) {
      const auto known = std::find(chosen.begin(), chosen.end(), language);
      bool on = known != chosen.end();
      if (ImGui::Checkbox(language.c_str(), &on)) {
        if (on) {
          chosen.push_back(language);
        } else {
          chosen.erase(known);
        }
        changed = true;
        break;
      }
    }
    if (offered.empty()) {
      DimText(Tr("The project has no lines yet."));
    }
    ImGui::EndCombo();
  }
  Tooltip(tip);
  ImGui::PopID();
  return changed;
}

bool IsInLibrary(const editor::ProjectPaths& paths, const std::string& name) {
  const auto sounds = editor::FindSounds(paths);
  return std::any_of(sounds.begin(), sounds.end(), [&](const editor::SoundFile& sound) {
    return sound.of_library && sound.name == name;
  });
}

DialogProblem SoundProblem(const editor::ProjectPaths& paths,
                           const std::string& name,
                           const std::string& file) {
  std::error_code ignored;
  if (file.empty()) {
    return Missing(Tr("Choose a file."));
  }
  if (!std::filesystem::is_regular_file(paths.Resolve(file), ignored)) {
    return Wrong(Tr("Choose a file that exists."));
  }
  const DialogProblem problem = NameProblem(name);
  return problem.any() || editor::SoundFileIn(paths.folder / "audio", name).empty()
             ? problem
             : Wrong(Tr("That name is taken."));
}

// Returns true when the dialog is finished.
bool SoundDialog(editor::Workspace& workspace, Dialogs& dialogs) {
  Hint(
      Tr("A recording of one channel, close to what sounds and without reverberation, is best. It "
         "is copied into the project's audio folder; places and the drama call it by its name."));
  DialogFields& fields = dialogs.fields;
  const std::string usual_name =
      editor::PlainNameOf(std::filesystem::path(fields.file).stem().string());
  if (BeginProperties("sound")) {
    PropertyLabel(Tr("File"));
    PathField("file", fields.file, workspace.project().paths().folder, FileType::kSound);
    PropertyLabel(Tr("Name"));
    ImGui::InputTextWithHint("##name", usual_name.c_str(), &fields.name);
    EndProperties();
  }
  const std::string name = fields.name.empty() ? usual_name : fields.name;
  if (IsInLibrary(workspace.project().paths(), name)) {
    Hint(Text(Tr("It takes the place of %s of the library."), name.c_str()));
  }
  const DialogAnswer answer =
      DialogButtons(Tr("Bring in"), SoundProblem(workspace.project().paths(), name, fields.file));
  if (answer == DialogAnswer::kAct) {
    workspace.project().BringInSound(name, workspace.project().paths().Resolve(fields.file));
  }
  return answer != DialogAnswer::kNone;
}

}  // namespace

void DrawLanguages(editor::Workspace& workspace) {
  Heading(Tr("Languages"));
  const editor::ProjectDocument& document = workspace.project().document();
  const Languages of_lines = document.lines == nullptr ? Languages() : document.lines->languages;
  editor::SpeechDocument speech = document.speech;
  if (!BeginProperties("languages")) {
    return;
  }
  const bool spoken = LanguageRow(
      Tr("Spoken"), speech.spoken, of_lines,
      of_lines.empty() ? Tr("the first of the lines")
                       : Text(Tr("%s, the first of the lines"), of_lines.front().c_str()),
      Tr("Voices are made in these. Visitors hear the first unless they choose another: the order "
         "is that in which they are ticked."));
  const bool captions = LanguageRow(
      Tr("Captions"), speech.captions, of_lines, Tr("all of the lines"),
      Tr("These can be read. Visitors read the first unless they choose another: the order is that "
         "in which they are ticked."));
  EndProperties();
  if (spoken || captions) {
    workspace.project().Edit(
        spoken ? Sentence("spoken languages") : Sentence("languages of captions"),
        [&](editor::ProjectDocument& edited) { edited.speech = speech; });
  }
}

void DrawSounds(editor::Workspace& workspace, Dialogs& dialogs) {
  Heading(Tr("Sounds"));
  Languages names;
  for (const editor::SoundFile& sound : editor::FindSounds(workspace.project().paths())) {
    if (!sound.of_library) {
      names.push_back(sound.name);
    }
  }
  Hint(names.empty() ? Tr("None was brought in; there are only those of the library.")
                     : Joined(names));
  BringInSoundButton(workspace, dialogs);
}

void BringInSoundButton(editor::Workspace& workspace, Dialogs& dialogs) {
  const std::string title = Label(Tr("Bring in a sound"), "bring in");
  if (ImGui::Button(Tr("Bring in a sound\xe2\x80\xa6"), ImVec2(-FLT_MIN, 0))) {
    dialogs.fields = {};
    ImGui::OpenPopup(title.c_str());
  }
  Tooltip(Tr("Copies a recording into the project, for places, the timeline and the drama"));
  DrawInspectorDialog(title, [&] { return SoundDialog(workspace, dialogs); });
}

}  // namespace lararium::panels
