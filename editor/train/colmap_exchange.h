#pragma once

// Places to and from COLMAP: train there and track here, or the other way round.

#include <cstdint>
#include <filesystem>

#include "editor/train/colmap_model.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// The map as a model: one camera, keyframes as images 1, 2, ... under names that
// are unique and fit a folder, points as 1, 2, ... with their colours (black
// where the map has none), observations as features that show them.
ColmapModel ColmapFromDatabase(const vision::SceneDatabase& database);

// Writes that model into a new folder, which appears as a whole or not at all.
// with_images: also the keyframes' grey images, into images/ below it; those that
// the budget left out are missing there.
Status ExportColmap(const vision::SceneDatabase& database,
                    const std::filesystem::path& folder,
                    ColmapFormat format,
                    bool with_images);

struct ColmapImportOptions {
  // How far from where the model sees a point our feature of it may lie.
  double radius_px = 1.0;
  int max_features = 8192;  // of each image, those of strongest response
  int max_points = 60'000;  // of the database
  uint64_t seed = 1;

  Status Validate() const;
};

// Where a COLMAP project keeps its parts.
struct ColmapFolders {
  std::filesystem::path model;
  std::filesystem::path images;
};

// model: a folder with a model, or a project with one in sparse/0 or sparse.
// images: empty to look for images/ in and beside them.
Result<ColmapFolders> FindColmapFolders(const std::filesystem::path& model,
                                        const std::filesystem::path& images);

// A model and its images as a place that can be tracked. Poses and points stay as
// they are, in the model's axes and unit; our features are found in the images and
// tied to the points that the model sees within radius_px of them. Points that
// keep fewer than two sights are left out.
//
// The database has one camera: the one that takes most images. Images of a camera
// that projects otherwise are resampled to it; the log says how many.
//
// Keyframes count as OpenImageFolder counts the image folder, or in order of
// names where an image lies outside it or in a folder below. Errors name images
// that are missing, unreadable or of another size than their camera's.
Result<vision::SceneDatabase> ImportColmap(const std::filesystem::path& model,
                                           const std::filesystem::path& images,
                                           const ColmapImportOptions& options,
                                           Progress& progress,
                                           Log& log);

}  // namespace lararium::train
