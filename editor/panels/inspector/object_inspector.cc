#include "editor/panels/inspector/object_inspector.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>

#include "editor/document/object_document.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

void DrawObject(editor::Workspace& workspace,
                Selection& selection,
                const editor::ObjectDocument& object) {
  Heading(object.name.c_str());
  Hint(Tr("Where it is at the beginning. What people do with it is written in the drama."));
  DrawWarnings(workspace, workspace.project().paths().Prop(object.name));
  editor::ObjectDocument edited = object;
  bool changed = false;
  if (BeginProperties("object")) {
    PropertyText(Tr("Model"), object.file.empty()
                                  ? Text(Tr("%s, from the library"), object.model.c_str())
                                  : object.file);
    changed = VectorProperty(workspace, Tr("Position"), edited.position, 0.005, "%.3f m");
    changed |= NumberProperty(workspace, Tr("Heading"), edited.heading, 0.5, -360.0, 360.0,
                              "%.0f\xc2\xb0");
    EndProperties();
  }
  if (changed) {
    workspace.project().Edit(
        Sentence("place %s", {object.name}),
        [&edited](editor::ProjectDocument& document) {
          std::replace_if(
              document.objects.begin(), document.objects.end(),
              [&](const auto& o) { return o.name == edited.name; }, edited);
        },
        "object");
  }
  if (ImGui::Button(Tr("Remove"), ImVec2(-FLT_MIN, 0))) {
    workspace.project().Edit(Sentence("remove %s", {object.name}),
                             [name = object.name](editor::ProjectDocument& document) {
                               std::erase_if(document.objects,
                                             [&](const auto& o) { return o.name == name; });
                             });
    selection = {};
  }
}

}  // namespace lararium::panels
