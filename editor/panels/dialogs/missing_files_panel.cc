#include "editor/panels/dialogs/missing_files_panel.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "editor/panels/dialogs/dialogs.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"
#include "shared/core/file.h"

namespace lararium::panels {

namespace {

constexpr double kFileCheckInterval = 1.0;  // seconds
FileType TypeOf(editor::FileKind kind) {
  switch (kind) {
    case editor::FileKind::kVideo:
      return FileType::kVideo;
    case editor::FileKind::kImages:
      return FileType::kImages;
    case editor::FileKind::kModel:
      return FileType::kModel;
    case editor::FileKind::kProbe:
      return FileType::kProbe;
    case editor::FileKind::kClip:
      return FileType::kClip;
    case editor::FileKind::kBones:
      return FileType::kBones;
    case editor::FileKind::kSound:
      break;
  }
  return FileType::kSound;
}

constexpr size_t kMostListed = 8;  // The number of other moved files that are listed by name.

// was: the path that is typed when the dialog opens; it names no file that exists.
DialogProblem LocateProblem(const editor::ProjectPaths& paths,
                            editor::FileKind kind,
                            const std::string& was,
                            const std::string& typed) {
  std::error_code ignored;
  const std::filesystem::path file = paths.Resolve(typed);
  const bool folder = std::filesystem::is_directory(file, ignored);
  if (typed.empty() || typed == was) {
    return Missing(Tr("Choose a file."));
  }
  if (!FileExists(file)) {
    return Wrong(Tr("Choose a file that exists."));
  }
  if (folder != (kind == editor::FileKind::kImages)) {
    return Wrong(folder ? Tr("This is a folder; choose a file in it.")
                        : Tr("Choose a folder of images."));
  }
  return {};
}

}  // namespace

void MissingFilesPanel::Look(const editor::Workspace& workspace) {
  if (looked_ < 0.0 || ImGui::GetTime() > looked_ + kFileCheckInterval) {
    looked_ = ImGui::GetTime();
    const editor::DramaRun* run = workspace.dry_run().newest();
    missing_ = editor::MissingFiles(workspace.project().paths(), workspace.project().document(),
                                    run != nullptr
                                        ? std::span<const editor::MissingSound>(run->missing_sounds)
                                        : std::span<const editor::MissingSound>());
  }
}

void MissingFilesPanel::FillOffers(const editor::Workspace& workspace,
                                   const editor::Relocation& located) {
  if (offered_for_ != located.to) {
    offered_for_ = located.to;
    offers_ = editor::SameMove(workspace.project().paths(), missing_, located);
  }
}

void MissingFilesPanel::DrawRow(const editor::Workspace& workspace,
                                const editor::MissingFile& file) {
  ImGui::PushID(file.path.c_str());
  if (ImGui::Button(Tr("Locate\xe2\x80\xa6"))) {
    locating_ = file;
    const std::filesystem::path was = workspace.project().paths().Resolve(file.path);
    std::error_code ignored;
    typed_ = std::filesystem::is_directory(was.parent_path(), ignored)
                 ? was.string()
                 : workspace.project().paths().folder.string();
    was_ = typed_;
    offered_for_.clear();
    offers_.clear();
    take_offers_ = true;
  }
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(Elided(file.shown, 0.5f * ImGui::GetContentRegionAvail().x).c_str());
  ImGui::SameLine(0.0f, Px(12));
  DimText(ElidedFront(file.path, ImGui::GetContentRegionAvail().x));
  ImGui::PopID();
}

void MissingFilesPanel::DrawDialog(editor::Workspace& workspace) {
  const editor::ProjectPaths& paths = workspace.project().paths();
  if (locating_->kind == editor::FileKind::kSound) {
    Hint(Text(Tr("Which recording is %s? It is copied into the project's audio folder."),
              locating_->shown.c_str()));
  } else {
    Hint(Text(Tr("Where is %s now? It was in %s."), locating_->shown.c_str(),
              paths.Resolve(locating_->path).c_str()));
  }
  if (BeginProperties("locate")) {
    PropertyLabel(locating_->kind == editor::FileKind::kImages ? Tr("Folder") : Tr("File"));
    PathField("file", typed_, paths.folder, TypeOf(locating_->kind));
    EndProperties();
  }
  const DialogProblem problem = LocateProblem(paths, locating_->kind, was_, typed_);
  const editor::Relocation located{locating_->path,
                                   typed_.empty() ? "" : paths.Shorten(paths.Resolve(typed_))};
  if (!problem.any()) {
    FillOffers(workspace, located);
  }
  if (!problem.any() && !offers_.empty()) {
    const std::string label = TrCount("Also %d other that moved along",
                                      "Also %d others that moved "
                                      "along",
                                      static_cast<int>(offers_.size()));
    ImGui::Checkbox(label.c_str(), &take_offers_);
    for (size_t i = 0; i < offers_.size() && i < kMostListed; ++i) {
      DimText("    " + ElidedFront(offers_[i].to, ImGui::GetContentRegionAvail().x - Px(24)));
    }
  }
  const DialogAnswer answer = DialogButtons(Tr("Locate"), problem);
  if (answer == DialogAnswer::kAct) {
    std::vector<editor::Relocation> moves = {located};
    if (take_offers_) {
      moves.insert(moves.end(), offers_.begin(), offers_.end());
    }
    Take(workspace, moves);
  }
  if (answer != DialogAnswer::kNone) {
    locating_.reset();
  }
}

// Copies sounds; for other files, changes the paths of the document as one edit.
void MissingFilesPanel::Take(editor::Workspace& workspace,
                             std::span<const editor::Relocation> moves) {
  std::vector<editor::Relocation> renamed;
  for (const editor::Relocation& move : moves) {
    const bool sound = std::any_of(missing_.begin(), missing_.end(), [&](const auto& file) {
      return file.kind == editor::FileKind::kSound && file.path == move.from;
    });
    if (sound) {
      workspace.project().BringInSound(std::filesystem::path(move.from).filename().string(),
                                       workspace.project().paths().Resolve(move.to));
    } else {
      renamed.push_back(move);
    }
  }
  if (!renamed.empty()) {
    const std::string name = std::filesystem::path(renamed.front().to).filename().string();
    workspace.project().Edit(Sentence("locate %s", {name}), [&](editor::ProjectDocument& document) {
      for (const editor::Relocation& move : renamed) {
        editor::Relocate(move, document);
      }
    });
  }
  looked_ = -1.0;
}

void MissingFilesPanel::Show(editor::Workspace& workspace) {
  if (!missing_.empty()) {
    Heading(TrCount("%d file is not where the project says",
                    "%d files are not where the project "
                    "says",
                    count())
                .c_str());
    for (const editor::MissingFile& file : missing_) {
      DrawRow(workspace, file);
    }
    ImGui::Dummy(ImVec2(0, Px(6)));
  }
  if (locating_) {
    bool open = true;
    DrawModal(Label(Tr("Locate a file"), "locate").c_str(), 620, open, [&] {
      DrawDialog(workspace);
      open = locating_.has_value();
    });
    if (!open) {
      locating_.reset();
    }
  }
}

}  // namespace lararium::panels
