#include "editor/cli/stage_options.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "editor/cli/command_table.h"
#include "editor/document/occluder_shape.h"
#include "editor/document/place_edits.h"
#include "editor/document/project.h"
#include "editor/import/objects/object_library.h"
#include "editor/jobs/occluder_alignment.h"

namespace lararium::editor {

namespace {

void AddStagePicks(CLI::App* command, StageOptions& options) {
  command
      ->add_option("--clear", options.clear,
                   "Forget where this point was picked, or POINT=FRAME: in this image alone; may "
                   "be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--pick", options.picks,
                   "POINT=FRAME,x,y: where a point is seen in a training image, each in two or "
                   "more of them; may be repeated. origin, forward: straight ahead of it, floor: "
                   "a third point of the floor; length_from, length_to: ends of a known length")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--session", options.session, "Of these images; 0: the training")
      ->check(CLI::Range(0, static_cast<int>(kMaxAddedSessions)));
  command
      ->add_option("--length", options.length,
                   "Metres of the known length; without its points, from origin to forward")
      ->check(CLI::Range(0.001, 1e4));
  CLI::Option* size =
      command
          ->add_option("--tag-size", options.tag_size,
                       "AprilTags of this size, in metres over the black border, fix the scale")
          ->check(CLI::Range(0.001, 100.0));
  CLI::Option* family =
      command->add_option("--tag-family", options.tag_family, "Family of the tags");
  command->add_flag("--without-tags", options.without_tags, "The scale is that of the picks")
      ->excludes(size)
      ->excludes(family);
}

void AddStage(CLI::App* command, StageOptions& options) {
  AddProject(command, options.project);
  command->add_option("--place", options.place, "The place; the only one otherwise");
  AddStagePicks(command, options);
  CLI::Option_group* hand = command->add_option_group("by hand", "On top of the picks");
  hand->add_flag("--back-to-picks", options.back_to_picks, "First as the picks lay it");
  hand->add_option("--at", options.at, "x,y,z: moved so far, metres of the picks")
      ->delimiter(',')
      ->expected(3);
  hand->add_option("--turn", options.turn, "Degrees: heading[,tilt[,roll]]")
      ->delimiter(',')
      ->expected(1, 3)
      ->check(CLI::Range(-360.0, 360.0));
  hand->add_option("--scale", options.scale, "Metres of the picks for each of the stage")
      ->check(CLI::Range(kMinStageScale, kMaxStageScale));
  hand->add_flag("--floor", options.on_floor, "Then laid on the floor that was found in the map");
  command->add_option("--nudge", options.nudge, "x,y,z: of the camera right, down, ahead, metres")
      ->delimiter(',')
      ->expected(3);
}

void CheckStage(const StageOptions& stage) {
  const std::vector<std::string> names = AnchorNames();
  bool in_images = !stage.picks.empty();
  for (const std::string& cleared : stage.clear) {
    const std::string name = cleared.substr(0, cleared.find('='));
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw CLI::ValidationError("--clear", name + " is not a point of the stage");
    }
    in_images |= name != cleared;
  }
  if (stage.session != 0 && !in_images) {
    throw CLI::ValidationError("--session", "needs --pick, or --clear of an image");
  }
}

void AddCheckPoints(CLI::App* command, CheckPointsOptions& options) {
  AddProject(command, options.project);
  command->add_option("--place", options.place, "The place; all of them otherwise");
  CLI::Option_group* work = command->add_option_group("work", "Before the report");
  CLI::Option* set = work->add_option("--set", options.set, "Add the point NAME, or move it");
  work->add_option("--pick", options.pick, "Pick NAME in a training image");
  work->add_option("--clear", options.clear,
                   "Forget where NAME was picked at the place, or in --frame alone");
  work->add_option("--remove", options.remove, "Remove the point NAME, everywhere");
  CLI::Option* rename = work->add_option("--rename", options.rename, "Give NAME another name");
  rename->needs(command->add_option("--to", options.to, "The other name")->needs(rename));
  work->add_flag("--lay", options.lay, "Lay the stage of the place by the points");
  work->require_option(0, 1);
  CLI::Option* at = command->add_option("--at", options.at, "x,y,z of the point, stage metres")
                        ->delimiter(',')
                        ->expected(3)
                        ->needs(set);
  command->add_flag("--here", options.here, "It is where it was picked at the place")
      ->needs(set)
      ->excludes(at);
  CLI::Option* frame =
      command->add_option("--frame", options.frame, "The image, as in the recording");
  command->add_option("--pixel", options.pixel, "x,y in it, of --pick")
      ->delimiter(',')
      ->expected(2)
      ->needs(frame);
  command->add_option("--session", options.session, "Of the image; 0: the training")
      ->check(CLI::Range(0, static_cast<int>(kMaxAddedSessions)))
      ->needs(frame);
}

void CheckCheckPoints(const CheckPointsOptions& points) {
  if (!points.set.empty() && points.at.empty() && !points.here) {
    throw CLI::ValidationError("--set", "needs the point's position: --at, or --here");
  }
  if (!points.pick.empty() && (points.frame.empty() || points.pixel.empty())) {
    throw CLI::ValidationError("--pick", "needs --frame and --pixel");
  }
  if (points.pick.empty() && !points.pixel.empty()) {
    throw CLI::ValidationError("--pixel", "needs --pick");
  }
  if (points.pick.empty() && points.clear.empty() && !points.frame.empty()) {
    throw CLI::ValidationError("--frame", "needs --pick or --clear");
  }
}

void AddOccluder(CLI::App* command, OccluderOptions& options) {
  std::vector<std::string> kinds;
  for (const ShapeEntry& entry : ShapeEntries()) {
    kinds.emplace_back(entry.name);
  }
  AddProject(command, options.project);
  command->add_option("--place", options.place, "The place; all of them in the list otherwise");
  CLI::Option_group* work = command->add_option_group("work", "Before the list");
  CLI::Option* add = work->add_option("--add", options.add, "Add NAME, a shape or a model");
  CLI::Option* draw = work->add_option(
      "--draw", options.draw, "Draw NAME on training images, or go on drawing it, by --seen");
  work->add_option("--set", options.set, "Change NAME");
  work->add_option("--remove", options.remove, "Remove NAME");
  work->require_option(0, 1);
  CLI::Option* seen =
      command
          ->add_option("--seen", options.seen,
                       "FRAME,x,y,x,y,...: where the corners of its face are seen in an image, in "
                       "turn around it, -,- for one that is not. Each in two images or more, taken "
                       "from well apart; to be repeated")
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
          ->needs(draw);
  draw->needs(seen);
  command->add_option("--session", options.session, "Of these images; 0: the training")
      ->check(CLI::Range(0, static_cast<int>(kMaxAddedSessions)))
      ->needs(draw);
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
                   "high its half circle begins); floor: width, depth; of one that is drawn: depth")
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

void CheckOccluder(const OccluderOptions& occluder) {
  const bool changes = !occluder.sizes.empty() || !occluder.at.empty() || !occluder.turn.empty() ||
                       occluder.scale || !occluder.receives_shadow.empty() ||
                       !occluder.blocks_sound.empty() || !occluder.blocks_walking.empty();
  if (!occluder.add.empty() && occluder.shape.empty() && occluder.model.empty()) {
    throw CLI::ValidationError("--add", "needs a shape or a model: --shape, or --model");
  }
  if (!occluder.set.empty() && !changes) {
    throw CLI::ValidationError("--set", "needs a change, such as --at or --size");
  }
  if (changes && occluder.add.empty() && occluder.set.empty() && occluder.draw.empty()) {
    throw CLI::ValidationError("occluder", "needs an occluder: --add NAME or --set NAME");
  }
}

// The names of the library's objects, as the help shows the values of an option.
std::string LibraryNames() {
  std::string names;
  for (const std::string& name : import::LibraryObjectNames()) {
    names += (names.empty() ? "{" : ",") + name;
  }
  return names.empty() ? names : names + "}";
}

void AddObject(CLI::App* command, ObjectOptions& options) {
  AddProject(command, options.project);
  CLI::Option_group* work = command->add_option_group("work", "Before the list");
  work->add_option("--add", options.add, "Add NAME, as the drama calls it");
  work->add_option("--set", options.set, "Change NAME");
  work->add_option("--remove", options.remove, "Remove NAME");
  work->require_option(0, 1);
  CLI::Option* model =
      command->add_option("--model", options.model, "It is this one of the library")
          ->check(
              [](const std::string& name) {
                return import::FindLibraryObject(name).status().message();
              },
              LibraryNames());
  command
      ->add_option("--file", options.file,
                   "It is this model; how it is used is in NAME.object.json beside it")
      ->check(CLI::ExistingFile)
      ->excludes(model);
  command->add_option("--at", options.at, "x,y,z where it is at the beginning, stage metres")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--heading", options.heading, "Degrees about the vertical")
      ->check(CLI::Range(-360.0, 360.0));
}

void CheckObject(const ObjectOptions& options) {
  const bool is_something = !options.model.empty() || !options.file.empty();
  const bool changes = is_something || !options.at.empty() || options.heading;
  if (!options.add.empty() && !is_something) {
    throw CLI::ValidationError("--add", "needs a model: --model, or --file");
  }
  if (!options.set.empty() && !changes) {
    throw CLI::ValidationError("--set", "needs a change, such as --at");
  }
  if (changes && options.add.empty() && options.set.empty()) {
    throw CLI::ValidationError("object", "needs an object: --add NAME or --set NAME");
  }
}

void AddSound(CLI::App* command, SoundOptions& options) {
  AddProject(command, options.project);
  CLI::Option* bring =
      command->add_option("--bring", options.bring, "Copy a recording in, as the sound NAME");
  CLI::Option* file = command->add_option("--file", options.file, "The recording")
                          ->check(CLI::ExistingFile)
                          ->needs(bring);
  bring->needs(file);
  command->add_option("--place", options.place, "Of what follows; the only one otherwise");
  command->add_option("--reverb", options.reverb,
                      "How its walls answer: none, small_room, wooden_room, stone_room, corridor, "
                      "hall, vault, courtyard, street");
  command->add_option("--reverb-gain", options.reverb_gain, "Decibels of that");
  CLI::Option* ambience = command->add_option("--ambience", options.ambience,
                                              "This sound is heard as long as one is there");
  command->add_option("--gain", options.gain, "Decibels of it")->needs(ambience);
  command->add_option("--at", options.at, "x,y,z it comes from, stage metres; all around otherwise")
      ->delimiter(',')
      ->expected(3)
      ->needs(ambience);
  command->add_option("--remove-ambience", options.remove_ambience, "It is heard no longer");
}

void AddAlign(CLI::App* command, AlignOptions& align) {
  AddProject(command, align.project);
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

// The input is a merged picture (.exr, .hdr) or a photograph.
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

// Options for the known properties of the surface and its image.
void AddGrey(CLI::App& command, ProbeOptions& options) {
  command.add_option("--gain", options.gain, "R,G,B of the camera in that image")
      ->delimiter(',')
      ->expected(3);
  command.add_option("--albedo", options.albedo, "Of the surface, one number or R,G,B")
      ->delimiter(',')
      ->expected(1, 3);
  command.add_option("--normal", options.normal, "Of the surface, stage axes")
      ->delimiter(',')
      ->expected(3);
  command.add_option("--response", options.response, "The camera's response (.json)")
      ->check(CLI::ExistingFile);
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
  scale->add_option("--turn", options.turn, "Degrees about the vertical, stage from probe");
  AddGrey(*scale, options);
}

void AddProbePlacement(CLI::App& command, ProbeOptions& options) {
  command.add_option("--at", options.at, "x,y,z where it was photographed, stage metres")
      ->delimiter(',')
      ->expected(3);
  command.add_option("--hour", options.hour, "Of the day, 0 to 24")->check(CLI::Range(0.0, 24.0));
  command.add_option("--rotation", options.rotation, "Degrees: heading[,tilt[,roll]]")
      ->delimiter(',')
      ->expected(1, 3)
      ->check(CLI::Range(-360.0, 360.0));
  command.add_option("--turn", options.turn, "Then turn it by these degrees about the vertical");
  command
      .add_option(
          "--match", options.pairs,
          "Then by directions, in degrees: azimuth,elevation of its sun on the stage, or of "
          "one or two things in the probe and then on the stage")
      ->delimiter(',')
      ->expected(2, 8);
  command.add_flag("--level", options.level, "That turns it about the vertical only");
}

void AddProbeLight(CLI::App& command, ProbeOptions& options) {
  for (const auto& [name, stops, text] :
       {std::tuple{"--exposure", &options.exposure, "Stops brighter than the file"},
        {"--warmth", &options.warmth, "Stops of red over blue"},
        {"--tint", &options.tint, "Stops of green over the two"}}) {
    command.add_option(name, *stops, text)->check(CLI::Range(-8.0, 8.0));
  }
  command
      .add_option("--grey", options.pixel,
                  "Then as bright as shows a grey surface of the place as R,G,B, 0 to 255")
      ->delimiter(',')
      ->expected(3);
  AddGrey(command, options);
}

// Adds the subcommands for the probes of a place.
void AddPlaceProbes(CLI::App& probe, ProbeOptions& options) {
  using Work = ProbeOptions::Work;
  for (const auto& [name, work, text] :
       {std::tuple{"list", Work::kList, "List the probes of a project"},
        {"add", Work::kAdd, "Light a place by a probe"},
        {"set", Work::kSet, "Change a probe of a place"},
        {"remove", Work::kRemove, "Take a probe from a place; its file stays"}}) {
    CLI::App* command = probe.add_subcommand(name, text);
    command->fallthrough();
    AddProject(command, options.project);
    command->add_option("--place", options.place, "The place; the only one otherwise");
    if (work != Work::kList) {
      command->add_option("NAME", options.name, "What it is called")->required();
    }
    if (work == Work::kAdd) {
      command->add_option("FILE", options.files, "Its image (.exr, .hdr)")
          ->required()
          ->expected(1)
          ->check(CLI::ExistingFile);
    } else if (work == Work::kSet) {
      command->add_option("--file", options.files, "Its image (.exr, .hdr)")
          ->expected(1)
          ->check(CLI::ExistingFile);
    }
    if (work == Work::kAdd || work == Work::kSet) {
      AddProbePlacement(*command, options);
      AddProbeLight(*command, options);
    }
  }
}

void AddProbe(CLI::App* probe, ProbeOptions& options) {
  probe->require_subcommand(1);
  CLI::App* info = probe->add_subcommand("info", "What light and what sun a probe holds");
  info->fallthrough();
  info->add_option("FILE", options.files, "The probe (.exr, .hdr)")
      ->required()
      ->check(CLI::ExistingFile);
  AddProbeMerge(*probe, options);
  AddProbeBall(*probe, options);
  AddProbeMatches(*probe, options);
  AddPlaceProbes(*probe, options);
  using Work = ProbeOptions::Work;
  for (const auto& [name, work] : {std::pair{"info", Work::kInfo}, std::pair{"merge", Work::kMerge},
                                   std::pair{"ball", Work::kBall}, std::pair{"match", Work::kMatch},
                                   std::pair{"scale", Work::kScale}, std::pair{"list", Work::kList},
                                   std::pair{"add", Work::kAdd}, std::pair{"set", Work::kSet},
                                   std::pair{"remove", Work::kRemove}}) {
    probe->get_subcommand(name)->callback([&options, work = work] { options.work = work; });
  }
}

}  // namespace

void AddStageCommands(CommandTable& table) {
  table.Add("stage", "Lay the stage at a place, and say how well it is known", AddStage,
            CheckStage);
  table.Add("check-points", "Say how the stage lies at each place, by points of it that are known",
            AddCheckPoints, CheckCheckPoints);
  table.Add("occluder", "List, add and change what hides people", AddOccluder, CheckOccluder);
  table.Add("object", "List, add and place things that people use", AddObject, CheckObject);
  table.Add("sound", "List sounds, bring them in, and say how a place sounds", AddSound);
  table.Add("align", "Lay an occluder's model where the real thing is", AddAlign);
  table.Add("probe", "Light probes: of photographs, and of places", AddProbe);
}

}  // namespace lararium::editor
