#pragma once

// What the interface remembers beside the project: what is selected, how the
// views look, what is being dragged. Nothing of it is saved or undone.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/app/cast_pictures.h"
#include "editor/app/check_points.h"
#include "editor/app/occluder_alignment.h"
#include "editor/app/onion_skin.h"
#include "editor/app/project.h"
#include "editor/app/settings.h"
#include "editor/app/show_contents.h"
#include "editor/bake/probe_match.h"
#include "editor/panels/gizmo.h"
#include "editor/panels/keyboard_focus.h"
#include "editor/panels/keys.h"
#include "editor/panels/picture_textures.h"
#include "editor/panels/point_colours.h"
#include "editor/panels/view_camera.h"
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
  std::string name;  // of a probe, occluder, check point, actor or object

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

// What has been typed into the open dialog.
struct DialogFields {
  std::string place;
  std::string name;
  std::string file;
  std::string intrinsics;
  std::string camera = "0";  // its number, or a recording that stands in
  std::string preset;        // of a person; empty: none
  int model = 0;             // of the built-in objects
  bool images = false;       // the recording is a folder of images
  bool own_model = false;    // of an occluder: a file instead of a shape
  app::OccluderShape shape;  // of an occluder
  // of an export
  std::string key;                            // that signs it, a file; empty: none does
  int points = app::MapBudget().max_points;   // of each map at most
  bool exporting = false;                     // it was started in this dialog
  std::optional<app::ShowContents> contents;  // as forecast
};

// How the person who is selected is looked at.
struct CastView {
  int frame = 0;         // head and shoulders, face, figure
  float azimuth = 0.0f;  // radians, as StudioView
  std::string search;    // among the features
  std::string joint;     // of an imported figure, lit in its portrait
  bool all_joints = false;
};

// The check points as they were worked out last, and from what.
struct CheckView {
  std::shared_ptr<const app::ProjectDocument> document;
  std::shared_ptr<const vision::SceneDatabase> database;
  std::string place;
  geometry::Similarity3 map_from_picked;
  app::CheckReport report;
};

// How the model of an occluder is aligned.
struct AlignView {
  std::string occluder;        // that the rest is of
  bool picking = false;        // the next click in a view takes a point of the model
  std::optional<size_t> pair;  // whose point is clicked in the training images
  double search_m = train::RefineOptions().search_m;
  std::shared_ptr<const vision::OccluderTree> tree;  // of the model, as staged here:
  std::shared_ptr<const stage::Place> tree_of;
  // The pairs as they were worked out last, and from what.
  std::shared_ptr<const app::ProjectDocument> document;
  std::shared_ptr<const vision::SceneDatabase> database;
  std::string place;
  geometry::Similarity3 map_from_picked;
  app::AlignmentReport report;
};

// How the light of a probe is looked at and matched.
struct LightView {
  enum class Picking { kNothing, kGrey, kOnProbe, kOnStage };
  Picking picking = Picking::kNothing;
  bool level = true;       // drags turn about the vertical only
  bool balls = true;       // a mirror ball and a grey one stand at the probe
  bool histogram = false;  // of the camera's image against people
  float albedo = 0.18f;    // of grey surfaces that are picked
  std::string probe;       // that the picks below are of
  std::vector<bake::GreyPatch> patches;
  std::optional<bake::ScaleMatch> scale_match;
  std::vector<bake::DirectionPair> pairs;
  std::optional<glm::vec3> in_probe;  // the first half of the next pair
  std::optional<bake::DirectionMatch> direction_match;
  std::string problem;                        // of the last pick; empty: none
  std::optional<glm::vec3> dragged_in_probe;  // what a drag holds on to
};

// How the view around the place shows the map, and what of it is chosen.
struct PlaceView {
  enum class LookAt { kWhereItDoes, kStage, kMap, kSelected };
  LookAt look_at = LookAt::kWhereItDoes;  // next: asked for by a button or a key
  PointColour colours = PointColour::kPicture;
  ColourRange range;             // of the colours, as the points were coloured last
  bool measure = false;          // a click adds a second point to the first
  bool snap = false;             // as if Control were held, in all views
  std::vector<uint32_t> points;  // of the map: none, one, or the two ends of what is measured
  double metres = 0.0;           // typed, of the distance of the two; 0: nothing yet
};

// Which walks the views show, and what of them the hand moves.
struct WalkHandles {
  // What is chosen in the timeline where it is one thing alone: an item, or what was done in the
  // dry run.
  std::optional<drama::TimelineItem> item;
  std::optional<uint32_t> task;

  struct Handle {
    drama::TimelineItem item;
    bool begins = false;  // where somebody is placed first; otherwise where they go

    friend bool operator==(const Handle&, const Handle&) = default;
  };
  std::optional<Handle> chosen;  // that keys move
  struct Drag {
    Handle handle;
    Eigen::Vector2d pressed = Eigen::Vector2d::Zero();  // window pixel
    glm::vec2 grip = glm::vec2(0.0f);   // from there on the floor to the handle; stage, metres
    glm::vec2 place = glm::vec2(0.0f);  // of the handle, as it is dragged
    bool moved = false;                 // further than a click
    bool given_up = false;              // nothing comes of it
  };
  std::optional<Drag> drag;
};

// What lies below the views.
enum class BottomTab { kTimeline, kScript, kChecks, kMessages };

// Where keys go that mean something else in each of them.
enum class Focus { kViews, kTimeline, kScript };

struct EditorState {
  std::vector<KeyPress> keys;  // since the last frame
  BottomTab bottom = BottomTab::kTimeline;
  Focus focus = Focus::kViews;
  KeyboardFocus keyboard;
  int script_line = 0;  // that the script is to show next, from 1; 0: none
  std::optional<drama::TimelineItem> timeline_item;  // that the timeline is to choose next
  Selection selection;
  ViewKind view = ViewKind::kCamera;
  GizmoMode gizmo = GizmoMode::kMove;
  std::optional<GizmoDrag> drag;
  bool drag_given_up = false;  // nothing comes of drag
  OrbitCamera orbit;
  bool show_stage = true;       // axes, grid and handles over the camera's picture
  bool show_points = true;      // around the place
  bool show_matches = false;    // over the camera's picture: the points that its pose stands on
  bool show_occluders = false;  // over the camera's picture: all, not the selected one alone
  bool show_wipe = false;       // the camera's image alone to the left of wipe_at
  float wipe_at = 0.5f;         // of the picture's width
  bool show_onion = false;      // people at other moments over the camera's picture
  bool open_onion = false;      // how many of them is asked for
  app::OnionSkin onion;         // how many, and how far apart

  // Picking: which anchor the next click sets, and in which keyframe.
  int anchor = 0;
  int keyframe = 0;

  PlaceView place;
  WalkHandles walk;
  CheckView check;
  AlignView align;
  LightView light;
  CastView cast;
  std::shared_ptr<const app::CastPortrait> portrait;  // the one shown in this frame
  PictureTextures pictures;

  Dialog dialog = Dialog::kNone;
  DialogFields fields;
  std::map<Dialog, DialogFields> left;  // what was typed into those that Escape closed
  app::Settings settings;               // of the window, which follows and keeps them
  std::string new_language;             // of the lines, as far as it was typed
  bool begin_tour = false;              // asked for
  bool quit = false;                    // asked for; the window decides
  bool leave = false;                   // the project, for the start page; likewise
  bool stops_work = false;              // leaving may stop what takes long
  uint64_t messages_read = 0;           // of Workspace::messages_told()
};

// With empty fields, or as it was when Escape closed it; true then.
bool OpenDialog(EditorState& state, Dialog dialog);

}  // namespace lararium::panels
