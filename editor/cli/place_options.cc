#include "editor/cli/place_options.h"

#include <cstdio>

#include "editor/cli/command_table.h"
#include "editor/document/project.h"

namespace lararium::editor {

namespace {

void AddNew(CLI::App* command, NewOptions& create) {
  AddProject(command, create.project);
  RequireUtf8(command->add_option("--title", create.title, "Title; the folder's name otherwise"));
}

void AddProjectItself(CLI::App* command, ProjectOptions& options) {
  AddProject(command, options.project);
  AddText(command, "--title", options.title, "What it is called");
  AddText(command, "--credits", options.credits, "Who made it");
  AddText(command, "--spoken", options.spoken,
          "Languages that voices are baked in, as la,it; \"\": the first of the lines");
  AddText(command, "--captions", options.captions,
          "Languages that can be read, likewise; \"\": all of the lines");
}

void AddPlace(CLI::App* command, PlaceOptions& options) {
  AddProject(command, options.project);
  CLI::Option_group* work = command->add_option_group("work", "Before the list");
  work->add_option("--add", options.add,
                   "Add NAME, to be trained; a title makes a name of its own");
  work->add_option("--set", options.set, "Change NAME");
  work->add_option("--first", options.first,
                   "Put NAME before the others: the window opens with it");
  CLI::Option* rename =
      work->add_option("--rename", options.rename, "Give NAME, and its folder, another name");
  work->add_option("--remove", options.remove, "Remove NAME; its files stay");
  work->require_option(0, 1);
  CLI::Option* to = command->add_option("--to", options.to, "The other name")->needs(rename);
  rename->needs(to);
  AddText(command, "--title", options.title, "What it is called");
  CLI::Option* video = command->add_option("--video", options.video, "What it is trained from")
                           ->check(CLI::ExistingFile);
  command->add_option("--from-images", options.images_of, "A folder of images to train it from")
      ->check(CLI::ExistingDirectory)
      ->excludes(video);
  command
      ->add_option("--preview", options.preview,
                   "What the camera view plays, a video or a folder of images; the training's is "
                   "played where there is none besides")
      ->check(CLI::ExistingPath);
  command->add_option("--occluders-of", options.occluders_of,
                      "Take over the shapes and models of this place");
  command->add_flag("--images", options.images, "List the training images, to pick in, too");
}

void CheckPlace(const PlaceOptions& options) {
  const bool changes = options.title || !options.video.empty() || !options.images_of.empty() ||
                       !options.preview.empty() || !options.occluders_of.empty();
  if (changes && options.add.empty() && options.set.empty()) {
    throw CLI::ValidationError("place", "needs a place: --add NAME or --set NAME");
  }
  if (!options.set.empty() && !changes) {
    throw CLI::ValidationError("--set", "needs a change, such as --preview");
  }
}

void AddLocate(CLI::App* command, LocateOptions& options) {
  AddProject(command, options.project);
  CLI::Option* from =
      command->add_option("--from", options.from, "One of them, as the list has it");
  CLI::Option* to =
      command->add_option("--to", options.to, "Where it is now; a sound is copied from there")
          ->check(CLI::ExistingPath)
          ->needs(from);
  from->needs(to);
  command->add_flag("--alone", options.alone, "Leave others that made the same move")->needs(from);
}

void AddTrain(CLI::App* command, TrainCommandOptions& train) {
  AddProject(command, train.project);
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

void CheckTrain(const TrainCommandOptions& train) {
  CheckIntrinsics(train.intrinsics);
  if (train.add && train.video.empty() && train.images.empty() && train.camera.empty()) {
    throw CLI::ValidationError("--add",
                               "needs the recording to add: --video, --images or --camera");
  }
  const bool recorded = !train.video.empty() || !train.images.empty() || !train.camera.empty();
  if (train.remove_session && (train.add || recorded)) {
    throw CLI::ValidationError("--remove-session", "cannot be combined with a recording");
  }
  if (train.put_back && (train.add || recorded || train.remove_session)) {
    throw CLI::ValidationError("--put-back",
                               "cannot be combined with a recording or --remove-session");
  }
}

void AddImportColmap(CLI::App* command, ImportColmapOptions& in) {
  AddProject(command, in.project);
  command->add_option("DIR", in.model, "The model, text or binary, or a COLMAP project")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--images", in.images, "Its images; in the project or beside it otherwise")
      ->check(CLI::ExistingDirectory);
  command->add_option("--place", in.place, "Name of the place");
}

void AddExportColmap(CLI::App* command, ExportColmapOptions& out) {
  AddProject(command, out.project);
  command->add_option("DIR", out.model, "The folder to write")->required();
  command->add_option("--place", out.place, "Name of the place");
  command->add_flag("--text", out.text, "As text; binary otherwise");
  command->add_flag("--with-images", out.with_images, "Write the keyframes' images too");
}

void AddPrune(CLI::App* command, PruneOptions& prune) {
  AddProject(command, prune.project);
  command->add_option("--points", prune.points, "Points that stay; only the table otherwise")
      ->check(CLI::Range(100, 10'000'000));
  command->add_option("--place", prune.place, "Name of the place");
}

void AddMeasure(CLI::App* command, MeasureOptions& options) {
  AddProject(command, options.project);
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

void AddCamera(CLI::App* command, CameraOptions& options) {
  command->add_option("PROJECT", options.project, "The project's folder; none with --list");
  command->add_option("--place", options.place, "The place; the only one otherwise");
  CLI::Option* video =
      command->add_option("--video", options.video, "A recording instead of the training's");
  video->check(CLI::ExistingFile);
  command->add_option("--images", options.images, "A folder of images instead of the training's")
      ->check(CLI::ExistingDirectory)
      ->excludes(video);
  CLI::Option* response = command->add_option("--response", options.response,
                                              "The camera's response (.json), of 'probe merge'");
  response->check(CLI::ExistingFile);
  command->add_option("--knee", options.knee, "Where highlights are compressed from; 1: nowhere")
      ->check(CLI::Range(0.05, 1.0))
      ->excludes(response);
  command
      ->add_option("--shutter", options.shutter,
                   "Share of the time between frames that it is open; learnt otherwise")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--device-out", options.device_out, "Write a device file for the player too");
  command->add_flag("--forget", options.forget, "People stay sharp and clean");
  const std::vector<CLI::Option*> all = command->get_options();
  CLI::Option* list =
      command->add_flag("--list", options.list, "Say which cameras are connected, nothing else");
  for (CLI::Option* other : all) {
    if (other != command->get_help_ptr()) {
      list->excludes(other);
    }
  }
}

void CheckCamera(const CameraOptions& options) {
  if (options.project.empty() && !options.list) {
    throw CLI::RequiredError("PROJECT");
  }
}

void ParseBoard(const std::string& text, CalibrateOptions& calibrate) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%4dx%4d%c", &calibrate.columns, &calibrate.rows, &rest) != 2) {
    throw CLI::ValidationError("--board", "takes CxR, as 9x6: the inner corners");
  }
}

void AddCalibrate(CLI::App* command, CalibrateOptions& options) {
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
      ->add_option_function<std::string>(
          "--board", [&](const std::string& text) { ParseBoard(text, options); },
          "CxR: inner corners, where four squares meet; 10 x 7 squares have 9x6")
      ->default_str("9x6");
  command->add_option("--square", options.square, "Side of a square in metres")
      ->check(CLI::Range(0.001, 10.0));
  command->add_option("--seconds", options.seconds, "How long to look at the camera")
      ->check(CLI::Range(1.0, 3600.0))
      ->capture_default_str();
  command->add_option("--device-out", options.device_out,
                      "Write the camera into this device file for the player");
}

}  // namespace

void AddPlaceCommands(CommandTable& table) {
  table.Add("new", "Make an empty project", AddNew);
  table.Add("project", "Say what a project holds, and change its title, credits and languages",
            AddProjectItself);
  table.Add("place", "List, add, rename and remove places", AddPlace, CheckPlace);
  table.Add("locate", "List files that are not where the project says, and say where they are",
            AddLocate);
  table.Add("train", "Learn a place from a recording", AddTrain, CheckTrain);
  table.Add("import-colmap", "Take a place over from a COLMAP model", AddImportColmap);
  table.Add("export-colmap", "Write a place as a COLMAP model", AddExportColmap);
  table.Add("prune", "Make a map smaller, and tell what smaller ones lose", AddPrune);
  table.Add("measure", "Measure between two points of a map, and scale the stage by that",
            AddMeasure);
  table.Add("camera", "Measure how noisy and soft a place's images are, or list the cameras",
            AddCamera, CheckCamera);
  table.Add("calibrate", "Measure a camera's intrinsics with a chessboard, and their errors",
            AddCalibrate);
}

}  // namespace lararium::editor
