#pragma once

// Tries graphics interfaces until one gives a context. Private to render.

#include <utility>

#include "shared/core/status.h"
#include "shared/render/gl/graphics_context.h"

namespace lararium::render {

// Checks that the current context supports everything that drawing needs.
Status CheckDriver();
// Checks that a driver will get the memory that it needs; Mesa's crash without. Call it before a
// driver is loaded.
Status CheckMemory();

// create(api) returns a Result; on success it has made a context current. Without a choice, OpenGL
// 3.3 is tried first, then OpenGL ES 3.0. The error contains the messages of all attempts.
template <typename Create>
auto CreateChosen(GraphicsChoice choice, const Create& create) {
  const auto checked = [&create](GraphicsApi api) {
    auto made = create(api);
    if (made.ok()) {
      if (Status status = CheckDriver(); !status.ok()) {
        made = std::move(status);
      }
    }
    return made;
  };
  auto first = checked(choice.value_or(GraphicsApi::kOpenGl33));
  if (first.ok() || choice) {
    return first;
  }
  auto second = checked(GraphicsApi::kOpenGlEs30);
  if (!second.ok()) {
    second = Status::Error("", first.message() + "\n" + second.message());
  }
  return second;
}

}  // namespace lararium::render
