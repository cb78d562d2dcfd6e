#include "editor/cli/drama_options.h"

#include <tuple>

#include "editor/cli/command_table.h"
#include "editor/document/cast_document.h"
#include "editor/import/cast/cast_presets.h"

namespace lararium::editor {

namespace {

void AddFigure(CLI::App* command, CLI::Option* name, CastOptions& options) {
  CLI::Option* preset =
      command->add_option("--preset", options.preset, "One of the people that come with the editor")
          ->check(CLI::IsMember(import::CastPresetNames()));
  CLI::Option* recipe =
      command->add_option("--recipe", options.recipe, "Build the figure from the cast library")
          ->check(CLI::ExistingFile)
          ->excludes(preset);
  CLI::Option* model =
      command->add_option("--import", options.model, "Figure to import: glTF, VRM, FBX, Collada")
          ->check(CLI::ExistingFile)
          ->excludes(preset)
          ->excludes(recipe);
  CLI::Option* plain = command->add_flag("--plain", options.plain, "The plain built-in figure")
                           ->excludes(preset)
                           ->excludes(recipe)
                           ->excludes(model);
  for (CLI::Option* figure : {preset, recipe, model, plain}) {
    figure->needs(name);
  }
  command->add_option("--bone-map", options.bone_map, "Which bone of the import is which joint")
      ->check(CLI::ExistingFile)
      ->needs(name);
  command
      ->add_option("--bone", options.bones,
                   "JOINT=BONE of the import; JOINT= where it has none; JOINT: as it is found. May "
                   "be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->needs(name);
  command->add_option("--height", options.height, "Of the plain figure, metres")
      ->check(CLI::Range(kMinHeight, kMaxHeight))
      ->needs(name);
  command->add_option("--tunic", options.tunic, "Of the plain figure: r,g,b, albedo from 0 to 1")
      ->delimiter(',')
      ->expected(3)
      ->check(CLI::Range(0.0, 1.0))
      ->needs(name);
}

void AddClips(CLI::App* command, CLI::Option* name, CastOptions& options) {
  CLI::Option* clip =
      command->add_option("--add-clip", options.add_clip, "A motion for the person: BVH, FBX, glTF")
          ->check(CLI::ExistingFile)
          ->needs(name);
  command->add_option("--clip-name", options.clip_name, "As the drama calls it")->needs(clip);
  command->add_flag("--loop", options.loops, "The motion repeats")->needs(clip);
  command->add_option("--remove-clip", options.remove_clip, "Forget the motion of this name")
      ->needs(name);
  CLI::Option* rename =
      command->add_option("--rename-clip", options.rename_clip, "Give the motion of this name...")
          ->needs(name);
  CLI::Option* to = command->add_option("--to", options.to, "...this one")->needs(rename);
  rename->needs(to);
}

void AddCast(CLI::App* command, CastOptions& options) {
  AddProject(command, options.project);
  CLI::Option* name = command->add_option(
      "--name", options.name,
      "Add this person, as the drama calls them, or change what is given; a title makes a name of "
      "its own; the list otherwise");
  AddText(command, "--title", options.title, "What they are called in the editor")->needs(name);
  command->add_option("--remove", options.remove, "Take this person out of the cast")
      ->excludes(name);
  AddFigure(command, name, options);
  AddClips(command, name, options);
  AddText(command, "--voice-variant", options.voice_variant,
          "Where lines are not recorded: m3, f2 and so on of espeak-ng")
      ->needs(name);
  for (const auto& [option, value, text] :
       {std::tuple{"--voice-pitch", &options.voice_pitch, "From 0 to 99"},
        {"--voice-range", &options.voice_range, "Of the pitch, from 0 to 99"},
        {"--voice-rate", &options.voice_rate, "Words a minute, from 80 to 450"}}) {
    command->add_option(option, *value, text)->needs(name);
  }
  command
      ->add_option("--listen", options.listen,
                   "Write their first line, or a sentence, into this FLAC file: the voice to "
                   "listen to")
      ->needs(name);
}

void AddLines(CLI::App* command, LinesOptions& in) {
  AddProject(command, in.project);
  CLI::Option_group* work = command->add_option_group("work", "Before the list");
  CLI::Option* import =
      work->add_option("--import", in.import,
                       "A gettext catalogue (.po) to translate by, or a table (.csv, .json) to "
                       "replace the project's")
          ->check(CLI::ExistingFile);
  work->add_option("--add-language", in.add_language, "Add a language, such as la, it or en");
  work->add_option("--add", in.add, "Add the line ID");
  work->add_option("--set", in.set, "Change the line ID");
  work->add_option("--remove", in.remove, "Remove the line ID");
  work->require_option(0, 1);
  command
      ->add_option("--language", in.language,
                   "Language of the catalogue; by default the one in its header")
      ->needs(import);
  AddText(command, "--speaker", in.speaker, "The person of the cast who says it; \"\": no speaker");
  AddText(command, "--notes", in.notes, "For speakers and translators");
  RequireUtf8(command->add_option(
                  "--text", in.texts,
                  "LANGUAGE=TEXT: what is said; LANGUAGE= where it has none. May be repeated"))
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void CheckLines(const LinesOptions& in) {
  const bool changes = in.speaker || in.notes || !in.texts.empty();
  if (changes && in.add.empty() && in.set.empty()) {
    throw CLI::ValidationError("lines", "needs a line: --add ID or --set ID");
  }
  if (!in.set.empty() && !changes) {
    throw CLI::ValidationError("--set", "needs a change, such as --text");
  }
}

void AddCaptions(CLI::App* command, CaptionsOptions& out) {
  AddProject(command, out.project);
  CLI::Option_group* way = command->add_option_group("file", "What is written or read");
  way->add_option("--out", out.out, "Write them here: SubRip (.srt) or WebVTT (.vtt)");
  way->add_option("--import", out.import,
                  "Take over the texts and times of such a file as captions of the lines that are "
                  "said then")
      ->check(CLI::ExistingFile);
  way->require_option(1);
  command->add_option("--language", out.language, "Of the captions; otherwise the first");
  command->add_option("--spoken", out.spoken, "That is spoken; otherwise the first");
  command->add_option("--seconds", out.seconds, "Of the drama that are run")
      ->check(CLI::Range(0.0, 36000.0));
}

void AddItemChanges(CLI::App* command, CLI::Option* item, TimelineOptions& options) {
  for (const auto& [name, seconds, text] :
       {std::tuple{"--trim-begin", &options.trim_begin,
                   "Seconds that its begin moves; its end stays"},
        {"--trim-end", &options.trim_end, "Seconds that its end moves"},
        {"--move", &options.move, "Seconds that it moves"},
        {"--copy-to", &options.copy_to, "A copy begins at this second of the drama"}}) {
    command->add_option(name, *seconds, text)->check(CLI::Range(-1e6, 1e6))->needs(item);
  }
  command->add_flag("--delete", options.remove, "Take it off the timeline")->needs(item);
  command->add_flag("--ripple", options.ripple, "What begins later moves along; a gap closes")
      ->needs(item);
  command->add_option("--unset", options.unset, "KEY: says this no longer; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->needs(item);
}

void AddTimeline(CLI::App* command, TimelineOptions& options) {
  AddProject(command, options.project);
  CLI::Option_group* work = command->add_option_group("work", "Before the list");
  work->add_option("--out", options.out, "Write it for other programs: OpenTimelineIO (.otio)");
  CLI::Option* add = work->add_option(
      "--add", options.add,
      "Add an item to this lane: clips, gestures, speech, walks, uses, gaze, expressions of an "
      "actor; lights, sounds, captions, descriptions, markers of the stage");
  CLI::Option* item =
      work->add_option("--item", options.items,
                       "Change this one, as the list calls it, or by its id; may be repeated")
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  work->require_option(0, 1);
  command->add_option("--actor", options.actor, "Whose the added item is")->needs(add);
  command->add_option("--at", options.at, "Second of the drama at which it begins")
      ->check(CLI::Range(0.0, 1e6))
      ->needs(add);
  command
      ->add_option("--field", options.fields,
                   "KEY=VALUE: what the item says, as line=salvete or to=1.5,-2,90 (x, z, heading "
                   "of a point); may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  AddItemChanges(command, item, options);
  command->add_option("--spoken", options.spoken, "Language that is spoken; otherwise the first");
  command->add_option("--seconds", options.seconds, "Of the drama that are run")
      ->check(CLI::Range(0.0, 36000.0));
}

void CheckTimeline(const TimelineOptions& options) {
  if (!options.add.empty() && !options.at) {
    throw CLI::ValidationError("--add", "needs the begin: --at SECONDS");
  }
  const bool changes = !options.fields.empty() || !options.unset.empty() || options.trim_begin ||
                       options.trim_end || options.move || options.copy_to || options.remove;
  if (!options.items.empty() && !changes) {
    throw CLI::ValidationError("--item", "needs a change, such as --move or --field");
  }
  if (!options.fields.empty() && options.items.empty() && options.add.empty()) {
    throw CLI::ValidationError("--field", "needs an item: --add or --item");
  }
}

void AddImportBml(CLI::App* command, ImportBmlOptions& in) {
  AddProject(command, in.project);
  command->add_option("FILE", in.file, "Behavior Markup Language 1.0 (.xml)")
      ->required()
      ->check(CLI::ExistingFile);
  command
      ->add_option("--actor", in.actors, "ID=NAME: who a character of the file is; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--at", in.begin, "When it begins, seconds of the drama")
      ->check(CLI::Range(0.0, 36000.0));
}

void AddCredits(CLI::App* command, CreditsOptions& credits) {
  AddProject(command, credits.project);
  command->add_option("--out", credits.out, "Write them here: .txt, or .json");
}

}  // namespace

void AddDramaCommands(CommandTable& table) {
  table.Add("cast", "Add, change and remove people", AddCast);
  table.Add("lines", "List, write and translate what is said", AddLines, CheckLines);
  table.Add("captions", "Write or read captions by the drama's time", AddCaptions);
  table.Add("timeline", "List and edit what is on the timeline, or write it for other programs",
            AddTimeline, CheckTimeline);
  table.Add("import-bml", "Add behaviours in BML to the drama's tracks", AddImportBml);
  table.Add("credits", "Say who made what, and on which evidence", AddCredits);
}

}  // namespace lararium::editor
