#include "editor/panels/inspector/clips_panel.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "editor/document/cast_edits.h"
#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {
namespace {

constexpr float kLabels = 70.0f;  // logical pixels
constexpr float kAddingWidth = 460.0f;

// "12, 40": the lines of the script that contain the word; empty: none.
std::string LinesOf(const editor::Workspace& workspace, const std::string& word) {
  constexpr size_t kMost = 6;
  const std::vector<size_t> lines = editor::LinesThatSay(workspace.project().script().text(), word);
  std::string text;
  for (size_t i = 0; i < std::min(lines.size(), kMost); ++i) {
    text += (i > 0 ? ", " : "") + std::to_string(lines[i]);
  }
  return text + (lines.size() > kMost ? "\xe2\x80\xa6" : "");
}

class ClipsPanel {
 public:
  ClipsPanel(editor::Workspace& workspace, DialogFields& fields, const editor::CastDocument& member)
      : workspace_(workspace), fields_(fields), member_(member) {}

  void Show() {
    for (const editor::ClipDocument& clip : member_.clips) {
      ImGui::PushID(clip.name.c_str());
      DrawClip(clip);
      ImGui::PopID();
    }
    if (member_.clips.empty()) {
      Hint(Tr("Recorded motions that are carried over to the figure, beside those that it has."));
    }
    DrawAdding();
  }

 private:
  void Edit(const Sentence& what, const std::function<Status(editor::CastDocument&)>& change) {
    workspace_.project().Edit(Sentence("%s of %s", {what, member_.name}),
                              [&](editor::ProjectDocument& document) {
                                for (editor::CastDocument& known : document.cast) {
                                  if (known.name == member_.name) {
                                    Tell(change(known));
                                  }
                                }
                              });
  }

  void Tell(const Status& status) {
    if (!status.ok()) {
      workspace_.messages().Tell(editor::Message::Level::kError, status.message());
    }
  }

  // Warns about lines of the drama that use the name. They are not rewritten, because the drama
  // belongs to the author.
  void WarnOfUses(const std::string& name) {
    if (const std::string lines = LinesOf(workspace_, name); !lines.empty()) {
      workspace_.messages().Tell(editor::Message::Level::kWarning,
                                 Text(Tr("The drama still says \"%s\": line %s of the script."),
                                      name.c_str(), lines.c_str()));
    }
  }

  void Rename(const std::string& name, const std::string& to) {
    if (const Status status = editor::CheckClipName(member_, to); !status.ok()) {
      Tell(status);
      return;
    }
    Edit(Sentence("rename the clip %s", {name}),
         [&](editor::CastDocument& known) { return editor::RenameClip(name, to, known); });
    WarnOfUses(name);
  }

  void Remove(const std::string& name) {
    Edit(Sentence("remove the clip %s", {name}),
         [&](editor::CastDocument& known) { return editor::RemoveClip(name, known); });
    WarnOfUses(name);
  }

  void DrawHeader(const editor::ClipDocument& clip) {
    const float button = ImGui::GetFrameHeight();
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    std::string name = clip.name;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - gap);
    if (ImGui::InputText("##name", &name, ImGuiInputTextFlags_EnterReturnsTrue) &&
        name != clip.name) {
      Rename(clip.name, name);
    }
    Tip(Tr("As the drama calls it: Enter renames it"));
    ImGui::SameLine(0, gap);
    const bool remove = ImGui::Button("\xc3\x97", ImVec2(button, 0));
    if (ImGui::IsItemHovered()) {
      const std::string lines = LinesOf(workspace_, clip.name);
      Tip(lines.empty() ? std::string(Tr("Remove it; its file stays"))
                        : Text(Tr("Remove it; its file stays. The drama says \"%s\": line %s of "
                                  "the script"),
                               clip.name.c_str(), lines.c_str()));
    }
    if (remove) {
      Remove(clip.name);
    }
  }

  void DrawClip(const editor::ClipDocument& clip) {
    DrawHeader(clip);
    if (BeginProperties("clip", kLabels)) {
      PropertyLabel(Tr("File"));
      ImGui::AlignTextToFramePadding();
      ImGui::TextUnformatted(ElidedFront(clip.file, ImGui::GetContentRegionAvail().x).c_str());
      Tip(clip.file);
      PropertyText(Tr("Length"), LengthOf(clip.name));
      PropertyLabel(Tr("Loops"));
      bool loops = clip.loops;
      if (ImGui::Checkbox("##loops", &loops)) {
        SetLoops(clip, loops);
      }
      Tip(Tr("It begins again where it ends, until the drama wants something else"));
      EndProperties();
    }
    ImGui::Separator();
  }

  // Known after the dry run of the drama.
  std::string LengthOf(const std::string& name) const {
    const editor::DramaRun* run = workspace_.dry_run().newest();
    const double seconds = run != nullptr ? run->words.ClipSeconds(member_.name, name) : 0.0;
    return seconds > 0.0 ? Text("%.2f s", seconds) : "\xe2\x80\x93";
  }

  void SetLoops(editor::ClipDocument clip, bool loops) {
    clip.loops = loops;
    Edit(Sentence("loop of the clip %s", {clip.name}), [&](editor::CastDocument& known) {
      std::replace_if(
          known.clips.begin(), known.clips.end(),
          [&](const auto& other) { return other.name == clip.name; }, clip);
      return Status();
    });
  }

  // ---- Adding a motion ----

  std::string NewName() const {
    const DialogFields& fields = fields_;
    return fields.name.empty() ? std::filesystem::path(fields.file).stem().string() : fields.name;
  }

  DialogProblem NewProblem() const {
    const std::string& file = fields_.file;
    std::error_code ignored;
    if (file.empty()) {
      return Missing(Tr("It needs a file: BVH, FBX, glTF or VRM."));
    }
    if (!std::filesystem::is_regular_file(workspace_.project().paths().Resolve(file), ignored)) {
      return Wrong(Tr("There is no such file."));
    }
    const DialogProblem problem = NameProblem(NewName());
    return problem.any() || editor::CheckClipName(member_, NewName()).ok()
               ? problem
               : Wrong(Tr("That name is taken."));
  }

  void DrawAdding() {
    if (ImGui::Button(Tr("Add a clip\xe2\x80\xa6"), ImVec2(-FLT_MIN, 0))) {
      fields_ = {};
      ImGui::OpenPopup("new clip");
    }
    Tip(Tr("A recorded motion of a BVH, FBX, glTF or VRM file, carried over to the figure"));
    ImGui::SetNextWindowSize(ImVec2(Px(kAddingWidth), 0));
    if (ImGui::BeginPopup("new clip")) {
      DrawNewClip();
      ImGui::EndPopup();
    }
  }

  void DrawNewClip() {
    DialogFields& fields = fields_;
    if (BeginProperties("new clip")) {
      PropertyLabel(Tr("File"));
      PathField("file", fields.file, workspace_.project().paths().folder, FileType::kClip);
      PropertyLabel(Tr("Name"));
      const std::string as_file = fields.file.empty() ? Tr("as the file") : NewName();
      ImGui::InputTextWithHint("##name", as_file.c_str(), &fields.name);
      Tip(Tr("As the drama calls it; empty: as the file is called"));
      EndProperties();
    }
    const DialogAnswer answer = DialogButtons(Tr("Add"), NewProblem());
    if (answer == DialogAnswer::kAct) {
      Add();
    }
    if (answer != DialogAnswer::kNone) {
      ImGui::CloseCurrentPopup();
    }
  }

  void Add() {
    const std::filesystem::path file = workspace_.project().paths().Resolve(fields_.file);
    const editor::ClipDocument clip{NewName(), workspace_.project().paths().Shorten(file), false};
    Edit(Sentence("add the clip %s", {clip.name}),
         [&](editor::CastDocument& known) { return editor::AddClip(clip, known); });
  }

  editor::Workspace& workspace_;
  DialogFields& fields_;
  const editor::CastDocument& member_;
};

}  // namespace

void DrawClips(editor::Workspace& workspace, Dialogs& dialogs, const editor::CastDocument& member) {
  if (Fold(Label(Tr("Clips"), "clips"), false)) {
    ClipsPanel(workspace, dialogs.fields, member).Show();
  }
}

}  // namespace lararium::panels
