#include "editor/cli/show_options.h"

#include <algorithm>
#include <cstdio>

#include "editor/cli/command_table.h"
#include "editor/import/cast/cast_presets.h"
#include "editor/import/wardrobe/garment_design.h"

namespace lararium::editor {

namespace {

void AddBake(CLI::App* command, BakeOptions& bake) { AddProject(command, bake.project); }

void AddCheck(CLI::App* command, CheckOptions& check) {
  AddProject(command, check.project);
  command->add_option("--seconds", check.seconds, "How long to run the drama")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  command
      ->add_option("--seeks", check.seeks,
                   "Then go to this many random times, and say whether all is as it was")
      ->check(CLI::Range(0, 10'000));
  command
      ->add_option("--visitor", check.visitors,
                   "Run it for this visitor too, as lararium-player --visitor-log recorded them")
      ->check(CLI::ExistingFile);
}

void AddRender(CLI::App* command, RenderOptions& render) {
  AddProject(command, render.project);
  command->add_option("--video", render.video, "Video file")->required()->check(CLI::ExistingFile);
  command->add_option("--out", render.out, "The composite, with its sound (.mp4)")->required();
  command->add_option("--sound", render.sound, "Write the sound here too (.wav)");
  command->add_flag("--evidence", render.evidence,
                    "People and things in the colours of how certain they are");
  command->add_option("--place", render.place, "Name of the place");
  AddIntrinsics(command, render.intrinsics);
}

void CheckRender(const RenderOptions& render) { CheckIntrinsics(render.intrinsics); }

void ParseSize(const std::string& text, PortraitOptions& portrait) {
  constexpr int kLargest = 4096;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%4dx%4d%c", &portrait.width, &portrait.height, &rest) != 2 ||
      std::clamp(portrait.width, 16, kLargest) != portrait.width ||
      std::clamp(portrait.height, 16, kLargest) != portrait.height) {
    throw CLI::ValidationError("--size", "takes WxH, from 16 to 4096 pixels");
  }
}

void AddWardrobe(CLI::App* command, WardrobeOptions& wardrobe) {
  command
      ->add_option("--check", wardrobe.check,
                   "Check this file garment.json; with --on also how it lies on a person")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--picture", wardrobe.picture,
                   "Picture this garment of the library; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check(CLI::IsMember(import::GarmentNames()));
  command
      ->add_option(
          "--on", wardrobe.on,
          "Who wears it in the picture (usually server), or on whom a checked file is tried")
      ->check(CLI::IsMember(import::CastPresetNames()));
  command->add_option("--out", wardrobe.out, "The picture (.png, .jpg)");
}

void CheckWardrobe(const WardrobeOptions& wardrobe) {
  if (wardrobe.picture.empty() != wardrobe.out.empty()) {
    throw CLI::ValidationError("--picture", "needs --out, and --out needs it");
  }
  if (!wardrobe.check.empty() && !wardrobe.picture.empty()) {
    throw CLI::ValidationError("--picture", "excludes --check");
  }
}

void AddPortrait(CLI::App* command, PortraitOptions& portrait) {
  command
      ->add_option("FILE", portrait.files,
                   "People (.larhuman), things (.larprop), or models of other programs")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_flag("--thing", portrait.thing,
                    "Import the models of other programs as things, not as people");
  command->add_option("--out", portrait.out, "The picture (.png, .jpg)")->required();
  command->add_option("--view", portrait.view, "From where")
      ->check(CLI::IsMember({"front", "side", "back", "bust", "face", "three-quarter"}));
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
  command->add_option_function<std::string>(
      "--size", [&](const std::string& text) { ParseSize(text, portrait); },
      "WxH in pixels, of each person");
  command->add_flag("--sheet", portrait.sheet, "A contact sheet: all views, faces and shapes");
}

void AddReference(CLI::App* command, ReferenceOptions& reference) {
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

void AddPoints(CLI::App* command, std::optional<int>& points) {
  command->add_option("--points", points, "Points that each place keeps at most")
      ->check(CLI::Range(100, 10'000'000));
}

CLI::Option* AddSign(CLI::App* command, std::filesystem::path& key) {
  return command->add_option("--sign", key, "Sign it with this secret key (NAME.key)")
      ->check(CLI::ExistingFile);
}

void AddExport(CLI::App* command, ExportOptions& pack) {
  AddProject(command, pack.project);
  CLI::Option* out = command->add_option("--out", pack.out, "The bundle (.larshow)");
  CLI::Option* web =
      command
          ->add_option("--web", pack.web,
                       "Write a folder for browsers instead, which any web server can serve")
          ->excludes(out);
  command->add_option("--page", pack.page, "The page in it; the one of this program otherwise")
      ->check(CLI::ExistingDirectory)
      ->needs(web);
  command
      ->add_option("--address", pack.address,
                   "Where the folder will be served (https://...): also write its QR code, and a "
                   "page with it to be printed")
      ->needs(web);
  CLI::Option* fleet =
      command
          ->add_option("--fleet", pack.fleet,
                       "Let the page join the fleet of a site: wss://HOST[:PORT]/SITE")
          ->needs(web);
  CLI::Option* password =
      command
          ->add_option("--fleet-password-file", pack.fleet_password,
                       "File visitors.password of the fleet's folder; every visitor can read it "
                       "in the page")
          ->check(CLI::ExistingFile)
          ->needs(fleet);
  fleet->needs(password);
  command->add_option("--group", pack.group, "Play one drama together with this group of the fleet")
      ->needs(fleet);
  AddPoints(command, pack.points);
  AddSign(command, pack.sign);
}

void AddPublish(CLI::App* command, PublishOptions& pack) {
  AddProject(command, pack.project);
  command->add_option("FOLDER", pack.folder, "The folder that a web server serves to players")
      ->required();
  AddPoints(command, pack.points);
  AddSign(command, pack.sign)->required();
}

void CheckExport(const ExportOptions& pack) {
  if (pack.out.empty() && pack.web.empty()) {
    throw CLI::RequiredError("--out or --web");
  }
  if (!pack.web.empty() && pack.sign.empty()) {
    throw CLI::ValidationError("--web", "needs --sign; make a key with lararium-editor key NAME");
  }
  if (!pack.address.empty() && !pack.address.starts_with("https://")) {
    throw CLI::ValidationError("--address",
                               "has to begin with https://, because browsers give the "
                               "camera to no other address");
  }
}

void AddKey(CLI::App* command, KeyOptions& key) {
  command
      ->add_option("NAME", key.name,
                   "Writes NAME.key, to be kept secret, and NAME.pub, for the players' --trust")
      ->required();
}

}  // namespace

void AddShowCommands(CommandTable& table) {
  table.Add("bake", "Prepare light, occluders and people", AddBake);
  table.Add("check", "Find every problem", AddCheck);
  table.Add("render", "Composite the show into a recording", AddRender, CheckRender);
  table.Add("portrait", "Picture people and things in a studio", AddPortrait);
  table.Add("wardrobe", "List, check and picture garments", AddWardrobe, CheckWardrobe);
  table.Add("reference", "Path-trace a moment of a show, or a person in a probe's light",
            AddReference);
  table.Add("export", "Pack the show", AddExport, CheckExport);
  table.Add("publish", "Put the show where players look for a newer one", AddPublish);
  table.Add("key", "Make the keys that shows are signed with", AddKey);
  table.Add<FetchCastLibraryOptions>("fetch-cast-library",
                                     "Fetch the library of which people are built, with npm",
                                     [](CLI::App*, FetchCastLibraryOptions&) {});
}

}  // namespace lararium::editor
