#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "player/app/options.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/gl/window.h"

namespace lararium::player {

// The output for pictures: a window, or only a graphics context (headless). The context is current
// on the thread that opened it.
class Screen {
 public:
  static Result<Screen> Open(const DisplayOptions& options, const std::string& title);

  void Present(const render::RenderTarget& target);
  // Logs a warning if the monitor does not have the size of a headset's panel, so that the panel
  // would be scaled.
  void CheckSize(const render::RenderTarget& panel, Log& log) const;

  // Handles input. Returns false once the user has asked to end the program.
  bool KeepGoing();
  // Returns the names of keys that were pressed since the last call.
  std::vector<std::string> TakeKeys() { return std::exchange(*keys_, {}); }

 private:
  bool full_screen_ = false;
  std::optional<render::OffscreenContext> offscreen_;
  std::optional<render::Window> window_;
  // On the heap, because callbacks of the window keep its address.
  std::unique_ptr<std::vector<std::string>> keys_ = std::make_unique<std::vector<std::string>>();
};

}  // namespace lararium::player
