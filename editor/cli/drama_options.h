#pragma once

// Options of the subcommands that edit the drama: its people, their lines and actions.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lararium::editor {

// Without a name and anything to remove, the subcommand only lists the cast. For an existing
// member, only the given properties change.
struct CastOptions {
  std::filesystem::path project = {};
  std::string name = {};  // Member to add or change; may be empty.
  std::optional<std::string> title = {};
  std::string remove = {};  // Removes the member from the cast; the files stay.
  // At most one source of the figure. Without one, a member keeps its figure, and a new one
  // gets the plain built-in figure.
  bool plain = false;                   // the plain built-in figure
  std::string preset = {};              // Name of a person that comes with the editor.
  std::filesystem::path recipe = {};    // Recipe of the cast library.
  std::filesystem::path model = {};     // Model file to import.
  std::filesystem::path bone_map = {};  // Saved bone map for the model.
  std::vector<std::string> bones = {};  // JOINT=BONE; "JOINT=": no bone; "JOINT": automatic.
  std::filesystem::path add_clip = {};  // Recorded motion for an existing member.
  std::string clip_name = {};           // Empty: the name in the file.
  bool loops = false;
  std::string remove_clip = {};
  std::string rename_clip = {};
  std::string to = {};                // New name of the clip.
  std::filesystem::path listen = {};  // FLAC file for a sample of the voice.
  std::optional<double> height = {};  // Height of the plain figure, metres.
  std::vector<double> tunic = {};     // Tunic of the plain figure, linear albedo; may be empty.
  // Fields of bake::VoiceSettings.
  std::optional<std::string> voice_variant = {};
  std::optional<int> voice_pitch = {};
  std::optional<int> voice_range = {};
  std::optional<int> voice_rate = {};
};

// Without an edit, the subcommand only lists the lines.
struct LinesOptions {
  std::filesystem::path project = {};
  std::filesystem::path import = {};  // .po, .csv or .json
  std::string language = {};          // Language of a .po; empty: stated in the file.
  std::string add_language = {};      // Language tag of an additional column.
  std::string add = {};               // Id of a line to add.
  std::string set = {};               // Id of a line to change.
  std::string remove = {};            // Id of a line to remove.
  // Fields of the line that is added or changed; fields that are not given stay.
  std::optional<std::string> speaker = {};
  std::optional<std::string> notes = {};
  std::vector<std::string> texts = {};  // LANGUAGE=TEXT; "LANGUAGE=" removes the text.
};

struct CaptionsOptions {
  std::filesystem::path project;
  std::filesystem::path out;     // .srt or .vtt; exactly one of `out` and `import`.
  std::filesystem::path import;  // Captions of the complete drama, to divide among its lines.
  std::string language;          // Empty: the first caption language.
  std::string spoken;            // Empty: the first spoken language.
  double seconds = 60.0;         // Seconds of the drama to run.
};

// Without an edit, the subcommand only lists the items.
struct TimelineOptions {
  std::filesystem::path project = {};
  std::filesystem::path out = {};        // .otio for other programs; nothing is edited then.
  std::string spoken = {};               // Spoken language; empty: the project's first.
  double seconds = 60.0;                 // Seconds of the drama to run.
  std::string add = {};                  // Lane for a new item (drama::LaneSpecs).
  std::string actor = {};                // Actor of the new item; empty: the stage.
  std::optional<double> at = {};         // Time in the drama, seconds.
  std::vector<std::string> items = {};   // Items to change: ACTOR/LANE/NUMBER, or ids.
  std::vector<std::string> fields = {};  // KEY=VALUE, set in all of them.
  std::vector<std::string> unset = {};
  std::optional<double> trim_begin = {};  // Seconds, later or earlier; the other end stays.
  std::optional<double> trim_end = {};
  std::optional<double> move = {};
  std::optional<double> copy_to = {};  // Time in the drama, seconds.
  bool remove = false;
  bool ripple = false;  // Moves later items along and closes gaps.
};

struct ImportBmlOptions {
  std::filesystem::path project;
  std::filesystem::path file;
  std::vector<std::string> actors;  // ID=NAME
  double begin = 0.0;               // Seconds of the drama.
};

struct CreditsOptions {
  std::filesystem::path project;
  std::filesystem::path out;  // .txt or .json; empty: print only.
};

}  // namespace lararium::editor
