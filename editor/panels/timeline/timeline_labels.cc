#include "editor/panels/timeline/timeline_labels.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "editor/document/timeline_fields.h"
#include "editor/panels/widgets/text.h"

namespace lararium::panels {

using drama::LaneKind;
using drama::TaskRecord;
using editor::TextOf;

namespace {

std::string Shorten(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

std::string PointText(const Json& point) {
  return Shorten(point.value("x", 0.0)) + ", " + Shorten(point.value("z", 0.0));
}

}  // namespace

std::string LabelOf(LaneKind kind, const Json& fields) {
  const auto point = [&](std::string_view key) {
    const auto found = fields.find(key);
    return found != fields.end() && found->is_object() ? PointText(*found) : "";
  };
  const drama::LaneSpec& lane = drama::SpecOf(kind);
  const std::string label = editor::LabelTexts(lane, fields);
  if (!lane.walks) {
    return label.empty() ? point(lane.content) : label;
  }
  const std::string to = point("to");
  const std::string from = point("from");
  const std::string where = !to.empty()                      ? "\xe2\x86\x92 " + to
                            : !from.empty() && label.empty() ? Text(Tr("at %s"), from.c_str())
                            : fields.contains("hide")        ? Tr("leaves")
                                                             : "";
  return label.empty() || where.empty() ? label + where : label + " " + where;
}

std::string BlockLabel(const TaskRecord& task, bool of_object) {
  std::string action = task.action;
  for (const char* prefix : {"say ", "gesture ", "express ", "use ", "play "}) {
    if (action.starts_with(prefix)) {
      action = action.substr(std::string_view(prefix).size());
      break;
    }
  }
  std::replace(action.begin(), action.end(), '_', ' ');
  return of_object ? task.actor + ": " + action
                   : action + (task.object.empty() ? "" : " " + task.object);
}

}  // namespace lararium::panels
