#include "editor/session/sample.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "editor/document/project.h"
#include "shared/bundle/sha256.h"
#include "shared/core/file.h"
#include "shared/core/program.h"

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPlaceProject = "maquette/maquette.lararium";
constexpr const char* kDramaProject = "thermopolium/thermopolium.lararium";
constexpr const char* kPlace = "maquette";
constexpr const char* kCopy = "sample";
constexpr const char* kVersionFile = "copied.from";  // The version of the sample that was copied.
constexpr size_t kVersionBytes = 64;
constexpr const char* kStep = "copying the sample";

// The hash of what the authors of the sample wrote. Training and baking do not change it.
Result<std::string> VersionOf(const fs::path& sample) {
  const ProjectPaths paths{SampleProject(sample)};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  std::string all = FormatProject(document).dump();
  for (const fs::path& file : {paths.Drama(), paths.folder / "lines.csv"}) {
    LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file));
    all += text;
  }
  return bundle::FormatSha256(bundle::ComputeSha256(std::as_bytes(std::span(all))));
}

Status CannotCopy(const fs::path& file, const std::error_code& error) {
  return Status::Error(file.string(), "the sample cannot be copied: " + error.message(),
                       "make room, or open another project");
}

struct MissingFile {
  fs::path from;
  fs::path to;
  uint64_t bytes = 0;
};

// The files below a folder that another folder does not have.
Result<std::vector<MissingFile>> FindMissing(const fs::path& from, const fs::path& to) {
  std::vector<MissingFile> files;
  std::error_code error;
  for (auto at = fs::recursive_directory_iterator(from, error);
       !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    const fs::path copy = to / at->path().lexically_relative(from);
    if (at->is_regular_file(error) && !FileExists(copy)) {
      files.push_back({at->path(), copy, at->file_size(error)});
    }
  }
  if (error) {
    return CannotCopy(from, error);
  }
  return files;
}

// The copy gets its name when it is complete, and can be changed by the user.
Status CopyFile(const MissingFile& file) {
  std::error_code error;
  fs::path part = file.to;
  part += ".part";
  fs::create_directories(part.parent_path(), error);
  if (!error) {
    fs::copy_file(file.from, part, fs::copy_options::overwrite_existing, error);
  }
  if (!error) {
    fs::permissions(part, fs::perms::owner_write, fs::perm_options::add, error);
  }
  if (!error) {
    fs::rename(part, file.to, error);
  }
  return error ? CannotCopy(file.to, error) : Status();
}

Status CopyMissing(const fs::path& shipped, const fs::path& own, Progress& progress) {
  std::vector<MissingFile> files;
  for (const char* project : {kPlaceProject, kDramaProject}) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<MissingFile> missing,
                              FindMissing(shipped / project, own / project));
    files.insert(files.end(), missing.begin(), missing.end());
  }
  uint64_t bytes = 1;  // Not 0, which cannot divide.
  for (const MissingFile& file : files) {
    bytes += file.bytes;
  }
  uint64_t copied = 0;
  for (const MissingFile& file : files) {
    if (progress.Cancelled()) {
      return Status::Error(own.string(), "the copying was cancelled");
    }
    progress.Report(kStep, static_cast<double>(copied) / static_cast<double>(bytes));
    LARARIUM_RETURN_IF_ERROR(CopyFile(file));
    copied += file.bytes;
  }
  return Status();
}

}  // namespace

fs::path SampleProject(const fs::path& sample) { return sample / kDramaProject; }

bool IsTrained(const fs::path& sample) {
  return FileExists(ProjectPaths{SampleProject(sample)}.Scene(kPlace));
}

fs::path ShippedSample(const fs::path& program) {
  const fs::path trained = ShippedData("lararium/sample", "build/demo", program);
  const fs::path bare = ShippedData("lararium/scenes", "scenes", program);
  const fs::path& sample = IsTrained(trained) ? trained : bare;
  return FileExists(ProjectPaths{SampleProject(sample)}.Project()) ? sample : fs::path();
}

Result<fs::path> OwnSample(const fs::path& shipped, const fs::path& folder, Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string version, VersionOf(shipped));
  for (int number = 1;; ++number) {
    const fs::path own = folder / (number == 1 ? kCopy : kCopy + ("-" + std::to_string(number)));
    const fs::path version_file = own / kVersionFile;
    const bool complete =
        FileExists(version_file) && FileExists(ProjectPaths{SampleProject(own)}.Project());
    const Result<std::string> copied = ReadText(version_file, kVersionBytes);
    if (complete && (!copied.ok() || *copied != version)) {
      continue;
    }
    if (!complete || (IsTrained(shipped) && !IsTrained(own))) {
      LARARIUM_RETURN_IF_ERROR(CopyMissing(shipped, own, progress));
      LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(version_file, std::string_view(version)));
    }
    return own;
  }
}

bool IsOwnSample(const fs::path& project, const fs::path& folder) {
  const fs::path below = project.lexically_relative(NormalFolder(folder));
  return !below.empty() && below.begin()->string().starts_with(kCopy);
}

}  // namespace lararium::editor
