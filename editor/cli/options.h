#pragma once

// The command line of the editor.

#include <filesystem>
#include <variant>

#include "editor/cli/drama_options.h"
#include "editor/cli/place_options.h"
#include "editor/cli/show_options.h"
#include "editor/cli/stage_options.h"

namespace lararium::editor {

struct WindowOptions {
  std::filesystem::path project;  // Empty: the start page.
};

using Subcommand = std::variant<WindowOptions,
                                NewOptions,
                                ProjectOptions,
                                PlaceOptions,
                                LocateOptions,
                                TrainCommandOptions,
                                ImportColmapOptions,
                                ExportColmapOptions,
                                PruneOptions,
                                MeasureOptions,
                                CastOptions,
                                BakeOptions,
                                CheckOptions,
                                StageOptions,
                                CheckPointsOptions,
                                OccluderOptions,
                                ObjectOptions,
                                SoundOptions,
                                AlignOptions,
                                LinesOptions,
                                CaptionsOptions,
                                TimelineOptions,
                                ImportBmlOptions,
                                CreditsOptions,
                                RenderOptions,
                                PortraitOptions,
                                WardrobeOptions,
                                ReferenceOptions,
                                ProbeOptions,
                                CameraOptions,
                                CalibrateOptions,
                                ExportOptions,
                                PublishOptions,
                                KeyOptions,
                                FetchCastLibraryOptions>;

struct CommandLine {
  Subcommand subcommand;
  bool json = false;  // Prints results as one object on stdout.
};

// Gives the command, or the exit code if the command line asks for help or has an error; in
// that case the message has been printed.
std::variant<CommandLine, int> ParseCommandLine(int argc, const char* const* argv);

}  // namespace lararium::editor
