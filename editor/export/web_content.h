#pragma once

// Leaves out of a show what a page in a browser does not need.

#include "editor/export/export.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::exporter {

// The page draws people at this detail or coarser; metres, as in human::ParseHuman.
inline constexpr float kWebDetail = 0.0015f;

Status ReduceForWeb(ExportContent& content, Progress& progress);

}  // namespace lararium::exporter
