#pragma once

// The open dialog and its input.

#include <map>
#include <optional>
#include <string>

#include "editor/document/project.h"
#include "editor/jobs/bundle_summary.h"

namespace lararium::panels {

enum class Dialog {
  kNone,
  kTrain,
  kTrainingReport,
  kAddSession,
  kExport,
  kOccluder,
  kProbe,
  kCast,
  kObject,
  kCheckPoint,
  kDroppedModel,
  kDropMessage,
  kFilm,
  kLiveCamera,
  kLeave,
  kKeys
};

// The input of the open dialog.
struct DialogFields {
  std::string place;  // The title or the name of a place; of a new one, `name` is the name.
  std::string title;
  std::string name;
  std::string file;
  std::string intrinsics;
  std::string camera = "0";     // A number, or a recording that is played like a camera.
  std::string preset;           // The preset of a person; empty: none.
  std::string model;            // An object of the library.
  bool images = false;          // The recording is a folder of images.
  bool own_model = false;       // The new occluder is a file instead of a shape.
  editor::OccluderShape shape;  // The shape of the new occluder.
  // The following fields are for an export.
  std::string key;  // The file of the key for the signature; empty: no signature.
  int points = editor::MapBudget().max_points;    // Limit for each map.
  bool exporting = false;                         // The export was started in this dialog.
  std::optional<editor::BundleSummary> contents;  // The forecast.
};

struct Dialogs {
  Dialog shown = Dialog::kNone;
  DialogFields fields;                  // The input of the shown dialog.
  std::map<Dialog, DialogFields> left;  // The input of dialogs that Escape closed.

  // Opens a dialog with empty fields, or with those from when Escape closed it; returns true in
  // that case.
  bool Open(Dialog dialog) {
    shown = dialog;
    const auto found = left.find(dialog);
    fields = found != left.end() ? found->second : DialogFields();
    return found != left.end();
  }
};

}  // namespace lararium::panels
