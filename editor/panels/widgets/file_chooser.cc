#include "editor/panels/widgets/file_chooser.h"

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "editor/document/project_paths.h"
#include "editor/document/user_folders.h"
#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/check.h"
#include "shared/core/file.h"

namespace lararium::panels {

namespace fs = std::filesystem;

namespace {

using RequestKind = editor::FileRequest::Kind;

constexpr float kWidth = 860.0f;  // Logical pixels.
constexpr float kHeight = 380.0f;
constexpr float kPlaces = 180.0f;

// The folder itself or the nearest one above it that exists; the home without any.
fs::path ExistingFolder(fs::path path) {
  std::error_code ignored;
  while (!path.empty() && !fs::is_directory(path, ignored) && path != path.parent_path()) {
    path = path.parent_path();
  }
  return fs::is_directory(path, ignored) ? path : editor::HomeFolder();
}

std::string PlaceLabel(const editor::FilePlace& place) {
  switch (place.kind) {
    case editor::FilePlace::Kind::kHome:
      return TrIn("folder", "Home");
    case editor::FilePlace::Kind::kDesktop:
      return Tr("Desktop");
    case editor::FilePlace::Kind::kDocuments:
      return Tr("Documents");
    case editor::FilePlace::Kind::kPictures:
      return Tr("Pictures");
    case editor::FilePlace::Kind::kVideos:
      return Tr("Videos");
    case editor::FilePlace::Kind::kMedia:
      break;
  }
  return place.folder.filename().string();
}

bool Pressed(ImGuiKey key, bool repeats = true) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeats);
}

}  // namespace

FileChooser::FileChooser(std::string parent_window) : parent_window_(std::move(parent_window)) {
  ImGui::GetIO().UserData = this;
}

FileChooser::~FileChooser() { ImGui::GetIO().UserData = nullptr; }

FileChooser& FileChooser::Current() {
  CHECK(ImGui::GetIO().UserData != nullptr);
  return *static_cast<FileChooser*>(ImGui::GetIO().UserData);
}

void FileChooser::BeginFrame() {
  portal_.Update();
  drop_frames_ = std::max(0, drop_frames_ - 1);
  if (asked_ && !std::exchange(asked_->drawn, false)) {
    portal_.Close();
    asked_.reset();
  }
}

void FileChooser::Ask(ImGuiID field, FileType type, const fs::path& path) {
  const bool again = IsWaiting(field);  // The desktop's dialog may lie behind other windows.
  ForgetProblem();
  portal_.Close();
  asked_ = Asked{field, type, again, true};
  std::error_code ignored;
  const bool folder = fs::is_directory(path, ignored);
  const auto last = last_.find(type);
  // A field that names nothing begins where the last file of its type was.
  const bool says_nothing = folder && !spec().folder();
  const fs::path shown = says_nothing && last != last_.end() ? last->second
                         : folder                            ? path
                                                             : path.parent_path();
  List list;
  list.column = list_.column;  // The table still shows this order.
  list.descending = list_.descending;
  list_ = std::move(list);
  list_.folder = ExistingFolder(shown);
  list_.name = spec().kind == RequestKind::kSave ? path.filename().string() : "";
  if (again) {
    OpenList();
    return;
  }
  editor::FileRequest request{spec().kind, Tr(spec().title), {}, list_.folder, list_.name};
  if (!spec().folder()) {
    request.filters.push_back(
        {Tr(spec().label), {spec().extensions.begin(), spec().extensions.end()}});
    request.filters.push_back({Tr("All files"), {""}});
  }
  portal_.Open(request, parent_window_);
}

void FileChooser::OpenList() {
  asked_->list = true;
  list_.places = editor::FindFilePlaces(editor::HomeFolder(), editor::ConfigFolder().parent_path());
  list_.recent.clear();
  std::copy_if(recent_.begin(), recent_.end(), std::back_inserter(list_.recent),
               [](const auto& project) { return editor::IsProject(project.folder); });
  Enter(list_.folder);
}

void FileChooser::Enter(const fs::path& folder) {
  const fs::path before = list_.folder;
  list_.folder = folder.lexically_normal();
  if (!list_.folder.has_filename() && list_.folder.has_relative_path()) {
    list_.folder = list_.folder.parent_path();  // This removes the slash at the end.
  }
  list_.typed = list_.folder.string();
  Read();
  // Going up chooses the folder that one comes from.
  if (before.parent_path() == list_.folder) {
    for (size_t i = 0; i < list_.entries.size(); ++i) {
      if (list_.entries[i].name == before.filename()) {
        list_.chosen = i;
      }
    }
  }
  list_.scroll = true;
}

void FileChooser::Read() {
  const std::span<const char* const> extensions = spec().extensions;
  list_.chosen.reset();
  list_.entries = ListFolder(list_.folder, list_.all ? std::span<const char* const>() : extensions,
                             list_.problem);
  if (extensions.empty() && spec().folder()) {
    std::erase_if(list_.entries, [](const FileEntry& entry) { return !entry.folder; });
  }
  SortEntries(list_.column, list_.descending, list_.entries);
}

fs::path FileChooser::Target() const {
  if (spec().kind == RequestKind::kSave) {
    return list_.folder / list_.name;
  }
  if (list_.chosen) {
    return list_.folder / list_.entries[*list_.chosen].name;
  }
  return editor::HomeFolder() / list_.typed;
}

// A file is taken; a folder is taken where one is asked for, and otherwise shown.
void FileChooser::Choose(size_t index) {
  const FileEntry& entry = list_.entries[index];
  list_.chosen = index;
  if (entry.folder && !(entry.project && asked_->type == FileType::kProject)) {
    Enter(fs::path(list_.folder) / entry.name);
  } else if (spec().kind == RequestKind::kSave) {
    list_.name = entry.name;
  } else if (entry.folder || !spec().folder()) {
    list_.result = Target();
  }
}

void FileChooser::HandleKeys() {
  constexpr ImGuiFocusedFlags kHere =
      ImGuiFocusedFlags_RootAndChildWindows | ImGuiFocusedFlags_NoPopupHierarchy;
  const ImGuiIO& io = ImGui::GetIO();
  if (!ImGui::IsWindowFocused(kHere) || io.WantTextInput || ImGui::IsAnyItemActive() ||
      io.KeyCtrl || io.KeyAlt) {
    return;
  }
  const auto count = static_cast<int>(list_.entries.size());
  int at = list_.chosen ? static_cast<int>(*list_.chosen) : -1;
  constexpr int kPage = 10;
  for (const auto& [key, step] : {std::pair{ImGuiKey_DownArrow, 1},
                                  {ImGuiKey_UpArrow, -1},
                                  {ImGuiKey_PageDown, kPage},
                                  {ImGuiKey_PageUp, -kPage},
                                  {ImGuiKey_Home, -count},
                                  {ImGuiKey_End, count}}) {
    if (Pressed(key) && count > 0) {
      at = std::clamp(at + step, 0, count - 1);
      list_.chosen = static_cast<size_t>(at);
      list_.scroll = true;
    }
  }
  for (const ImWchar character : io.InputQueueCharacters) {
    std::array<char, 5> text = {};
    ImTextCharToUtf8(text.data(), character);
    if (const auto found =
            list_.ahead.Type(text.data(), ImGui::GetTime(), list_.entries, list_.chosen)) {
      list_.chosen = found;
      list_.scroll = true;
    }
  }
  if (Pressed(ImGuiKey_RightArrow, false) && list_.chosen && list_.entries[*list_.chosen].folder) {
    Enter(fs::path(list_.folder) / list_.entries[*list_.chosen].name);
  }
  if (Pressed(ImGuiKey_Backspace, false) || Pressed(ImGuiKey_LeftArrow, false)) {
    Enter(list_.folder.parent_path());
  }
}

void FileChooser::DrawPath() {
  if (ImGui::Button(WithIcon(Icon::kUndo, Tr("Up")).c_str())) {
    Enter(list_.folder.parent_path());
  }
  Tooltip(Tr("The folder above (Backspace)"));
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::InputText("##path", &list_.typed)) {
    list_.chosen.reset();  // The typed path replaces the choice.
    std::error_code ignored;
    const fs::path typed = editor::HomeFolder() / list_.typed;
    if (fs::is_directory(typed, ignored)) {
      list_.folder = typed;
      Read();
    }
  }
}

void FileChooser::DrawPlaces() {
  const auto row = [&](Icon icon, const std::string& label, const fs::path& folder) {
    ImGui::PushID(folder.c_str());
    const bool here = list_.folder == folder;
    const float width = ImGui::GetContentRegionAvail().x;
    if (ImGui::Selectable(Elided(WithIcon(icon, label), width).c_str(), here,
                          ImGuiSelectableFlags_DontClosePopups)) {
      Enter(folder);
    }
    Tooltip(folder.string());
    ImGui::PopID();
  };
  for (const editor::FilePlace& place : list_.places) {
    row(Icon::kProject, PlaceLabel(place), place.folder);
  }
  if (!list_.recent.empty()) {
    ImGui::Dummy(ImVec2(0, Px(4)));
    DimText(Tr("Recent projects"));
  }
  for (const editor::RecentProject& project : list_.recent) {
    row(Icon::kProject, project.title, project.folder);
  }
}

void FileChooser::DrawEntry(size_t index) {
  const FileEntry& entry = list_.entries[index];
  // A folder is asked for: its files are only shown.
  const bool possible = entry.folder || !spec().folder();
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushID(static_cast<int>(index));
  ImGui::BeginDisabled(!possible);
  if (entry.project) {
    ImGui::PushStyleColor(ImGuiCol_Text, Colours().accent);
  }
  const std::string label = entry.folder ? WithIcon(Icon::kProject, entry.name) : entry.name;
  const bool pressed = ImGui::Selectable(label.c_str(), list_.chosen == index,
                                         ImGuiSelectableFlags_SpanAllColumns |
                                             ImGuiSelectableFlags_AllowDoubleClick |
                                             ImGuiSelectableFlags_DontClosePopups);
  if (entry.project) {
    ImGui::PopStyleColor();
  }
  ImGui::EndDisabled();
  ImGui::PopID();
  ImGui::TableNextColumn();
  if (!entry.folder) {
    DimText(SizeText(entry.bytes));
  } else if (entry.project) {
    DimText(Tr("Project"));
  }
  ImGui::TableNextColumn();
  DimText(DateText(entry.changed));
  if (pressed) {
    list_.chosen = index;
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
      Choose(index);  // The entries may change.
    } else if (spec().kind == RequestKind::kSave && !entry.folder) {
      list_.name = entry.name;
    }
  }
}

void FileChooser::DrawEntries() {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY |
                                     ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_RowBg;
  if (!ImGui::BeginTable("entries", 3, kFlags)) {
    return;
  }
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn(Tr("Name"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(
      Tr("Size"), ImGuiTableColumnFlags_WidthFixed | ImGuiTableColumnFlags_PreferSortDescending,
      Px(76));
  ImGui::TableSetupColumn(
      Tr("Changed"), ImGuiTableColumnFlags_WidthFixed | ImGuiTableColumnFlags_PreferSortDescending,
      Px(146));
  ImGui::TableHeadersRow();
  ImGuiTableSortSpecs* sort = ImGui::TableGetSortSpecs();
  if (sort != nullptr && sort->SpecsDirty && sort->SpecsCount > 0) {
    list_.column = static_cast<FileColumn>(sort->Specs->ColumnIndex);
    list_.descending = sort->Specs->SortDirection == ImGuiSortDirection_Descending;
    sort->SpecsDirty = false;
    SortEntries(list_.column, list_.descending, list_.entries);
    list_.chosen.reset();
  }
  const float row = ImGui::GetTextLineHeight() + 2.0f * ImGui::GetStyle().CellPadding.y;
  if (std::exchange(list_.scroll, false)) {
    const float top = row * static_cast<float>(list_.chosen.value_or(0));
    const float room = ImGui::GetWindowHeight() - 2.0f * row;  // The header takes the rest.
    if (!list_.chosen || top < ImGui::GetScrollY() || top > ImGui::GetScrollY() + room - row) {
      ImGui::SetScrollY(std::max(0.0f, top - 0.5f * room));
    }
  }
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(list_.entries.size()), row);
  const size_t count = list_.entries.size();
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      // A double click may have opened another folder.
      if (list_.entries.size() == count && !list_.result) {
        DrawEntry(static_cast<size_t>(i));
      }
    }
  }
  ImGui::EndTable();
}

void FileChooser::DrawFilter() {
  if (spec().kind == RequestKind::kSave) {
    ImGui::AlignTextToFramePadding();
    DimText(Tr("Name"));
    ImGui::SameLine();
    ImGui::SetNextItemWidth(Px(320));
    ImGui::InputText("##name", &list_.name);
    ImGui::SameLine();
  }
  if (spec().extensions.empty()) {
    return;
  }
  std::string kind = Tr(spec().label);
  for (const char* extension : spec().extensions) {
    kind += (extension == spec().extensions.front() ? " (" : ", ") + std::string(extension + 1);
  }
  kind += ")";
  ImGui::SetNextItemWidth(Px(320));
  if (ImGui::BeginCombo("##kind", list_.all ? Tr("All files") : kind.c_str())) {
    const bool before = list_.all;
    if (ImGui::Selectable(kind.c_str(), !list_.all)) {
      list_.all = false;
    }
    if (ImGui::Selectable(Tr("All files"), list_.all)) {
      list_.all = true;
    }
    if (list_.all != before) {
      Read();
    }
    ImGui::EndCombo();
  }
}

DialogProblem FileChooser::ListProblem() const {
  const fs::path target = Target();
  if (!list_.problem.empty()) {
    return Wrong(Text(Tr("This folder cannot be read: %s"), list_.problem.c_str()));
  }
  if (spec().kind == RequestKind::kSave) {
    return list_.name.empty() ? Missing(Tr("It needs a name.")) : DialogProblem();
  }
  if (!FileExists(target)) {
    return Wrong(Tr("It is not there."));
  }
  if (target == list_.folder && Enters(target)) {
    return Missing(spec().folder() ? Tr("Choose a project: they are coloured.")
                                   : Tr("Choose a file."));
  }
  return {};
}

// Whether a folder is opened in the list instead of being taken.
bool FileChooser::Enters(const fs::path& target) const {
  std::error_code ignored;
  const bool wanted =
      spec().folder() && (asked_->type != FileType::kProject || editor::IsProject(target));
  return !wanted && fs::is_directory(target, ignored);
}

const char* FileChooser::Action() const {
  return Enters(Target())                    ? Tr("Open")
         : spec().kind == RequestKind::kSave ? Tr("Use this name")
                                             : Tr("Choose");
}

void FileChooser::DrawList() {
  DrawPath();
  const float height =
      std::min(Px(kHeight), ImGui::GetMainViewport()->WorkSize.y - 7.0f * ImGui::GetFrameHeight());
  ImGui::BeginChild("places", ImVec2(Px(kPlaces), height), false, ImGuiWindowFlags_NoNavInputs);
  DrawPlaces();
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("folder", ImVec2(0, height), false, ImGuiWindowFlags_NoNavInputs);
  DrawEntries();
  ImGui::EndChild();
  HandleKeys();
  DrawFilter();
}

std::optional<fs::path> FileChooser::ShowList() {
  const std::optional<fs::path> result = list_.result;
  bool open = true;
  DrawModal(
      Label(Tr(spec().title), "files").c_str(), kWidth, open,
      [&] {
        DrawList();
        const DialogAnswer answer = DialogButtons(Action(), ListProblem());
        const fs::path target = Target();
        if (answer == DialogAnswer::kAct && Enters(target)) {
          Enter(target);
        } else if (answer == DialogAnswer::kAct) {
          list_.result = target;
        }
        open = answer != DialogAnswer::kCancel && !result;
      },
      ImGuiWindowFlags_NoNavInputs);
  if (!open) {
    asked_.reset();
  }
  return result;
}

std::optional<fs::path> FileChooser::Show(ImGuiID field) {
  if (!asked_ || asked_->field != field) {
    return std::nullopt;
  }
  asked_->drawn = true;
  const Asked asked = *asked_;
  std::optional<fs::path> chosen;
  if (asked.list) {
    chosen = ShowList();
  } else if (const std::optional<editor::FileAnswer> answer = portal_.TakeAnswer()) {
    if (answer->outcome == editor::FileAnswer::Outcome::kFailed) {
      OpenList();
      return std::nullopt;
    }
    if (answer->outcome == editor::FileAnswer::Outcome::kRefused) {
      refused_ = field;
      problem_ = answer->problem;
    } else if (answer->outcome == editor::FileAnswer::Outcome::kChosen) {
      chosen = answer->file;
    }
    asked_.reset();
  }
  const FileTypeSpec& wanted = SpecOf(asked.type);
  if (chosen) {
    last_[asked.type] = chosen->parent_path();
    if (wanted.kind == RequestKind::kSave && !HasExtension(*chosen, wanted.extensions)) {
      *chosen += wanted.extensions.front();
    }
  }
  return chosen;
}

void FileChooser::Drop(const fs::path& file) {
  dropped_ = file;
  drop_frames_ = 2;
  drop_taken_ = false;
}

std::optional<fs::path> FileChooser::TakeDrop(FileType type) {
  if (drop_frames_ == 0 || !Fits(dropped_, type)) {
    return std::nullopt;
  }
  drop_frames_ = 0;
  drop_taken_ = true;
  return dropped_;
}

}  // namespace lararium::panels
