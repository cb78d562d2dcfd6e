#include <algorithm>
#include <utility>

#include "editor/check/project_check.h"
#include "editor/document/file_stamp.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/exporting.h"
#include "editor/jobs/sounds.h"
#include "editor/session/player_trial.h"
#include "editor/session/workspace.h"

namespace lararium::editor {

void Workspace::RunDramaAgain() {
  constexpr double kPause = 1.0;       // Seconds without edits.
  constexpr double kBehind = 30.0;     // Seconds after the last item.
  constexpr double kShortest = 240.0;  // Seconds; for a drama whose length only its script knows.
  const bool wanted = stage_changed_ || run_script_ != script_.revision();
  if (!wanted || since_script_ < kPause || tasks_.Running(TaskKind::kOpening) ||
      cast_pictures_.Working() || document().cast.empty()) {
    return;
  }
  if (tasks_.Running(TaskKind::kDryRun)) {
    tasks_.Cancel(TaskKind::kDryRun);  // The result would be outdated.
    return;
  }
  const auto run = std::make_shared<DramaRun>();
  const double seconds =
      std::min(std::max(script_.duration() + kBehind, kShortest), drama::Drama::kMaxTime);
  const auto work = [run, paths = paths_, document = commands_.snapshot(),
                     script = script_.snapshot(), seconds](Progress& progress) {
    run->missing_sounds = FindMissingSounds(paths, *document, *script);
    LARARIUM_ASSIGN_OR_RETURN(DramaRun played,
                              RunDrama(paths, *document, "", *script, seconds, progress));
    played.missing_sounds = std::move(run->missing_sounds);
    *run = std::move(played);
    return Status();
  };
  const auto done = [this, run, revision = script_.revision()](const Status& status,
                                                               bool cancelled) {
    if (cancelled) {
      return;
    }
    if (!status.ok()) {
      run->problems.push_back(status.message());
      if (drama_run_ != nullptr) {  // Keeps the last result until there is a newer one.
        run->tasks = drama_run_->tasks;
        run->words = drama_run_->words;
        run->last = drama_run_->last;
        run->trails = drama_run_->trails;
        run->floor = drama_run_->floor;
      }
    } else {
      played_script_ = revision;
    }
    drama_run_ = run;
    ++drama_run_number_;
  };
  if (tasks_.Start(TaskKind::kDryRun, work, done)) {
    run_script_ = script_.revision();
    stage_changed_ = false;
  }
}

void Workspace::Check() {
  const auto result = std::make_shared<CheckedProject>();
  tasks_.Start(
      TaskKind::kChecking,
      [result, project = paths_.folder](Progress& progress) {
        CheckOptions options;
        options.project = project;
        LARARIUM_ASSIGN_OR_RETURN(*result, CheckProject(options, progress));
        return Status();
      },
      [this, result](const Status& status, bool cancelled) {
        if (cancelled) {
          return;
        }
        checked_ = true;
        problems_ = std::move(result->problems);
        warnings_ = std::move(result->warnings);
        if (!status.ok()) {
          problems_ = {status.message()};
        }
      });
}

bool Workspace::BringInSound(const std::string& name, const std::filesystem::path& file) {
  if (const Status status = editor::BringInSound(paths_, name, file); !status.ok()) {
    Tell(Message::Level::kError, status.message());
    return false;
  }
  Tell(Message::Level::kInfo,
       Text(Tr("Copied %s into the project's audio folder"), file.filename().c_str()));
  stage_changed_ = true;
  preview_stale_ = true;
  return true;
}

// Pictures of objects wait for the preview's first picture and for the dry run: each needs tens of
// megabytes, and both processor cores while shaders are compiled.
void Workspace::AskForPictures() {
  cast_pictures_.SetCast(document().cast);
  const bool opens =
      map_stale_ || tasks_.Running(TaskKind::kOpening) || tasks_.Running(TaskKind::kDryRun);
  const bool has_picture = picture_ != nullptr || !(preview_stale_ || awaiting_picture_);
  if (!opens && has_picture) {
    cast_pictures_.SetObjects(document().objects);
  }
}

void Workspace::TellOfPictures() {
  for (const std::string& warning : cast_pictures_.TakeWarnings()) {
    Tell(Message::Level::kWarning, warning);
  }
  for (const Status& problem : cast_pictures_.TakeProblems()) {
    Tell(Message::Level::kError, problem.message());
  }
}

const CastCatalogue* Workspace::catalogue() {
  if (catalogue_ != nullptr || !catalogue_problem_.empty()) {
    return catalogue_.get();
  }
  const std::optional<std::filesystem::path> folder = FindCastLibrary();
  if (!folder) {
    catalogue_problem_ =
        Tr("The cast library is not installed; fetch it with scripts/fetch_cast_library.sh.");
    return nullptr;
  }
  const auto listed = std::make_shared<CastCatalogue>();
  tasks_.Start(
      TaskKind::kCatalogue,
      [listed, folder = *folder](Progress&) {
        LARARIUM_ASSIGN_OR_RETURN(const import::CastLibrary library,
                                  import::CastLibrary::Open(folder));
        LARARIUM_ASSIGN_OR_RETURN(*listed, ListCast(library));
        return Status();
      },
      [this, listed](const Status& status, bool) {
        if (status.ok()) {
          catalogue_ = listed;
        } else {
          catalogue_problem_ = status.message();
        }
      });
  return nullptr;
}

const BoneReview* Workspace::bone_review(const CastDocument& member) {
  CastDocument figure = member;
  figure.voice = {};  // The voice does not change the bones.
  std::string key = FormatCastMember(figure).dump() + FileStamp(paths_.Resolve(member.model)) +
                    FileStamp(paths_.Resolve(member.bone_map));
  if (key != review_key_) {
    const auto review = std::make_shared<BoneReview>();
    const auto work = [review, paths = paths_, member](Progress&) {
      LARARIUM_ASSIGN_OR_RETURN(*review, ReviewBones(paths, member));
      return Status();
    };
    const auto done = [this, review, name = member.name](const Status& status, bool cancelled) {
      if (!status.ok()) {
        Report(status, cancelled, "");
        return;
      }
      review_ = review;
      reviewed_name_ = name;
    };
    if (tasks_.Start(TaskKind::kBoneReview, work, done)) {
      review_key_ = std::move(key);
    }
  }
  return reviewed_name_ == member.name ? review_.get() : nullptr;
}

const ProbePicture* Workspace::probe_picture(const ProbeDocument& probe) {
  const std::filesystem::path file = paths_.Resolve(probe.file);
  std::string key = file.string() + FileStamp(file);
  if (key != probe_key_) {
    const auto picture = std::make_shared<ProbePicture>();
    const auto work = [picture, file](Progress&) {
      LARARIUM_ASSIGN_OR_RETURN(*picture, LoadProbePicture(file));
      return Status();
    };
    const auto done = [this, picture, key](const Status& status, bool) {
      if (status.ok()) {
        probe_picture_ = picture;
        pictured_probe_ = key;
      } else if (key == probe_key_) {
        probe_problem_ = status.message();
      }
    };
    if (tasks_.Start(TaskKind::kProbe, work, done)) {
      probe_problem_.clear();
      probe_key_ = key;
    }
  }
  return pictured_probe_ == key ? probe_picture_.get() : nullptr;
}

void Workspace::SaveBones(const CastDocument& member) {
  if (review_ == nullptr || reviewed_name_ != member.name ||
      tasks_.Running(TaskKind::kBoneReview)) {
    return;  // The present result is not of the member's current bones.
  }
  if (const Status status = SaveBoneMap(paths_, member, *review_); !status.ok()) {
    Tell(Message::Level::kError, status.message());
    return;
  }
  const std::filesystem::path file = BoneMapFile(paths_, member);
  Edit(Text(Tr("save the bones of %s"), member.name.c_str()), [&](ProjectDocument& document) {
    for (CastDocument& known : document.cast) {
      if (known.name == member.name) {
        known.bone_map = paths_.Shorten(file);
        known.bones.clear();
      }
    }
  });
  Tell(Message::Level::kInfo, Text(Tr("Wrote %s"), file.c_str()));
}

void Workspace::Bake() {
  const auto report = std::make_shared<BakeReport>();
  tasks_.Start(
      TaskKind::kBaking,
      [report, paths = paths_, document = commands_.snapshot(),
       baking = baking_](Progress& progress) {
        const std::lock_guard turn(*baking);
        LARARIUM_ASSIGN_OR_RETURN(*report, editor::Bake(paths, *document, progress));
        return Status();
      },
      [this, report](const Status& status, bool cancelled) {
        for (const std::string& warning : report->warnings) {
          Tell(Message::Level::kWarning, warning);
        }
        Report(status, cancelled,
               Text(Tr("Baked %d, %d were up to date."), static_cast<int>(report->baked.size()),
                    static_cast<int>(report->unchanged.size())));
        preview_key_.clear();
        preview_stale_ = true;
      });
}

void Workspace::Export(const ExportRequest& request) {
  Save();  // The drama is packed from its file.
  if (changed_outside() || commands_.dirty()) {
    export_problem_ = messages_.back().text;
    return;
  }
  const auto shown = std::make_shared<ExportedShow>();
  shown->file = request.out;
  export_problem_.clear();
  tasks_.Start(
      TaskKind::kExporting,
      [paths = paths_, document = commands_.snapshot(), request, shown,
       baking = baking_](Progress& progress) -> Status {
        const std::lock_guard turn(*baking);
        LARARIUM_RETURN_IF_ERROR(ExportProject(paths, *document, request, progress));
        LARARIUM_ASSIGN_OR_RETURN(shown->contents, ReadBundleSummary(request.out));
        return Status();
      },
      [this, shown](const Status& status, bool cancelled) {
        Report(status, cancelled, Text(Tr("Wrote %s"), shown->file.c_str()));
        if (status.ok() && !cancelled) {
          exported_ = shown;
        } else {
          export_problem_ =
              cancelled ? std::string(Tr("The export was cancelled.")) : status.message();
        }
      });
}

void Workspace::TryShow() {
  if (exported_ == nullptr || place() == nullptr) {
    return;
  }
  tasks_.Start(
      TaskKind::kTrying,
      [arguments = TrialArguments(paths_, *place(), exported_->file)](Progress& progress) {
        return RunProgram(FindPlayer(), arguments, progress);
      },
      [this](const Status& status, bool cancelled) {
        if (!status.ok() && !cancelled) {
          Tell(Message::Level::kError, status.message());
        }
      });
}

}  // namespace lararium::editor
