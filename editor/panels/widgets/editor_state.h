#pragma once

// The state of the interface outside the project: selection, viewpoints, drags. It is not saved and
// not part of undo.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/bake/probe_match.h"
#include "editor/document/project.h"
#include "editor/jobs/bundle_summary.h"
#include "editor/jobs/check_points.h"
#include "editor/jobs/occluder_alignment.h"
#include "editor/panels/viewport/gizmo.h"
#include "editor/panels/viewport/picture_textures.h"
#include "editor/panels/viewport/point_colours.h"
#include "editor/panels/viewport/view_camera.h"
#include "editor/panels/widgets/keyboard_focus.h"
#include "editor/panels/widgets/keys.h"
#include "editor/session/cast_pictures.h"
#include "editor/session/onion_skin.h"
#include "editor/session/settings.h"
#include "shared/drama/timeline_text.h"
#include "shared/stage/place.h"
#include "shared/vision/occluders.h"

namespace lararium::panels {

enum class ViewKind { kCamera, kAround, kPicks };

struct Selection {
  enum class Kind {
    kProject,
    kPlace,
    kStage,
    kPicks,
    kNudge,
    kOccluder,
    kProbe,
    kActor,
    kObject,
    kCheckPoint
  };
  Kind kind = Kind::kStage;
  std::string name;  // The name of a probe, occluder, check point, actor or object.

  friend bool operator==(const Selection&, const Selection&) = default;
};

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
  kFilm,
  kLiveCamera,
  kLeave,
  kKeys
};

// The input of the open dialog.
struct DialogFields {
  std::string place;
  std::string name;
  std::string file;
  std::string intrinsics;
  std::string camera = "0";     // A number, or a recording that is played like a camera.
  std::string preset;           // The preset of a person; empty: none.
  int model = 0;                // Index of a built-in object.
  bool images = false;          // The recording is a folder of images.
  bool own_model = false;       // The new occluder is a file instead of a shape.
  editor::OccluderShape shape;  // The shape of the new occluder.
  // The following fields are for an export.
  std::string key;  // The file of the key for the signature; empty: no signature.
  int points = editor::MapBudget().max_points;    // Limit for each map.
  bool exporting = false;                         // The export was started in this dialog.
  std::optional<editor::BundleSummary> contents;  // The forecast.
};

// The view of the selected person.
struct CastView {
  int frame = 0;         // Head and shoulders, face, or figure.
  float azimuth = 0.0f;  // Radians; see StudioView.
  std::string search;    // The text to find among the features.
  std::string joint;     // Joint of an imported figure that is highlighted in its portrait.
  bool all_joints = false;
};

// The last report on the check points, with its inputs.
struct CheckView {
  std::shared_ptr<const editor::ProjectDocument> document;
  std::shared_ptr<const vision::SceneDatabase> database;
  std::string place;
  geometry::Similarity3 map_from_picked;
  editor::CheckReport report;
};

// The state of aligning an occluder's model.
struct AlignView {
  std::string occluder;        // The occluder that the other fields belong to.
  bool picking = false;        // The next click in a view picks a point of the model.
  std::optional<size_t> pair;  // The pair that is being picked in the training images.
  double search_m = train::RefineOptions().search_m;
  // The tree of the model as staged in tree_of.
  std::shared_ptr<const vision::OccluderTree> tree;
  std::shared_ptr<const stage::Place> tree_of;
  // The last report on the pairs, with its inputs.
  std::shared_ptr<const editor::ProjectDocument> document;
  std::shared_ptr<const vision::SceneDatabase> database;
  std::string place;
  geometry::Similarity3 map_from_picked;
  editor::AlignmentReport report;
};

// The state of the light panel.
struct LightView {
  enum class Picking { kNothing, kGrey, kOnProbe, kOnStage };
  Picking picking = Picking::kNothing;
  bool level = true;       // Drags rotate about the vertical only.
  bool balls = true;       // Shows a mirror ball and a grey ball at the probe.
  bool histogram = false;  // Compares the camera's image with people.
  float albedo = 0.18f;    // Albedo of picked grey surfaces.
  std::string probe;       // The probe that the picks below belong to.
  std::vector<bake::GreyPatch> patches;
  std::optional<bake::ScaleMatch> scale_match;
  std::vector<bake::DirectionPair> pairs;
  std::optional<glm::vec3> in_probe;  // The first half of the next pair.
  std::optional<bake::DirectionMatch> direction_match;
  std::string problem;  // Why the last pick failed; empty: it did not.
  // The direction that a drag keeps under the pointer.
  std::optional<glm::vec3> dragged_in_probe;
};

// How the scene view shows the map, and the selected points.
struct PlaceView {
  enum class LookAt { kWhereItDoes, kStage, kMap, kSelected };
  LookAt look_at = LookAt::kWhereItDoes;  // The next viewpoint, requested by a button or a key.
  PointColour colours = PointColour::kPicture;
  ColourRange range;     // The range of the present point colours.
  bool measure = false;  // A click adds a second point to the first.
  bool snap = false;     // Snapping is on in all views without Control.
  // Selected points of the map: none, one, or the two ends of a distance.
  std::vector<uint32_t> points;
  double metres = 0.0;  // The distance of the two that was typed; 0: none yet.
};

// The walks that the views show, and the end that is being moved.
struct WalkHandles {
  // The selection in the timeline, if it is a single item or a single task of the dry run.
  std::optional<drama::TimelineItem> item;
  std::optional<uint32_t> task;

  struct Handle {
    drama::TimelineItem item;
    bool begins = false;  // The place where a person appears; otherwise the end of a walk.

    friend bool operator==(const Handle&, const Handle&) = default;
  };
  std::optional<Handle> chosen;  // The handle that keys move.
  struct Drag {
    Handle handle;
    Eigen::Vector2d pressed = Eigen::Vector2d::Zero();  // Window pixel.
    // From the pressed point on the floor to the handle; stage, metres.
    glm::vec2 grip = glm::vec2(0.0f);
    glm::vec2 place = glm::vec2(0.0f);  // The handle's present position; stage, metres.
    bool moved = false;                 // Moved farther than a click allows.
    bool given_up = false;              // The drag was cancelled.
  };
  std::optional<Drag> drag;
};

// The tabs below the views.
enum class BottomTab { kTimeline, kScript, kChecks, kMessages };

// Which part receives keys that have another meaning in each part.
enum class Focus { kViews, kTimeline, kScript };

struct EditorState {
  std::vector<KeyPress> keys;  // The keys since the last frame.
  BottomTab bottom = BottomTab::kTimeline;
  Focus focus = Focus::kViews;
  KeyboardFocus keyboard;
  int script_line = 0;  // The line that the script panel shows next, from 1; 0: none.
  std::optional<drama::TimelineItem> timeline_item;  // The item that the timeline selects next.
  Selection selection;
  ViewKind view = ViewKind::kCamera;
  GizmoMode gizmo = GizmoMode::kMove;
  std::optional<GizmoDrag> drag;
  bool drag_given_up = false;  // drag was cancelled.
  OrbitCamera orbit;
  bool show_stage = true;   // Axes, grid and handles over the camera's picture.
  bool show_points = true;  // Shows the map's points in the scene view.
  // Shows the points that determine the pose over the camera's picture.
  bool show_matches = false;
  // Shows all occluders over the camera's picture, not only the selected one.
  bool show_occluders = false;
  bool show_compare = false;  // Shows the camera's image alone left of compare_at.
  float compare_at = 0.5f;    // Share of the picture's width.
  bool show_onion = false;    // Shows people at other moments over the camera's picture.
  bool open_onion = false;    // Opens the settings of the onion skin.
  editor::OnionSkin onion;    // Number and spacing of the skins.

  // Picking: the anchor that the next click sets, and the keyframe.
  int anchor = 0;
  int keyframe = 0;

  PlaceView place;
  WalkHandles walk;
  CheckView check;
  AlignView align;
  LightView light;
  CastView cast;
  std::shared_ptr<const editor::CastPortrait> portrait;  // The portrait of this frame.
  PictureTextures pictures;

  Dialog dialog = Dialog::kNone;
  DialogFields fields;
  std::map<Dialog, DialogFields> left;  // The input of dialogs that Escape closed.
  editor::Settings settings;            // The settings of the window, which applies and saves them.
  std::string new_language;             // The language that is being typed for the lines.
  bool begin_tour = false;              // Requests the tour.
  bool quit = false;                    // Requests to close the window.
  bool leave = false;                   // Requests to close the project and to show the start page.
  bool stops_work = false;              // Leaving may stop long work.
  uint64_t messages_read = 0;           // See MessageLog::told().
};

// Opens a dialog with empty fields, or with those from when Escape closed it; returns true in that
// case.
bool OpenDialog(EditorState& state, Dialog dialog);

}  // namespace lararium::panels
