#pragma once

// An open project: its document with undo, what was loaded for the place at
// hand, and the work in the background. Knows nothing of windows; panels show it
// and call its commands. Everything here happens on one thread.

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

#include "editor/app/background_task.h"
#include "editor/app/bone_review.h"
#include "editor/app/cast_catalogue.h"
#include "editor/app/cast_pictures.h"
#include "editor/app/command_stack.h"
#include "editor/app/drama_run.h"
#include "editor/app/journal.h"
#include "editor/app/live_camera.h"
#include "editor/app/picked_frames.h"
#include "editor/app/place_recordings.h"
#include "editor/app/preview.h"
#include "editor/app/probe_picture.h"
#include "editor/app/project.h"
#include "editor/app/script_document.h"
#include "editor/app/show_contents.h"
#include "editor/app/staging.h"
#include "editor/app/text.h"
#include "editor/app/training_report.h"
#include "editor/train/map_statistics.h"
#include "editor/train/mesh_alignment.h"
#include "editor/train/trainer.h"
#include "shared/core/log.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"
#include "shared/stage/place.h"
#include "shared/vision/scene_database.h"

namespace lararium::app {

struct Message {
  enum class Level { kInfo, kWarning, kError };
  Level level = Level::kInfo;
  std::string text;
};

// What of the place is loaded. Replaced as a whole.
struct LoadedPlace {
  std::shared_ptr<const vision::SceneDatabase> database;   // nullptr: not trained
  std::shared_ptr<const train::MapStatistics> statistics;  // of the database
  MapMeasures measures;
  bool measured = false;  // measures are of this map and of the tags that the place names
  ResolvedPicks picks;
  std::shared_ptr<const TrainingReport> report;  // of the training; nullptr: nothing is known of it
  bool has_former = false;                       // PutFormerMapBack() can be done
  // As staged for the preview; occluder meshes for drawing. nullptr before that.
  std::shared_ptr<const stage::Place> staged;
  // The probes as they were then, and their light: edits turn and brighten that at once.
  std::vector<ProbeDocument> baked_probes;
  std::vector<light::PlacedProbe> baked_light;
};

class Workspace {
 public:
  static constexpr const char* kTraining = TrLater("Training");
  static constexpr const char* kBaking = TrLater("Baking");
  static constexpr const char* kExporting = TrLater("Exporting");
  static constexpr const char* kTrying = TrLater("Playing the show");
  static constexpr const char* kOpening = TrLater("Opening");
  static constexpr const char* kMeasuring = TrLater("Measuring");
  static constexpr const char* kCatalogue = TrLater("Opening the cast library");
  static constexpr const char* kReview = TrLater("Reading the bones");
  static constexpr const char* kProbe = TrLater("Reading the light probe");
  static constexpr const char* kCamera = TrLater("Measuring the camera");
  static constexpr const char* kDryRun = TrLater("Running the drama");
  static constexpr const char* kChecking = TrLater("Checking");
  static constexpr const char* kKeeping = TrLater("Writing the map");
  static constexpr const char* kRefining = TrLater("Refining on the map");

  // Reads the project, and what a crash left unsaved. Borrows log.
  static Result<std::unique_ptr<Workspace>> Open(ProjectPaths paths, Log& log);
  ~Workspace();

  const ProjectPaths& paths() const { return paths_; }
  const ProjectDocument& document() const { return commands_.document(); }
  using Commands = CommandStack<ProjectDocument, drama::TextEdit>;
  const Commands& commands() const { return commands_; }
  // The drama, which has its commands among those of the project.
  const ScriptDocument& script() const { return script_; }

  // The place that the views show; nullptr where the project has none.
  const PlaceDocument* place() const { return document().FindPlace(place_name_); }
  // The drama stays at its moment.
  void ShowPlace(const std::string& name);
  const LoadedPlace& loaded() const { return loaded_; }

  // Edits. gesture: see CommandStack::Edit.
  void Edit(const std::string& name,
            const std::function<void(ProjectDocument&)>& change,
            std::string_view gesture = {});
  void EditPlace(const std::string& name,
                 const std::function<void(PlaceDocument&)>& change,
                 std::string_view gesture = {});
  // Of the place at hand; nothing where it has none of that name.
  void EditOccluder(const std::string& name,
                    const std::string& occluder,
                    const std::function<void(OccluderDocument&)>& change,
                    std::string_view gesture = {});
  // The stage laid on the floor that was found in the map; nothing without one.
  void LayStageOnFloor();
  // The frame in the camera view as an image to pick in.
  FrameToPick frame_to_pick() const;
  // Makes it one of the map's images, where it is none yet, so that picks in it count. The map's
  // file follows.
  void KeepFrame(const vision::Keyframe& keyframe);
  // The stage scaled about its origin, so that two points of the map are so many metres apart.
  // Nothing where they lie in one place or the stage would become impossibly large or small.
  void SetDistance(uint32_t from, uint32_t to, double metres);
  // Edits of the drama. False, and a message, where the change fails.
  bool EditTimeline(const std::string& name,
                    const std::function<Status(drama::TimelineText&)>& change,
                    std::string_view gesture = {});
  void EditScript(const std::string& name, std::string text, std::string_view gesture = {});
  // Edits of the table of lines, document().lines, which has to be there. Its file follows a
  // moment after the last edit, whether or not the project is saved: voices are made from it. A
  // message instead, where the table could not be read back.
  void EditLines(const std::string& name, bake::LineTable table, std::string_view gesture = {});
  void EndGesture() { commands_.EndGesture(); }
  // As if the gesture at work had not been begun; nothing between gestures.
  void CancelGesture();
  void Undo();
  void Redo();
  void Save();

  // Files of the project that were changed by others while there are edits that were not
  // saved, or so that they cannot be read. Until somebody has chosen, nothing is saved.
  bool changed_outside() const {
    return outside_script_.has_value() || outside_project_ || !outside_damage().empty();
  }
  // Why what is in the files cannot be taken, until they are mended; else "".
  const std::string& outside_damage() const {
    return script_damage_.empty() ? project_damage_ : script_damage_;
  }
  // What is in the files, as an edit. Only where they can be read.
  void TakeOutside();
  // What is here; saving will overwrite the files. A file that cannot be read is kept beside as
  // NAME.damaged.
  void KeepOwn();

  // Long work; progress in tasks(), outcome in messages().
  void Train();  // the place at hand, from its recordings
  // The place of that name, which is made where there is none, from another first recording. A
  // place that has a map names that recording once this has worked, in all that undo and redo
  // could bring back: until then, and where it fails, it goes on as it was.
  void TrainFrom(const std::string& place, const SessionDocument& recording);
  // Merges a further recording of the place at hand into its map; the document
  // names it once that has worked, likewise.
  void AddSession(const SessionDocument& session);
  // Takes a further recording, from 1 on, out of the map of the place at hand. Once that has
  // worked the document forgets it too, in all that undo and redo could bring back, for the map
  // will not have it again: to be done only by whoever was asked.
  void RemoveSession(uint32_t session);
  // Exchanges the map of the place at hand with the one from before its last training, and what
  // the document says of its recordings, in all that undo and redo could bring back. Doing it
  // again undoes it.
  void PutFormerMapBack();
  // Once after each training that was done in this window, when its map and report are loaded.
  bool TakeNewReport() { return std::exchange(report_is_new_, false); }
  void Bake();
  // Lays the model of an occluder by the map's points within so many metres of it: an edit, once
  // that is known, unless it was moved meanwhile. The occluder has to be staged.
  void RefineOccluder(const std::string& occluder, double search_m);
  // What that came to last, for an occluder that still lies as it then was laid, or as it lay
  // where it failed; nullptr otherwise.
  struct Refinement {
    std::string place;
    std::string occluder;
    geometry::Similarity3 stage_from_mesh;
    Result<train::RefineReport> report;
  };
  const Refinement* refinement(const OccluderDocument& occluder) const;
  // All that is wrong with the project as it is saved, as the subcommand check tells it.
  void Check();
  bool checked() const { return checked_; }
  const std::vector<Sentence>& problems() const { return problems_; }
  // What it found that is right, but perhaps not meant.
  const std::vector<Sentence>& warnings() const { return warnings_; }
  // Saves first.
  void Export(const ExportRequest& request);
  // What was exported last in this window; nullptr before that. And why the last export failed;
  // empty where it did not.
  struct ExportedShow {
    std::filesystem::path file;
    ShowContents contents;
  };
  const ExportedShow* exported() const { return exported_.get(); }
  const std::string& export_problem() const { return export_problem_; }
  // Opens the exported show in the player, at the place at hand.
  void TryShow();
  TaskList& tasks() { return tasks_; }
  bool tasks_empty() const { return tasks_.entries().empty(); }

  // The people and objects of the project in pictures.
  CastPictures& cast_pictures() { return cast_pictures_; }
  // How many people of the cast are still to be built or pictured.
  size_t PeopleLeft() const;
  // The preview shows plain figures, or people as they were built before, for some of them.
  bool HasStandIns() const { return stand_ins_ > 0; }
  // What recipes can choose from, read when first asked for. nullptr: not yet, or the
  // library is not there, which catalogue_problem() says.
  const CastCatalogue* catalogue();
  const std::string& catalogue_problem() const { return catalogue_problem_; }
  // How the bones of an imported figure were taken, read when first asked for and again
  // when its map changes; the last one stays until then. nullptr: not yet, or it failed.
  const BoneReview* bone_review(const CastDocument& member);
  // Copies a recording into the project as one of the sounds that it lacks. False, and a message,
  // where it is none.
  bool BringInSound(const std::string& name, const std::filesystem::path& file);
  // Writes what is in use into a file, which the member names from then on.
  void SaveBones(const CastDocument& member);

  // The image of a probe of the document, read when first asked for and again when the file
  // changes. nullptr: not yet, or it cannot be read, which probe_problem() says.
  const ProbePicture* probe_picture(const ProbeDocument& probe);
  const std::string& probe_problem() const { return probe_problem_; }
  // How noisy and soft the images of the place at hand are, from its training recording: an
  // edit, once that is known.
  void MeasureCameraTraits();

  // People in the camera view as the camera would have taken them, or as drawn.
  bool camera_look() const { return camera_look_; }
  void SetCameraLook(bool on);
  // Whether pictures come with what they are compared with (PreviewPicture::plain).
  void SetCompare(bool compare);

  // People and things at other moments over the camera's picture; nullopt: none. While the drama
  // plays there are none.
  void SetOnionSkin(const std::optional<OnionSkin>& onion);

  // The camera view in the colours of how certain people and things are.
  bool shows_evidence() const { return evidence_; }
  void SetEvidence(bool on);
  // What visitors who do not see well are told is read and heard too.
  bool descriptions() const { return descriptions_; }
  void SetDescriptions(bool on);
  // Whether the recording is heard while it plays.
  bool sound() const { return sound_; }
  void SetSound(bool on) { sound_ = on; }

  // The moment of the drama that is seen. It plays in a loop of duration().
  bool playing() const { return playing_; }
  void SetPlaying(bool playing) { playing_ = playing; }
  double time() const { return time_; }
  void SetTime(double seconds);
  // The longest of the recording, the timeline and what was played in the dry run.
  double duration() const;
  // What the drama's script does by itself; nullptr before the first run ended. It is run
  // again a moment after each edit.
  const DramaRun* drama_run() const { return drama_run_.get(); }
  // Another number for each run.
  int64_t drama_run_number() const { return drama_run_number_; }
  // It played the script as it is written now.
  bool drama_run_is_current() const { return played_script_ == script_.revision(); }

  // The recording in the camera view, which begins anew where it ends before the drama.
  int64_t frame() const;
  void SetFrame(int64_t frame);
  // So many frames of the recording on, or back: to the very moment of one.
  void StepFrames(int64_t frames);
  std::optional<PreviewSource> recording() const {
    return preview_ ? preview_->source() : std::nullopt;
  }
  // What the camera view shows. Nothing of it is saved: each place begins with its recording.
  enum class ViewSource { kRecording, kTraining, kLive };
  void SetViewSource(ViewSource source);
  ViewSource view_source() const { return view_source_; }
  // A live camera by its number, or a recording as if it were one (live_camera.h); the drama goes
  // on by its own clock. Where it cannot be opened or ends, the recording is back, and a message.
  void ShowLiveCamera(const std::string& camera);
  const std::string& live_camera() const { return live_camera_; }
  // False while the live camera is unplugged.
  bool camera_is_there() const { return *camera_presence_; }
  // The place names a recording for the camera view besides that of its training.
  bool has_own_recording() const;
  // The newest picture; nullptr before the first.
  const std::shared_ptr<const PreviewPicture>& picture() const { return picture_; }

  const std::deque<Message>& messages() const { return messages_; }
  uint64_t messages_told() const { return told_; }  // so far, with those that went since
  // What takes long is at work, and lost to whoever leaves.
  bool AtLongWork() const { return tasks_.Running(kTraining) || tasks_.Running(kExporting); }
  void Tell(Message::Level level, std::string text);

  // Brings everything up to date, once for each frame of the interface. seconds:
  // since the last call.
  void Update(double seconds);
  // Something moves without input: redraw soon.
  bool Busy() const { return playing_ || awaiting_picture_ || view_source_ == ViewSource::kLive; }

 private:
  Workspace(ProjectPaths paths, ProjectDocument document, std::string script, Log& log);

  void Recover();
  // What a journal comes to, as an edit of what is saved.
  void TakeOver(JournalContent content);
  // Undo and redo of the drama's part of a command.
  void ApplyToScript(const drama::TextEdit& edit);
  void NoteScriptEdit(const std::string& name, drama::TextEdit edit, std::string_view gesture);
  void Note(const Status& journal);
  // Ends the journal where everything is in its file.
  void DiscardIfSaved();
  void OnScriptChanged();
  // Looks whether others changed project.json or drama.lua.
  void LookOutside();
  // The table of lines from its file, and into it where it was edited.
  std::shared_ptr<const bake::LineTable> ReadLines();
  void WriteLines();
  std::string LinesStamp() const;
  void RunDramaAgain();

  // Of whom there are to be pictures, and what was wrong with them.
  void AskForPictures();
  void TellOfPictures();
  void OnDocumentChanged();
  void ResolvePicksAgain();
  // Looks for the floor and the tags, in the background.
  void MeasureAgain();
  // What the preview is made of; it opens anew when this changes.
  std::string PreviewKey() const;
  void ReloadMap();
  // The map with the frames that were kept, into its file.
  struct UnsavedMap {
    std::filesystem::path file;
    std::string stamp;  // of the file as it was
    std::shared_ptr<const vision::SceneDatabase> database;
  };
  void WriteMap();
  void ReloadPreview();
  void RequestPicture();
  Preview::Opener ViewOpener();
  // The preview shows a stage that is about to be replaced: somebody was added, say, whom the
  // drama names already.
  bool StageIsOutdated() const;
  void AdvancePlayback(double seconds);
  // False, and a message, while the map is at work otherwise.
  bool MapIsFree();
  // Reads what others changed since; a file that is gone is written anew.
  void LookAtScript();
  void LookAtProject();
  // A file that cannot be read, which its damage then says.
  void MeetDamage(const std::filesystem::path& file,
                  const std::string& problem,
                  std::string& damage);
  void KeepDamaged(const std::filesystem::path& file);
  // The work of training the place at hand. recordings: of its map after success.
  void StartTraining(std::function<Result<train::TrainReport>(Progress&)> work,
                     std::vector<TaskStep> steps,
                     const PlaceRecordings& recordings);
  void TrainWith(const PlaceRecordings& recordings);
  // What is true of the place's map now, and cannot be undone.
  void NameRecordings(const std::string& place, const PlaceRecordings& recordings);
  void Report(const Status& status, bool cancelled, const std::string& success);

  ProjectPaths paths_;
  Log& log_;
  Commands commands_;
  ScriptDocument script_;
  std::shared_ptr<const std::string> saved_script_;
  Commands::Snapshot saved_project_;
  Journal journal_;
  std::string script_stamp_;  // of the files as they were read or written last
  std::string project_stamp_;
  std::string lines_stamp_;
  std::shared_ptr<const bake::LineTable> written_lines_;
  double since_lines_ = 0.0;  // seconds since they were edited
  double since_edit_ = 0.0;   // likewise anything of the project
  std::optional<std::string> outside_script_;
  std::shared_ptr<const ProjectDocument> outside_project_;
  std::string script_damage_;   // why drama.lua cannot be read, as it was changed by others
  std::string project_damage_;  // likewise project.json
  std::string place_name_;
  LoadedPlace loaded_;
  std::string picks_key_;
  std::string tags_key_;  // what was measured last
  bool measures_stale_ = false;
  std::string trained_place_;   // whose report is to be shown
  bool report_is_new_ = false;  // and is loaded
  std::string preview_key_;
  bool map_stale_ = false;
  std::optional<UnsavedMap> unsaved_map_;
  std::string scene_stamp_;  // of the map's file as it was read or written last
  int64_t map_loads_ = 0;    // how often a map was read
  ViewSource view_source_ = ViewSource::kRecording;
  std::string live_camera_;
  std::shared_ptr<CameraPresence> camera_presence_ = std::make_shared<CameraPresence>(true);
  bool preview_stale_ = false;
  size_t stand_ins_ = 0;  // people for whom others stand in, in the preview
  std::unique_ptr<Preview> preview_;
  std::shared_ptr<const PreviewPicture> picture_;
  int64_t requested_frame_ = -1;
  bool requested_sound_ = false;
  double requested_time_ = -1.0;
  int64_t requested_script_ = -1;                      // revision
  std::shared_ptr<const std::string> requested_text_;  // and text
  int64_t previewed_script_ = -1;                      // revision that the preview was opened with
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
  std::set<std::string> told_of_preview_;  // its problems, since it showed a picture
  bool playing_ = false;
  double time_ = 0.0;                 // seconds
  double since_files_checked_ = 0.0;  // seconds
  std::deque<Message> messages_;
  uint64_t told_ = 0;
  std::shared_ptr<std::mutex> baking_ = std::make_shared<std::mutex>();  // one at a time
  std::shared_ptr<const DramaRun> drama_run_;
  int64_t drama_run_number_ = 0;
  int64_t run_script_ = -1;     // revision that was run last
  int64_t played_script_ = -1;  // and that drama_run_ played
  double since_script_ = 0.0;   // seconds since it changed
  bool stage_changed_ = true;   // since the last run
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
  std::string pictured_probe_;  // key of probe_picture_
  std::string probe_key_;       // of what was read last, also where that failed
  std::string probe_problem_;
  std::shared_ptr<const BoneReview> review_;
  std::string reviewed_name_;  // whose bones review_ shows
  std::string review_key_;     // of what was read last, also where that failed
  TaskList tasks_;             // last: its threads end before the rest goes
};

}  // namespace lararium::app
