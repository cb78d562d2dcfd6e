#pragma once

// An open project: its document with undo, the data of the current place, and the work in the
// background. It knows no windows; panels show it and call its commands. Use it from one thread
// only.

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/check/drama_run.h"
#include "editor/document/command_stack.h"
#include "editor/document/journal.h"
#include "editor/document/place_recordings.h"
#include "editor/document/project.h"
#include "editor/document/script_document.h"
#include "editor/jobs/background_task.h"
#include "editor/jobs/bone_review.h"
#include "editor/jobs/bundle_summary.h"
#include "editor/jobs/cast_catalogue.h"
#include "editor/jobs/picked_frames.h"
#include "editor/jobs/staging.h"
#include "editor/jobs/training_report.h"
#include "editor/session/cast_pictures.h"
#include "editor/session/frame_to_pick.h"
#include "editor/session/live_camera.h"
#include "editor/session/preview.h"
#include "editor/session/probe_picture.h"
#include "editor/text/text.h"
#include "editor/train/map_statistics.h"
#include "editor/train/mesh_alignment.h"
#include "editor/train/trainer.h"
#include "shared/core/log.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"
#include "shared/stage/place.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

struct Message {
  enum class Level { kInfo, kWarning, kError };
  Level level = Level::kInfo;
  std::string text;
};

// The loaded data of the current place. Replaced as a whole.
struct LoadedPlace {
  std::shared_ptr<const vision::SceneDatabase> database;   // nullptr: the place is not trained.
  std::shared_ptr<const train::MapStatistics> statistics;  // Statistics of database.
  MapMeasures measures;
  bool measured = false;  // The measures belong to this map and to the place's tags.
  ResolvedPicks picks;
  // The report of the training; nullptr: there is none.
  std::shared_ptr<const TrainingReport> report;
  bool has_previous = false;  // RestorePreviousMap() is possible.
  // The place as staged for the preview, with occluder meshes for drawing. nullptr before that.
  std::shared_ptr<const stage::Place> staged;
  // The probes at the time of staging, and their light. Edits apply rotation and brightness to it
  // immediately.
  std::vector<ProbeDocument> baked_probes;
  std::vector<light::PlacedProbe> baked_light;
};

class Workspace {
 public:
  // Reads the project, and edits that a crash left unsaved. log must outlive the result.
  static Result<std::unique_ptr<Workspace>> Open(ProjectPaths paths, Log& log);
  ~Workspace();

  const ProjectPaths& paths() const { return paths_; }
  const ProjectDocument& document() const { return commands_.document(); }
  using Commands = CommandStack<ProjectDocument, drama::TextEdit>;
  const Commands& commands() const { return commands_; }
  // The drama. Its edits share the command stack with those of the project.
  const ScriptDocument& script() const { return script_; }

  // The place that the views show; nullptr where the project has none.
  const PlaceDocument* place() const { return document().FindPlace(place_name_); }
  // Changes the place and keeps the moment of the drama.
  void SelectPlace(const std::string& name);
  const LoadedPlace& loaded() const { return loaded_; }

  // Edits of the document. gesture: see CommandStack::Edit.
  void Edit(const std::string& name,
            const std::function<void(ProjectDocument&)>& change,
            std::string_view gesture = {});
  void EditPlace(const std::string& name,
                 const std::function<void(PlaceDocument&)>& change,
                 std::string_view gesture = {});
  // Edits an occluder of the current place; does nothing where it has none of that name.
  void EditOccluder(const std::string& name,
                    const std::string& occluder,
                    const std::function<void(OccluderDocument&)>& change,
                    std::string_view gesture = {});
  // Levels the stage on the floor that was found in the map; does nothing where there is none.
  void LayStageOnFloor();
  // The frame in the camera view as an image for picks.
  FrameToPick frame_to_pick() const;
  // Adds the frame to the map's images, unless it is one already, so that picks in it count. The
  // map's file is written later.
  void KeepFrame(const vision::Keyframe& keyframe);
  // Scales the stage about its origin so that two points of the map are the given number of metres
  // apart. Does nothing where the points coincide, or where the scale would be out of range.
  void SetDistance(uint32_t from, uint32_t to, double metres);
  // Edits of the drama. Returns false, and adds a message, where the change fails.
  bool EditTimeline(const std::string& name,
                    const std::function<Status(drama::TimelineText&)>& change,
                    std::string_view gesture = {});
  void EditScript(const std::string& name, std::string text, std::string_view gesture = {});
  // Edits the table of lines, document().lines, which must not be nullptr. Its file is written
  // shortly after the last edit, even when the project is not saved, because voices are made from
  // it. If the edited table could not be read back, nothing changes and a message tells why.
  void EditLines(const std::string& name, bake::LineTable table, std::string_view gesture = {});
  void EndGesture() { commands_.EndGesture(); }
  // Undoes the current gesture; does nothing outside a gesture.
  void CancelGesture();
  void Undo();
  void Redo();
  void Save();

  // Whether other programs changed files of the project while there are unsaved edits, or made them
  // unreadable. Nothing is saved until the user has chosen between both versions.
  bool changed_outside() const {
    return outside_script_.has_value() || outside_project_ || !outside_damage().empty();
  }
  // Why the changed files cannot be read; empty: they can.
  const std::string& outside_damage() const {
    return script_damage_.empty() ? project_damage_ : script_damage_;
  }
  // Adopts the content of the files as an edit. Only where they can be read.
  void AdoptExternal();
  // Keeps the state of this window; saving will overwrite the files. A file that cannot be read is
  // kept as NAME.damaged.
  void KeepLocal();

  // Long work. tasks() has its progress, messages() its result.
  void Train();  // Trains the current place from its recordings.
  // Trains the place of that name from another first recording; adds the place where it does not
  // exist. Where the place already has a map, the document changes only after a successful
  // training, and the change cannot be undone.
  void TrainFrom(const std::string& place, const SessionDocument& recording);
  // Merges a further recording into the map of the current place. The document changes only
  // afterwards, and the change cannot be undone.
  void AddSession(const SessionDocument& session);
  // Removes recording 1 or higher from the map of the current place. The document changes only
  // afterwards, and the change cannot be undone, because the map cannot get the recording back. Ask
  // the user first.
  void RemoveSession(uint32_t session);
  // Exchanges the map of the current place, and its recordings in the document, with the map from
  // before its last training. This is not part of undo; a second call reverses it.
  void RestorePreviousMap();
  // Returns true once after each training in this window, when its map and report are loaded.
  bool TakeNewReport() { return std::exchange(report_is_new_, false); }
  void Bake();
  // Aligns the model of an occluder with the map's points within search_m metres. The result is an
  // edit, unless the model was moved meanwhile. The occluder must be staged.
  void RefineOccluder(const std::string& occluder, double search_m);
  // The last result for an occluder that has not moved since; nullptr otherwise. After a failure
  // stage_from_mesh is the unchanged alignment.
  struct Refinement {
    std::string place;
    std::string occluder;
    geometry::Similarity3 stage_from_mesh;
    Result<train::RefineReport> report;
  };
  const Refinement* refinement(const OccluderDocument& occluder) const;
  // Checks the saved project, like the subcommand check.
  void Check();
  bool checked() const { return checked_; }
  const std::vector<Sentence>& problems() const { return problems_; }
  // Findings of the check that are valid but possibly not intended.
  const std::vector<Sentence>& warnings() const { return warnings_; }
  // Saves the project first.
  void Export(const ExportRequest& request);
  // The last export of this window; nullptr before the first. export_problem(): why the last export
  // failed; empty where it did not.
  struct ExportedShow {
    std::filesystem::path file;
    BundleSummary contents;
  };
  const ExportedShow* exported() const { return exported_.get(); }
  const std::string& export_problem() const { return export_problem_; }
  // Opens the exported show in the player, at the current place.
  void TryShow();
  TaskList& tasks() { return tasks_; }
  bool tasks_empty() const { return tasks_.entries().empty(); }

  // Pictures of the project's people and objects.
  CastPictures& cast_pictures() { return cast_pictures_; }
  // The number of cast members who still have to be built or drawn.
  size_t PeopleLeft() const;
  // Whether the preview shows plain figures, or outdated ones, for some people.
  bool HasStandIns() const { return stand_ins_ > 0; }
  // The options of recipes, read at the first call. nullptr: not read yet, or the library is
  // missing; see catalogue_problem().
  const CastCatalogue* catalogue();
  const std::string& catalogue_problem() const { return catalogue_problem_; }
  // How the bones of an imported figure were assigned. Read at the first call and again when the
  // bone map changes; the old result stays until then. nullptr: not read yet, or reading failed.
  const BoneReview* bone_review(const CastDocument& member);
  // Copies a recording into the project for a missing sound. Returns false, and adds a message,
  // where it is not a sound file.
  bool BringInSound(const std::string& name, const std::filesystem::path& file);
  // Writes the current bone map into a file, and sets the member's bone_map to it.
  void SaveBones(const CastDocument& member);

  // The picture of a probe of the document, read at the first call and again when the file changes.
  // nullptr: not read yet, or it cannot be read; see probe_problem().
  const ProbePicture* probe_picture(const ProbeDocument& probe);
  const std::string& probe_problem() const { return probe_problem_; }
  // Measures noise and sharpness of the current place's images from its training recording. The
  // result is an edit.
  void MeasureCameraTraits();

  // Whether the camera view draws people with the camera's noise and blur.
  bool camera_look() const { return camera_look_; }
  void SetCameraLook(bool on);
  // Whether pictures include the images for comparison (PreviewPicture::plain).
  void SetCompare(bool compare);

  // Shows people and objects at other moments over the camera's picture; nullopt: off. There are
  // none while the drama plays.
  void SetOnionSkin(const std::optional<OnionSkin>& onion);

  // Whether the camera view shows the colours of the evidence view.
  bool shows_evidence() const { return evidence_; }
  void SetEvidence(bool on);
  // Whether audio descriptions are shown and played.
  bool descriptions() const { return descriptions_; }
  void SetDescriptions(bool on);
  // Whether the sound is audible during playback.
  bool sound() const { return sound_; }
  void SetSound(bool on) { sound_ = on; }

  // Playback of the drama, in a loop of duration(). time(): the moment that is shown, seconds.
  bool playing() const { return playing_; }
  void SetPlaying(bool playing) { playing_ = playing; }
  double time() const { return time_; }
  void SetTime(double seconds);
  // The maximum of the durations of the recording, the timeline and the dry run, seconds.
  double duration() const;
  // The result of the dry run of the drama's script; nullptr before the first one has ended. It
  // runs again shortly after each edit.
  const DramaRun* drama_run() const { return drama_run_.get(); }
  // Changes with each dry run.
  int64_t drama_run_number() const { return drama_run_number_; }
  // Whether the dry run played the present script.
  bool drama_run_is_current() const { return played_script_ == script_.revision(); }

  // The frame of the recording in the camera view. The recording starts again where it is shorter
  // than the drama.
  int64_t frame() const;
  void SetFrame(int64_t frame);
  // Moves the time by a number of frames of the recording, to the exact time of a frame.
  void StepFrames(int64_t frames);
  std::optional<PreviewSource> recording() const {
    return preview_ ? preview_->source() : std::nullopt;
  }
  // The source of the camera view. It is not saved: each place starts with its recording.
  enum class ViewSource { kRecording, kTraining, kLive };
  void SetViewSource(ViewSource source);
  ViewSource view_source() const { return view_source_; }
  // Shows a live camera by its number, or a recording that is played like a camera (live_camera.h).
  // The drama then runs by its own clock. Where the camera cannot be opened or ends, the view
  // returns to the recording and a message tells why.
  void PreviewLiveCamera(const std::string& camera);
  const std::string& live_camera() const { return live_camera_; }
  // False while the live camera is unplugged.
  bool camera_is_there() const { return *camera_presence_; }
  // Whether the place has a recording for the camera view that differs from the training recording.
  bool has_own_recording() const;
  // The newest picture; nullptr before the first.
  const std::shared_ptr<const PreviewPicture>& picture() const { return picture_; }

  const std::deque<Message>& messages() const { return messages_; }
  // The number of all messages so far, including those that were removed.
  uint64_t messages_told() const { return told_; }
  // Whether work is running that would be lost by closing the window.
  bool AtLongWork() const {
    return tasks_.Running(TaskKind::kTraining) || tasks_.Running(TaskKind::kExporting);
  }
  void Tell(Message::Level level, std::string text);

  // Updates everything. Call once for each frame of the interface. seconds: since the last call.
  void Update(double seconds);
  // The picture changes without input, so the interface must redraw soon.
  bool Busy() const { return playing_ || awaiting_picture_ || view_source_ == ViewSource::kLive; }

 private:
  Workspace(ProjectPaths paths, ProjectDocument document, std::string script, Log& log);

  void Recover();
  // Applies the content of a journal as an edit of the saved project.
  void TakeOver(JournalContent content);
  // Undo and redo of the part of a command that changes the drama.
  void ApplyToScript(const drama::TextEdit& edit);
  void NoteScriptEdit(const std::string& name, drama::TextEdit edit, std::string_view gesture);
  void Note(const Status& journal);
  // Removes the journal where all edits are saved.
  void DiscardIfSaved();
  void OnScriptChanged();
  // Detects changes of project.json, drama.lua and the table of lines by other programs.
  void DetectExternalChanges();
  // Reads the table of lines from its file, and writes it after edits.
  std::shared_ptr<const bake::LineTable> ReadLines();
  void WriteLines();
  std::string LinesStamp() const;
  void RunDramaAgain();

  // Orders pictures of the cast and the objects, and reports their problems.
  void AskForPictures();
  void TellOfPictures();
  void OnDocumentChanged();
  void ResolvePicksAgain();
  // Detects the floor and the tags, in the background.
  void MeasureAgain();
  // Identifies the inputs of the preview, which opens again when they change.
  std::string PreviewKey() const;
  void ReloadMap();
  // The map with additional frames, to be written to its file.
  struct UnsavedMap {
    std::filesystem::path file;
    std::string stamp;  // The stamp of the file before writing.
    std::shared_ptr<const vision::SceneDatabase> database;
  };
  void WriteMap();
  void ReloadPreview();
  void RequestPicture();
  Preview::Opener ViewOpener();
  // Whether the preview shows a stage that is about to be replaced, for example because a person
  // was added whom the drama already uses.
  bool StageIsOutdated() const;
  void AdvancePlayback(double seconds);
  // Returns false, and adds a message, while another task uses the map.
  bool MapIsFree();
  // Read the changes of other programs. A file that was deleted is written again.
  void LookAtScript();
  void LookAtProject();
  // Handles a file that cannot be read; damage receives the reason.
  void ReportUnreadable(const std::filesystem::path& file,
                        const std::string& problem,
                        std::string& damage);
  void KeepDamaged(const std::filesystem::path& file);
  // Trains the current place. recordings: those of its map after success.
  void StartTraining(std::function<Result<train::TrainReport>(Progress&)> work,
                     std::vector<TaskStep> steps,
                     const PlaceRecordings& recordings);
  void TrainWith(const PlaceRecordings& recordings);
  // Sets a fact about the place's map in the document, which cannot be undone.
  void NameRecordings(const std::string& place, const PlaceRecordings& recordings);
  void Report(const Status& status, bool cancelled, const std::string& success);

  ProjectPaths paths_;
  Log& log_;
  Commands commands_;
  ScriptDocument script_;
  std::shared_ptr<const std::string> saved_script_;
  Commands::Snapshot saved_project_;
  Journal journal_;
  std::string script_stamp_;  // Stamps of the files when they were last read or written.
  std::string project_stamp_;
  std::string lines_stamp_;
  std::shared_ptr<const bake::LineTable> written_lines_;
  double since_lines_ = 0.0;  // Seconds since the lines were edited.
  double since_edit_ = 0.0;   // Seconds since the project was edited.
  std::optional<std::string> outside_script_;
  std::shared_ptr<const ProjectDocument> outside_project_;
  std::string script_damage_;  // Why drama.lua cannot be read after another program changed it.
  // Why project.json cannot be read after another program changed it.
  std::string project_damage_;
  std::string place_name_;
  LoadedPlace loaded_;
  std::string picks_key_;
  std::string tags_key_;  // The key of the last measurement.
  bool measures_stale_ = false;
  std::string trained_place_;   // The place whose report is to be shown.
  bool report_is_new_ = false;  // The report of trained_place_ is loaded.
  std::string preview_key_;
  bool map_stale_ = false;
  std::optional<UnsavedMap> unsaved_map_;
  std::string scene_stamp_;  // Stamp of the map's file when it was last read or written.
  int64_t map_loads_ = 0;    // The number of times that a map was read.
  ViewSource view_source_ = ViewSource::kRecording;
  std::string live_camera_;
  std::shared_ptr<CameraPresence> camera_presence_ = std::make_shared<CameraPresence>(true);
  bool preview_stale_ = false;
  size_t stand_ins_ = 0;  // People in the preview who are drawn as a replacement.
  std::unique_ptr<Preview> preview_;
  std::shared_ptr<const PreviewPicture> picture_;
  int64_t requested_frame_ = -1;
  bool requested_sound_ = false;
  double requested_time_ = -1.0;
  int64_t requested_script_ = -1;  // Revision of the script in the last request.
  std::shared_ptr<const std::string> requested_text_;  // Text of the script in the last request.
  int64_t previewed_script_ = -1;                      // Revision that the preview was opened with.
  bool place_changed_ = true;
  bool camera_look_ = true;
  bool compare_ = false;
  std::optional<OnionSkin> onion_;
  bool requested_onion_ = false;
  bool requested_settled_ = false;
  bool evidence_ = false;
  bool descriptions_ = false;
  bool sound_ = true;
  bool awaiting_picture_ = false;
  // Problems of the preview that were reported since it last showed a picture.
  std::set<std::string> told_of_preview_;
  bool playing_ = false;
  double time_ = 0.0;                 // seconds
  double since_files_checked_ = 0.0;  // seconds
  std::deque<Message> messages_;
  uint64_t told_ = 0;
  // Locked while a person is baked, so that only one is baked at a time.
  std::shared_ptr<std::mutex> baking_ = std::make_shared<std::mutex>();
  std::shared_ptr<const DramaRun> drama_run_;
  int64_t drama_run_number_ = 0;
  int64_t run_script_ = -1;     // Revision of the last dry run.
  int64_t played_script_ = -1;  // Revision that drama_run_ played.
  double since_script_ = 0.0;   // Seconds since the script changed.
  bool stage_changed_ = true;   // The stage changed since the last dry run.
  bool checked_ = false;
  std::optional<Refinement> refinement_;
  std::shared_ptr<const ExportedShow> exported_;
  std::string export_problem_;
  std::vector<Sentence> problems_;
  std::vector<Sentence> warnings_;
  CastPictures cast_pictures_;
  std::shared_ptr<const CastCatalogue> catalogue_;
  std::string catalogue_problem_;
  std::shared_ptr<const ProbePicture> probe_picture_;
  std::string pictured_probe_;  // The key of probe_picture_.
  std::string probe_key_;       // The key of the last attempt to read, even if it failed.
  std::string probe_problem_;
  std::shared_ptr<const BoneReview> review_;
  std::string reviewed_name_;  // The member whose bones review_ shows.
  std::string review_key_;     // The key of the last attempt to read, even if it failed.
  // The last member: its threads must end before the other members are destroyed.
  TaskList tasks_;
};

}  // namespace lararium::editor
