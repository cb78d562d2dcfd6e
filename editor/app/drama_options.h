#pragma once

// What the subcommands take that write the drama: its people, and what they say and do.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lararium::app {

// Without a name and anything to remove: only the list. Of somebody who is in the cast already,
// only what is given changes.
struct CastOptions {
  std::filesystem::path project = {};
  std::string name = {};    // whom to add or change; empty: nobody
  std::string remove = {};  // takes them out of the cast; their files stay
  // At most one; none: the figure that they have, the plain built-in one of somebody new.
  bool plain = false;                   // the plain built-in figure
  std::string preset = {};              // one of the people that come with the editor
  std::filesystem::path recipe = {};    // of the cast library
  std::filesystem::path model = {};     // a figure to import
  std::filesystem::path bone_map = {};  // of the model
  std::vector<std::string> bones = {};  // JOINT=BONE of it, JOINT= (there is none), JOINT (found)
  std::filesystem::path add_clip = {};  // a recorded motion for somebody who is in the cast
  std::string clip_name = {};           // empty: the file's
  bool loops = false;
  std::string remove_clip = {};
  std::string rename_clip = {};
  std::string to = {};                // what it is called from then on
  std::filesystem::path listen = {};  // a FLAC file that the voice is written into
  std::optional<double> height = {};  // of the plain figure, metres
  std::vector<double> tunic = {};     // of the plain figure, linear albedo; or empty
  // bake::VoiceSettings
  std::optional<std::string> voice_variant = {};
  std::optional<int> voice_pitch = {};
  std::optional<int> voice_range = {};
  std::optional<int> voice_rate = {};
};

// Without a work: only the list.
struct LinesOptions {
  std::filesystem::path project = {};
  std::filesystem::path import = {};  // .po, .csv or .json
  std::string language = {};          // of a .po; empty: as it says
  std::string add_language = {};      // a further column
  std::string add = {};               // adds a line of this id
  std::string set = {};               // changes the one of this id
  std::string remove = {};            // removes it
  // Of one that is added or changed; what is not given stays.
  std::optional<std::string> speaker = {};
  std::optional<std::string> notes = {};
  std::vector<std::string> texts = {};  // LANGUAGE=TEXT; LANGUAGE=: it has none
};

struct CaptionsOptions {
  std::filesystem::path project;
  std::filesystem::path out;     // .srt or .vtt; exactly one of out and import
  std::filesystem::path import;  // of the whole drama: becomes captions of its lines
  std::string language;          // empty: the project's first
  std::string spoken;            // likewise
  double seconds = 60.0;         // of the drama that are run
};

// Without anything to do: only the list.
struct TimelineOptions {
  std::filesystem::path project = {};
  std::filesystem::path out = {};        // .otio, for other programs; nothing is edited then
  std::string spoken = {};               // language; empty: the project's first
  double seconds = 60.0;                 // of the drama that are run
  std::string add = {};                  // adds an item to this lane (drama::kLaneNames),
  std::string actor = {};                // whose it is; empty: the stage's
  std::optional<double> at = {};         // seconds of the drama
  std::vector<std::string> items = {};   // or else changes these: ACTOR/LANE/NUMBER, or ids,
  std::vector<std::string> fields = {};  // KEY=VALUE, of all of them
  std::vector<std::string> unset = {};
  std::optional<double> trim_begin = {};  // seconds, later or earlier; the other end stays
  std::optional<double> trim_end = {};
  std::optional<double> move = {};
  std::optional<double> copy_to = {};  // seconds of the drama
  bool remove = false;
  bool ripple = false;  // what begins later moves along, and a gap closes
};

struct ImportBmlOptions {
  std::filesystem::path project;
  std::filesystem::path file;
  std::vector<std::string> actors;  // ID=NAME
  double begin = 0.0;               // seconds of the drama
};

struct CreditsOptions {
  std::filesystem::path project;
  std::filesystem::path out;  // .txt or .json; empty: only told
};

}  // namespace lararium::app
