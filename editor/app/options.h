#pragma once

// The editor's command line.

#include <filesystem>
#include <variant>

#include "editor/app/drama_options.h"
#include "editor/app/place_options.h"
#include "editor/app/show_options.h"
#include "editor/app/stage_options.h"

namespace lararium::app {

struct WindowOptions {
  std::filesystem::path project;  // empty: the start page
};

using Subcommand = std::variant<WindowOptions,
                                NewOptions,
                                ProjectOptions,
                                PlaceOptions,
                                LocateOptions,
                                TrainOptions,
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
                                ReferenceOptions,
                                ProbeOptions,
                                CameraOptions,
                                CalibrateOptions,
                                ExportOptions,
                                KeyOptions>;

struct CommandLine {
  Subcommand subcommand;
  bool json = false;  // results as one object on stdout
};

// What to do, or the exit code where the command line asked for help or is wrong
// (its message is printed).
std::variant<CommandLine, int> ParseCommandLine(int argc, const char* const* argv);

}  // namespace lararium::app
