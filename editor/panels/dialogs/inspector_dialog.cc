#include "editor/panels/dialogs/inspector_dialog.h"

#include <imgui.h>

#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

void DrawInspectorDialog(const std::string& title, const std::function<bool()>& content) {
  constexpr float kWidth = 520.0f;  // logical pixels
  if (!ImGui::IsPopupOpen(title.c_str())) {
    return;
  }
  bool open = true;
  DrawModal(title.c_str(), kWidth, open, [&] { open = !content(); });
}

}  // namespace lararium::panels
