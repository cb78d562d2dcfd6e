#include "player/app/screen.h"

#include <utility>

namespace lararium::player {

Result<Screen> Screen::Open(const DisplayOptions& options, const std::string& title) {
  Screen screen;
  if (options.headless) {
    LARARIUM_ASSIGN_OR_RETURN(screen.offscreen_, render::CreateOffscreenContext(options.graphics));
    return screen;
  }
  render::WindowOptions window;
  window.title = title;
  window.vsync = options.mode != Display::kOpenXr;  // An OpenXR headset sets the pace itself.
  if (options.mode != Display::kOpenXr) {           // OpenXR needs OpenGL 3.3
    window.graphics = options.graphics;
  }
  if (options.monitor >= 0) {
    window.monitor = options.monitor;
    screen.full_screen_ = true;
  }
  LARARIUM_ASSIGN_OR_RETURN(screen.window_, render::Window::Create(window));
  render::WindowCallbacks callbacks;
  callbacks.key = [keys = screen.keys_.get()](int key, int action, int /*modifiers*/) {
    const std::string name = render::KeyName(key);
    if (action == render::kKeyPressed && !name.empty()) {
      keys->push_back(name);
    }
  };
  screen.window_->SetCallbacks(std::move(callbacks));
  return screen;
}

void Screen::Present(const render::RenderTarget& target) {
  if (window_) {
    const render::Window::Size size = window_->framebuffer_size();
    target.Present(size.width, size.height);
    window_->SwapBuffers();
  }
}

void Screen::CheckSize(const render::RenderTarget& panel, Log& log) const {
  if (!full_screen_) {
    return;
  }
  const render::Window::Size size = window_->framebuffer_size();
  if (size.width != panel.width() || size.height != panel.height()) {
    log.Warn(
        "the monitor has {}x{} pixels, the headset's panel {}x{}: the picture is scaled, and "
        "does not fit the lenses",
        size.width, size.height, panel.width(), panel.height());
  }
}

bool Screen::KeepGoing() {
  if (!window_) {
    return true;
  }
  window_->PollEvents();
  for (std::string& button : window_->TakePadButtons()) {
    keys_->push_back(std::move(button));
  }
  return !window_->ShouldClose();
}

}  // namespace lararium::player
