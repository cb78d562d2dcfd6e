#pragma once

// Exchanges maps with COLMAP: train there and track here, or the other way round.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "editor/colmap/colmap_model.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// Converts a map to a model: one camera, keyframes as images 1, 2, ... with unique names that are
// valid in a folder, points as 1, 2, ... with their colours (black if the map has none), and
// observations as features.
ColmapModel ColmapFromDatabase(const vision::SceneDatabase& database);

// Writes that model into a new folder, completely or not at all. with_images also writes the
// keyframes' grey images into its subfolder images/; keyframes without an image are missing there.
Status ExportColmap(const vision::SceneDatabase& database,
                    const std::filesystem::path& folder,
                    ColmapFormat format,
                    bool with_images);

struct ColmapImportOptions {
  // Largest distance between the model's feature of a point and our feature of it.
  double radius_px = 1.0;
  int max_features = 8192;  // Number of strongest features per image.
  int max_points = 60'000;  // Maximum number of points of the database.
  uint64_t seed = 1;

  Status Validate() const;
};

// The folders of a COLMAP project.
struct ColmapFolders {
  std::filesystem::path model;
  std::filesystem::path images;
};

// Finds the folders. model is a folder with a model, or a project with a model in sparse/0 or
// sparse, also below colmap/. If images is empty, a folder images/ is searched for in and beside
// these folders.
Result<ColmapFolders> FindColmapFolders(const std::filesystem::path& model,
                                        const std::filesystem::path& images);

// Imports a model and its images as a place that can be tracked. Poses and points stay unchanged,
// in the model's axes and unit. Our features are extracted from the images and assigned to the
// points whose model features lie within radius_px. Points with fewer than two such observations
// are left out. If the model has no tracks, as those of photogrammetry programs often, our features
// are matched and triangulated with the model's poses.
//
// The database has one camera: the one with the most images. Images of a camera with another
// projection are resampled to it; a warning says how many.
//
// Frame indices of keyframes are those of OpenImageFolder for the image folder. If it does not find
// all images, frames are numbered in the order of their names, and the log says so. Errors name
// images that are missing, unreadable, or whose size differs from that of their camera.
Result<vision::SceneDatabase> ImportColmap(const std::filesystem::path& model,
                                           const std::filesystem::path& images,
                                           const ColmapImportOptions& options,
                                           Progress& progress,
                                           Log& log,
                                           std::vector<std::string>& warnings);

}  // namespace lararium::train
