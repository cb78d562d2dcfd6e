#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "player/options.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/render/graphics_context.h"
#include "shared/render/render_target.h"
#include "shared/render/window.h"

namespace lararium::player {

// Where the pictures go: a window, or nowhere that is seen. Its graphics context
// is current on the thread that opened it.
class Screen {
 public:
  static Result<Screen> Open(const PlayOptions& options, const std::string& title);

  void Present(const render::RenderTarget& target);
  // Warns where a headset's panel would not be shown pixel for pixel on the whole monitor.
  void CheckSize(const render::RenderTarget& panel, Log& log) const;

  // Handles input; false once the visitor wants the end.
  bool KeepGoing();
  // The names of keys pressed since it was last asked.
  std::vector<std::string> TakeKeys() { return std::exchange(*keys_, {}); }

 private:
  bool full_screen_ = false;
  std::optional<render::OffscreenContext> offscreen_;
  std::optional<render::Window> window_;
  // On the heap: the window keeps its address.
  std::unique_ptr<std::vector<std::string>> keys_ = std::make_unique<std::vector<std::string>>();
};

}  // namespace lararium::player
