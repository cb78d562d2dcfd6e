#pragma once

// The map of the current place while the project is open: reads and measures it in the background,
// resolves the place's picks in it, and keeps frames that are added to it. Use it from the
// interface thread only.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/jobs/background_task.h"
#include "editor/jobs/staging.h"
#include "editor/jobs/training_report.h"
#include "editor/session/message_log.h"
#include "editor/session/project_session.h"
#include "editor/train/map_statistics.h"
#include "editor/train/mesh_alignment.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/stage/place.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

// The map of a place as it was read, and what follows from it.
struct LoadedMap {
  std::shared_ptr<const vision::SceneDatabase> database;   // nullptr: the place is not trained.
  std::shared_ptr<const train::MapStatistics> statistics;  // Statistics of database.
  MapMeasures measures;
  bool measured = false;  // The measures belong to this map and to the place's tags.
  ResolvedPicks picks;
  // The report of the training; nullptr: there is none.
  std::shared_ptr<const TrainingReport> report;
  std::vector<std::string> warnings;  // See TrainingReport; there even if there is no report.
  bool has_previous = false;          // MapTraining::RestorePreviousMap() is possible.
};

class MapSession {
 public:
  // All arguments must outlive the map session.
  MapSession(ProjectSession& project, TaskList& tasks, MessageLog& messages, Log& log);
  // Writes added frames that are not in the map's file yet. No task may run any more.
  ~MapSession();
  MapSession(const MapSession&) = delete;
  MapSession& operator=(const MapSession&) = delete;

  const LoadedMap& loaded() const { return loaded_; }
  // The number of times that a map was read.
  int64_t loads() const { return loads_; }
  // Changes when a map was read or measured.
  int64_t revision() const { return revision_; }
  // Whether the file has to be read.
  bool stale() const { return stale_; }
  // Whether frames were added that are not in the map's file yet.
  bool unsaved() const { return unsaved_.has_value() || tasks_.Running(TaskKind::kWritingMap); }

  // Reads the file again if it is that of the current place.
  void Reload(const std::string& place);
  // Reads the file again where another program changed it.
  void DetectExternalChange();
  // Adds the frame to the map's images, unless it is one already, so that picks in it count. The
  // map's file is written later.
  void KeepFrame(const vision::Keyframe& keyframe);

  // Levels the stage on the floor that was found in the map; does nothing where there is none.
  void LayStageOnFloor();
  // Scales the stage about its origin so that two points of the map are the given number of metres
  // apart. Does nothing where the points coincide, or where the scale would be out of range.
  void SetDistance(uint32_t from, uint32_t to, double metres);
  // Aligns the model of an occluder with the map's points within search_m metres. The result is an
  // edit, unless the model was moved meanwhile. staged: the current place with the occluder's mesh.
  void RefineOccluder(const std::string& occluder,
                      std::shared_ptr<const stage::Place> staged,
                      double search_m);
  // The last result for an occluder that has not moved since; nullptr otherwise. After a failure
  // stage_from_mesh is the unchanged alignment.
  struct Refinement {
    std::string place;
    std::string occluder;
    geometry::Similarity3 stage_from_mesh;
    Result<train::RefineReport> report;
  };
  const Refinement* refinement(const OccluderDocument& occluder) const;

  // Call once for each frame of the interface.
  void Update();

 private:
  // The map with added frames, to be written to its file.
  struct UnsavedMap {
    std::filesystem::path file;
    std::string stamp;  // The stamp of the file before writing.
    std::shared_ptr<const vision::SceneDatabase> database;
  };

  void Read();
  void Write();
  // Detects the floor and the tags in the background.
  void Measure();
  // Adopts measures of the loaded map and resolves the picks with them.
  void TakeMeasures(MapMeasures measures);
  void UpdatePicks();

  ProjectSession& project_;
  TaskList& tasks_;
  MessageLog& messages_;
  Log& log_;
  LoadedMap loaded_;
  int64_t loads_ = 0;
  int64_t revision_ = 0;
  bool stale_ = true;
  std::string stamp_;  // The stamp of the map's file when it was last read or written.
  std::optional<UnsavedMap> unsaved_;
  std::string tags_key_;  // The tags of the last measurement.
  bool measures_stale_ = false;
  std::string picks_key_;  // The picks that loaded_.picks resolves.
  std::optional<Refinement> refinement_;
};

}  // namespace lararium::editor
