#pragma once

// Recording of a place with a camera, with live advice on which views are still missing
// (coverage_guide.h).

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <thread>

#include "editor/train/coverage_guide.h"
#include "shared/capture/frame_source.h"
#include "shared/core/free_space.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Whether the text is the number of a camera (at most four digits) rather than a recording.
bool IsCameraNumber(const std::string& camera);

// Plays a recording like a live camera: each frame arrives at its capture time.
std::unique_ptr<capture::FrameSource> AtItsOwnPace(std::unique_ptr<capture::FrameSource> recording);

// Opens the camera with a number, or a recording that is played like a camera.
Result<std::unique_ptr<capture::FrameSource>> OpenFilmCamera(const std::string& camera);

// The state after the newest frame.
struct FilmMoment {
  std::shared_ptr<const cv::Mat> bgr;
  train::CoverageState coverage;
  train::CoverageGuide::Cells cells = {};
  double seconds = 0.0;  // Time since the first frame.
  int64_t frames = 0;
};

enum class FilmStep { kGoOn, kFinish, kDiscard };

// The result of filming. The file is complete.
struct Filmed {
  FilmMoment last;
  // The error that ended the recording: the camera failed or the disk is full. Ok where the user
  // ended it.
  Status stopped;
};

// Records until the camera ends or next() says so, which is called after each frame. Training reads
// frames more than once and so needs a file. A camera that fails or a disk that is nearly full also
// ends the recording, and what was filmed so far is kept. On an error nothing was filmed or it was
// discarded, and an existing file stays unchanged.
Result<Filmed> Film(capture::FrameSource& camera,
                    const std::filesystem::path& file,
                    const std::function<FilmStep(const FilmMoment&)>& next,
                    const FreeSpace& free_space = FreeSpaceOf);

// The first of film-1.mp4, film-2.mp4, ... that does not exist in a folder.
std::filesystem::path NewFilmFile(const std::filesystem::path& folder);

// The present fault, and what to do next. translated: in the language of the interface; otherwise
// English.
std::string FaultText(train::CoverageFault fault, bool translated);
std::string AdviceText(train::CoverageAdvice advice, bool translated);

// Films on a separate thread, for the window.
class FilmTask {
 public:
  FilmTask(std::unique_ptr<capture::FrameSource> camera, std::filesystem::path file);
  // Ends the recording, and keeps it unless it was discarded.
  ~FilmTask();
  FilmTask(const FilmTask&) = delete;
  FilmTask& operator=(const FilmTask&) = delete;

  // The newest state. Before the first frame it has no image.
  FilmMoment moment() const;
  // Ends the recording and completes the file.
  void Finish() { finish_ = true; }
  bool finishing() const { return finish_; }
  // Deletes the recording, even when it is already complete.
  void Discard() { discard_ = true; }
  // Set after the recording has ended.
  std::optional<Result<Filmed>> outcome() const;
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::atomic<bool> finish_ = false;
  std::atomic<bool> discard_ = false;
  mutable std::mutex mutex_;
  FilmMoment moment_;
  std::optional<Result<Filmed>> outcome_;
  // The last member, so that the thread is joined before the others are destroyed.
  std::jthread thread_;
};

}  // namespace lararium::editor
