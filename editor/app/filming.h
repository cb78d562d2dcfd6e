#pragma once

// Filming a place with a camera, told meanwhile what is still missing (coverage_guide.h).

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
#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::app {

// Whether it names a camera rather than a recording: at most four digits.
bool IsCameraNumber(const std::string& camera);

// A recording whose frames come when they were taken, as if it were a camera.
std::unique_ptr<capture::FrameSource> AtItsOwnPace(std::unique_ptr<capture::FrameSource> recording);

// The camera of a number; or a recording, which comes at its own pace as if it were one.
Result<std::unique_ptr<capture::FrameSource>> OpenFilmCamera(const std::string& camera);

// Of the newest frame.
struct FilmMoment {
  std::shared_ptr<const cv::Mat> bgr;
  train::CoverageState coverage;
  train::CoverageGuide::Cells cells = {};
  double seconds = 0.0;  // since the first frame
  int64_t frames = 0;
};

enum class FilmStep { kGoOn, kFinish, kDiscard };

// What came of filming. The file is complete.
struct Filmed {
  FilmMoment last;
  // Why it ended before anybody ended it, where the camera failed or the disk is full.
  Status stopped;
};

// Bytes that can still be written to a folder; nullopt where nobody knows.
using FreeSpace = std::function<std::optional<uint64_t>(const std::filesystem::path& folder)>;
std::optional<uint64_t> FreeSpaceOf(const std::filesystem::path& folder);

// Records until the camera ends or next, which is told of each frame, says so. Training needs a
// recording: it looks at frames more than once. A camera that fails, or a disk that is nearly full,
// ends it too: what was filmed until then is kept. On an error there was nothing to keep, or it
// was discarded, and a file that was there before stays as it was.
Result<Filmed> Film(capture::FrameSource& camera,
                    const std::filesystem::path& file,
                    const std::function<FilmStep(const FilmMoment&)>& next,
                    const FreeSpace& free_space = FreeSpaceOf);

// The first of film-1.mp4, film-2.mp4, ... that is not in a folder yet.
std::filesystem::path NewFilmFile(const std::filesystem::path& folder);

// What is wrong now, if anything is; and what to do next. In the language of the interface, or
// untranslated.
std::string FaultText(train::CoverageFault fault, bool translated);
std::string AdviceText(train::CoverageAdvice advice, bool translated);
// {"covered", "ahead", "floor", "sideways", "depth", "advice"}
Json CoverageJson(const train::CoverageState& coverage);

// The same on a thread of its own, for a window.
class FilmTask {
 public:
  FilmTask(std::unique_ptr<capture::FrameSource> camera, std::filesystem::path file);
  // Ends the recording, and keeps it unless it was discarded.
  ~FilmTask();
  FilmTask(const FilmTask&) = delete;
  FilmTask& operator=(const FilmTask&) = delete;

  // The newest; without a picture before the first.
  FilmMoment moment() const;
  // Ends the recording and completes the file.
  void Finish() { finish_ = true; }
  bool finishing() const { return finish_; }
  // There will be no file, even if it is complete by now.
  void Discard() { discard_ = true; }
  // Once it has ended, by itself or not.
  std::optional<Result<Filmed>> outcome() const;
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::atomic<bool> finish_ = false;
  std::atomic<bool> discard_ = false;
  mutable std::mutex mutex_;
  FilmMoment moment_;
  std::optional<Result<Filmed>> outcome_;
  std::jthread thread_;  // last: joined before the rest goes
};

}  // namespace lararium::app
