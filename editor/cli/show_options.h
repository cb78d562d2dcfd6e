#pragma once

// Options of the subcommands that produce images, video and bundles from a project.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/check/dry_run.h"
#include "editor/jobs/portrait.h"
#include "editor/jobs/reference.h"
#include "editor/jobs/wardrobe.h"

namespace lararium::editor {

struct BakeOptions {
  std::filesystem::path project;
};

struct RenderOptions {
  std::filesystem::path project;
  std::string place;
  std::filesystem::path video;
  std::vector<double> intrinsics;
  std::filesystem::path out;
  std::filesystem::path sound;
  bool evidence = false;  // Colours that show the certainty of objects.
};

struct ExportOptions {
  std::filesystem::path project;
  std::filesystem::path out = {};   // The bundle, if there is no `web`.
  std::filesystem::path web = {};   // The folder for browsers.
  std::optional<int> points = {};   // Limit for the points of each place.
  std::filesystem::path sign = {};  // Secret key file; empty: the bundle is not signed.
  std::filesystem::path page = {};  // See ExportRequest.
  std::string address = {};         // See exporter::WebExport.
  // See bundle::FleetEntry; an empty address: pages join no fleet.
  std::string fleet = {};
  std::string group = {};
  std::filesystem::path fleet_password = {};
};

struct PublishOptions {
  std::filesystem::path project;
  std::filesystem::path folder;
  std::optional<int> points = {};  // See ExportOptions.
  std::filesystem::path sign;
};

struct FetchCastLibraryOptions {};

struct KeyOptions {
  std::filesystem::path name;  // Name of the pair: NAME.key and NAME.pub.
};

}  // namespace lararium::editor
