#include "editor/panels/dialogs/start_page.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <utility>

#include "editor/document/project.h"
#include "editor/document/project_paths.h"
#include "editor/document/user_folders.h"
#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/dialogs/key_list.h"
#include "editor/panels/dialogs/look.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "editor/session/project_picture.h"
#include "editor/session/sample.h"
#include "editor/session/task_text.h"
#include "shared/core/program.h"
#include "shared/image/decode.h"

namespace lararium::panels {

namespace {

namespace fs = std::filesystem;

constexpr double kListCheckInterval = 2.0;  // seconds
constexpr float kWidestPage = 1180.0f;      // Logical pixels, for the whole page.
constexpr float kActions = 240.0f;
constexpr float kCard = 264.0f;
constexpr float kPad = 10.0f;  // Inside a card.
constexpr float kGap = 18.0f;  // Between cards.
constexpr float kNarrowestStep = 170.0f;
constexpr float kUnderPicture = 2.0f;
constexpr float kStepRatio = 0.6f;  // Height by width of a step's picture.
constexpr float kSampleRatio = 9.0f / 16.0f;
constexpr const char* kSampleTitle = TrLater("A morning at the thermopolium");

struct IntroductionStep {
  const char* picture;
  const char* title;
  const char* text;
};
constexpr std::array<IntroductionStep, 3> kIntroduction = {{
    {"film", TrLater("1  Film"),
     TrLater("Walk sideways around a place with a camera for half a minute. The editor learns the "
             "place from the film.")},
    {"stage", TrLater("2  Stage"),
     TrLater("Pick where the floor is and how long something is. Then place people, things and "
             "light, and write what happens.")},
    {"play", TrLater("3  Play"),
     TrLater("Export one file. Visitors see the people at the place itself, on a screen or through "
             "a headset.")},
}};

float WrappedHeight(const char* text, float width) {
  return ImGui::CalcTextSize(text, nullptr, false, width).y;
}

// The height of a project's card: its picture, two lines and a row of buttons.
float CardHeight(float width) {
  return 2 * Px(kPad) + (width - 2 * Px(kPad)) * kSampleRatio +
         2 * ImGui::GetTextLineHeightWithSpacing() + ImGui::GetFrameHeightWithSpacing() + Px(2);
}

// Dim text in lines of the given width.
void WrappedHint(const char* text, float width) {
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
  Hint(text);
  ImGui::PopTextWrapPos();
}

// The path with "~" for the user's home.
std::string FolderText(const fs::path& folder) {
  const std::string text = folder.string();
  const std::string home = editor::HomeFolder().string() + "/";
  return home.size() > 2 && text.starts_with(home) ? "~/" + text.substr(home.size()) : text;
}

// The folder for new projects: that of the project that was opened last.
fs::path UsualFolder(const editor::RecentProjects& recent) {
  for (const editor::RecentProject& project : recent.entries()) {
    if (editor::IsProject(project.folder)) {
      return project.folder.parent_path();
    }
  }
  return editor::HomeFolder();
}

DialogProblem FolderProblem(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    return Wrong(Tr("Choose a folder that exists."));
  }
  return editor::IsProject(folder)
             ? DialogProblem()
             : Missing(Tr("There is no project.json in this folder: choose one called "
                          "NAME.lararium."));
}

bool WideButton(const char* label, bool important) {
  if (important) {
    ImGui::PushStyleColor(ImGuiCol_Button, Colours().chosen);
  }
  const bool chosen = ImGui::Button(label, ImVec2(-FLT_MIN, Px(38)));
  if (important) {
    ImGui::PopStyleColor();
  }
  return chosen;
}

// The part of a picture that fills a rectangle with another aspect ratio.
std::pair<ImVec2, ImVec2> Cover(const cv::Mat& picture, const ImVec2& size) {
  const float picture_ratio = static_cast<float>(picture.cols) / static_cast<float>(picture.rows);
  const float ratio = size.x / size.y;
  const float u = std::min(1.0f, ratio / picture_ratio);
  const float v = std::min(1.0f, picture_ratio / ratio);
  return {ImVec2(0.5f - 0.5f * u, 0.5f - 0.5f * v), ImVec2(0.5f + 0.5f * u, 0.5f + 0.5f * v)};
}

// Whether the keyboard focus is on the item with this label, wherever the pointer is.
bool HasKeyboard(const char* label) {
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  return !g.NavDisableHighlight && g.NavId == ImGui::GetID(label);
}

}  // namespace

void StartPage::Look(const editor::RecentProjects& recent) {
  if (looked_ >= 0.0 && ImGui::GetTime() < looked_ + kListCheckInterval) {
    return;
  }
  looked_ = ImGui::GetTime();
  for (const editor::RecentProject& project : recent.entries()) {
    Face& face = faces_[project.folder];
    face.exists = editor::IsProject(project.folder);
    if (face.picture == nullptr) {
      if (std::optional<cv::Mat> picture = editor::LoadProjectPicture(project.folder)) {
        face.picture = std::make_shared<const cv::Mat>(std::move(*picture));
      }
    }
  }
}

void StartPage::HandleKeys(const editor::RecentProjects& recent,
                           std::span<const KeyPress> keys,
                           StartChoice& choice) {
  for (const KeyPress& press : keys) {
    const KeyAction action = ActionOf(KeyScope::kAlways, press);
    if (action == KeyAction::kQuit) {
      choice.kind = StartChoice::Kind::kQuit;
    }
    if (has_dialog()) {
      continue;
    }
    if (action == KeyAction::kKeyList) {
      OpenDialog(Open::kKeys, recent);
      continue;
    }
    const KeyAction of_start = ActionOf(KeyScope::kStart, press);
    if (of_start == KeyAction::kOpenProject) {
      OpenDialog(Open::kProject, recent);
    }
    using From = NewProjectDialog::From;
    constexpr std::pair<KeyAction, From> kOpens[] = {{KeyAction::kNewProject, From::kVideo},
                                                     {KeyAction::kNewFromImages, From::kImages},
                                                     {KeyAction::kNewFromCamera, From::kCamera},
                                                     {KeyAction::kNewEmpty, From::kNothing}};
    for (const auto& [opens, from] : kOpens) {
      if (of_start == opens) {
        BeginNew(from, recent);
      }
    }
  }
}

void StartPage::OpenDialog(Open dialog, const editor::RecentProjects& recent) {
  dialog_ = dialog;
  problem_.clear();
  folder_ = UsualFolder(recent).string();
}

void StartPage::BeginNew(NewProjectDialog::From from,
                         const editor::RecentProjects& recent,
                         const fs::path& recording) {
  problem_.clear();
  new_.Open(from, UsualFolder(recent), recording);
}

void StartPage::DrawActions(const editor::RecentProjects& recent,
                            bool has_sample,
                            editor::Settings& settings,
                            StartChoice& choice) {
  ImGui::PushFont(ThemeFonts().title);
  ImGui::TextUnformatted("Lararium");
  ImGui::PopFont();
  Hint(Tr("People of the past, where they lived."));
  ImGui::Dummy(ImVec2(0, Px(12)));
  if (WideButton(Tr("New from video\xe2\x80\xa6"), true)) {
    BeginNew(NewProjectDialog::From::kVideo, recent);
  }
  if (WideButton(Tr("New from images\xe2\x80\xa6"), false)) {
    BeginNew(NewProjectDialog::From::kImages, recent);
  }
  if (WideButton(Tr("New from camera\xe2\x80\xa6"), false)) {
    BeginNew(NewProjectDialog::From::kCamera, recent);
  }
  if (WideButton(Tr("New, empty\xe2\x80\xa6"), false)) {
    BeginNew(NewProjectDialog::From::kNothing, recent);
  }
  ImGui::Dummy(ImVec2(0, Px(8)));
  if (WideButton(Tr("Open\xe2\x80\xa6"), false)) {
    OpenDialog(Open::kProject, recent);
  }
  ImGui::BeginDisabled(!has_sample);
  if (WideButton(Tr("Open the sample"), false)) {
    choice.kind = StartChoice::Kind::kSample;
  }
  ImGui::EndDisabled();
  Tooltip(has_sample ? Tr("Your own copy of a street kitchen in Pompeii with five people, "
                          "and a tour of it: change whatever you like.")
                     : Tr("The sample was not installed with this program."));
  ImGui::Dummy(ImVec2(0, Px(20)));
  DrawLook(settings);
}

const std::shared_ptr<const cv::Mat>& StartPage::OwnPicture(const std::string& name) {
  const auto [entry, added] = own_pictures_.try_emplace(name);
  if (added) {
    const fs::path folder = ShippedData("lararium/start", "editor/panels/dialogs/start");
    auto picture = image::ReadImage(folder / (name + ".jpg"), image::Channels::kBgr);
    if (picture.ok()) {
      entry->second = std::make_shared<const cv::Mat>(*std::move(picture));
    }
  }
  return entry->second;
}

void StartPage::DrawPicture(const std::string& key,
                            const std::shared_ptr<const cv::Mat>& picture,
                            const ImVec2& size,
                            bool faded) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const ImVec2 to(from.x + size.x, from.y + size.y);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (picture != nullptr) {
    const auto [first, last] = Cover(*picture, size);
    draw.AddImageRounded(pictures_.Show(key, picture), from, to, first, last,
                         IM_COL32(255, 255, 255, faded ? 90 : 255),
                         ImGui::GetStyle().FrameRounding);
  } else {
    draw.AddRectFilled(from, to, Packed(Colours().frame), ImGui::GetStyle().FrameRounding);
    const char* text = Tr("No picture yet");
    const ImVec2 extent = ImGui::CalcTextSize(text);
    draw.AddText(ImVec2(from.x + 0.5f * (size.x - extent.x), from.y + 0.5f * (size.y - extent.y)),
                 Packed(Colours().dim), text);
  }
  ImGui::Dummy(size);
}

StartPage::Card StartPage::BeginCard(const ImVec2& size, bool possible) {
  Card card{ImGui::GetCursorScreenPos(), size};
  const ImVec2 to(card.from.x + size.x, card.from.y + size.y);
  if (possible) {
    card.clicked = ImGui::InvisibleButton("open", size);
    ImGui::SetItemAllowOverlap();  // The buttons of the card lie over it.
    card.hovered = ImGui::IsItemHovered();
  }
  ImGui::GetWindowDrawList()->AddRectFilled(
      card.from, to, Packed(card.hovered ? Colours().hover : Colours().panel), Px(6));
  ImGui::SetCursorScreenPos(ImVec2(card.from.x + Px(kPad), card.from.y + Px(kPad)));
  ImGui::BeginGroup();
  return card;
}

void StartPage::EndCard(const Card& card) {
  ImGui::EndGroup();
  ImGui::SetCursorScreenPos(card.from);
  ImGui::Dummy(card.size);
}

void StartPage::DrawCard(editor::RecentProjects& recent,
                         const editor::RecentProject& project,
                         float width,
                         StartChoice& choice) {
  const Face& face = faces_[project.folder];
  const float inner = width - 2 * Px(kPad);
  ImGui::PushID(project.folder.c_str());
  const Card card = BeginCard(ImVec2(width, CardHeight(width)), face.exists);
  DrawPicture(project.folder.string(), face.picture, ImVec2(inner, inner * kSampleRatio),
              !face.exists);
  if (face.exists) {
    Heading(Elided(project.title, inner).c_str());
  } else {
    DimText(Elided(project.title, inner));
  }
  DimText(ElidedFront(FolderText(project.folder), inner));
  Tooltip(project.folder);
  if (face.exists) {
    DimText(DateText(project.opened));
    ImGui::SameLine(inner - ImGui::CalcTextSize(Tr("Forget")).x - Px(8));
  } else if (ImGui::SmallButton(Tr("Locate\xe2\x80\xa6"))) {
    OpenDialog(Open::kLocate, recent);
    missing_ = project.folder;
  }
  bool forget = false;
  if (!face.exists) {
    ImGui::SameLine();
    forget = ImGui::SmallButton(Tr("Forget"));
    ImGui::SameLine();
    ImGui::TextColored(Colours().warning, "%s", Tr("not there"));
  } else if (card.hovered || HasKeyboard(Tr("Forget"))) {
    forget = ImGui::SmallButton(Tr("Forget"));
    Tooltip(Tr("Takes it off this list. The project itself stays."));
  } else {
    ImGui::NewLine();
  }
  EndCard(card);
  ImGui::PopID();
  if (forget) {
    const fs::path folder = project.folder;  // The list changes below.
    problem_ = recent.Forget(folder).message();
  } else if (card.clicked) {
    choice.kind = StartChoice::Kind::kOpen;
    choice.project = project.folder;
  }
}

void StartPage::DrawSampleCard(float width, StartChoice& choice) {
  const float inner = width - 2 * Px(kPad);
  ImGui::PushID("sample");
  const Card card = BeginCard(ImVec2(width, CardHeight(width)), true);
  DrawPicture("sample", OwnPicture("sample"), ImVec2(inner, inner * kSampleRatio));
  Heading(Elided(Tr(kSampleTitle), inner).c_str());
  DimText(Elided(Tr("The sample, with a tour"), inner));
  EndCard(card);
  ImGui::PopID();
  if (card.clicked) {
    choice.kind = StartChoice::Kind::kSample;
  }
}

void StartPage::DrawSample(StartChoice& choice) {
  Heading(Tr("Look at a finished one first"));
  ImGui::Dummy(ImVec2(0, Px(2)));
  const float room = ImGui::GetContentRegionAvail().x;
  const char* text =
      Tr("A street kitchen in Pompeii: five people, who speak Latin, and twenty-three things that "
         "they use. Opens your own copy, so change whatever you like. A tour leads through it.");
  const bool beside = room >= Px(3 * kNarrowestStep);
  const float inner = room - 2 * Px(kPad);
  const float picture = beside ? 0.5f * inner : inner;
  const float column = beside ? inner - picture - Px(kGap) : inner;
  const float words = ImGui::GetTextLineHeightWithSpacing() + WrappedHeight(text, column) + Px(12) +
                      ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().ItemSpacing.y;
  const float height = beside ? std::max(picture * kSampleRatio, words)
                              : picture * kSampleRatio + words + ImGui::GetStyle().ItemSpacing.y;
  ImGui::PushID("sample");
  const Card card = BeginCard(ImVec2(room, height + 2 * Px(kPad)), true);
  DrawPicture("sample", OwnPicture("sample"), ImVec2(picture, picture * kSampleRatio));
  if (beside) {
    ImGui::SameLine(0.0f, Px(kGap));
  }
  ImGui::BeginGroup();
  Heading(Elided(Tr(kSampleTitle), column).c_str());
  WrappedHint(text, column);
  ImGui::Dummy(ImVec2(0, Px(4)));
  ImGui::PushStyleColor(ImGuiCol_Button, Colours().chosen);
  const bool pressed = ImGui::Button(Label(Tr("Open the sample"), "button").c_str());
  ImGui::PopStyleColor();
  ImGui::EndGroup();
  EndCard(card);
  ImGui::PopID();
  if (card.clicked || pressed) {
    choice.kind = StartChoice::Kind::kSample;
  }
}

void StartPage::DrawIntroduction() {
  Heading(Tr("How it works"));
  ImGui::Dummy(ImVec2(0, Px(2)));
  const float room = ImGui::GetContentRegionAvail().x;
  const auto count = static_cast<float>(kIntroduction.size());
  // The text lies below the picture where three steps are beside each other, else at its right.
  const bool below = room >= count * Px(kNarrowestStep) + (count - 1) * Px(kGap);
  const float width = below ? (room - (count - 1) * Px(kGap)) / count : room;
  const float inner = width - 2 * Px(kPad);
  const float picture = below ? inner : std::min(Px(kNarrowestStep), 0.45f * inner);
  const float column = below ? inner : inner - picture - Px(kGap);
  float words = 0.0f;
  for (const IntroductionStep& step : kIntroduction) {
    words = std::max(words, WrappedHeight(Tr(step.text), column));
  }
  words += ImGui::GetTextLineHeightWithSpacing();
  const float height =
      below ? picture * kStepRatio + Px(kUnderPicture) + 2 * ImGui::GetStyle().ItemSpacing.y + words
            : std::max(picture * kStepRatio, words);
  for (const IntroductionStep& step : kIntroduction) {
    if (below && &step != &kIntroduction.front()) {
      ImGui::SameLine(0.0f, Px(kGap));
    }
    const Card card = BeginCard(ImVec2(width, height + 2 * Px(kPad)), false);
    DrawPicture(step.picture, OwnPicture(step.picture), ImVec2(picture, picture * kStepRatio));
    if (below) {
      ImGui::Dummy(ImVec2(0, Px(kUnderPicture)));
    } else {
      ImGui::SameLine(0.0f, Px(kGap));
    }
    ImGui::BeginGroup();
    Heading(Tr(step.title));
    WrappedHint(Tr(step.text), column);
    ImGui::EndGroup();
    EndCard(card);
  }
}

void StartPage::DrawCopying(const editor::BackgroundTask& copying, StartChoice& choice) {
  const editor::BackgroundTask::State state = copying.state();
  ImGui::TextUnformatted(editor::TaskText(copying.kind(), state).c_str());
  ImGui::ProgressBar(static_cast<float>(state.fraction), ImVec2(Px(320), Px(6)), "");
  if (ImGui::Button(Tr("Cancel"))) {
    choice.kind = StartChoice::Kind::kStopCopying;
  }
  ImGui::Dummy(ImVec2(0, Px(8)));
}

void StartPage::DrawRecent(editor::RecentProjects& recent, bool has_sample, StartChoice& choice) {
  Heading(Tr("Recent projects"));
  ImGui::Dummy(ImVec2(0, Px(2)));
  const float room = ImGui::GetContentRegionAvail().x;
  const int columns = std::max(1, static_cast<int>((room + Px(kGap)) / Px(kCard + kGap)));
  const float width = std::min(
      room, (room - static_cast<float>(columns - 1) * Px(kGap)) / static_cast<float>(columns));
  // Copied, because cards change the list.
  const std::vector<editor::RecentProject> entries = recent.entries();
  const bool own_sample = std::any_of(entries.begin(), entries.end(), [](const auto& project) {
    return editor::IsOwnSample(project.folder, editor::DataFolder());
  });
  const size_t cards = entries.size() + (has_sample && !own_sample ? 1 : 0);
  for (size_t i = 0; i < cards; ++i) {
    if (i % static_cast<size_t>(columns) != 0) {
      ImGui::SameLine(0.0f, Px(kGap));
    } else if (i > 0) {
      ImGui::Dummy(ImVec2(0, Px(kGap) - 2 * ImGui::GetStyle().ItemSpacing.y));
    }
    if (i < entries.size()) {
      DrawCard(recent, entries[i], width, choice);
    } else {
      DrawSampleCard(width, choice);
    }
  }
}

const char* StartPage::TitleOf(Open dialog) {
  switch (dialog) {
    case Open::kProject:
      return Tr("Open a project");
    case Open::kLocate:
      return Tr("Locate the project");
    case Open::kNothing:
    case Open::kKeys:
      break;
  }
  return "";
}

void StartPage::ProjectDialog(editor::RecentProjects& recent, StartChoice& choice) {
  const bool locate = dialog_ == Open::kLocate;
  Hint(locate ? Text(Tr("Where is the project now that was in %s?"), missing_.c_str())
              : Tr("A project is a folder with project.json in it, called NAME.lararium."));
  if (BeginProperties("project")) {
    PropertyLabel(Tr("Folder"));
    PathField("folder", folder_, editor::HomeFolder(), FileType::kProject);
    EndProperties();
  }
  const fs::path project = editor::HomeFolder() / folder_;
  const DialogAnswer answer =
      DialogButtons(locate ? Tr("Locate") : Tr("Open"), FolderProblem(project));
  if (answer != DialogAnswer::kNone) {
    dialog_ = Open::kNothing;
  }
  if (answer == DialogAnswer::kAct && locate) {
    problem_ = recent.Move(missing_, project).message();
    looked_ = -1.0;
  } else if (answer == DialogAnswer::kAct) {
    choice.kind = StartChoice::Kind::kOpen;
    choice.project = project;
  }
}

void StartPage::DrawDialog(editor::RecentProjects& recent,
                           std::span<const KeyPress> keys,
                           StartChoice& choice) {
  if (dialog_ == Open::kKeys && !DrawKeyList(keys)) {
    dialog_ = Open::kNothing;
  }
  if (std::optional<NewProject> made = new_.Show(pictures_)) {
    choice.kind = StartChoice::Kind::kNew;
    choice.made = *std::move(made);
  }
  if (dialog_ == Open::kNothing || dialog_ == Open::kKeys) {
    return;
  }
  bool open = true;
  DrawModal(Label(TitleOf(dialog_), "dialog").c_str(), 560, open, [&] {
    ProjectDialog(recent, choice);
    open = dialog_ != Open::kNothing;
  });
  if (!open) {
    dialog_ = Open::kNothing;
  }
}

StartChoice StartPage::Show(editor::RecentProjects& recent,
                            std::span<const KeyPress> keys,
                            bool has_sample,
                            const editor::BackgroundTask* copying,
                            editor::Settings& settings) {
  StartChoice choice;
  HandleKeys(recent, keys, choice);
  Look(recent);
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->WorkPos);
  ImGui::SetNextWindowSize(viewport->WorkSize);
  const float width = std::min(viewport->WorkSize.x - 2 * Px(24), Px(kWidestPage));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(0.5f * (viewport->WorkSize.x - width), Px(40)));
  ImGui::Begin("Start", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar();
  ImGui::BeginChild("actions", ImVec2(Px(kActions), 0), false, ImGuiWindowFlags_NavFlattened);
  DrawActions(recent, has_sample, settings, choice);
  ImGui::EndChild();
  ImGui::SameLine(0.0f, Px(48));
  ImGui::BeginChild("recent", ImVec2(0, 0), false, ImGuiWindowFlags_NavFlattened);
  if (!problem_.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, Colours().error);
    ImGui::TextWrapped("%s", problem_.c_str());
    ImGui::PopStyleColor();
    ImGui::Dummy(ImVec2(0, Px(8)));
  }
  if (copying != nullptr) {
    DrawCopying(*copying, choice);
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(Px(8), Px(4)));
  const ImVec2 between(0, Px(16));
  if (!recent.entries().empty()) {
    DrawRecent(recent, has_sample, choice);
    ImGui::Dummy(between);
  }
  DrawIntroduction();
  if (recent.entries().empty() && has_sample) {
    ImGui::Dummy(between);
    DrawSample(choice);
  }
  ImGui::PopStyleVar();
  ImGui::EndChild();
  DrawDialog(recent, keys, choice);
  ImGui::End();
  if (choice.kind != StartChoice::Kind::kNothing) {
    problem_.clear();
  }
  return choice;
}

}  // namespace lararium::panels
