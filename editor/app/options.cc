#include "editor/app/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <tuple>

#include "editor/app/occluder_alignment.h"
#include "editor/app/project.h"
#include "editor/import/cast_presets.h"

namespace lararium::app {

namespace {

constexpr int kUsageError = 2;

// Parsed options of every subcommand; the one that was named counts.
struct AllOptions {
  WindowOptions window;
  NewOptions create;
  TrainOptions train;
  ImportColmapOptions import_colmap;
  ExportColmapOptions export_colmap;
  PruneOptions prune;
  MeasureOptions measure;
  CastOptions cast;
  BakeOptions bake;
  CheckOptions check;
  CheckPointsOptions check_points;
  OccluderOptions occluder;
  AlignOptions align;
  LinesOptions lines;
  CaptionsOptions captions;
  TimelineOptions timeline;
  ImportBmlOptions import_bml;
  CreditsOptions credits;
  RenderOptions render;
  PortraitOptions portrait;
  std::string portrait_size;
  ReferenceOptions reference;
  ProbeOptions probe;
  CameraOptions camera;
  CalibrateOptions calibrate;
  std::string calibrate_board = "9x6";
  ExportOptions export_;
  KeyOptions key;
};

CLI::App* AddSubcommand(CLI::App& app,
                        const std::string& name,
                        const std::string& description,
                        std::filesystem::path& project) {
  CLI::App* command = app.add_subcommand(name, description);
  command->add_option("PROJECT", project, "The project's folder")->required();
  command->fallthrough();
  return command;
}

void AddIntrinsics(CLI::App* command, std::vector<double>& intrinsics) {
  command->add_option("--intrinsics", intrinsics, "fx,fy,cx,cy[,k1,k2,p1,p2] in pixels")
      ->delimiter(',')
      ->expected(4, 8)
      ->check(CLI::Number);
}

void AddTrain(CLI::App& app, TrainOptions& train) {
  CLI::App* command = AddSubcommand(app, "train", "Learn a place from a recording", train.project);
  CLI::Option_group* source = command->add_option_group("source", "The recording");
  CLI::Option* video = source->add_option("--video", train.video, "Video file");
  video->check(CLI::ExistingFile);
  CLI::Option* images = source->add_option("--images", train.images, "Folder of images");
  images->check(CLI::ExistingDirectory)->excludes(video);
  source
      ->add_option("--camera", train.camera,
                   "Record the camera of this number first, and say meanwhile what is missing; a "
                   "video file is played as one")
      ->check(CLI::NonNegativeNumber | CLI::ExistingFile)
      ->excludes(video)
      ->excludes(images);
  command->add_option("--seconds", train.seconds, "How long to record the camera")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  command->add_option("--place", train.place, "Name of the place");
  AddIntrinsics(command, train.intrinsics);
  command->add_flag("--add", train.add,
                    "Merge the recording, shot in other light, into the map that is there");
  command
      ->add_option("--remove-session", train.remove_session,
                   "Take an added recording out of the map and forget it: 1 is the first that was "
                   "added")
      ->check(CLI::Range(1, 31));
  command->add_flag("--put-back", train.put_back,
                    "Put the map from before the last training back; doing so again undoes it");
  command->add_option("--points", train.points, "Points that the map may have")
      ->check(CLI::Range(100, 10'000'000));
  command
      ->add_option("--tag-size", train.tag_size,
                   "AprilTags of this size, in metres over the black border, fix the scale")
      ->check(CLI::Range(0.001, 100.0));
  command->add_option("--tag-family", train.tag_family, "Family of the tags")
      ->capture_default_str();
  command->add_option("--poses-out", train.poses_out, "Write the poses here (poses.json)");
  command->add_option("--report", train.report, "Write the capture report here (.html)");
}

void AddCast(CLI::App& app, CastOptions& options) {
  CLI::App* cast =
      AddSubcommand(app, "cast", "Add a person; without a figure, the plain one", options.project);
  cast->add_option("--name", options.name, "As the drama calls the person")->required();
  CLI::Option* preset =
      cast->add_option("--preset", options.preset, "One of the people that come with the editor")
          ->check(CLI::IsMember(import::CastPresetNames()));
  CLI::Option* recipe =
      cast->add_option("--recipe", options.recipe, "Build the figure from the cast library")
          ->check(CLI::ExistingFile)
          ->excludes(preset);
  cast->add_option("--import", options.model, "Figure to import: glTF, VRM, FBX, Collada")
      ->check(CLI::ExistingFile)
      ->excludes(preset)
      ->excludes(recipe);
  cast->add_option("--bone-map", options.bone_map, "Which bone of the import is which joint")
      ->check(CLI::ExistingFile);
  CLI::Option* clip =
      cast->add_option("--add-clip", options.add_clip, "A motion for the person: BVH, FBX, glTF")
          ->check(CLI::ExistingFile);
  cast->add_option("--clip-name", options.clip_name, "As the drama calls it")->needs(clip);
  cast->add_flag("--loop", options.loops, "The motion repeats")->needs(clip);
  cast->add_option("--height", options.height, "Of the plain figure, metres")
      ->check(CLI::Range(kMinHeight, kMaxHeight));
  cast->add_option("--tunic", options.tunic, "Of the plain figure: r,g,b, albedo from 0 to 1")
      ->delimiter(',')
      ->expected(3)
      ->check(CLI::Range(0.0, 1.0));
}

void AddColmap(CLI::App& app, AllOptions& options) {
  ImportColmapOptions& in = options.import_colmap;
  CLI::App* import =
      AddSubcommand(app, "import-colmap", "Take a place over from a COLMAP model", in.project);
  import->add_option("DIR", in.model, "The model, text or binary, or a COLMAP project")
      ->required()
      ->check(CLI::ExistingDirectory);
  import->add_option("--images", in.images, "Its images; in the project or beside it otherwise")
      ->check(CLI::ExistingDirectory);
  import->add_option("--place", in.place, "Name of the place");

  ExportColmapOptions& out = options.export_colmap;
  CLI::App* write =
      AddSubcommand(app, "export-colmap", "Write a place as a COLMAP model", out.project);
  write->add_option("DIR", out.model, "The folder to write")->required();
  write->add_option("--place", out.place, "Name of the place");
  write->add_flag("--text", out.text, "As text; binary otherwise");
  write->add_flag("--with-images", out.with_images, "Write the keyframes' images too");
}

void AddMeasure(CLI::App& app, MeasureOptions& options) {
  CLI::App* command = AddSubcommand(
      app, "measure", "Measure between two points of a map, and scale the stage by that",
      options.project);
  command->add_option("--place", options.place, "The place, if there are several");
  command
      ->add_option("--from", options.from, "Number of a point, as the view around the place says")
      ->required()
      ->check(CLI::NonNegativeNumber);
  command->add_option("--to", options.to, "Number of the other point")
      ->required()
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--metres", options.metres,
                   "What the distance is in truth: scales the stage about its origin")
      ->check(CLI::Range(0.001, 1e4));
}

void AddPrune(CLI::App& app, PruneOptions& prune) {
  CLI::App* command = AddSubcommand(
      app, "prune", "Make a map smaller, and tell what smaller ones lose", prune.project);
  command->add_option("--points", prune.points, "Points that stay; only the table otherwise")
      ->check(CLI::Range(100, 10'000'000));
  command->add_option("--place", prune.place, "Name of the place");
}

void AddCheckPoints(CLI::App& app, CheckPointsOptions& options) {
  CLI::App* command = AddSubcommand(
      app, "check-points", "Say how the stage lies at each place, by points of it that are known",
      options.project);
  command->add_option("--place", options.place, "The place; all of them otherwise");
  CLI::Option_group* work = command->add_option_group("work", "Before the report");
  CLI::Option* set = work->add_option("--set", options.set, "Add the point NAME, or move it");
  CLI::Option* pick = work->add_option("--pick", options.pick, "Pick NAME in a training image");
  work->add_option("--clear", options.clear, "Forget where NAME was picked at the place");
  work->add_option("--remove", options.remove, "Remove the point NAME, everywhere");
  work->add_flag("--lay", options.lay, "Lay the stage of the place by the points");
  work->require_option(0, 1);
  CLI::Option* at = command->add_option("--at", options.at, "x,y,z of the point, stage metres")
                        ->delimiter(',')
                        ->expected(3)
                        ->needs(set);
  command->add_flag("--here", options.here, "It is where it was picked at the place")
      ->needs(set)
      ->excludes(at);
  command->add_option("--frame", options.frame, "The image, as in the recording")->needs(pick);
  command->add_option("--pixel", options.pixel, "x,y in it")
      ->delimiter(',')
      ->expected(2)
      ->needs(pick);
  command->add_option("--session", options.session, "Of the image; 0: the training")
      ->check(CLI::Range(0, static_cast<int>(kMaxAddedSessions)))
      ->needs(pick);
}

void AddOccluder(CLI::App& app, OccluderOptions& options) {
  std::vector<std::string> kinds;
  for (const ShapeEntry& entry : ShapeEntries()) {
    kinds.emplace_back(entry.name);
  }
  CLI::App* command =
      AddSubcommand(app, "occluder", "List, add and change what hides people", options.project);
  command->add_option("--place", options.place, "The place; all of them in the list otherwise");
  CLI::Option_group* work = command->add_option_group("work", "Before the list");
  CLI::Option* add = work->add_option("--add", options.add, "Add NAME, a shape or a model");
  work->add_option("--set", options.set, "Change NAME");
  work->add_option("--remove", options.remove, "Remove NAME");
  work->require_option(0, 1);
  CLI::Option* shape =
      command->add_option("--shape", options.shape, "What is added is one of these")
          ->check(CLI::IsMember(kinds))
          ->needs(add);
  command->add_option("--model", options.model, "What is added is this model")
      ->check(CLI::ExistingFile)
      ->needs(add)
      ->excludes(shape);
  CLI::Option_group* change = command->add_option_group("change", "What it is like");
  change
      ->add_option("--size", options.sizes,
                   "NAME=METRES,... of a shape. box: width, height, depth; plane: width, height; "
                   "cylinder: diameter, height; arch: width, height, depth, opening, spring (how "
                   "high its half circle begins); floor: width, depth")
      ->delimiter(',');
  change->add_option("--at", options.at, "x,y,z of the middle of its foot, stage metres")
      ->delimiter(',')
      ->expected(3);
  change->add_option("--turn", options.turn, "Degrees: heading[,tilt[,roll]]")
      ->delimiter(',')
      ->expected(1, 3)
      ->check(CLI::Range(-360.0, 360.0));
  change->add_option("--scale", options.scale, "Stage metres for each unit of a model")
      ->check(CLI::Range(1e-4, 1e4));
  for (const auto& [name, value, text] :
       {std::tuple{"--receives-shadow", &options.receives_shadow, "Whether shadows are seen on it"},
        {"--blocks-sound", &options.blocks_sound, "Whether sounds are muffled behind it"},
        {"--blocks-walking", &options.blocks_walking, "Whether people walk around it"}}) {
    change->add_option(name, *value, text)->check(CLI::IsMember({"yes", "no"}));
  }
}

void AddAlign(CLI::App& app, AlignOptions& align) {
  CLI::App* command =
      AddSubcommand(app, "align", "Lay an occluder's model where the real thing is", align.project);
  command->add_option("--place", align.place, "Name of the place");
  command->add_option("--occluder", align.occluder, "Its name")->required();
  CLI::Option* pair =
      command->add_option("--pair", align.pair, "Add a pair: x,y,z of the model's point, as in it")
          ->delimiter(',')
          ->expected(3);
  command
      ->add_option("--pick", align.picks,
                   "Where the point is seen in a training image, FRAME,x,y; twice or more")
      ->needs(pair);
  command->add_option("--session", align.session, "Of these images; 0: the training")
      ->check(CLI::Range(0, static_cast<int>(kMaxAddedSessions)))
      ->needs(pair);
  command->add_option("--remove", align.remove, "Remove a pair, by its number")
      ->check(CLI::Range(1, static_cast<int>(kMaxModelPairs)));
  command->add_flag_function(
      "--keep-scale,!--fit-scale", [&](int64_t times) { align.keep_scale = times > 0; },
      "The model's scale is right, as where it is in metres; or it is found too");
  command->add_flag("--by-points", align.by_points, "Lay the model by the pairs");
  CLI::Option* refine =
      command->add_flag("--refine", align.refine, "Then lay it by the map's points on its surface");
  command->add_option("--within", align.within, "Metres from it that these are looked for, 0.3")
      ->check(CLI::Range(kMinSearch, kMaxSearch))
      ->needs(refine);
  command->add_flag_function(
      "--flat,!--not-flat", [&](int64_t times) { align.flat = times > 0; },
      "Of a drawn occluder: lay its corners onto the plane that fits them best, or not");
}

void AddLines(CLI::App& app, AllOptions& options) {
  LinesOptions& in = options.lines;
  CLI::App* lines = AddSubcommand(app, "lines", "Take over translations or a table", in.project);
  lines
      ->add_option("--import", in.import,
                   "A gettext catalogue (.po) to translate by, or a table (.csv, .json) to replace "
                   "the project's")
      ->required()
      ->check(CLI::ExistingFile);
  lines->add_option("--language", in.language, "Of the catalogue; otherwise as it says");

  CaptionsOptions& out = options.captions;
  CLI::App* captions =
      AddSubcommand(app, "captions", "Write or read captions by the drama's time", out.project);
  CLI::Option_group* way = captions->add_option_group("file", "What is written or read");
  way->add_option("--out", out.out, "Write them here: SubRip (.srt) or WebVTT (.vtt)");
  way->add_option("--import", out.import,
                  "Take over the texts and times of such a file as captions of the lines that are "
                  "said then")
      ->check(CLI::ExistingFile);
  way->require_option(1);
  captions->add_option("--language", out.language, "Of the captions; otherwise the first");
  captions->add_option("--spoken", out.spoken, "That is spoken; otherwise the first");
  captions->add_option("--seconds", out.seconds, "Of the drama that are run")
      ->check(CLI::Range(0.0, 36000.0));
}

void AddInterchange(CLI::App& app, AllOptions& options) {
  TimelineOptions& out = options.timeline;
  CLI::App* timeline =
      AddSubcommand(app, "timeline", "Write the drama's timeline for other programs", out.project);
  timeline->add_option("--out", out.out, "OpenTimelineIO (.otio)")->required();
  timeline->add_option("--spoken", out.spoken, "Language that is spoken; otherwise the first");
  timeline->add_option("--seconds", out.seconds, "Of the drama that are run")
      ->check(CLI::Range(0.0, 36000.0));

  ImportBmlOptions& in = options.import_bml;
  CLI::App* bml =
      AddSubcommand(app, "import-bml", "Add behaviours in BML to the drama's tracks", in.project);
  bml->add_option("FILE", in.file, "Behavior Markup Language 1.0 (.xml)")
      ->required()
      ->check(CLI::ExistingFile);
  bml->add_option("--actor", in.actors, "ID=NAME: who a character of the file is; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  bml->add_option("--at", in.begin, "When it begins, seconds of the drama")
      ->check(CLI::Range(0.0, 36000.0));
}

void AddCredits(CLI::App& app, CreditsOptions& credits) {
  CLI::App* command =
      AddSubcommand(app, "credits", "Say who made what, and on which evidence", credits.project);
  command->add_option("--out", credits.out, "Write them here: .txt, or .json");
}

void AddRender(CLI::App& app, RenderOptions& render) {
  CLI::App* command =
      AddSubcommand(app, "render", "Composite the show into a recording", render.project);
  command->add_option("--video", render.video, "Video file")->required()->check(CLI::ExistingFile);
  command->add_option("--out", render.out, "The composite, with its sound (.mp4)")->required();
  command->add_option("--sound", render.sound, "Write the sound here too (.wav)");
  command->add_flag("--evidence", render.evidence,
                    "People and things in the colours of how certain they are");
  command->add_option("--place", render.place, "Name of the place");
  AddIntrinsics(command, render.intrinsics);
}

void AddPortrait(CLI::App& app, PortraitOptions& portrait, std::string& size) {
  CLI::App* command = app.add_subcommand("portrait", "Picture people in a studio");
  command->fallthrough();
  command->add_option("FILE", portrait.humans, "The people (.larhuman)")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("--out", portrait.out, "The picture (.png, .jpg)")->required();
  command->add_option("--view", portrait.view, "From where")
      ->check(CLI::IsMember({"front", "side", "back", "bust", "face", "three-quarter"}))
      ->capture_default_str();
  command->add_option("--shape", portrait.shapes, "NAME=weight of the face; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  CLI::Option* clip =
      command->add_option("--clip", portrait.clip, "The clip to pose by; standing otherwise");
  command->add_option("--time", portrait.time, "Seconds into the clip")
      ->check(CLI::Range(0.0, 3600.0));
  command->add_option("--walk", portrait.walk, "Seconds of walking, seen at their end")
      ->check(CLI::Range(0.0, 60.0))
      ->excludes(clip);
  command->add_option("--size", size, "WxH in pixels, of each person");
  command->add_flag("--sheet", portrait.sheet, "A contact sheet: all views, faces and shapes");
}

void AddReference(CLI::App& app, ReferenceOptions& reference) {
  CLI::App* command = app.add_subcommand(
      "reference", "Path-trace a moment of a show, or a person in a probe's light");
  command->fallthrough();
  command->add_option("FILE", reference.human, "The project, or the person (.larhuman)")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_option("--place", reference.place, "Of the project; the only one otherwise");
  CLI::Option* video =
      command->add_option("--video", reference.video, "Of the place, whose frame it is")
          ->check(CLI::ExistingFile);
  command->add_option("--probe", reference.probe, "The light of a person (.exr, .hdr)")
      ->check(CLI::ExistingFile);
  command->add_option("--probe-turn", reference.probe_turn, "Degrees about the vertical")
      ->check(CLI::Range(-360.0, 360.0));
  command->add_option("--probe-scale", reference.probe_scale, "Radiance for each unit of the file")
      ->check(CLI::Range(1e-6, 1e6));
  command->add_option("--camera", reference.camera, "Where from (poses.json, world = stage)")
      ->check(CLI::ExistingFile)
      ->excludes(video);
  command->add_option("--frame", reference.frame, "Of the video, or which pose of the camera")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--clip", reference.clip, "The clip to pose by; the rest pose otherwise");
  command->add_option("--time", reference.time, "Seconds into the clip, or into the drama")
      ->check(CLI::Range(0.0, 3600.0));
  command->add_option("--ground", reference.ground, "Albedo of a floor")
      ->check(CLI::Range(0.0, 1.0));
  command->add_flag("--without-person", reference.without_person, "The floor alone");
  command
      ->add_option("--method", reference.method,
                   "path: path tracing; prt: as the player lights people; sh: without shadows; "
                   "phong: one lamp and ambient light")
      ->check(CLI::IsMember({"path", "prt", "sh", "phong"}))
      ->capture_default_str();
  command->add_option("--samples", reference.samples, "Paths for each pixel")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  command->add_option("--bounces", reference.bounces, "Reflections between surfaces; 0: direct")
      ->check(CLI::Range(0, 16))
      ->capture_default_str();
  command->add_option("--seed", reference.seed, "Of the noise");
  command->add_option("--out", reference.out, "The image (.exr; of a project .png or .jpg)")
      ->required();
}

// A picture that was merged already (.exr, .hdr) or a photograph.
void AddProbeBall(CLI::App& probe, ProbeOptions& options) {
  CLI::App* ball = probe.add_subcommand("ball", "Unwrap a picture of a mirror ball");
  ball->fallthrough();
  ball->add_option("FILE", options.files, "The picture; several: a bracketed series")
      ->required()
      ->check(CLI::ExistingFile);
  ball->add_option("--out", options.out, "The probe (.exr)")->required();
  ball->add_option("--circle", options.circle, "x,y,radius of the ball in pixels; found otherwise")
      ->delimiter(',')
      ->expected(3);
  ball->add_option("--distance", options.distance, "From the camera, in radii of the ball; 0: far");
  ball->add_option("--reflectance", options.reflectance, "Of the ball")
      ->check(CLI::Range(0.02, 1.0));
  ball->add_option("--exposures", options.exposures, "Seconds of each photograph; EXIF otherwise")
      ->delimiter(',');
  ball->add_option("--response", options.response, "The camera's response (.json)")
      ->check(CLI::ExistingFile);
  ball->add_option("--width", options.width, "Of the probe in pixels")->check(CLI::Range(8, 8192));
}

void AddProbeMerge(CLI::App& probe, ProbeOptions& options) {
  CLI::App* merge = probe.add_subcommand("merge", "Merge a bracketed series of photographs");
  merge->fallthrough();
  merge->add_option("FILE", options.files, "The photographs")->required()->check(CLI::ExistingFile);
  merge->add_option("--out", options.out, "The merged image (.exr)")->required();
  merge->add_option("--exposures", options.exposures, "Seconds of each; EXIF otherwise")
      ->delimiter(',');
  merge->add_option("--response", options.response, "The camera's response; calibrated otherwise")
      ->check(CLI::ExistingFile);
  merge->add_option("--response-out", options.response_out, "Where to keep the response (.json)");
}

void AddProbeMatches(CLI::App& probe, ProbeOptions& options) {
  CLI::App* match = probe.add_subcommand("match", "Rotation from directions known on the stage");
  match->fallthrough();
  match->add_option("FILE", options.files, "The probe; its sun is the direction if one is missing")
      ->required()
      ->check(CLI::ExistingFile);
  match
      ->add_option("--to", options.pairs,
                   "Degrees: azimuth,elevation of its sun on the stage, or of one or two "
                   "directions in the probe and then on the stage")
      ->required()
      ->delimiter(',')
      ->expected(2, 8);
  match->add_flag("--level", options.level, "Turn about the vertical only");
  CLI::App* scale = probe.add_subcommand("scale", "Brightness from a grey surface");
  scale->fallthrough();
  scale->add_option("FILE", options.files, "The probe")->required()->check(CLI::ExistingFile);
  scale->add_option("--pixel", options.pixel, "R,G,B of the surface, 0 to 255")
      ->required()
      ->delimiter(',')
      ->expected(3);
  scale->add_option("--gain", options.gain, "R,G,B of the camera in that image")
      ->delimiter(',')
      ->expected(3);
  scale->add_option("--albedo", options.albedo, "Of the surface, one number or R,G,B")
      ->delimiter(',')
      ->expected(1, 3);
  scale->add_option("--normal", options.normal, "Of the surface, stage axes")
      ->delimiter(',')
      ->expected(3);
  scale->add_option("--turn", options.turn, "Degrees about the vertical, stage from probe");
  scale->add_option("--response", options.response, "The camera's response (.json)")
      ->check(CLI::ExistingFile);
}

void AddProbe(CLI::App& app, ProbeOptions& options) {
  CLI::App* probe = app.add_subcommand("probe", "Light probes from photographs");
  probe->require_subcommand(1);
  probe->fallthrough();
  CLI::App* info = probe->add_subcommand("info", "What light and what sun a probe holds");
  info->fallthrough();
  info->add_option("FILE", options.files, "The probe (.exr, .hdr)")
      ->required()
      ->check(CLI::ExistingFile);
  AddProbeMerge(*probe, options);
  AddProbeBall(*probe, options);
  AddProbeMatches(*probe, options);
  using Work = ProbeOptions::Work;
  for (const auto& [name, work] : {std::pair{"info", Work::kInfo}, std::pair{"merge", Work::kMerge},
                                   std::pair{"ball", Work::kBall}, std::pair{"match", Work::kMatch},
                                   std::pair{"scale", Work::kScale}}) {
    probe->get_subcommand(name)->callback([&options, work = work] { options.work = work; });
  }
}

void AddCamera(CLI::App& app, CameraOptions& options) {
  CLI::App* camera = AddSubcommand(app, "camera", "Measure how noisy and soft a place's images are",
                                   options.project);
  camera->add_option("--place", options.place, "The place; the only one otherwise");
  CLI::Option* video =
      camera->add_option("--video", options.video, "A recording instead of the training's");
  video->check(CLI::ExistingFile);
  camera->add_option("--images", options.images, "Likewise, a folder of images")
      ->check(CLI::ExistingDirectory)
      ->excludes(video);
  CLI::Option* response = camera->add_option("--response", options.response,
                                             "The camera's response (.json), of 'probe merge'");
  response->check(CLI::ExistingFile);
  camera->add_option("--knee", options.knee, "Where highlights are compressed from; 1: nowhere")
      ->check(CLI::Range(0.05, 1.0))
      ->excludes(response);
  camera
      ->add_option("--shutter", options.shutter,
                   "Share of the time between frames that it is open; learnt otherwise")
      ->check(CLI::Range(0.0, 1.0));
  camera->add_option("--device-out", options.device_out, "Write a device file for the player too");
  camera->add_flag("--forget", options.forget, "People stay sharp and clean");
}

void AddCalibrate(CLI::App& app, CalibrateOptions& options, std::string& board) {
  CLI::App* command = app.add_subcommand(
      "calibrate", "Measure a camera's intrinsics with a chessboard, and their errors");
  command->fallthrough();
  CLI::Option_group* source = command->add_option_group("source", "What shows the board");
  source->add_option("--video", options.video, "Video file")->check(CLI::ExistingFile);
  source->add_option("--images", options.images, "Folder of images")->check(CLI::ExistingDirectory);
  source
      ->add_option("--camera", options.camera,
                   "The camera of this number; a video file is played as one")
      ->check(CLI::NonNegativeNumber | CLI::ExistingFile);
  source->add_option("--print-board", options.print_board,
                     "None: write the board here, to print it on A4 (.svg)");
  source->require_option(1);
  command
      ->add_option("--board", board,
                   "CxR: inner corners, where four squares meet; 10 x 7 squares have 9x6")
      ->capture_default_str();
  command->add_option("--square", options.square, "Side of a square in metres")
      ->check(CLI::Range(0.001, 10.0));
  command->add_option("--seconds", options.seconds, "How long to look at the camera")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  command->add_option("--device-out", options.device_out,
                      "Write the camera into this device file for the player");
}

void AddOthers(CLI::App& app, AllOptions& options) {
  CLI::App* create = AddSubcommand(app, "new", "Make an empty project", options.create.project);
  create->add_option("--title", options.create.title, "Title; the folder's name otherwise");

  AddTrain(app, options.train);
  AddColmap(app, options);
  AddPrune(app, options.prune);
  AddMeasure(app, options.measure);

  AddCast(app, options.cast);

  AddCamera(app, options.camera);
  AddCalibrate(app, options.calibrate, options.calibrate_board);

  AddSubcommand(app, "bake", "Prepare light, occluders and people", options.bake.project);

  CLI::App* check = AddSubcommand(app, "check", "Find every problem", options.check.project);
  check->add_option("--seconds", options.check.seconds, "How long to run the drama")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  check
      ->add_option("--seeks", options.check.seeks,
                   "Then go to this many random times, and say whether all is as it was")
      ->check(CLI::Range(0, 10'000));
  check
      ->add_option("--visitor", options.check.visitors,
                   "Run it for this visitor too, as lararium-player --visitor-log recorded them")
      ->check(CLI::ExistingFile);

  AddCheckPoints(app, options.check_points);
  AddOccluder(app, options.occluder);
  AddAlign(app, options.align);
  AddLines(app, options);
  AddInterchange(app, options);
  AddCredits(app, options.credits);
  AddRender(app, options.render);
  AddPortrait(app, options.portrait, options.portrait_size);
  AddReference(app, options.reference);
  AddProbe(app, options.probe);

  CLI::App* pack = AddSubcommand(app, "export", "Pack the show", options.export_.project);
  pack->add_option("--out", options.export_.out, "The bundle (.larshow)")->required();
  pack->add_option("--points", options.export_.points, "Points that each place keeps at most")
      ->check(CLI::Range(100, 10'000'000));
  pack->add_option("--sign", options.export_.sign, "Sign it with this secret key (NAME.key)")
      ->check(CLI::ExistingFile);
  CLI::App* key = app.add_subcommand("key", "Make the keys that shows are signed with");
  key->add_option("NAME", options.key.name,
                  "Writes NAME.key, to be kept secret, and NAME.pub, for the players' --trust")
      ->required();
  key->fallthrough();
}

Subcommand Chosen(const CLI::App& app, const AllOptions& options) {
  if (app.got_subcommand("new")) return options.create;
  if (app.got_subcommand("train")) return options.train;
  if (app.got_subcommand("import-colmap")) return options.import_colmap;
  if (app.got_subcommand("export-colmap")) return options.export_colmap;
  if (app.got_subcommand("prune")) return options.prune;
  if (app.got_subcommand("measure")) return options.measure;
  if (app.got_subcommand("cast")) return options.cast;
  if (app.got_subcommand("bake")) return options.bake;
  if (app.got_subcommand("check")) return options.check;
  if (app.got_subcommand("check-points")) return options.check_points;
  if (app.got_subcommand("occluder")) return options.occluder;
  if (app.got_subcommand("align")) return options.align;
  if (app.got_subcommand("lines")) return options.lines;
  if (app.got_subcommand("captions")) return options.captions;
  if (app.got_subcommand("timeline")) return options.timeline;
  if (app.got_subcommand("import-bml")) return options.import_bml;
  if (app.got_subcommand("credits")) return options.credits;
  if (app.got_subcommand("render")) return options.render;
  if (app.got_subcommand("portrait")) return options.portrait;
  if (app.got_subcommand("reference")) return options.reference;
  if (app.got_subcommand("probe")) return options.probe;
  if (app.got_subcommand("camera")) return options.camera;
  if (app.got_subcommand("calibrate")) return options.calibrate;
  if (app.got_subcommand("export")) return options.export_;
  if (app.got_subcommand("key")) return options.key;
  return options.window;
}

void CheckIntrinsics(const std::vector<double>& intrinsics) {
  if (!intrinsics.empty() && intrinsics.size() != 4 && intrinsics.size() != 8) {
    throw CLI::ValidationError("--intrinsics", "takes 4 or 8 numbers");
  }
}

void ParseSize(const std::string& text, PortraitOptions& portrait) {
  constexpr int kLargest = 4096;
  if (text.empty()) {
    return;
  }
  char rest = 0;
  if (std::sscanf(text.c_str(), "%4dx%4d%c", &portrait.width, &portrait.height, &rest) != 2 ||
      std::clamp(portrait.width, 16, kLargest) != portrait.width ||
      std::clamp(portrait.height, 16, kLargest) != portrait.height) {
    throw CLI::ValidationError("--size", "takes WxH, from 16 to 4096 pixels");
  }
}

void ParseBoard(const std::string& text, CalibrateOptions& calibrate) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%4dx%4d%c", &calibrate.columns, &calibrate.rows, &rest) != 2) {
    throw CLI::ValidationError("--board", "takes CxR, as 9x6: the inner corners");
  }
}

void CheckSession(const TrainOptions& train) {
  if (train.add && train.video.empty() && train.images.empty() && train.camera.empty()) {
    throw CLI::ValidationError("--add",
                               "needs the recording to add: --video, --images or --camera");
  }
  const bool recorded = !train.video.empty() || !train.images.empty() || !train.camera.empty();
  if (train.remove_session && (train.add || recorded)) {
    throw CLI::ValidationError("--remove-session", "goes without a recording to train from");
  }
  if (train.put_back && (train.add || recorded || train.remove_session)) {
    throw CLI::ValidationError("--put-back", "goes without a recording and --remove-session");
  }
}

void CheckPointWork(const CheckPointsOptions& points) {
  if (!points.set.empty() && points.at.empty() && !points.here) {
    throw CLI::ValidationError("--set", "needs the point's position: --at, or --here");
  }
  if (!points.pick.empty() && (points.frame.empty() || points.pixel.empty())) {
    throw CLI::ValidationError("--pick", "needs --frame and --pixel");
  }
}

void OccluderWork(const OccluderOptions& occluder) {
  const bool changes = !occluder.sizes.empty() || !occluder.at.empty() || !occluder.turn.empty() ||
                       occluder.scale || !occluder.receives_shadow.empty() ||
                       !occluder.blocks_sound.empty() || !occluder.blocks_walking.empty();
  if (!occluder.add.empty() && occluder.shape.empty() && occluder.model.empty()) {
    throw CLI::ValidationError("--add", "needs what is added: --shape, or --model");
  }
  if (!occluder.set.empty() && !changes) {
    throw CLI::ValidationError("--set", "needs what changes, such as --at or --size");
  }
  if (changes && occluder.add.empty() && occluder.set.empty()) {
    throw CLI::ValidationError("occluder", "needs to be told which one: --add NAME or --set NAME");
  }
}

}  // namespace

std::variant<CommandLine, int> ParseCommandLine(int argc, const char* const* argv) {
  AllOptions options;
  CommandLine line;
  CLI::App app("Stages dramas with virtual people on real places.");
  app.set_version_flag("--version", LARARIUM_VERSION);
  app.require_subcommand(0, 1);
  app.add_flag("--json", line.json, "Print the result as one JSON object");
  app.add_option("PROJECT", options.window.project, "Project to open; the start page otherwise");
  AddOthers(app, options);
  try {
    app.parse(argc, argv);
    CheckIntrinsics(options.train.intrinsics);
    CheckIntrinsics(options.render.intrinsics);
    CheckSession(options.train);
    CheckPointWork(options.check_points);
    OccluderWork(options.occluder);
    ParseSize(options.portrait_size, options.portrait);
    ParseBoard(options.calibrate_board, options.calibrate);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageError;
  }
  line.subcommand = Chosen(app, options);
  return line;
}

}  // namespace lararium::app
